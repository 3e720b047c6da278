#include "lambent/synthesis/appearance.h"
