#include "lambent/bi_scale/tint.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <string>
#include <vector>

#include "lambent/bi_scale/quoted_mesh.h"
#include "lambent/radiometry/srgb.h"
#include "lambent/scene/texel_map.h"

namespace lambent::bi_scale {

namespace {

/// What a surface sends back in all: glTF's base colour, of metals too.
Rgb factorOf(const scene::Material& material) {
  return (material.diffuse + material.glossy).max(0.0f).min(1.0f);
}

/// Twice the area that a triangle covers by `uvs`.
double twiceArea(std::span<const Vec2> uvs, const scene::Triangle& t) {
  const Vec2d a = uvs[t[0]].cast<double>();
  const Vec2d b = uvs[t[1]].cast<double>() - a, c = uvs[t[2]].cast<double>() - a;
  return std::abs(b.x() * c.y() - b.y() * c.x());
}

/// Texels a side that show `from` as finely as it is in the mean.
double finestSide(const scene::Texture& from, std::span<const Vec2> uvs, const scene::Mesh& mesh) {
  double texels = 0.0, area = 0.0;
  for (const scene::Triangle& t : mesh.triangles) {
    texels += twiceArea(uvs, t) * from.width * from.height;
    area += twiceArea(mesh.uvs, t);
  }
  return area > 0.0 ? std::sqrt(texels / area) : 0.0;
}

std::uint8_t srgbCode(float linear) {
  return std::uint8_t(std::lround(255.0f * std::clamp(radiometry::srgbEncode(linear), 0.0f, 1.0f)));
}

}  // namespace

Result<Findings> wearPatch(scene::Scene& scene, std::uint32_t index, std::string_view name,
                           const Rgb& reflectance, const Tint& tint) {
  scene::Mesh& mesh = scene.meshes[index];
  const scene::Material old = scene.materials[std::size_t(mesh.material)];
  const bool varies = old.baseColorTexture >= 0 || !mesh.colors.empty();
  const bool keeps = std::holds_alternative<OwnTint>(tint);
  Findings findings;
  const auto note = [&](const char* code, const char* what) {
    findings.push_back({Severity::Note, code, quoted(mesh, index) + ": " + what, 1});
  };
  if (old.source >= 0 && keeps)
    note("material-replaced",
         "its material gives way to the patch's, but for its base colour, which tints it");
  else if (old.source >= 0)
    note("material-replaced",
         "its material, with its name and textures, gives way to the patch's (--tint own would "
         "keep its base colour)");
  else if (varies && !keeps)
    note("colours-replaced",
         "its texture or vertex colours give way to the patch's (--tint own would keep them)");
  if (keeps && !varies)
    note("tint-even",
         "has neither a texture nor vertex colours: its tint is its material's colour everywhere");

  scene::Material material;
  material.name = name;
  material.diffuse = reflectance;
  if (keeps) {
    material.baseColorTexture = old.baseColorTexture;
    const Rgb factor = factorOf(old);
    if ((factor != Rgb::Ones()).any()) {
      mesh.colors.resize(mesh.positions.size(), Rgb::Ones());
      for (Rgb& color : mesh.colors) color *= factor;
    }
  } else {
    mesh.colors.clear();
  }
  if (const auto* picture = std::get_if<PictureTint>(&tint)) {
    if (mesh.uvs.empty())
      return report::badInput(quoted(mesh, index) +
                              " has no texture coordinates for the tint's picture to lie over: "
                              "give it some, or colours at its vertices and --tint own");
    material.baseColorTexture = picture->texture;
  }
  mesh.material = int(scene.materials.size());
  scene.materials.push_back(std::move(material));
  return findings;
}

scene::Texture laidOut(const scene::Texture& from, std::span<const Vec2> uvs,
                       const scene::Mesh& mesh, int least, int most) {
  assert(0 < least && least <= most);
  assert(uvs.size() == mesh.positions.size() && mesh.uvs.size() == mesh.positions.size());
  const double finest = finestSide(from, uvs, mesh);
  const int side = int(std::clamp(std::ceil(finest), double(least), double(most)));
  // Two samples a texel of the source and way, as far as that is affordable.
  const int samples = int(std::clamp(std::ceil(2.0 * finest / side), 1.0, 4.0));

  scene::Mesh flat;  // without the texel UVs that may stand beside
  flat.uvs = mesh.uvs;
  const std::size_t texels = std::size_t(side) * std::size_t(side);
  std::vector<Rgb> sums(texels, Rgb::Zero());
  std::vector<float> alphas(texels, 0.0f);
  std::vector<std::uint32_t> counts(texels, 0);
  for (const scene::Triangle& t : mesh.triangles)
    scene::visitTexels(
        flat, t, side * samples, side * samples, [&](int x, int y, double u, double v) {
          const std::size_t texel = std::size_t(y / samples) * side + std::size_t(x / samples);
          const Vec2 uv =
              float(1.0 - u - v) * uvs[t[0]] + float(u) * uvs[t[1]] + float(v) * uvs[t[2]];
          sums[texel] += scene::sampleBaseColor(from, uv);
          alphas[texel] += scene::sampleAlpha(from, uv);
          ++counts[texel];
        });
  std::vector<std::uint8_t> full(texels);
  for (std::size_t i = 0; i < texels; ++i) full[i] = counts[i] > 0;
  const std::vector<std::uint32_t> nearest = scene::nearestFull(side, side, full);

  scene::Texture to;
  to.name = from.name;
  to.width = to.height = side;
  to.wrapU = to.wrapV = scene::Wrap::ClampToEdge;
  to.rgba.resize(4 * texels, 255);
  for (std::size_t i = 0; i < texels; ++i) {
    if (nearest[i] == scene::kNobody) continue;
    const float count = float(counts[nearest[i]]);
    const Rgb mean = sums[nearest[i]] / count;
    for (std::size_t c = 0; c < 3; ++c) to.rgba[4 * i + c] = srgbCode(mean[Eigen::Index(c)]);
    to.rgba[4 * i + 3] = std::uint8_t(std::lround(255.0f * alphas[nearest[i]] / count));
  }
  return to;
}

}  // namespace lambent::bi_scale
