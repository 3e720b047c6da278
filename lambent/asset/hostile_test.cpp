// Files from anywhere: truncated, damaged, and made to mislead. What single members may hold is in
// spec/refused.json (refused_test.cpp).
#include <gtest/gtest.h>

#include <functional>
#include <nlohmann/json.hpp>
#include <random>

#include "lambent/asset/asset.h"
#include "lambent/asset/check.h"
#include "lambent/asset/format.h"
#include "lambent/asset/read.h"
#include "lambent/asset/samples.h"
#include "lambent/asset/test_support.h"

namespace lambent::asset {
namespace {

using nlohmann::json;
using test::Folder;
using test::Glb;

class AssetHostile : public ::testing::Test {
 public:
  explicit AssetHostile(Asset asset = everyLayout()) : asset_(std::move(asset)) {}

 protected:
  void SetUp() override {
    const Status written = write(asset_, folder_ / "good.glb");
    ASSERT_TRUE(written) << written.error().message;
    good_ = test::bytesOf(folder_ / "good.glb");
  }

  Result<Asset> readBytes(std::span<const std::byte> bytes) {
    test::spill(folder_ / "bad.glb", bytes);
    return read(folder_ / "bad.glb");
  }

  /// Reads the good file with its JSON changed.
  Result<Asset> readChanged(const std::function<void(json&)>& change) {
    Glb glb = Glb::parse(good_);
    json document = json::parse(glb.json);
    change(document);
    glb.json = document.dump();
    return readBytes(glb.bytes());
  }

  void expectRefused(const std::string& what, const std::function<void(json&)>& change) {
    const Result<Asset> asset = readChanged(change);
    ASSERT_FALSE(asset) << what;
    EXPECT_EQ(asset.error().kind, ErrorKind::BadInput);
    EXPECT_NE(asset.error().message.find(what), std::string::npos) << asset.error().message;
    EXPECT_NE(asset.error().message.find("bad.glb"), std::string::npos) << asset.error().message;
  }

  static json& root(json& document) { return document["extensions"][test::kName]; }
  static json& primitive(json& document, int mesh) {
    return document["meshes"][std::size_t(mesh)]["primitives"][0]["extensions"][test::kName];
  }

