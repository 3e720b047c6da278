#include "lambent/synthesis/meso_offsets.h"

#include <cmath>

#include <Eigen/Geometry>

#include "lambent/work/parallel_for.h"

namespace lambent::synthesis {
namespace {

/// `d` in the frame of a vertex, metres, as long as d.
Vec2 laid(const MesoMesh& mesh, std::uint32_t vertex, const Vec3& d) {
  const Vec3& n = mesh.normals[vertex];
  const Vec3& t = mesh.tangents[vertex];
  const Vec2 flat(d.dot(t), d.dot(n.cross(t)));
  const float length = flat.norm();
  return length > 0.0f ? Vec2(flat * (d.norm() / length)) : Vec2(Vec2::Zero());
}

}  // namespace

std::vector<Vec2> offsetsOf(const MesoMesh& mesh, std::size_t level, const Vec2& patchSize) {
  std::vector<Vec2> offsets(mesh.levels[level].neighbours.size());
  work::parallelRanges(mesh.levelEnd[level], 1024, [&](std::uint32_t begin, std::uint32_t end) {
    for (std::uint32_t i = begin; i < end; ++i) {
      std::size_t k = mesh.levels[level].begin[i];
      for (std::uint32_t j : mesh.neighbours(level, i)) {
        const Vec3 d = mesh.positions[j] - mesh.positions[i];
        const Vec2 there = laid(mesh, i, d), back = laid(mesh, j, -d);
        Vec2 mean = 0.5f * (there - back);
        const float length = mean.norm(), wanted = there.norm();
        // Frames that look against each other, at a singularity: the vertex's own
        // decides.
        mean = length > 0.1f * wanted ? Vec2(mean * (wanted / length)) : there;
        offsets[k++] = mean.cwiseQuotient(patchSize);
      }
    }
  });
  return offsets;
}

}  // namespace lambent::synthesis
