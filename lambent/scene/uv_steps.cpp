#include "lambent/scene/uv_steps.h"

#include <Eigen/Geometry>

namespace lambent::scene {

UvSteps uvSteps(const Mesh& mesh, std::uint32_t triangle) {
  const auto [i, j, k] = mesh.triangles[triangle];
  const Vec3d e1 = (mesh.positions[j] - mesh.positions[i]).cast<double>();
  const Vec3d e2 = (mesh.positions[k] - mesh.positions[i]).cast<double>();
  const Vec2d d1 = (mesh.uvs[j] - mesh.uvs[i]).cast<double>();
  const Vec2d d2 = (mesh.uvs[k] - mesh.uvs[i]).cast<double>();
  const double area = d1.x() * d2.y() - d2.x() * d1.y();
  if (area == 0.0) return {};
  const UvSteps steps{((d2.y() * e1 - d1.y() * e2) / area).cast<float>(),
                      ((d1.x() * e2 - d2.x() * e1) / area).cast<float>()};
  if (!steps.u.allFinite() || !steps.v.allFinite()) return {};
  return steps;
}

}  // namespace lambent::scene
