// This work is based on:
// - veach1997robust: §8.2, sampling by area and its density in solid angle, p_A d²/cos θ.
#include "lambent/reference/emitters.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "lambent/scene/coverage.h"

namespace lambent::reference {

Emitters::Emitters(const scene::Scene& scene) : scene_(scene) {
  double sum = 0;
  for (std::uint32_t m = 0; m < scene.meshes.size(); ++m) {
    const scene::Mesh& mesh = scene.meshes[m];
    const scene::Material& material = scene.materials[std::size_t(mesh.material)];
    if (!material.isEmitter() || material.isMirror()) continue;
    for (std::uint32_t number = 0; number < mesh.triangles.size(); ++number) {
      const scene::Triangle& t = mesh.triangles[number];
      const Vec3 corner = mesh.positions[t[0]];
      const Vec3 edge1 = mesh.positions[t[1]] - corner, edge2 = mesh.positions[t[2]] - corner;
      const Vec3 cross = edge1.cross(edge2);
      const float twiceArea = cross.norm();
      if (!(twiceArea > 0)) continue;
      sum += 0.5 * double(twiceArea) * double(material.emission.mean());
      triangles_.push_back({corner, edge1, edge2, cross / twiceArea, material.emission, m, number});
      cumulative_.push_back(sum);
    }
  }
}

Emitters::Sample Emitters::sample(const Vec2& place, float choice) const {
  assert(!empty());
  const auto found =
      std::upper_bound(cumulative_.begin(), cumulative_.end(), double(choice) * cumulative_.back());
  const auto at = std::min(std::size_t(found - cumulative_.begin()), triangles_.size() - 1);
  const Triangle& triangle = triangles_[at];
  const float root = std::sqrt(place.x());
  const float u = 1 - root, v = place.y() * root;
  return {triangle.corner + u * triangle.edge1 + v * triangle.edge2, triangle.normal,
          triangle.emission, scene::coverageAt(scene_, triangle.mesh, triangle.triangle, u, v)};
}

// A triangle is drawn by area times mean emission and a point of it evenly: per area, the density
// is the emission's mean over the sum, whatever the triangle.
float Emitters::pdf(const Rgb& emission, float distance, float cosine) const {
  if (!(cosine > 0)) return std::numeric_limits<float>::infinity();
  return float(double(emission.mean()) / cumulative_.back()) * distance * distance / cosine;
}

}  // namespace lambent::reference
