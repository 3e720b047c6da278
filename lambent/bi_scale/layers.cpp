#include "lambent/bi_scale/layers.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <Eigen/Geometry>

#include "lambent/bi_scale/quoted_mesh.h"
#include "lambent/scene/coverage.h"
#include "lambent/scene/layers.h"

namespace lambent::bi_scale {

namespace {

constexpr double kPlaces = 100000.0;  ///< of a surface, asked what is seen there
/// Fractions of a sequence that fills the square evenly: powers of the plastic number.
constexpr double kAlongU = 0.7548776662466927, kAlongV = 0.5698402909980532;

}  // namespace

Result<std::optional<Layer>> addLayer(scene::Scene& scene, std::uint32_t base,
                                      std::string_view name, const Rgb& reflectance,
                                      const Mask& mask, const Tint& tint) {
  if (scene.meshes[base].uvs.empty())
    return report::badInput(quoted(scene.meshes[base], base) +
                            " has no texture coordinates for the mask to lie over: unwrap it where "
                            "it was made, or give patches to meshes of their own");
  Layer layer;
  layer.mesh = std::uint32_t(scene.meshes.size());
  layer.base = base;
  scene.meshes.push_back(scene::Mesh(scene.meshes[base]));
  scene::Mesh& mesh = scene.meshes.back();
  mesh.layer = true;
  mesh.name += (mesh.name.empty() ? "" : ": ") + std::string(name);
  // What it finds is said of the mesh below.
  if (auto worn = wearPatch(scene, layer.mesh, name, reflectance, tint); !worn) return worn.error();

  scene::Material& material = scene.materials.back();
  const int color = material.baseColorTexture;
  scene::Texture alpha = scene::masked(color < 0 ? nullptr : &scene.textures[std::size_t(color)],
                                       mask.picture, mask.channel);
  layer.triangles = scene::trianglesWithAlpha(mesh, alpha);
  if (layer.triangles.empty()) {
    scene.meshes.pop_back();
    return std::optional<Layer>();
  }
  material.alphaMode = scene::AlphaMode::Blend;
  material.baseColorTexture = int(scene.textures.size());
  scene.textures.push_back(std::move(alpha));
  return std::optional(std::move(layer));
}

std::vector<double> sharesSeen(const scene::Scene& scene, std::uint32_t base,
                               std::span<const std::uint32_t> layers) {
  const scene::Mesh& mesh = scene.meshes[base];
  std::vector<double> areas;
  double whole = 0.0;
  for (const auto& [i, j, k] : mesh.triangles) {
    const Vec3 &a = mesh.positions[i], &b = mesh.positions[j], &c = mesh.positions[k];
    whole += areas.emplace_back(0.5 * double((b - a).cross(c - a).norm()));
  }
  std::vector<double> shares(1 + layers.size(), 0.0);
  if (!(whole > 0.0)) return shares;
  std::uint64_t number = 0;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const int places = int(std::ceil(kPlaces * areas[t] / whole));
    for (int i = 0; i < places; ++i, ++number) {
      double u = std::fmod(double(number) * kAlongU, 1.0);
      double v = std::fmod(double(number) * kAlongV, 1.0);
      if (u + v > 1.0) u = 1.0 - u, v = 1.0 - v;
      double through = areas[t] / whole / places;
      for (std::size_t k = layers.size(); k-- > 0;) {
        const double there = scene::coverageAt(scene, layers[k], t, float(u), float(v));
        shares[k + 1] += through * there;
        through *= 1.0 - there;
      }
      shares[0] += through;
    }
  }
  return shares;
}

}  // namespace lambent::bi_scale
