// Lamps and an occluder that move around any object, to see captured light at work.
#pragma once

#include "lambent/capture/moving_scene.h"

namespace lambent::capture {

/// Three coloured lamps that go about an object at different heights and speeds, and a dark bar
/// that sweeps by between it and them. Sized by the object's box, which nothing enters; the lamps
/// light it about as much as a sky of radiance 1 does.
MovingScene demoSurroundings(const scene::Box& object);

}  // namespace lambent::capture
