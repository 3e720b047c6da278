// One level's corrections: every vertex takes the place of the patch that fits its neighbours best.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "lambent/synthesis/meso_mesh.h"
#include "lambent/synthesis/similar_places.h"

namespace lambent::synthesis {

class Correction {
 public:
  /// `offsets` as of offsetsOf; all must outlive this.
  Correction(const MesoMesh& mesh, std::size_t level, std::span<const Vec2> offsets,
             const PatchLevel& patch, const Vec2& patchSize);

  /// One pass over all vertices of the level. Vertices fall into four classes by chance; those of a
  /// class are corrected at once, from what stood there before the class had its turn. So the
  /// result does not depend on the number of threads.
  void pass(std::vector<Vec2>& q) const;

 private:
  Vec2 corrected(std::uint32_t vertex, const std::vector<Vec2>& q) const;

  const MesoMesh& mesh_;
  std::size_t level_;
  std::span<const Vec2> offsets_;
  const PatchLevel& patch_;
  Vec2 patchSize_;
  float least_;  ///< metres: places nearer to each other than that are one
  float stray_;  ///< squared descriptor distance that a neighbour off its continuation costs
  std::array<std::vector<std::uint32_t>, 4> classes_;
};

}  // namespace lambent::synthesis
