#include "lambent/scene/coverage.h"

#include <algorithm>
#include <map>

namespace lambent::scene {
namespace {

const Material& materialOf(const Scene& scene, const Mesh& mesh) {
  static const Material kDefault;
  const bool known = mesh.material >= 0 && std::size_t(mesh.material) < scene.materials.size();
  return known ? scene.materials[std::size_t(mesh.material)] : kDefault;
}

const Texture* textureOf(const Scene& scene, const Mesh& mesh) {
  const int texture = materialOf(scene, mesh).baseColorTexture;
  if (texture < 0 || std::size_t(texture) >= scene.textures.size() || mesh.uvs.empty())
    return nullptr;
  return &scene.textures[std::size_t(texture)];
}

/// Linear interpolation over a triangle.
template <class T>
T between(const std::vector<T>& values, const Triangle& t, float u, float v) {
  return T((1.0f - u - v) * values[t[0]] + u * values[t[1]] + v * values[t[2]]);
}

float leastAlpha(const Texture& texture) {
  std::uint8_t least = 255;
  for (std::size_t i = 3; i < texture.rgba.size(); i += 4) least = std::min(least, texture.rgba[i]);
  return float(least) / 255.0f;
}

}  // namespace

std::vector<Passing> passingsOf(const Scene& scene) {
  std::vector<Passing> passings(scene.meshes.size(), Passing::Nothing);
  std::map<const Texture*, float> known;  // many meshes may share a large one
  for (std::size_t m = 0; m < passings.size(); ++m) {
    const Mesh& mesh = scene.meshes[m];
    const Material& material = materialOf(scene, mesh);
    if (material.transmitted.maxCoeff() > 0.0f) passings[m] = Passing::Shares;
    if (material.alphaMode == AlphaMode::Opaque || passings[m] == Passing::Shares) continue;
    float least = material.opacity;
    if (!mesh.alphas.empty()) least *= *std::min_element(mesh.alphas.begin(), mesh.alphas.end());
    if (const Texture* texture = textureOf(scene, mesh)) {
      const auto [entry, isNew] = known.try_emplace(texture, 1.0f);
      if (isNew) entry->second = leastAlpha(*texture);
      least *= entry->second;
    }
    if (material.alphaMode == AlphaMode::Mask)
      passings[m] = least < material.alphaCutoff ? Passing::Holes : Passing::Nothing;
    else
      passings[m] = least < 1.0f ? Passing::Shares : Passing::Nothing;
  }
  return passings;
}

float coverageAt(const Scene& scene, std::uint32_t meshIndex, std::uint32_t triangle, float u,
                 float v) {
  const Mesh& mesh = scene.meshes[meshIndex];
  const Material& material = materialOf(scene, mesh);
  if (material.alphaMode == AlphaMode::Opaque) return 1.0f;
  const Triangle& corners = mesh.triangles[triangle];
  float alpha = material.opacity;
  if (!mesh.alphas.empty()) alpha *= between(mesh.alphas, corners, u, v);
  if (const Texture* texture = textureOf(scene, mesh))
    alpha *= sampleAlpha(*texture, between(mesh.uvs, corners, u, v));
  if (material.alphaMode == AlphaMode::Mask) return alpha < material.alphaCutoff ? 0.0f : 1.0f;
  return std::clamp(alpha, 0.0f, 1.0f);
}

Rgb passedAt(const Scene& scene, std::uint32_t meshIndex, std::uint32_t triangle, float u,
             float v) {
  const float there = coverageAt(scene, meshIndex, triangle, u, v);
  const Rgb gaps = Rgb::Constant(1.0f - there);
  const Mesh& mesh = scene.meshes[meshIndex];
  const Rgb& transmitted = materialOf(scene, mesh).transmitted;
  if (!(transmitted.maxCoeff() > 0.0f)) return gaps;
  const Triangle& corners = mesh.triangles[triangle];
  Rgb base = Rgb::Ones();
  if (!mesh.colors.empty()) base = between(mesh.colors, corners, u, v);
  if (const Texture* texture = textureOf(scene, mesh))
    base *= sampleBaseColor(*texture, between(mesh.uvs, corners, u, v));
  return gaps + there * transmitted * base;
}

}  // namespace lambent::scene
