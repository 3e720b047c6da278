#include "lambent/synthesis/synthesize.h"
