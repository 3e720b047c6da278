// The planes that tangents lie in, and tangents carried from one to another by the least rotation.
#pragma once

#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "lambent/math/types.h"
#include "lambent/scene/shapes.h"

namespace lambent::synthesis {

/// Per vertex, unit: the mesh's own or, where it has none, angle-weighted ones.
inline std::vector<Vec3> normalsOf(const scene::Mesh& mesh) {
  if (mesh.normals.size() == mesh.positions.size()) return mesh.normals;
  scene::Mesh bare;
  bare.positions = mesh.positions, bare.triangles = mesh.triangles;
  scene::computeNormals(bare);
  return std::move(bare.normals);
}

/// `tangent`, at right angles to the unit normal `from`, turned by the least rotation that takes
/// `from` to the unit normal `to`; unit length. Opposite normals leave it as it lies.
inline Vec3 turnedInto(const Vec3& tangent, const Vec3& from, const Vec3& to) {
  const float cosine = from.dot(to);
  Vec3 turned = tangent;
  if (cosine > -0.9999f) turned -= tangent.dot(to) / (1.0f + cosine) * (from + to);
  turned -= turned.dot(to) * to;  // what rounding left
  const float length = turned.norm();
  return length > 1e-6f ? Vec3(turned / length) : Vec3(to.unitOrthogonal());
}

}  // namespace lambent::synthesis
