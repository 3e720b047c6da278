// Terms: Â_l, convolution factors of the clamped cosine (ramamoorthi2001efficient eq. 8); y_i, the
// basis of three bands, written out here by hand so that the samples check the basis and not
// themselves.
#include "lambent/asset/samples.h"

#include <array>
#include <cmath>
#include <memory>

#include "lambent/transfer/encode.h"

namespace lambent::asset {

namespace {

using transfer::Encoding;
using transfer::Kind;
using transfer::Numbers;
using Response = transfer::SurfaceResponse<Numbers>;
using Surface = transfer::Surface<Numbers>;

std::array<double, 9> basis(const Vec3d& d) {
  const double x = d.x(), y = d.y(), z = d.z();
  return {std::sqrt(1.0 / (4.0 * kPi)),
          std::sqrt(3.0 / (4.0 * kPi)) * y,
          std::sqrt(3.0 / (4.0 * kPi)) * z,
          std::sqrt(3.0 / (4.0 * kPi)) * x,
          std::sqrt(15.0 / (4.0 * kPi)) * x * y,
          std::sqrt(15.0 / (4.0 * kPi)) * y * z,
          std::sqrt(5.0 / (16.0 * kPi)) * (3.0 * z * z - 1.0),
          std::sqrt(15.0 / (4.0 * kPi)) * x * z,
          std::sqrt(15.0 / (16.0 * kPi)) * (x * x - y * y)};
}

/// ρ/π Â_l y_i(N): transfer of a receiver that nothing hides the light from.
std::vector<float> unoccluded(const Rgb& albedo, int channels, const Vec3& normal) {
  constexpr std::array<double, 3> kCosine{kPi, 2.0 * kPi / 3.0, kPi / 4.0};
  const std::array<double, 9> y = basis(normal.cast<double>());
  std::vector<float> vector;
  for (int c = 0; c < channels; ++c)
    for (int l = 0; l < 3; ++l)
      for (int i = l * l; i < (l + 1) * (l + 1); ++i)
        vector.push_back(
            float(double(albedo[c]) / kPi * kCosine[std::size_t(l)] * y[std::size_t(i)]));
  return vector;
}

/// A square of edge 2 around `center` that faces +y, front side up.
scene::Mesh square(const char* name, int material, const Vec3& center) {
  scene::Mesh mesh;
  mesh.name = name;
  mesh.material = material;
  for (const Vec2& corner : {Vec2(0, 0), Vec2(1, 0), Vec2(0, 1), Vec2(1, 1)}) {
    mesh.positions.push_back(center +
                             Vec3(2.0f * corner.x() - 1.0f, 0.0f, 2.0f * corner.y() - 1.0f));
    mesh.normals.emplace_back(0.0f, 1.0f, 0.0f);
    mesh.uvs.push_back(corner);
  }
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}};
  return mesh;
}

transfer::SharedReceivers atVertices(const scene::Mesh& mesh) {
  return std::make_shared<const transfer::Receivers>(
      transfer::Receivers{mesh.positions, mesh.normals, transfer::AtVertices{}});
}

transfer::Diffuse<Numbers> unoccluded(const transfer::Receivers& receivers, const Rgb& albedo,
                                      int channels, Encoding encoding) {
  std::vector<float> numbers;
  for (const Vec3& normal : receivers.normals) {
    const std::vector<float> one = unoccluded(albedo, channels, normal);
    numbers.insert(numbers.end(), one.begin(), one.end());
  }
  return {transfer::Albedo::Included, {3, channels, transfer::encode(numbers, encoding)}};
}

transfer::EncodedField statement() {
  transfer::EncodedField field;
  field.kind = Kind::Unshadowed;
  field.bands = 3;
  return field;
}

scene::Material grey(const char* name) {
  scene::Material material;
  material.name = name;
  material.diffuse = Rgb::Constant(0.5f);
  return material;
}

}  // namespace

Asset unoccludedSquare() {
  Asset asset;
  asset.scene.materials = {grey("grey")};
  asset.scene.meshes = {square("square", 0, Vec3::Zero())};
  asset.transfer = statement();
  Surface surface{atVertices(asset.scene.meshes[0]), {}};
  const Response& response = surface.responses.set(
      Kind::Unshadowed,
      {unoccluded(*surface.receivers, Rgb::Constant(0.5f), 1, Encoding::Float32), {}});
  double energy = 0.0;
  for (const float m : decode(response.diffuse->vectors.numbers)) energy += double(m) * double(m);
  asset.transfer.passEnergy = {energy / double(surface.receivers->size())};
  asset.transfer.meshes = {surface};
  return asset;
}

