#include "lambent/synthesis/tangent_field.h"
