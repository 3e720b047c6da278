#include "lambent/shade/patch_place.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace lambent::shade {

Vec2 patchPlace(const transfer::Patch& patch, const Vec2& uv) {
  if (const transfer::IdMap* map = patch.idMap()) {
    // In this sequence a NaN ends at the border, and not outside of the map.
    const auto texel = [](float coordinate, int size) {
      return int(std::max(0.0f, std::min(float(size - 1), std::floor(coordinate * float(size)))));
    };
    return map->at(texel(uv.x(), map->width), texel(uv.y(), map->height));
  }
  const Vec2 q = patch.tiles().cwiseProduct(Vec2(uv.x(), -uv.y()));
  return q - Vec2(q.array().floor());
}

PatchGradient patchGradient(const transfer::Patch& patch, const Vec2& rttSize,
                            const Mat3& worldFromPatch) {
  return {worldFromPatch.col(0) / (rttSize.x() * patch.scale),
          worldFromPatch.col(1) / (rttSize.y() * patch.scale)};
}

PatchGradient patchGradient(const transfer::Patch& patch, const scene::Mesh& mesh,
                            std::uint32_t triangle) {
  // Of a function with the values f0, f1, f2 at the corners: ((f1 − f0) (e2 × n) … ) / |n|², with
  // the normal n = e1 × e2.
  const auto [i, j, k] = mesh.triangles[triangle];
  const Vec3d e1 = (mesh.positions[j] - mesh.positions[i]).cast<double>();
  const Vec3d e2 = (mesh.positions[k] - mesh.positions[i]).cast<double>();
  const Vec3d n = e1.cross(e2);
  const double area = n.squaredNorm();
  if (!(area > 0.0)) return {};
  const Vec3d along1 = e2.cross(n) / area, along2 = n.cross(e1) / area;
  const Eigen::Vector2d d1 = (mesh.uvs[j] - mesh.uvs[i]).cast<double>();
  const Eigen::Vector2d d2 = (mesh.uvs[k] - mesh.uvs[i]).cast<double>();
  const Vec3d u = d1.x() * along1 + d2.x() * along2, v = d1.y() * along1 + d2.y() * along2;
  PatchGradient gradient{(double(patch.tiles().x()) * u).cast<float>(),
                         (-double(patch.tiles().y()) * v).cast<float>()};
  if (!gradient.x.allFinite() || !gradient.y.allFinite()) return {};
  return gradient;
}

}  // namespace lambent::shade
