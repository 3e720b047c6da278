// Where a scene that was moved near the origin stood, in a glTF document: three numbers of double
// precision in scene.extras.lambent.origin. Not a node's translation: that would put the positions
// back where floats do not hold them.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "lambent/math/types.h"

namespace lambent::scene_io {

/// The extras of a scene whose (0, 0, 0) lies at `origin`.
nlohmann::json originExtras(const Vec3d& origin);
/// The origin that the document's scene has in its extras; zero if there is none.
Vec3d originOf(const nlohmann::json& document);

}  // namespace lambent::scene_io
