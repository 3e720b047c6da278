#include <gtest/gtest.h>

#include <fstream>
#include <random>

#include "lambent/asset/asset.h"
#include "lambent/asset/check.h"
#include "lambent/asset/samples.h"
#include "lambent/asset/test_support.h"
#include "lambent/sh/rotation.h"
#include "lambent/transfer/encode.h"

namespace lambent::asset {
namespace {

using test::Folder;
using transfer::Encoding;
using transfer::Kind;
using transfer::Numbers;
using Response = transfer::SurfaceResponse<Numbers>;
using Surface = transfer::Surface<Numbers>;

Surface& surfaceOf(Asset& asset, std::size_t mesh = 0) {
  return std::get<Surface>(asset.transfer.meshes[mesh]);
}
/// The response that stands in the primitive itself.
Response& responseOf(Asset& asset, std::size_t mesh = 0) {
  return *surfaceOf(asset, mesh).responses.find(asset.transfer.kind);
}

// A 2×2 PNG: red, green, blue, grey.
constexpr std::uint8_t kPng[] = {
    0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d, 0x49, 0x48, 0x44, 0x52,
    0x00, 0x00, 0x00, 0x02, 0x00, 0x00, 0x00, 0x02, 0x08, 0x02, 0x00, 0x00, 0x00, 0xfd, 0xd4, 0x9a,
    0x73, 0x00, 0x00, 0x00, 0x13, 0x49, 0x44, 0x41, 0x54, 0x78, 0xda, 0x63, 0xf8, 0xcf, 0xc0, 0xc0,
    0x00, 0xc2, 0x0c, 0xff, 0x1b, 0x1a, 0x1a, 0x00, 0x1c, 0xf4, 0x04, 0x7e, 0x9d, 0x71, 0x8c, 0x3d,
    0x00, 0x00, 0x00, 0x00, 0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82};

/// Writes, reads, writes again: the same content and the same bytes.
Asset throughFile(const Asset& asset) {
  const Folder folder;
  const Status written = write(asset, folder / "once.glb");
  EXPECT_TRUE(written) << written.error().message;
  Result<Asset> read = asset::read(folder / "once.glb");
  EXPECT_TRUE(read) << read.error().message;
  if (!read) return {};
  const Status again = write(*read, folder / "twice.glb");
  EXPECT_TRUE(again) << again.error().message;
  EXPECT_EQ(test::bytesOf(folder / "once.glb"), test::bytesOf(folder / "twice.glb"));
  return std::move(*read);
}

std::vector<float> randomNumbers(std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<float> normal;
  std::vector<float> numbers(count);
  for (float& number : numbers) number = normal(random);
  return numbers;
}

enum class Layout { Vertices, Texels };

/// A single mesh of transfer in every shape: random numbers, since here nothing looks at them.
Asset shaped(Layout layout, Encoding encoding, int bands, int channels, int outBands,
             int matrixChannels) {
  Asset asset = unoccludedSquare();
  asset.transfer.bands = bands;
  Surface& surface = surfaceOf(asset);
  if (layout == Layout::Texels) {
    transfer::Receivers receivers;
    transfer::AtTexels grid{5, 3, {}};
    const std::vector<float> places = randomNumbers(15 * 3, 9);
    for (std::size_t t = 0; t < 15; ++t) {
      receivers.positions.emplace_back(places[3 * t], places[3 * t + 1], places[3 * t + 2]);
      receivers.normals.emplace_back(0.0f, 1.0f, 0.0f);
      grid.covered.push_back(t % 4 != 0);
    }
    receivers.where = grid;
    surface.receivers = std::make_shared<const transfer::Receivers>(receivers);
  }
  const std::size_t receivers = surface.receivers->size();
  const std::size_t n = std::size_t(bands * bands), rows = std::size_t(outBands * outBands);
  Response& response = responseOf(asset);
  response.diffuse->vectors = {
      bands, channels,
      transfer::encode(randomNumbers(receivers * std::size_t(channels) * n, 1), encoding)};
  if (outBands > 0)
    response.glossy = {
        {Rgb(0.1f, 0.2f, 0.3f), 12.7f},
        {outBands, bands, matrixChannels,
         transfer::encode(randomNumbers(receivers * std::size_t(matrixChannels) * rows * n, 2),
                          encoding)}};
  return asset;
}

TEST(AssetRoundTrip, SamplesAreExact) {
  for (const auto& [name, asset] : samples()) {
    SCOPED_TRACE(name);
    test::expectSame(throughFile(asset), asset);
  }
}

TEST(AssetRoundTrip, EveryLayoutEncodingAndChannelIsExact) {
  for (Layout layout : {Layout::Vertices, Layout::Texels})
    for (Encoding encoding : {Encoding::Float16, Encoding::Float32})
      for (int bands : {1, 5, 10})
        for (int channels : {1, 3})
          for (auto [outBands, matrixChannels] :
               {std::pair{0, 0}, std::pair{3, 1}, std::pair{5, 3}}) {
            SCOPED_TRACE(::testing::Message()
                         << "layout " << int(layout) << " encoding " << int(encoding) << " bands "
                         << bands << " channels " << channels << " outBands " << outBands);
            const Asset asset = shaped(layout, encoding, bands, channels, outBands, matrixChannels);
            test::expectSame(throughFile(asset), asset);
          }
}

TEST(AssetRoundTrip, VectorsAndMatricesMayDifferInEncoding) {
  Asset asset = shaped(Layout::Vertices, Encoding::Float16, 4, 3, 4, 1);
  Numbers& numbers = responseOf(asset).diffuse->vectors.numbers;
  numbers = transfer::encode(decode(numbers), Encoding::Float32);
  test::expectSame(throughFile(asset), asset);
}

TEST(AssetRoundTrip, GlossyWithoutDiffuse) {
  Asset asset = shaped(Layout::Vertices, Encoding::Float16, 4, 1, 4, 1);
  responseOf(asset).diffuse.reset();
  test::expectSame(throughFile(asset), asset);
}

TEST(AssetRoundTrip, TextureBytesAreCarriedAsFound) {
  Asset asset = unoccludedSquare();
  scene::Texture texture;
  texture.width = texture.height = 2;
  texture.encoded.assign(std::begin(kPng), std::end(kPng));
  texture.mimeType = "image/png";
  texture.wrapU = scene::Wrap::ClampToEdge;
  texture.wrapV = scene::Wrap::MirroredRepeat;
  texture.rgba = {255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 128, 128, 128, 255};
  asset.scene.textures = {texture};
  asset.scene.materials[0].baseColorTexture = 0;
  responseOf(asset).diffuse->albedo = transfer::Albedo::BaseColor;
  test::expectSame(throughFile(asset), asset);
}

TEST(AssetRoundTrip, MeshesThatShareNothingKeepTheirOwnTransfer) {
  Asset asset = everyLayout();
  std::swap(asset.scene.meshes[0], asset.scene.meshes[2]);
  std::swap(asset.transfer.meshes[0], asset.transfer.meshes[2]);
  test::expectSame(throughFile(asset), asset);
}

TEST(AssetRoundTrip, VerticesThatNoTriangleUsesKeepTheirReceivers) {
  Asset asset = unoccludedSquare();
  asset.scene.meshes[0].triangles.pop_back();
  test::expectSame(throughFile(asset), asset);
}

TEST(AssetWrite, TheSameAssetGivesTheSameBytes) {
  const Folder folder;
  ASSERT_TRUE(write(everyLayout(), folder / "a.glb"));
  ASSERT_TRUE(write(everyLayout(), folder / "b.glb"));
  EXPECT_EQ(test::bytesOf(folder / "a.glb"), test::bytesOf(folder / "b.glb"));
}

TEST(AssetWrite, RefusesWhatItCouldNotRead) {
  const Folder folder;
  const auto refused = [&](const Asset& asset, const char* what) {
    const Status status = write(asset, folder / "refused.glb");
    ASSERT_FALSE(status) << what;
    EXPECT_NE(status.error().message.find(what), std::string::npos) << status.error().message;
    EXPECT_FALSE(std::filesystem::exists(folder / "refused.glb"));
  };
  Asset asset = unoccludedSquare();
  responseOf(asset).diffuse->vectors.numbers.single[9 + 4] = std::nanf("");
  refused(asset,
          "mesh 0 (\"square\"): vectors: not a finite number at receiver 1, channel 0, "
          "coefficient 4");
  asset = everyLayout();
  responseOf(asset).diffuse->vectors.numbers.half[27 * 2 + 9 + 8] = 0x7c00;
  refused(asset, "receiver 2, channel 1, coefficient 8");
  asset = everyLayout();
  responseOf(asset, 2).glossy->matrices.numbers.single[36 * 3 + 9 * 2 + 5] = 1.0f / 0.0f;
  refused(asset, "matrices: not a finite number at receiver 3, channel 0, row 2, column 5");
  asset = unoccludedSquare();
  responseOf(asset).diffuse->vectors.numbers.single.pop_back();
  refused(asset, "35 numbers where 4 receivers");
  asset = unoccludedSquare();
  asset.transfer.meshes.clear();
  refused(asset, "transfer for 0 meshes");
  asset = unoccludedSquare();
  transfer::Receivers moved = *surfaceOf(asset).receivers;
  moved.positions[3].x() += 1.0f;
  surfaceOf(asset).receivers = std::make_shared<const transfer::Receivers>(moved);
  refused(asset, "receiver 3 does not stand at vertex 3");
  asset = unoccludedSquare();
  asset.transfer.bands = 2;
  refused(asset, "takes light of 3 bands");
  asset = everyLayout();
  asset.scene.meshes[1].normals.clear();
  refused(asset, "0 normals for 4 vertices");
  asset = everyLayout();
  asset.scene.meshes[3].normals[2].x() = std::nanf("");
  refused(asset, "mesh 3 (\"mirror\"): a position, normal, texture coordinate or colour is not");
  asset = biScale();
  std::get<transfer::BiScale<Numbers>>(asset.transfer.meshes[1]).patch.place =
      transfer::Tiles{Vec2(1, 0)};
  refused(asset, "biScale.tiles: must be finite and not 0");
  asset = biScale();
  std::get<transfer::BiScale<Numbers>>(asset.transfer.meshes[1]).bands = 2;
  refused(asset, "biScale.bands: is 2, and its RTT's 3");

  asset = unoccludedSquare();
  asset.scene.meshes[0].layer = true;
  refused(asset, "is a layer, and holds no meso-structure");

  EXPECT_EQ(write(unoccludedSquare(), folder / "asset.gltf").error().kind, ErrorKind::BadUsage);
  EXPECT_EQ(write(unoccludedSquare(), folder / "no/such/folder.glb").error().kind,
            ErrorKind::BadInput);
}

TEST(AssetWrite, WhatDoesNotFitInAGlbIsSaid) {
  PartBytes bytes;
  bytes.vectors = (std::uint64_t(1) << 32) - 1;
  EXPECT_TRUE(checkSize(bytes));
  bytes.matrices = 1;
  const Status status = checkSize(bytes);
  ASSERT_FALSE(status);
  EXPECT_NE(status.error().message.find("at most 4 GiB"), std::string::npos);
}

TEST(AssetRead, TheSameAssetAsJsonAndBinSideBySide) {
  const Folder folder;
  ASSERT_TRUE(write(everyLayout(), folder / "asset.glb"));
  const test::Glb glb = test::Glb::parse(test::bytesOf(folder / "asset.glb"));
  std::string text = glb.json;
  const std::string buffer = "\"buffers\":[{";
  const std::size_t at = text.find(buffer);
  ASSERT_NE(at, std::string::npos);
  text.insert(at + buffer.size(), "\"uri\":\"asset.bin\",");
  test::spill(folder / "asset.bin", glb.binary);
  test::spill(folder / "asset.gltf", std::as_bytes(std::span(text)));
  const Result<Asset> read = asset::read(folder / "asset.gltf");
  ASSERT_TRUE(read) << read.error().message;
  test::expectSame(*read, everyLayout());
  const Result<bool> answer = isAsset(folder / "asset.gltf");
  ASSERT_TRUE(answer);
  EXPECT_TRUE(*answer);
}

TEST(AssetRead, AnUnbakedMeshIsSentToTheBake) {
  const Folder folder;
  const std::string_view mesh = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  ASSERT_TRUE(file::writeAtomically(folder / "mesh.obj", mesh));
  const Result<Asset> read = asset::read(folder / "mesh.obj");
  ASSERT_FALSE(read);
  EXPECT_NE(read.error().message.find("bake it first"), std::string::npos) << read.error().message;
  const Result<Asset> missing = asset::read(folder / "missing.obj");
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().message.find("bake it first"), std::string::npos);
}

TEST(IsAsset, TellsAssetsFromOtherFiles) {
  const Folder folder;
  ASSERT_TRUE(write(everyLayout(), folder / "asset.glb"));
  Result<bool> answer = isAsset(folder / "asset.glb");
  ASSERT_TRUE(answer);
  EXPECT_TRUE(*answer);

  test::Glb plain = test::Glb::parse(test::bytesOf(folder / "asset.glb"));
  for (std::size_t at; (at = plain.json.find("LAMBENT_")) != std::string::npos;)
    plain.json.replace(at, 8, "FOREIGN_");
  ASSERT_TRUE(file::writeAtomically(folder / "plain.glb", plain.bytes()));
  answer = isAsset(folder / "plain.glb");
  ASSERT_TRUE(answer);
  EXPECT_FALSE(*answer);

  for (const char* text : {"", "glTF", "solid but not glTF at all: LAMBENT_radiance_transfer"}) {
    ASSERT_TRUE(file::writeAtomically(folder / "other.glb", std::string_view(text)));
    answer = isAsset(folder / "other.glb");
    ASSERT_TRUE(answer);
    EXPECT_FALSE(*answer);
  }
  EXPECT_EQ(isAsset(folder / "missing.glb").error().kind, ErrorKind::BadInput);
}

TEST(AssetRoundTrip, ShadowedTransferKeptBesideIsExact) {
  for (Layout layout : {Layout::Vertices, Layout::Texels})
    for (Encoding encoding : {Encoding::Float16, Encoding::Float32})
      for (int channels : {1, 3})
        for (int outBands : {0, 2}) {
          Asset asset = shaped(layout, encoding, 3, 3, outBands, 3);
          asset.transfer.kind = transfer::Kind::Interreflected;
          Surface& surface = surfaceOf(asset);
          Response own = *surface.responses.find(Kind::Unshadowed);
          surface.responses.drop(Kind::Unshadowed);
          Response kept = own;
          const std::size_t receivers = surface.receivers->size() * std::size_t(channels);
          kept.diffuse->vectors = {3, channels,
                                   transfer::encode(randomNumbers(receivers * 9, 3), encoding)};
          if (outBands > 0)
            kept.glossy->matrices = {outBands, 3, channels,
                                     transfer::encode(randomNumbers(receivers * 36, 4), encoding)};
          surface.responses.set(Kind::Interreflected, own);
          surface.responses.set(Kind::Shadowed, kept);
          test::expectSame(throughFile(asset), asset);
          surface.responses.each([](Kind, Response& response) { response.diffuse.reset(); });
          if (outBands > 0) test::expectSame(throughFile(asset), asset);
        }
}

TEST(AssetRoundTrip, BiScaleInEveryEncoding) {
  for (const Encoding encoding : {Encoding::Float16, Encoding::Float32, Encoding::Snorm8}) {
    Asset asset = biScale();
    asset.transfer.rtts[0] = transfer::encode(decode(asset.transfer.rtts[0]), encoding);
    auto& matrices = std::get<transfer::BiScale<Numbers>>(asset.transfer.meshes[0]).matrices;
    matrices.set(Kind::Interreflected,
                 {3, 3, 3, transfer::encode(randomNumbers(4 * 3 * 81, 5), encoding, 81)});
    Numbers& shadowed = matrices.find(Kind::Shadowed)->numbers;
    shadowed = transfer::encode(decode(shadowed), encoding, 81);
    test::expectSame(throughFile(asset), asset);
  }
}

TEST(AssetRoundTrip, TheSamplesRotationIsTheHarmonics) {
  Mat3d tangentFromWorld;  // rows: T = +x, N × T = −z, N = +y
  tangentFromWorld << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  const std::vector<double> rotation = sh::rotationMatrix(3, tangentFromWorld);
  const std::vector<float> stored =
      decode(std::get<transfer::BiScale<Numbers>>(biScale().transfer.meshes[0])
                 .matrices.find(Kind::Shadowed)
                 ->numbers);
  for (std::size_t k = 0; k < stored.size(); ++k)
    EXPECT_NEAR(stored[k], rotation[k % 81], 5e-4) << k;
}

}  // namespace
}  // namespace lambent::asset
