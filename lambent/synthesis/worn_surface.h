// A surface that wears a patch, as an asset holds it, texel by texel of its id map: what measures of
// a result stand on, whatever has laid the patch out.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lambent/math/types.h"
#include "lambent/scene/scene.h"
#include "lambent/transfer/id_map.h"

namespace lambent::synthesis {

struct Worn {
  const scene::Mesh& mesh;         ///< with UVs over the id map
  std::span<const Vec3> tangents;  ///< of its vertices, the patch's +x: unit, world space
  const transfer::IdMap& map;
  Vec2 period;  ///< metres of the surface that the patch's period covers
};

/// The texels whose centres lie on the surface, and which are next to each other there: beside each
/// other in a chart, or on either side of a border of charts that is no border of the surface.
struct WornTexels {
  std::vector<Vec3> positions, normals;
  std::vector<Vec3> along, across;  ///< unit: the patch's +x and +y in the surface
  std::vector<Vec2> places;         ///< q, as the id map has it
  std::vector<float> areas;         ///< m² of the surface that a texel stands for
  std::vector<std::uint8_t> atEnd;  ///< whether the surface ends here

  /// Two texels next to each other; each pair comes once, a < b.
  struct Step {
    std::uint32_t a = 0, b = 0;
    float width = 0.0f;  ///< metres of the line on which they meet
  };
  std::vector<Step> steps;  ///< by rising a, then b

  std::size_t size() const { return positions.size(); }
};

WornTexels texelsOf(const Worn& worn);

/// `d` (world) in the frame of a texel, metres, as long as d.
Vec2 laidAt(const WornTexels& texels, std::uint32_t texel, const Vec3& d);

}  // namespace lambent::synthesis