Asset everyLayout() {
  Asset asset;
  scene::Material coloured = grey("coloured");
  coloured.diffuse = Rgb(0.75f, 0.5f, 0.25f);
  scene::Material glossy = grey("glossy");
  glossy.glossy = Rgb(0.25f, 0.5f, 0.125f);
  glossy.lobeExponent = 16.0f;
  scene::Material mirror;
  mirror.name = "mirror";
  mirror.diffuse = Rgb::Zero();
  mirror.mirror = Rgb::Constant(0.875f);
  asset.scene.materials = {coloured, grey("grey"), glossy, mirror};
  asset.scene.meshes = {square("per vertex", 0, {0, 0, 0}), square("per texel", 1, {3, 0, 0}),
                        square("glossy", 2, {6, 0, 0}), square("mirror", 3, {9, 0, 0})};
  asset.scene.meshes[0].colors = {{1, 1, 1}, {0.5f, 1, 1}, {1, 0.5f, 1}, {1, 1, 0.5f}};
  scene::Camera camera;
  camera.name = "above";
  camera.worldFromCamera << 1, 0, 0, 4.5f, 0, 0, 1, 12, 0, -1, 0, 0, 0, 0, 0, 1;
  asset.scene.cameras = {camera};

  asset.transfer = statement();
  asset.transfer.kind = Kind::Interreflected;
  asset.transfer.directions = 8192;
  asset.transfer.bounces = 2;
  asset.transfer.seed = 0xfedcba9876543210u;  // more than a JSON number holds in every reader
  asset.transfer.passEnergy = {0.125, 0.0625, 1.0 / 3.0};

  Surface perVertex{atVertices(asset.scene.meshes[0]), {}};
  perVertex.responses
      .set(Kind::Interreflected,
           {unoccluded(*perVertex.receivers, coloured.diffuse, 3, Encoding::Float16), {}})
      .diffuse->albedo = transfer::Albedo::BaseColor;

  transfer::Receivers texels;
  transfer::AtTexels grid{3, 2, {}};
  for (int row = 0; row < 2; ++row)
    for (int column = 0; column < 3; ++column) {
      const Vec2 uv((float(column) + 0.5f) / 3.0f, (float(row) + 0.5f) / 2.0f);
      texels.positions.emplace_back(2.0f + 2.0f * uv.x(), 0.0f, 2.0f * uv.y() - 1.0f);
      texels.normals.emplace_back(0.0f, 1.0f, 0.0f);
      grid.covered.push_back(row == 1 && column == 2 ? 0 : 1);
    }
  texels.where = grid;
  Surface perTexel{std::make_shared<const transfer::Receivers>(texels), {}};
  perTexel.responses.set(Kind::Interreflected,
                         {unoccluded(texels, Rgb::Constant(0.5f), 1, Encoding::Float16), {}});

  Surface shiny{atVertices(asset.scene.meshes[2]), {}};
  // Nothing hides the light: the identity, its rows cut to 2 bands.
  std::vector<float> matrices;
  for (std::size_t receiver = 0; receiver < shiny.receivers->size(); ++receiver)
    for (int row = 0; row < 4; ++row)
      for (int column = 0; column < 9; ++column) matrices.push_back(row == column ? 1.0f : 0.0f);
  shiny.responses.set(
      Kind::Interreflected,
      {unoccluded(*shiny.receivers, Rgb::Constant(0.5f), 1, Encoding::Float32),
       transfer::Glossy<Numbers>{{glossy.glossy, glossy.lobeExponent},
                                 {2, 3, 1, transfer::encode(matrices, Encoding::Float32)}}});

  asset.transfer.meshes = {perVertex, perTexel, shiny, transfer::NoTransfer{}};
  return asset;
}

