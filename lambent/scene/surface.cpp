// Points of surfaces with their material evaluated: bounds, base colour, normals.
#include <algorithm>
#include <cassert>
#include <cmath>

#include <Eigen/Geometry>

#include "lambent/radiometry/srgb.h"
#include "lambent/scene/scene.h"

namespace lambent::scene {
namespace {

/// The sRGB decoding of all 256 texel values (IEC 61966-2-1), so that filtering is of light and
/// not of code values, as sRGB textures on a GPU do it.
struct SrgbTable {
  std::array<float, 256> linear;
  SrgbTable() {
    for (int i = 0; i < 256; ++i) linear[i] = radiometry::srgbDecode(float(i) / 255.0f);
  }
};

const SrgbTable& srgbTable() {
  static const SrgbTable table;
  return table;
}

/// Integer texel coordinate under a wrapping rule → 0 … size−1.
int wrapTexel(std::int64_t i, int size, Wrap wrap) {
  switch (wrap) {
    case Wrap::ClampToEdge:
      return int(std::clamp<std::int64_t>(i, 0, size - 1));
    case Wrap::MirroredRepeat: {
      std::int64_t k = i % (2 * std::int64_t(size));
      if (k < 0) k += 2 * std::int64_t(size);
      return int(k < size ? k : 2 * std::int64_t(size) - 1 - k);
    }
    case Wrap::Repeat:
      break;
  }
  const std::int64_t k = i % size;
  return int(k < 0 ? k + size : k);
}

struct Taps {
  int first, second;
  float weight;  ///< of the second
};

Taps filterTaps(float coordinate, int size, Wrap wrap) {
  // Far outside [0, 1] a float has no fraction left to filter with; such coordinates are nonsense
  // in a file, and must only not overflow here.
  const float limit = 1e6f;
  const float c = std::isfinite(coordinate) ? std::clamp(coordinate, -limit, limit) : 0.0f;
  const double x = double(c) * size - 0.5;
  const double base = std::floor(x);
  const auto i = std::int64_t(base);
  return {wrapTexel(i, size, wrap), wrapTexel(i + 1, size, wrap), float(x - base)};
}

Vec3 unitOr(const Vec3& v, const Vec3& fallback) {
  const float length = v.norm();
  return length > 1e-20f && std::isfinite(length) ? Vec3(v / length) : fallback;
}

/// Texture × vertex colour.
Rgb baseColor(const Scene& scene, const Mesh& mesh, const Vec2& uv, const Rgb& color) {
  const int texture = materialOf(scene, mesh).baseColorTexture;
  const bool has =
      texture >= 0 && std::size_t(texture) < scene.textures.size() && !mesh.uvs.empty();
  return has ? Rgb(color * sampleBaseColor(scene.textures[texture], uv)) : color;
}

/// Texture × vertex colour into the reflectances of the mesh's material.
void applyMaterial(const Scene& scene, const Mesh& mesh, const Vec2& uv, const Rgb& color,
                   SurfacePoint& point) {
  const Material& material = materialOf(scene, mesh);
  const Rgb base = baseColor(scene, mesh, uv, color);
  point.uv = point.texelUv = uv;
  point.diffuse = material.diffuse * base;
  point.glossy = material.glossy * base;
  point.mirror = material.mirror * base;
  point.lobeExponent = material.lobeExponent;
  point.emission = material.emission;
}

}  // namespace

const Material& materialOf(const Scene& scene, const Mesh& mesh) {
  static const Material kDefault;
  const bool known = mesh.material >= 0 && std::size_t(mesh.material) < scene.materials.size();
  return known ? scene.materials[std::size_t(mesh.material)] : kDefault;
}

Box bounds(const Mesh& mesh) {
  Box box;
  for (const Vec3& p : mesh.positions) box.extend(p);
  return box;
}

Box bounds(const Scene& scene) {
  Box box;
  for (const Mesh& mesh : scene.meshes) {
    if (mesh.positions.empty()) continue;
    const Box own = bounds(mesh);
    box.extend(own.lower);
    box.extend(own.upper);
  }
  return box;
}

Rgb sampleBaseColor(const Texture& texture, const Vec2& uv) {
  const int w = texture.width, h = texture.height;
  if (w <= 0 || h <= 0 || texture.rgba.size() < 4 * std::size_t(w) * std::size_t(h)) {
    return Rgb::Ones();
  }
  const Taps tx = filterTaps(uv.x(), w, texture.wrapU);
  const Taps ty = filterTaps(uv.y(), h, texture.wrapV);
  const auto& table = srgbTable().linear;
  const auto texel = [&](int x, int y) -> Rgb {
    const std::uint8_t* t = texture.rgba.data() + 4 * (std::size_t(y) * w + x);
    return {table[t[0]], table[t[1]], table[t[2]]};
  };
  const Rgb top = (1.0f - tx.weight) * texel(tx.first, ty.first) +  //
                  tx.weight * texel(tx.second, ty.first);
  const Rgb bottom =
      (1.0f - tx.weight) * texel(tx.first, ty.second) + tx.weight * texel(tx.second, ty.second);
  return (1.0f - ty.weight) * top + ty.weight * bottom;
}

float sampleAlpha(const Texture& texture, const Vec2& uv) {
  const int w = texture.width, h = texture.height;
  if (w <= 0 || h <= 0 || texture.rgba.size() < 4 * std::size_t(w) * std::size_t(h)) return 1.0f;
  const Taps tx = filterTaps(uv.x(), w, texture.wrapU);
  const Taps ty = filterTaps(uv.y(), h, texture.wrapV);
  const auto texel = [&](int x, int y) {
    return float(texture.rgba[4 * (std::size_t(y) * w + x) + 3]) / 255.0f;
  };
  const float top = (1.0f - tx.weight) * texel(tx.first, ty.first) +  //
                    tx.weight * texel(tx.second, ty.first);
  const float bottom =
      (1.0f - tx.weight) * texel(tx.first, ty.second) + tx.weight * texel(tx.second, ty.second);
  return (1.0f - ty.weight) * top + ty.weight * bottom;
}

SurfacePoint surfaceAt(const Scene& scene, std::uint32_t meshIndex, std::uint32_t triangle, float u,
                       float v) {
  assert(meshIndex < scene.meshes.size());
  const Mesh& mesh = scene.meshes[meshIndex];
  assert(triangle < mesh.triangles.size());
  const auto [i, j, k] = mesh.triangles[triangle];
  const float w = 1.0f - u - v;

  SurfacePoint point;
  const Vec3 &a = mesh.positions[i], &b = mesh.positions[j], &c = mesh.positions[k];
  point.position = w * a + u * b + v * c;
  const Vec3 cross = (b - a).cross(c - a);
  Vec3 shading = Vec3::Zero();
  if (!mesh.normals.empty()) {
    shading = w * mesh.normals[i] + u * mesh.normals[j] + v * mesh.normals[k];
  }
  const Vec3 fallback = unitOr(shading, Vec3::UnitY());
  point.geometricNormal = unitOr(cross, fallback);
  point.normal = unitOr(shading, point.geometricNormal);
  // Interpolation at a sharp silhouette can lean behind the triangle: mirrored to its front, which
  // stays continuous where it just reaches the triangle's plane.
  const float side = point.normal.dot(point.geometricNormal);
  if (side < 0.0f) {
    const Vec3 mirrored = point.normal - 2.0f * side * point.geometricNormal;
    point.normal = unitOr(mirrored, point.geometricNormal);
  }
  Vec2 uv = Vec2::Zero();
  if (!mesh.uvs.empty()) uv = w * mesh.uvs[i] + u * mesh.uvs[j] + v * mesh.uvs[k];
  Rgb color = Rgb::Ones();
  if (!mesh.colors.empty()) color = w * mesh.colors[i] + u * mesh.colors[j] + v * mesh.colors[k];
  applyMaterial(scene, mesh, uv, color, point);
  if (!mesh.texelUvs.empty())
    point.texelUv = w * mesh.texelUvs[i] + u * mesh.texelUvs[j] + v * mesh.texelUvs[k];
  return point;
}

Rgb baseColorAt(const Scene& scene, std::uint32_t meshIndex, std::uint32_t triangle, float u,
                float v) {
  const Mesh& mesh = scene.meshes[meshIndex];
  const auto [i, j, k] = mesh.triangles[triangle];
  const float w = 1.0f - u - v;
  Vec2 uv = Vec2::Zero();
  if (!mesh.uvs.empty()) uv = w * mesh.uvs[i] + u * mesh.uvs[j] + v * mesh.uvs[k];
  Rgb color = Rgb::Ones();
  if (!mesh.colors.empty()) color = w * mesh.colors[i] + u * mesh.colors[j] + v * mesh.colors[k];
  return baseColor(scene, mesh, uv, color);
}

SurfacePoint surfaceAtVertex(const Scene& scene, std::uint32_t meshIndex, std::uint32_t vertex) {
  assert(meshIndex < scene.meshes.size());
  const Mesh& mesh = scene.meshes[meshIndex];
  assert(vertex < mesh.positions.size());
  SurfacePoint point;
  point.position = mesh.positions[vertex];
  point.normal =
      mesh.normals.empty() ? Vec3(Vec3::UnitY()) : unitOr(mesh.normals[vertex], Vec3::UnitY());
  point.geometricNormal = point.normal;
  const Vec2 uv = mesh.uvs.empty() ? Vec2(Vec2::Zero()) : mesh.uvs[vertex];
  const Rgb color = mesh.colors.empty() ? Rgb(Rgb::Ones()) : mesh.colors[vertex];
  applyMaterial(scene, mesh, uv, color, point);
  if (!mesh.texelUvs.empty()) point.texelUv = mesh.texelUvs[vertex];
  return point;
}

}  // namespace lambent::scene