  Asset asset_;
  Folder folder_;
  std::vector<std::byte> good_;
};

TEST_F(AssetHostile, ALimitOfMemory) {
  ReadOptions options;
  options.memoryLimit = 100;
  const Result<Asset> asset = read(folder_ / "good.glb", options);
  ASSERT_FALSE(asset);
  EXPECT_NE(asset.error().message.find("over the limit of 800 bytes"), std::string::npos)
      << asset.error().message;
  options.memoryLimit = 1 << 20;
  EXPECT_TRUE(read(folder_ / "good.glb", options));
}

TEST_F(AssetHostile, TheFileThatTheOthersAreMadeFromIsGood) {
  const Result<Asset> asset = readChanged([](json&) {});
  ASSERT_TRUE(asset) << asset.error().message;
  test::expectSame(*asset, everyLayout());
}

TEST_F(AssetHostile, OrdinaryGltfIsSentToTheBake) {
  expectRefused("is an ordinary glTF file: bake it first with `lambent bake`", [](json& document) {
    document.erase("extensions");
    document.erase("extensionsUsed");
    for (json& mesh : document["meshes"]) mesh["primitives"][0].erase("extensions");
  });
}

TEST_F(AssetHostile, MessagesSayWhatToDo) {
  expectRefused("version: 2.0 is newer than 1.6, which this Lambent reads: use a newer Lambent",
                [](json& d) { root(d)["version"] = "2.0"; });
  expectRefused("version: 0.9 is older than 1.6: bake the scene anew",
                [](json& d) { root(d)["version"] = "0.9"; });
  expectRefused("108 numbers where 4 receivers × 1 channels × 9 coefficients need 36",
                [](json& d) { primitive(d, 0)["vectors"]["channels"] = 1; });
  expectRefused("grid: 6 positions for 8 texels",
                [](json& d) { primitive(d, 1)["grid"]["width"] = 4; });
  expectRefused("has component type 5123 × 1 where 5126",
                [](json& d) { primitive(d, 0)["vectors"]["encoding"] = "float32"; });
  expectRefused("moves a mesh away from where its transfer was baked: bake the scene as it stands",
                [](json& d) {
                  d["nodes"][1]["translation"] = {0, 1, 0};
                });
}

TEST_F(AssetHostile, NumbersThatAreNotFiniteAreFound) {
  Glb glb = Glb::parse(good_);
  json document = json::parse(glb.json);
  const std::size_t accessor = primitive(document, 0)["vectors"]["accessor"];
  const std::size_t view = document["accessors"][accessor]["bufferView"];
  const std::size_t offset = document["bufferViews"][view].value("byteOffset", std::size_t(0));
  glb.binary[offset + 2 * (27 * 3 + 5)] = std::byte(0);
  glb.binary[offset + 2 * (27 * 3 + 5) + 1] = std::byte(0x7e);
  const Result<Asset> half = readBytes(glb.bytes());
  ASSERT_FALSE(half);
  EXPECT_NE(half.error().message.find(
                "meshes[0].primitives[0].extensions.LAMBENT_radiance_transfer.vectors: not a "
                "finite number at receiver 3, channel 0, coefficient 5"),
            std::string::npos)
      << half.error().message;
}

TEST_F(AssetHostile, EveryTruncationIsRefused) {
  // Every length of the headers and of the JSON's beginning, then steps through the rest.
  for (std::size_t size = 0; size < good_.size(); size += size < 64 ? 1 : 37) {
    const Result<Asset> asset = readBytes(std::span(good_).first(size));
    ASSERT_FALSE(asset) << size;
    EXPECT_EQ(asset.error().kind, ErrorKind::BadInput);
    (void)isAsset(folder_ / "bad.glb");
  }
}

TEST_F(AssetHostile, FlippedBytesNeverYieldAnAssetThatCannotBeWritten) {
  std::mt19937 random(11);
  int readable = 0;
  for (int round = 0; round < 1500; ++round) {
    std::vector<std::byte> bad = good_;
    const int flips = 1 + int(random() % 3);
    for (int i = 0; i < flips; ++i) bad[random() % bad.size()] = std::byte(random() & 255);
    const Result<Asset> asset = readBytes(bad);
    (void)isAsset(folder_ / "bad.glb");
    if (!asset) {
      EXPECT_FALSE(asset.error().message.empty());
      continue;
    }
    ++readable;
    const Status writable = checkForWriting(*asset);
    EXPECT_TRUE(writable) << writable.error().message;
  }
  EXPECT_GT(readable, 0);  // most flips only change a number
}

TEST_F(AssetHostile, JsonTokensSwapped) {
  // Numbers of the JSON replaced by odd ones: no crash, no hang, no huge allocation.
  const Glb glb = Glb::parse(good_);
  std::mt19937 random(5);
  const std::vector<std::string> odd = {"-1",    "4294967296", "1e308", "null",
                                        "\"x\"", "[]",         "{}",    "65535"};
  for (int round = 0; round < 600; ++round) {
    Glb bad = glb;
    std::size_t at = random() % bad.json.size();
    at = bad.json.find_first_of("0123456789", at);
    if (at == std::string::npos) continue;
    const std::size_t end = bad.json.find_first_not_of("0123456789", at);
    bad.json.replace(at, end - at, odd[random() % odd.size()]);
    const Result<Asset> asset = readBytes(bad.bytes());
    if (asset) continue;
    EXPECT_FALSE(asset.error().message.empty());
  }
}

class KeptShadowedHostile : public AssetHostile {
 public:
  KeptShadowedHostile() : AssetHostile(keptShadowed()) {}
};

TEST_F(KeptShadowedHostile, NumbersThatAreNotFinite) {
  std::get<transfer::Surface<transfer::Numbers>>(asset_.transfer.meshes[1])
      .responses.find(transfer::Kind::Shadowed)
      ->glossy->matrices.numbers.single[81 * 2 + 9 * 4 + 7] = std::nanf("");
  const Status status = write(asset_, folder_ / "nan.glb");
  ASSERT_FALSE(status);
  EXPECT_NE(status.error().message.find("shadowed.matrices: not a finite number at receiver 2, "
                                        "channel 0, row 4, column 7"),
            std::string::npos)
      << status.error().message;
}

TEST_F(KeptShadowedHostile, AReaderThatDoesNotKnowItSeesTheInterreflectedTransfer) {
  const Result<Asset> without = readChanged([](json& d) {
    for (int mesh : {0, 1}) primitive(d, mesh).erase("shadowed");
    root(d)["version"] = "1.1";
  });
  ASSERT_TRUE(without) << without.error().message;
  Asset expected = keptShadowed();
  for (transfer::EncodedMesh& mesh : expected.transfer.meshes)
    std::get<transfer::Surface<transfer::Numbers>>(mesh).responses.drop(transfer::Kind::Shadowed);
  test::expectSame(*without, expected);
}

}  // namespace
}  // namespace lambent::asset