Asset biScale() {
  Asset asset;
  asset.scene.materials = {grey("patch")};
  asset.scene.meshes = {square("with an id map", 0, {0, 0, 0}), square("by its UVs", 0, {3, 0, 0})};
  asset.transfer = statement();
  asset.transfer.kind = Kind::Shadowed;
  asset.transfer.directions = 1024;

  // Flat stripes: B_i = ρ/π Â_l y_i(+z), with a reflectance for each position and a view that is
  // half as bright as the others.
  transfer::Rtt<transfer::Floats> rtt;
  rtt.name = "stripes";
  rtt.width = 4, rtt.height = 2, rtt.views = 2, rtt.bands = 3;
  rtt.size = Vec2(0.5f, 0.25f);
  const std::vector<float> flat = unoccluded(Rgb::Ones(), 1, Vec3(0, 0, 1));
  for (int i = 0; i < 9; ++i)
    for (int y = 0; y < 2; ++y)
      for (int x = 0; x < 4; ++x)
        for (int view = 0; view < 4; ++view)
          for (int c = 0; c < 3; ++c)
            rtt.values.push_back(0.25f * float(1 + (x + y + c) % 4) * (view == 3 ? 0.5f : 1.0f) *
                                 flat[std::size_t(i)]);
  asset.transfer.rtts = {transfer::encode(rtt, Encoding::Snorm8)};

  // T = +x, N × T = −z, N = +y: the rotation of three bands into that frame, by hand. Band 1 is
  // (y, z, x): the frame's (y', z', x') = (−z, y, x).
  const double s = std::sqrt(3.0) / 2.0;
  const double rotation[9][9] = {{1, 0, 0, 0, 0, 0, 0, 0, 0},     {0, 0, -1, 0, 0, 0, 0, 0, 0},
                                 {0, 1, 0, 0, 0, 0, 0, 0, 0},     {0, 0, 0, 1, 0, 0, 0, 0, 0},
                                 {0, 0, 0, 0, 0, 0, 0, -1, 0},    {0, 0, 0, 0, 0, -1, 0, 0, 0},
                                 {0, 0, 0, 0, 0, 0, -0.5, 0, -s}, {0, 0, 0, 0, 1, 0, 0, 0, 0},
                                 {0, 0, 0, 0, 0, 0, -s, 0, 0.5}};
  for (int mesh = 0; mesh < 2; ++mesh) {
    transfer::BiScale<Numbers> patched;
    patched.receivers = atVertices(asset.scene.meshes[std::size_t(mesh)]);
    patched.bands = 3;
    patched.patch.scale = 2.0f;
    patched.tangents.assign(4, Vec3(1, 0, 0));
    if (mesh == 1) {
      patched.patch.place = transfer::Tiles{Vec2(3, 3)};
    } else {
      patched.patch.place = transfer::IdMap{2, 2, {0, 0, 16384, 0, 0, 32768, 65535, 65535}};
      std::vector<float> matrices;
      for (int receiver = 0; receiver < 4; ++receiver)
        for (const auto& row : rotation)
          for (const double value : row) matrices.push_back(float(value));
      patched.matrices.set(Kind::Shadowed,
                           {3, 3, 1, transfer::encode(matrices, Encoding::Float16)});
    }
    asset.transfer.meshes.emplace_back(std::move(patched));
  }
  return asset;
}

namespace {

/// `numbers` for each of three channels, times that channel's factor.
std::vector<float> tinted(const std::vector<float>& numbers, const Rgb& factors) {
  std::vector<float> all;
  for (int c = 0; c < 3; ++c)
    for (const float number : numbers) all.push_back(factors[c] * number);
  return all;
}

Numbers atEach(const std::vector<float>& one, std::size_t receivers, Encoding encoding) {
  std::vector<float> all;
  for (std::size_t r = 0; r < receivers; ++r) all.insert(all.end(), one.begin(), one.end());
  return transfer::encode(all, encoding);
}

}  // namespace

Asset relief() {
  Asset asset = biScale();
  transfer::EncodedRtt& rtt = asset.transfer.rtts[0];
  rtt.depth = 0.25f;
  for (int place = 0; place < 8; ++place)
    for (int view = 0; view < 4; ++view)
      rtt.heights.push_back(std::uint8_t(place % 4 < 2 ? 255 - 10 * view : 5 * view));
  return asset;
}

Asset layered() {
  Asset asset = biScale();
  scene::Mesh& layer = asset.scene.meshes[1];
  layer.name = "layer";
  layer.positions = asset.scene.meshes[0].positions;
  layer.triangles.resize(1);
  layer.layer = true;
  layer.material = 1;
  std::get<transfer::BiScale<Numbers>>(asset.transfer.meshes[1]).receivers = atVertices(layer);
  scene::Material& material = asset.scene.materials.emplace_back(grey("layer"));
  material.alphaMode = scene::AlphaMode::Blend;
  for (const Vec2& uv : layer.uvs) {
    layer.colors.push_back(Rgb::Ones());
    layer.alphas.push_back(uv.x());
  }
  return asset;
}

