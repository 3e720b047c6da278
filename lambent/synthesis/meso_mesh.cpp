#include "lambent/synthesis/meso_mesh.h"
