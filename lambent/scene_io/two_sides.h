// Backs for surfaces that have two sides.
#pragma once

#include <string>
#include <vector>

#include "lambent/file/budget.h"
#include "lambent/report/result.h"
#include "lambent/scene/scene.h"
#include "lambent/scene_io/diagnosis.h"
#include "lambent/scene_io/load.h"

namespace lambent::scene_io {

/// Gives the meshes that `sides` means a back of their own (scene::withBacks), and takes the flag
/// from their materials: each side is a front now. Returns which meshes were given one. What bounds
/// a body, alone or with other meshes that say they have two sides, is not open: nobody sees its
/// inside. BadInput where the file's budget ends; `name` is the file's.
Result<std::vector<bool>> giveBacks(scene::Scene& scene, Sides sides, const std::string& name,
                                    file::Budget& budget, Diagnosis& diagnosis);

}  // namespace lambent::scene_io
