// Operations on whole meshes: transforms, merging, normals.
#include <algorithm>
#include <cassert>
#include <cmath>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "lambent/scene/shapes.h"

namespace lambent::scene {

Mesh transformed(Mesh mesh, const Mat4& dstFromSrc) {
  return transformed(std::move(mesh), Eigen::Matrix4d(dstFromSrc.cast<double>()));
}

Mesh transformed(Mesh mesh, const Eigen::Matrix4d& dstFromSrc) {
  const Mat3d linear = dstFromSrc.topLeftCorner<3, 3>();
  const Vec3d translation = dstFromSrc.topRightCorner<3, 1>();
  const double determinant = linear.determinant();
  // The cofactor matrix is the inverse transpose times the determinant: it turns normals rightly
  // even where one axis is scaled to nothing. Its sign is the determinant's.
  Mat3d cofactor;
  cofactor.col(0) = linear.col(1).cross(linear.col(2));
  cofactor.col(1) = linear.col(2).cross(linear.col(0));
  cofactor.col(2) = linear.col(0).cross(linear.col(1));
  if (determinant < 0.0) cofactor = -cofactor;
  for (Vec3& p : mesh.positions) p = (linear * p.cast<double>() + translation).cast<float>();
  for (Vec3& n : mesh.normals) {
    const Vec3d turned = cofactor * n.cast<double>();
    const double length = turned.norm();
    n = length > 0.0 ? Vec3((turned / length).cast<float>()) : Vec3(Vec3::Zero());
  }
  transformTangents(mesh.others, linear);
  if (determinant < 0.0) {
    for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
  }
  return mesh;
}

Mesh translated(Mesh mesh, const Vec3& offset) {
  for (Vec3& p : mesh.positions) p += offset;
  return mesh;
}

Mesh scaled(Mesh mesh, const Vec3& factors) {
  Mat4 m = Mat4::Identity();
  m.diagonal().head<3>() = factors;
  return transformed(std::move(mesh), m);
}

Mesh rotated(Mesh mesh, const Vec3& axis, float radians) {
  Mat4 m = Mat4::Identity();
  m.topLeftCorner<3, 3>() =
      Eigen::AngleAxisd(double(radians), axis.cast<double>().normalized()).matrix().cast<float>();
  return transformed(std::move(mesh), m);
}

Mesh flipped(Mesh mesh) {
  for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
  for (Vec3& n : mesh.normals) n = -n;
  std::erase_if(mesh.others, [](const VertexNumbers& n) { return n.areTangents(); });
  return mesh;
}

std::vector<std::uint32_t> dropUnusedVertices(Mesh& mesh) {
  constexpr std::uint32_t kUnused = 0xffffffffu;
  std::vector<std::uint32_t> newFromOld(mesh.positions.size(), kUnused);
  for (const Triangle& t : mesh.triangles)
    for (const std::uint32_t v : t) newFromOld[v] = 0;
  std::vector<std::uint32_t> oldFromNew;
  oldFromNew.reserve(mesh.positions.size());
  for (std::size_t i = 0; i < newFromOld.size(); ++i) {
    if (newFromOld[i] == kUnused) continue;
    newFromOld[i] = std::uint32_t(oldFromNew.size());
    oldFromNew.push_back(std::uint32_t(i));
  }
  if (oldFromNew.size() == newFromOld.size()) return oldFromNew;
  const auto keep = [&](auto& values) {
    if (values.empty()) return;
    for (std::size_t i = 0; i < oldFromNew.size(); ++i) values[i] = values[oldFromNew[i]];
    values.resize(oldFromNew.size());
    values.shrink_to_fit();
  };
  keep(mesh.positions);
  keep(mesh.normals);
  keep(mesh.uvs);
  keep(mesh.texelUvs);
  keep(mesh.colors);
  keep(mesh.alphas);
  takeVertices(mesh.others, oldFromNew);
  for (Triangle& t : mesh.triangles)
    for (std::uint32_t& v : t) v = newFromOld[v];
  return oldFromNew;
}

Mesh merge(std::span<const Mesh> parts) {
  Mesh whole;
  if (parts.empty()) return whole;
  whole.name = parts[0].name;
  whole.material = parts[0].material;
  bool normals = true, uvs = true, texelUvs = true, colors = true, alphas = true;
  for (const Mesh& part : parts) {
    if (part.positions.empty()) continue;
    normals = normals && !part.normals.empty();
    uvs = uvs && !part.uvs.empty();
    texelUvs = texelUvs && !part.texelUvs.empty();
    colors = colors && !part.colors.empty();
    alphas = alphas && !part.alphas.empty();
  }
  for (const Mesh& part : parts) {
    const auto first = std::uint32_t(whole.positions.size());
    const auto append = [](auto& to, const auto& from) {
      to.insert(to.end(), from.begin(), from.end());
    };
    append(whole.positions, part.positions);
    if (normals) append(whole.normals, part.normals);
    if (uvs) append(whole.uvs, part.uvs);
    if (texelUvs) append(whole.texelUvs, part.texelUvs);
    if (colors) append(whole.colors, part.colors);
    if (alphas) append(whole.alphas, part.alphas);
    for (const auto& [a, b, c] : part.triangles) {
      whole.triangles.push_back({a + first, b + first, c + first});
    }
  }
  return whole;
}

Scene sceneOf(Mesh mesh, Material material) {
  Scene scene;
  addTo(scene, std::move(mesh), std::move(material));
  return scene;
}

std::uint32_t addTo(Scene& scene, Mesh mesh, Material material) {
  mesh.material = int(scene.materials.size());
  scene.materials.push_back(std::move(material));
  scene.meshes.push_back(std::move(mesh));
  return std::uint32_t(scene.meshes.size() - 1);
}

std::size_t computeNormals(Mesh& mesh, std::span<const std::uint32_t> groups) {
  const std::size_t count = mesh.positions.size();
  assert(groups.empty() || groups.size() == count);
  std::size_t groupCount = count;
  if (!groups.empty()) {
    groupCount = 0;
    for (std::uint32_t g : groups) groupCount = std::max(groupCount, std::size_t(g) + 1);
  }
  const auto groupOf = [&](std::uint32_t v) { return groups.empty() ? v : groups[v]; };
  const auto position = [&](std::uint32_t v) -> Vec3d { return mesh.positions[v].cast<double>(); };

  std::vector<Vec3d> sums(groupCount, Vec3d::Zero());
  for (const Triangle& t : mesh.triangles) {
    const Vec3d p[3] = {position(t[0]), position(t[1]), position(t[2])};
    const Vec3d cross = (p[1] - p[0]).cross(p[2] - p[0]);
    const double area = cross.norm();
    if (!(area > 0.0)) continue;
    const Vec3d normal = cross / area;
    for (int corner = 0; corner < 3; ++corner) {
      const Vec3d a = p[(corner + 1) % 3] - p[corner], b = p[(corner + 2) % 3] - p[corner];
      sums[groupOf(t[corner])] += std::atan2(area, a.dot(b)) * normal;
    }
  }
  // Two sides of a folded sheet cancel: there the largest triangle decides.
  constexpr double kCancelled = 1e-6;
  std::vector<double> largest;
  for (const Triangle& t : mesh.triangles) {
    for (std::uint32_t v : t) {
      const std::uint32_t g = groupOf(v);
      if (sums[g].norm() > kCancelled && (largest.empty() || largest[g] == 0.0)) continue;
      if (largest.empty()) largest.resize(groupCount, 0.0);
      const Vec3d a = position(t[0]);
      const Vec3d cross = (position(t[1]) - a).cross(position(t[2]) - a);
      const double area = cross.norm();
      if (area > largest[g]) {
        largest[g] = area;
        sums[g] = cross / area;
      }
    }
  }
  mesh.normals.resize(count);
  std::size_t without = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3d& sum = sums[groupOf(std::uint32_t(i))];
    const double length = sum.norm();
    if (length > kCancelled) {
      mesh.normals[i] = (sum / length).cast<float>();
    } else {
      mesh.normals[i] = Vec3::UnitY();
      ++without;
    }
  }
  return without;
}

}  // namespace lambent::scene
