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
  const Vec2d d1 = (mesh.uvs[j] - mesh.uvs[i]).cast<double>();
  const Vec2d d2 = (mesh.uvs[k] - mesh.uvs[i]).cast<double>();
  const Vec3d u = d1.x() * along1 + d2.x() * along2, v = d1.y() * along1 + d2.y() * along2;
  PatchGradient gradient{(double(patch.tiles().x()) * u).cast<float>(),
                         (-double(patch.tiles().y()) * v).cast<float>()};
  if (!gradient.x.allFinite() || !gradient.y.allFinite()) return {};
  return gradient;
}

PatchPlaces patchPlaces(const transfer::Patch& patch, const Vec2& uv, const scene::UvSteps& steps,
                        const PatchGradient& gradient) {
  PatchPlaces places;
  const transfer::IdMap* map = patch.idMap();
  if (!map) {
    places.add(patchPlace(patch, uv), 1.0f);
    return places;
  }
  // In this sequence a NaN ends at the border, and not outside of the map.
  const auto within = [](float coordinate, int size) {
    return std::max(0.0f, std::min(float(size - 1), coordinate * float(size) - 0.5f));
  };
  const Vec2 at(within(uv.x(), map->width), within(uv.y(), map->height));
  const int left = int(at.x()), top = int(at.y());
  const int right = std::min(left + 1, map->width - 1), bottom = std::min(top + 1, map->height - 1);
  const Vec2 part(at.x() - float(left), at.y() - float(top));
  // How q changes from a texel to the next.
  const Vec2 alongX = Vec2(gradient.x.dot(steps.u), gradient.y.dot(steps.u)) / float(map->width);
  const Vec2 alongY = Vec2(gradient.x.dot(steps.v), gradient.y.dot(steps.v)) / float(map->height);
  const Vec2 same = alongX.cwiseAbs() + alongY.cwiseAbs() + Vec2::Constant(0x1p-15f);
  std::array<Vec2, 4> q;
  std::array<float, 4> weight;
  for (int k = 0; k < 4; ++k) {
    const float x = float(k & 1), y = float(k >> 1);
    q[k] = map->at(k & 1 ? right : left, k >> 1 ? bottom : top) + (part.x() - x) * alongX +
           (part.y() - y) * alongY;
    weight[k] = (k & 1 ? part.x() : 1 - part.x()) * (k >> 1 ? part.y() : 1 - part.y());
  }
  for (int k = 0; k < 4; ++k) {
    if (weight[k] == 0.0f) continue;
    float share = 0.0f;
    Vec2 sum = Vec2::Zero();
    for (int m = k; m < 4; ++m) {
      const Vec2 apart = q[m] - q[k], wrapped = apart - Vec2((apart.array() + 0.5f).floor());
      if ((wrapped.cwiseAbs().array() > same.array()).any()) continue;
      share += weight[m], sum += weight[m] * wrapped;
      if (m > k) weight[m] = 0.0f;
    }
    places.add(q[k] + sum / share, share);
  }
  return places;
}

}  // namespace lambent::shade
