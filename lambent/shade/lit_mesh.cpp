#include "lambent/shade/lit_mesh.h"

#include <algorithm>
#include <cmath>

#include "lambent/scene/texel_map.h"
#include "lambent/sh/basis.h"
#include "lambent/shade/shade.h"
#include "lambent/shade/transfer_matrices.h"
#include "lambent/shade/unshadowed.h"

namespace lambent::shade {

using scene::Mesh;
using scene::Scene;
using scene::Texture;

ReceiverWeights ReceiverWeights::ofTexels(int width, int height, const Vec2& uv) {
  struct Taps {
    std::uint32_t first, second;
    float weight;  // of the second
  };
  const auto taps = [](float coordinate, int size) -> Taps {
    const float x = std::clamp(coordinate * float(size) - 0.5f, 0.0f, float(size - 1));
    const auto first = std::uint32_t(x);
    return {first, std::min(first + 1, std::uint32_t(size - 1)), x - float(first)};
  };
  const Taps x = taps(uv.x(), width), y = taps(uv.y(), height);
  const std::uint32_t top = y.first * width, bottom = y.second * width;
  return {{top + x.first, top + x.second, bottom + x.first, bottom + x.second},
          {(1 - y.weight) * (1 - x.weight), (1 - y.weight) * x.weight, y.weight * (1 - x.weight),
           y.weight * x.weight},
          4};
}

Rgb LitMesh::diffuseAt(const ReceiverWeights& at) const {
  Rgb sum = Rgb::Zero();
  if (diffuse.empty()) return sum;
  for (int k = 0; k < at.count; ++k) {
    const float* value = diffuse.data() + std::size_t(at.index[k]) * 3;
    for (int c = 0; c < 3; ++c) sum[c] += at.weight[k] * value[c];
  }
  return sum;
}

Rgb LitMesh::glossyAt(const ReceiverWeights& at, const Vec3& toViewer, const Vec3& normal) const {
  Rgb sum = Rgb::Zero();
  if (lobe.empty()) return sum;
  std::array<float, sh::coefficientCount(sh::kMaxBands)> y;
  sh::evaluate(lobeBands, mirrored(toViewer, normal), y);
  const int coefficients = sh::coefficientCount(lobeBands);
  for (int k = 0; k < at.count; ++k) {
    const float* value = lobe.data() + std::size_t(at.index[k]) * coefficients * 3;
    float r = 0.0f, g = 0.0f, b = 0.0f;
    for (int i = 0; i < coefficients; ++i) {
      r += value[3 * i] * y[i];
      g += value[3 * i + 1] * y[i];
      b += value[3 * i + 2] * y[i];
    }
    sum += at.weight[k] * Rgb(r, g, b);
  }
  return sum * gain.at(normal.dot(toViewer));
}

LitMesh lightMesh(const transfer::SurfaceResponse<transfer::Numbers>& response, transfer::Kind kind,
                  const sh::RgbCoefficients& light, const Showing& showing) {
  LitMesh lit;
  if (const auto& diffuse = response.diffuse) {
    lit.albedoOutside = diffuse->albedo == transfer::Albedo::BaseColor;
    const DiffuseShader shader(diffuse->vectors);
    lit.diffuse.resize(3 * shader.receiverCount());
    shader.shade(light, lit.diffuse);
  }
  if (const auto& glossy = response.glossy) {
    const transfer::Lobe& lobe = glossy->lobe;
    lit.lobeBands = glossy->matrices.outBands;
    const int rows = sh::coefficientCount(lit.lobeBands);
    const std::vector<float> factors = lobeFactors(lit.lobeBands, lobe, showing);
    lit.gain = lobeGain(lit.lobeBands, lobe, showing, kind);
    const std::vector<float> incident =
        applyMatrices(glossy->matrices, showing.softLobes ? softened(light) : light);
    const std::size_t receivers = incident.size() / (3 * std::size_t(rows));
    lit.lobe.resize(incident.size());
    for (std::size_t p = 0; p < receivers; ++p)
      for (int c = 0; c < 3; ++c)
        for (int i = 0; i < rows; ++i)
          lit.lobe[(p * rows + i) * 3 + c] =
              lobe.reflectance[c] * factors[i] * incident[(p * 3 + c) * rows + i];
  }
  return lit;
}

LitMesh lightSurface(const asset::Asset& asset, std::uint32_t mesh,
                     const sh::RgbCoefficients& light, const Showing& showing,
                     const std::optional<SharpSun>& sun) {
  const transfer::EncodedMesh& encoded = asset.transfer.meshes[mesh];
  if (!std::holds_alternative<transfer::Surface<transfer::Numbers>>(encoded)) return {};
  const transfer::Kind kind = kindShown(encoded, showing);
  LitMesh lit = lightMesh(*responseUnder(asset, mesh, kind), kind, light, showing);
  const auto directKind = sun ? kindWithoutBounces(encoded, showing) : std::nullopt;
  if (!directKind) return lit;
  const auto direct = responseUnder(asset, mesh, *directKind);
  std::vector<float> share(lit.diffuse.size());
  DiffuseShader(direct->diffuse->vectors).shade(sun->share, share);
  for (std::size_t i = 0; i < share.size(); ++i) lit.diffuse[i] -= share[i];
  return lit;
}

namespace {

const Texture* baseTexture(const Scene& scene, const Mesh& mesh) {
  if (mesh.uvs.empty() || mesh.material < 0 || std::size_t(mesh.material) >= scene.materials.size())
    return nullptr;
  const int texture = scene.materials[mesh.material].baseColorTexture;
  if (texture < 0 || std::size_t(texture) >= scene.textures.size()) return nullptr;
  return &scene.textures[texture];
}

// Vertex colours at texel centres: each triangle paints the texels whose centres it holds in uv.
// Texels that no triangle holds (gutters) are dilated copies of neighbours and stay white here.
std::vector<Rgb> colorsAtTexels(const Mesh& mesh, int width, int height) {
  std::vector<Rgb> colors(std::size_t(width) * height, Rgb::Ones());
  for (const auto& [i, j, k] : mesh.triangles) {
    const Vec2 size(width, height);
    const Vec2 a = mesh.uvs[i].cwiseProduct(size), b = mesh.uvs[j].cwiseProduct(size),
               c = mesh.uvs[k].cwiseProduct(size);
    const auto cross = [](const Vec2& p, const Vec2& q) { return p.x() * q.y() - p.y() * q.x(); };
    const float area = cross(b - a, c - a);
    if (!(std::abs(area) > 0.0f)) continue;
    const Vec2 low = a.cwiseMin(b).cwiseMin(c), high = a.cwiseMax(b).cwiseMax(c);
    const int x1 = int(std::clamp(high.x(), 0.0f, float(width - 1)));
    const int y1 = int(std::clamp(high.y(), 0.0f, float(height - 1)));
    for (int y = int(std::clamp(low.y(), 0.0f, float(height - 1))); y <= y1; ++y) {
      for (int x = int(std::clamp(low.x(), 0.0f, float(width - 1))); x <= x1; ++x) {
        const Vec2 p(x + 0.5f, y + 0.5f);
        const float u = cross(p - a, c - a) / area, v = cross(b - a, p - a) / area;
        if (u < 0.0f || v < 0.0f || u + v > 1.0f) continue;
        colors[std::size_t(y) * width + x] =
            (1.0f - u - v) * mesh.colors[i] + u * mesh.colors[j] + v * mesh.colors[k];
      }
    }
  }
  return colors;
}

/// On a layout of its own; texels that show nothing have the colour of the nearest that does.
std::vector<Rgb> colorsAtLayout(const Scene& scene, std::uint32_t meshIndex,
                                const transfer::AtTexels& grid) {
  const scene::TexelMap map = scene::texelMap(scene.meshes[meshIndex], grid.width, grid.height);
  std::vector<std::uint8_t> covered(map.size());
  for (std::size_t t = 0; t < map.size(); ++t) covered[t] = map.covered(t);
  const std::vector<std::uint32_t> nearest = scene::nearestFull(grid.width, grid.height, covered);
  std::vector<Rgb> colors(map.size(), Rgb::Ones());
  for (std::size_t t = 0; t < map.size(); ++t) {
    if (nearest[t] == scene::kNobody) continue;
    const Vec2& at = map.barycentric[nearest[t]];
    colors[t] = scene::baseColorAt(scene, meshIndex, map.triangle[nearest[t]], at.x(), at.y());
  }
  return colors;
}

}  // namespace

std::vector<Rgb> receiverBaseColors(const Scene& scene, std::uint32_t meshIndex,
                                    const transfer::Receivers& receivers) {
  const Mesh& mesh = scene.meshes[meshIndex];
  const Texture* texture = baseTexture(scene, mesh);
  if (mesh.colors.empty() && !texture) return {};
  const transfer::AtTexels* grid = receivers.texels();
  if (grid && !mesh.texelUvs.empty()) return colorsAtLayout(scene, meshIndex, *grid);
  std::vector<Rgb> base;
  if (mesh.colors.empty())
    base.assign(receivers.size(), Rgb::Ones());
  else
    base = grid ? colorsAtTexels(mesh, grid->width, grid->height) : mesh.colors;
  if (!texture) return base;
  for (std::size_t p = 0; p < base.size(); ++p) {
    const Vec2 uv =
        grid ? Vec2((p % grid->width + 0.5f) / grid->width, (p / grid->width + 0.5f) / grid->height)
             : mesh.uvs[p];
    base[p] *= scene::sampleBaseColor(*texture, uv);
  }
  return base;
}

}  // namespace lambent::shade
