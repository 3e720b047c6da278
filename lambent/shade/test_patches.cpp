#include "lambent/shade/test_patches.h"

#include <cmath>

#include "lambent/math/directions.h"
#include "lambent/sh/rotation.h"
#include "lambent/sh/zonal.h"
#include "lambent/shade/macro_transport.h"
#include "lambent/transfer/encode.h"

namespace lambent::shade::test {

transfer::SimulatedRtt emptyRtt(int width, int height, int views, int bands) {
  transfer::SimulatedRtt rtt;
  rtt.name = "patch";
  rtt.width = width;
  rtt.height = height;
  rtt.views = views;
  rtt.bands = bands;
  rtt.values.assign(rtt.planeSize() * std::size_t(bands) * bands, 0.0f);
  return rtt;
}

namespace {

std::vector<float> diffuseResponse(int bands, const Vec3& normal) {
  std::vector<double> vector(std::size_t(sh::coefficientCount(bands)));
  sh::turnTo(sh::clampedCosine(bands), normal.cast<double>(), std::span<double>(vector));
  std::vector<float> out;
  for (const double b : vector) out.push_back(float(b / kPi));
  return out;
}

/// In [0, 1), the same for the same number.
float hashed(std::uint32_t n) {
  n = (n ^ (n >> 16)) * 0x7feb352du;
  n = (n ^ (n >> 15)) * 0x846ca68bu;
  return float((n ^ (n >> 16)) >> 8) * 0x1p-24f;
}

}  // namespace

transfer::SimulatedRtt flatRtt(int width, int height, int views, int bands,
                               const Rgb& reflectance) {
  transfer::SimulatedRtt rtt = emptyRtt(width, height, views, bands);
  const std::vector<float> response = diffuseResponse(bands, Vec3::UnitZ());
  for (std::size_t i = 0; i < rtt.values.size(); ++i)
    rtt.values[i] = response[i / rtt.planeSize()] * reflectance[i % 3];
  return rtt;
}

transfer::SimulatedRtt bumpyRtt(int width, int height, int views, int bands) {
  transfer::SimulatedRtt rtt = emptyRtt(width, height, views, bands);
  const float turn = 2.0f * float(kPi);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const float u = (x + 0.5f) / width, v = (y + 0.5f) / height;
      const float a = std::sin(turn * 3 * u), b = std::sin(turn * 2 * v + 1);
      const Vec3 normal =
          Vec3(-0.8f * std::cos(turn * 3 * u) * b, -0.6f * a * std::cos(turn * 2 * v + 1), 1.0f)
              .normalized();
      const std::vector<float> response = diffuseResponse(bands, normal);
      const float grain = 0.7f + 0.3f * hashed(std::uint32_t(y * width + x));
      const Rgb colour = grain * Rgb(0.8f, 0.4f + 0.3f * u, 0.2f + 0.5f * v);
      for (int vy = 0; vy < views; ++vy)
        for (int vx = 0; vx < views; ++vx) {
          const Vec3 view =
              math::hemisphereFromSquare(Vec2((vx + 0.5f) / views, (vy + 0.5f) / views));
          const float facing = 0.6f + 0.4f * std::max(0.0f, normal.dot(view));
          for (std::size_t i = 0; i < response.size(); ++i)
            for (int c = 0; c < 3; ++c)
              rtt.values[rtt.index(int(i), x, y, vx, vy) + std::size_t(c)] =
                  response[i] * colour[c] * facing;
        }
    }
  return rtt;
}

std::vector<Vec3> tangentsAlong(const scene::Mesh& mesh, const Vec3& direction) {
  std::vector<Vec3> tangents;
  for (const Vec3& normal : mesh.normals)
    tangents.emplace_back(worldFromPatch(normal, direction).col(0));
  return tangents;
}

transfer::IdMap patchworkMap(int width, int height, const Vec2& tiles) {
  transfer::IdMap map;
  map.width = width;
  map.height = height;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const std::uint32_t square = std::uint32_t(y / 8 * 1000 + x / 8);
      const Vec2 q(tiles.x() * (x + 0.5f) / width + hashed(2 * square),
                   -tiles.y() * (y + 0.5f) / height + hashed(2 * square + 1));
      for (const float f : {q.x(), q.y()})
        map.ids.push_back(std::uint16_t(std::int64_t(std::floor(f * 65536.0f)) & 0xffff));
    }
  return map;
}

void addPatched(asset::Asset& asset, scene::Mesh mesh, const transfer::SimulatedRtt& rtt,
                const SpreadOptions& options) {
  using transfer::Kind;
  transfer::BiScale<transfer::Numbers> biScale;
  biScale.receivers = std::make_shared<const transfer::Receivers>(
      transfer::Receivers{mesh.positions, mesh.normals, transfer::AtVertices{}});
  biScale.tangents = tangentsAlong(mesh, options.tangent);
  biScale.patch = {int(asset.transfer.rtts.size()), options.scale, transfer::Tiles{options.tiles}};
  if (options.idMap) biScale.patch.place = *options.idMap;
  biScale.bands = options.shadowedBands > 0 ? options.shadowedBands : rtt.bands;
  if (options.shadowedBands > 0) {
    std::vector<float> shadowed, interreflected;
    for (std::size_t p = 0; p < mesh.normals.size(); ++p) {
      const Mat3 frame = worldFromPatch(mesh.normals[p], biScale.tangents[p]);
      const std::vector<double> rotation =
          sh::rotationMatrix(biScale.bands, frame.transpose().cast<double>());
      for (const double r : rotation) shadowed.push_back(float(0.75 * r));
      for (int c = 0; c < options.channels; ++c)
        for (const double r : rotation)
          interreflected.push_back(float((0.5 + 0.1 * c + 0.1 * hashed(std::uint32_t(p))) * r));
    }
    const auto set = [&](Kind kind, int channels, const std::vector<float>& numbers) {
      transfer::Matrices<transfer::Numbers> matrices{biScale.bands, biScale.bands, channels, {}};
      matrices.numbers = transfer::encode(numbers, options.matrices, matrices.perMatrix());
      biScale.matrices.set(kind, std::move(matrices));
    };
    set(Kind::Shadowed, 1, shadowed);
    if (options.channels > 0) set(Kind::Interreflected, options.channels, interreflected);
  }
  asset.transfer.bands = std::max(asset.transfer.bands, biScale.bands);
  asset.transfer.rtts.push_back(transfer::encode(rtt, options.encoding));
  mesh.material = int(asset.scene.materials.size());
  asset.scene.materials.emplace_back();
  asset.scene.meshes.push_back(std::move(mesh));
  asset.transfer.meshes.push_back(std::move(biScale));
}

void addLayer(asset::Asset& asset, std::uint32_t mesh, const transfer::SimulatedRtt& rtt,
              const SpreadOptions& options, const std::vector<std::uint8_t>& alphas) {
  addPatched(asset, asset.scene.meshes[mesh], rtt, options);
  asset.scene.meshes.back().layer = true;
  scene::Material& material = asset.scene.materials.back();
  material.alphaMode = scene::AlphaMode::Blend;
  material.baseColorTexture = int(asset.scene.textures.size());
  scene::Texture& texture = asset.scene.textures.emplace_back();
  texture.width = int(alphas.size()), texture.height = 1;
  texture.wrapU = texture.wrapV = scene::Wrap::ClampToEdge;
  for (const std::uint8_t alpha : alphas)
    texture.rgba.insert(texture.rgba.end(), {255, 255, 255, alpha});
}

}  // namespace lambent::shade::test
