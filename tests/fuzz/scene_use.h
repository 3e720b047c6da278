// What becomes of a scene once it is read.
#pragma once

#include "lambent/scene/scene.h"

namespace lambent::fuzz {

/// What scene_io::load() promises: indices in range, unit normals, finite numbers, no empty scene.
void requireSound(const scene::Scene& scene);

/// Looks at a sound scene as a bake and a picture do, writes it as .glb and reads that again.
void use(const scene::Scene& scene);

}  // namespace lambent::fuzz
