// A patch of meso-structure as a plain value: what an RTT is built from.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "lambent/report/finding.h"
#include "lambent/report/result.h"
#include "lambent/scene/scene.h"

namespace lambent::meso {

/// A small piece of surface with depth that repeats itself without end (sloan2003biscale §4.2).
///
/// Its geometry is a scene in the patch's frame, which is the frame of the RTT: +x along the patch,
/// +y along the patch, +z away from the surface, metres. The surface is the union of the scene's
/// translates by all whole multiples of `size` in x and y: triangles may reach over the period, and
/// it does not matter where the scene lies in x and y. Fronts (counter-clockwise) are lit; backs
/// block light and give none. Materials are diffuse, glossy or both, never mirrors.
struct Patch {
  std::string name;
  scene::Scene scene;
  Vec2 size = Vec2(0.1f, 0.1f);  ///< metres: the period along x and y
  /// Diffuse reflectance of an opaque plane just under the lowest point, for geometry that is not
  /// closed below (a weave); none: nothing can be seen through the patch.
  std::optional<Rgb> backing;

  std::size_t triangleCount() const;
};

/// How far the geometry reaches in z, metres.
struct Extent {
  float lowest = 0.0f, highest = 0.0f;
  float depth() const { return highest - lowest; }
  float middle() const { return 0.5f * (lowest + highest); }  ///< where the sampling plane lies
};
Extent extentOf(const Patch& patch);

/// Whether an RTT can be built from the patch. BadInput: no triangles, a period that is not a
/// positive number, positions that are not finite, triangles that name vertices or materials that
/// do not exist, mirrors, reflectances outside [0, 1]. Otherwise what there is to say: a warning
/// where the patch is deeper than half its period, for which a grid of views is too coarse.
Result<Findings> check(const Patch& patch);

}  // namespace lambent::meso