Asset keptShadowed() {
  constexpr float kThrough = 0.5f;
  const Rgb all = kThrough * Rgb(1.5f, 1.25f, 1.125f);
  Asset asset;
  scene::Material glossy = grey("glossy");
  glossy.glossy = Rgb::Constant(0.25f);
  glossy.lobeExponent = 8.0f;
  asset.scene.materials = {grey("grey"), glossy};
  asset.scene.meshes = {square("per vertex", 0, {0, 0, 0}), square("per texel", 1, {3, 0, 0})};
  asset.transfer = statement();
  asset.transfer.kind = Kind::Interreflected;
  asset.transfer.directions = 4096;
  asset.transfer.bounces = 1;
  asset.transfer.passEnergy = {0.25, 0.0625};

  std::vector<float> vector = unoccluded(Rgb::Constant(0.5f), 1, Vec3::UnitY());
  for (float& number : vector) number *= kThrough;
  // Both kinds at so many receivers.
  const auto setVectors = [&](Surface& surface, Encoding encoding) {
    const std::size_t receivers = surface.receivers->size();
    const auto diffuse = [&](const std::vector<float>& one, int channels) {
      return transfer::Diffuse<Numbers>{transfer::Albedo::Included,
                                        {3, channels, atEach(one, receivers, encoding)}};
    };
    surface.responses.set(Kind::Interreflected, {diffuse(tinted(vector, all / kThrough), 3), {}});
    surface.responses.set(Kind::Shadowed, {diffuse(vector, 1), {}});
  };
  Surface perVertex{atVertices(asset.scene.meshes[0]), {}};
  setVectors(perVertex, Encoding::Float16);

  transfer::Receivers texels;
  for (const Vec2& at : {Vec2(2.5f, -0.5f), Vec2(3.5f, -0.5f), Vec2(2.5f, 0.5f), Vec2(3.5f, 0.5f)})
    texels.positions.emplace_back(at.x(), 0.0f, at.y());
  texels.normals.assign(4, Vec3::UnitY());
  texels.where = transfer::AtTexels{2, 2, {1, 1, 1, 1}};
  Surface perTexel{std::make_shared<const transfer::Receivers>(texels), {}};
  setVectors(perTexel, Encoding::Float32);
  std::vector<float> identity(81, 0.0f);
  for (std::size_t i = 0; i < 9; ++i) identity[10 * i] = 1.0f;
  const auto setMatrices = [&](Kind kind, int channels, const std::vector<float>& one) {
    perTexel.responses.find(kind)->glossy = {{glossy.glossy, glossy.lobeExponent},
                                             {3, 3, channels, atEach(one, 4, Encoding::Float32)}};
  };
  setMatrices(Kind::Interreflected, 3, tinted(identity, all));
  for (float& number : identity) number *= kThrough;
  setMatrices(Kind::Shadowed, 1, identity);

  asset.transfer.meshes = {perVertex, perTexel};
  return asset;
}

Asset secondUvs() {
  Asset asset;
  asset.scene.materials = {grey("grey")};
  asset.scene.meshes = {square("on TEXCOORD_1", 0, Vec3::Zero())};
  scene::Mesh& mesh = asset.scene.meshes[0];
  for (Vec2& uv : mesh.uvs) {
    mesh.texelUvs.emplace_back(1.0f - uv.x(), uv.y());
    uv *= 3.0f;
  }
  asset.transfer = statement();
  transfer::Receivers texels;
  std::vector<float> numbers;
  for (int texel = 0; texel < 4; ++texel) {
    texels.positions.emplace_back(texel % 2 == 0 ? 0.5f : -0.5f, 0.0f, texel < 2 ? -0.5f : 0.5f);
    const std::vector<float> one =
        unoccluded(Rgb::Constant(std::ldexp(0.5f, -texel)), 1, Vec3::UnitY());
    numbers.insert(numbers.end(), one.begin(), one.end());
  }
  texels.normals.assign(4, Vec3::UnitY());
  texels.where = transfer::AtTexels{2, 2, {1, 1, 1, 1}};
  Surface surface{std::make_shared<const transfer::Receivers>(texels), {}};
  surface.responses.set(
      Kind::Unshadowed,
      {transfer::Diffuse<Numbers>{transfer::Albedo::Included,
                                  {3, 1, transfer::encode(numbers, Encoding::Float32)}},
       {}});
  asset.transfer.meshes = {surface};
  return asset;
}

std::vector<std::pair<std::string, Asset>> samples() {
  return {{"unoccluded-square.glb", unoccludedSquare()},
          {"every-layout.glb", everyLayout()},
          {"bi-scale.glb", biScale()},
          {"relief.glb", relief()},
          {"layered.glb", layered()},
          {"kept-shadowed.glb", keptShadowed()},
          {"second-uvs.glb", secondUvs()}};
}

}  // namespace lambent::asset
