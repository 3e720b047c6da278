// A little air for the tests of shade and render.
#pragma once

#include "lambent/shade/air.h"

namespace lambent::shade::test {

/// A clear air, resolved coarsely, with the Sun 18° high over +x and the viewer 50 m above the ground.
Air clearAir(double metresPerUnit = 1);

}  // namespace lambent::shade::test
