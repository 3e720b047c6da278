#include "lambent/synthesis/atlas.h"
