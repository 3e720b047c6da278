#include "lambent/synthesis/place_ids.h"
