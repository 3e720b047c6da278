// Files from anywhere: truncated, damaged, and made to mislead.
#include <gtest/gtest.h>

#include <functional>
#include <nlohmann/json.hpp>
#include <random>

#include "lambent/asset/asset.h"
#include "lambent/asset/check.h"
#include "lambent/asset/names.h"
#include "lambent/asset/samples.h"
#include "lambent/asset/test_support.h"

namespace lambent::asset {
namespace {

using nlohmann::json;
using test::Folder;
using test::Glb;

const std::string kName(kExtensionName);

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

  static json& root(json& document) { return document["extensions"][kName]; }
  static json& primitive(json& document, int mesh) {
    return document["meshes"][std::size_t(mesh)]["primitives"][0]["extensions"][kName];
  }

  Asset asset_;
  Folder folder_;
  std::vector<std::byte> good_;
};

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

TEST_F(AssetHostile, Versions) {
  expectRefused("version: 2.0 is newer than 1.2", [](json& d) { root(d)["version"] = "2.0"; });
  expectRefused("version: 0.9 is older than 1.2", [](json& d) { root(d)["version"] = "0.9"; });
  for (const char* odd : {"", "1", "1.", ".5", "1.x", "one", "1.0.0", "-1.0"})
    expectRefused("is not of the form", [&](json& d) { root(d)["version"] = odd; });
  expectRefused("version: is not a string", [](json& d) { root(d)["version"] = 1; });
  expectRefused("version: is missing", [](json& d) { root(d).erase("version"); });
  EXPECT_TRUE(readChanged([](json& d) { root(d)["version"] = "1.7"; }));
}

TEST_F(AssetHostile, RootMembers) {
  expectRefused("transfer: is not unshadowed", [](json& d) { root(d)["transfer"] = "dark"; });
  expectRefused("frame: is not \"scene\"", [](json& d) { root(d)["frame"] = "object"; });
  for (const json& odd :
       {json(0), json(11), json(5.5), json("5"), json(1e300), json(-3), json(nullptr)})
    expectRefused("bands: is not an integer", [&](json& d) { root(d)["bands"] = odd; });
  expectRefused("takes light of 3 bands", [](json& d) { root(d)["bands"] = 2; });
  for (const json& odd : {json("18446744073709551616"), json("-1"), json(""), json("0x1")})
    expectRefused("seed: is not a string of", [&](json& d) { root(d)["seed"] = odd; });
  expectRefused("seed: is not a string", [](json& d) { root(d)["seed"] = 7; });
  expectRefused("passEnergy: has an entry", [](json& d) { root(d)["passEnergy"] = {1, "x"}; });
  expectRefused("passEnergy: is not an array", [](json& d) { root(d)["passEnergy"] = 1; });
  expectRefused(kName + ": is not an object", [](json& d) { root(d) = json::array(); });
}

TEST_F(AssetHostile, PrimitiveMembers) {
  expectRefused("meshes[0].primitives[0].extensions.LAMBENT_radiance_transfer.layout: is neither",
                [](json& d) { primitive(d, 0)["layout"] = "none"; });
  expectRefused("vectors.encoding: is neither",
                [](json& d) { primitive(d, 0)["vectors"]["encoding"] = "float64"; });
  expectRefused("vectors.albedo: is neither",
                [](json& d) { primitive(d, 0)["vectors"]["albedo"] = "maybe"; });
  expectRefused("channels is 2, not 1 or 3",
                [](json& d) { primitive(d, 0)["vectors"]["channels"] = 2; });
  expectRefused("vectors: is not an object", [](json& d) { primitive(d, 0)["vectors"] = 3; });
  expectRefused("108 numbers where 4 receivers × 1 channels × 9 coefficients need 36",
                [](json& d) { primitive(d, 0)["vectors"]["channels"] = 1; });
  expectRefused("matrices: 144 numbers where",
                [](json& d) { primitive(d, 2)["matrices"]["outBands"] = 3; });
  expectRefused("matrices.inBands: is not an integer from 1 to 10",
                [](json& d) { primitive(d, 2)["matrices"]["inBands"] = 1000000; });
  expectRefused("glossy: is not an array of 3", [](json& d) {
    primitive(d, 2)["matrices"]["glossy"] = {1, 2};
  });
  expectRefused("glossy must be", [](json& d) { primitive(d, 2)["matrices"]["glossy"][1] = -1; });
  expectRefused("glossy must be", [](json& d) { primitive(d, 2)["matrices"]["glossy"][1] = 1e60; });
  expectRefused("lobeExponent: is not a number in range",
                [](json& d) { primitive(d, 2)["matrices"]["lobeExponent"] = -1; });
}

TEST_F(AssetHostile, Grids) {
  expectRefused("grid: is missing", [](json& d) { primitive(d, 1).erase("grid"); });
  expectRefused("grid.width: is not an integer",
                [](json& d) { primitive(d, 1)["grid"]["width"] = 2147483647; });
  expectRefused("grid: 6 positions for 8 texels",
                [](json& d) { primitive(d, 1)["grid"]["width"] = 4; });
  expectRefused("grid.texCoord: is not an integer from 0 to 0",
                [](json& d) { primitive(d, 1)["grid"]["texCoord"] = 1; });
  expectRefused("grid: the primitive has no TEXCOORD_0",
                [](json& d) { d["meshes"][1]["primitives"][0]["attributes"].erase("TEXCOORD_0"); });
  expectRefused("grid.normals: accessor", [](json& d) {
    json& grid = primitive(d, 1)["grid"];
    grid["normals"] = grid["covered"];
  });
}

TEST_F(AssetHostile, Accessors) {
  for (const json& odd : {json(-1), json(1e18), json("0"), json(0.5), json(nullptr)})
    expectRefused("vectors.accessor: is not an integer",
                  [&](json& d) { primitive(d, 0)["vectors"]["accessor"] = odd; });
  const Result<Asset> beyond =
      readChanged([](json& d) { primitive(d, 0)["vectors"]["accessor"] = 1000000; });
  ASSERT_FALSE(beyond);
  EXPECT_EQ(beyond.error().kind, ErrorKind::BadInput);
  expectRefused("has component type 5126 × 3", [](json& d) {
    primitive(d, 0)["vectors"]["accessor"] =
        d["meshes"][0]["primitives"][0]["attributes"]["POSITION"];
  });
  expectRefused("has component type 5123 × 1 where 5126",
                [](json& d) { primitive(d, 0)["vectors"]["encoding"] = "float32"; });
  // Claims more than the buffer holds.
  const Result<Asset> longer = readChanged([](json& d) {
    const std::size_t accessor = primitive(d, 0)["vectors"]["accessor"];
    d["accessors"][accessor]["count"] = 4000000000u;
  });
  ASSERT_FALSE(longer);
  EXPECT_EQ(longer.error().kind, ErrorKind::BadInput);
  // Empty, by sparse or no buffer view: zeros of any number without a byte of file.
  const Result<Asset> zeros = readChanged([](json& d) {
    const std::size_t accessor = primitive(d, 0)["vectors"]["accessor"];
    d["accessors"][accessor].erase("bufferView");
    d["accessors"][accessor]["count"] = 4000000000u;
  });
  EXPECT_FALSE(zeros);
}

TEST_F(AssetHostile, AccessorsThatOverlapCannotAskForMoreThanTheFile) {
  expectRefused("accessors overlap", [](json& d) {
    // A hundred nodes show the same mesh: each would take a copy of its transfer.
    for (int i = 0; i < 100; ++i) {
      d["nodes"].push_back({{"mesh", 1}});
      d["scenes"][0]["nodes"].push_back(d["nodes"].size() - 1);
    }
  });
}

TEST_F(AssetHostile, NodesThatMoveTheMesh) {
  expectRefused("nodes[1]: moves a mesh away", [](json& d) {
    d["nodes"][1]["translation"] = {0, 1, 0};
  });
  expectRefused("nodes[2]: moves a mesh away", [](json& d) {
    d["nodes"].push_back({{"children", {2}}, {"scale", {2, 2, 2}}});
    d["scenes"][0]["nodes"] = {0, 1, d["nodes"].size() - 1, 3};
  });
  // An identity that is spelled out moves nothing; nor does moving a mirror unbake the others.
  const Result<Asset> same = readChanged([](json& d) {
    d["nodes"][0]["rotation"] = {0, 0, 0, 1};
    d["nodes"][1]["scale"] = {1.0, 1.0, 1.0};
  });
  EXPECT_TRUE(same);
}

TEST_F(AssetHostile, DeformedMeshes) {
  expectRefused("deform a mesh", [](json& d) { d["nodes"][0]["skin"] = 0; });
  expectRefused("deform a mesh", [](json& d) {
    json& bent = d["meshes"][1]["primitives"][0];
    bent["targets"] = {{{"POSITION", bent["attributes"]["POSITION"]}}};
  });
}

TEST_F(AssetHostile, NumbersThatAreNotFinite) {
  Glb glb = Glb::parse(good_);
  const json document = json::parse(glb.json);
  const auto poke = [&](std::size_t accessor, std::size_t at, std::initializer_list<int> bytes) {
    Glb bad = glb;
    const std::size_t view = document["accessors"][accessor]["bufferView"];
    std::size_t offset = document["bufferViews"][view].value("byteOffset", std::size_t(0)) + at;
    for (int byte : bytes) bad.binary[offset++] = std::byte(byte);
    return readBytes(bad.bytes());
  };
  json copy = document;
  const Result<Asset> half =
      poke(primitive(copy, 0)["vectors"]["accessor"], 2 * (27 * 3 + 5), {0, 0x7e});
  ASSERT_FALSE(half);
  EXPECT_NE(half.error().message.find(
                "meshes[0].primitives[0].extensions.LAMBENT_radiance_transfer: vectors: not a "
                "finite number at receiver 3, channel 0, coefficient 5"),
            std::string::npos)
      << half.error().message;
  const Result<Asset> single =
      poke(primitive(copy, 2)["matrices"]["accessor"], 4 * 36, {0, 0, 0x80, 0xff});
  ASSERT_FALSE(single);
  EXPECT_NE(single.error().message.find("matrices: not a finite number at receiver 1, channel 0, "
                                        "row 0, column 0"),
            std::string::npos);
  const Result<Asset> place = poke(primitive(copy, 1)["grid"]["positions"], 12, {0, 0, 0xc0, 0x7f});
  ASSERT_FALSE(place);
  EXPECT_NE(place.error().message.find("not a finite position at texel 1"), std::string::npos);
  const Result<Asset> flag = poke(primitive(copy, 1)["grid"]["covered"], 4, {7});
  ASSERT_FALSE(flag);
  EXPECT_NE(flag.error().message.find("covered is 7"), std::string::npos);
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

class BiScaleHostile : public AssetHostile {
 public:
  BiScaleHostile() : AssetHostile(biScale()) {}
  static json& patch(json& document, int mesh) { return primitive(document, mesh)["biScale"]; }
};

TEST_F(BiScaleHostile, Members) {
  EXPECT_TRUE(readChanged([](json&) {}));
  expectRefused("rtt is 1, and the asset has 1", [](json& d) { patch(d, 0)["rtt"] = 1; });
  expectRefused("rtt: is not an integer", [](json& d) { patch(d, 0)["rtt"] = -1; });
  expectRefused("scale must be", [](json& d) { patch(d, 0)["scale"] = 0; });
  expectRefused("tangents: is missing", [](json& d) { patch(d, 0).erase("tangents"); });
  expectRefused("shadowed: 324 numbers where", [](json& d) { patch(d, 0)["bands"] = 2; });
  expectRefused("takes light of 3 bands", [](json& d) { root(d)["bands"] = 2; });
  expectRefused("idMap: 8 numbers for 3×2 texels",
                [](json& d) { patch(d, 0)["idMap"]["width"] = 3; });
  expectRefused("idMap.height: is not an integer",
                [](json& d) { patch(d, 0)["idMap"]["height"] = 100000; });
  expectRefused("tiles: is not an array of at most 2", [](json& d) {
    patch(d, 1)["tiles"] = {1, 2, 3};
  });
  expectRefused("tangent 0 is not", [](json& d) {
    patch(d, 0)["tangents"] = d["meshes"][0]["primitives"][0]["attributes"]["NORMAL"];
  });
  asset_.transfer.meshes[0].bands = 3;
  asset_.transfer.meshes[0].channels = 1;
  asset_.transfer.meshes[0].vectors =
      encode::encode(std::vector<float>(36, 0.5f), encode::Encoding::Float32);
  const Status both = write(asset_, folder_ / "both.glb");
  ASSERT_FALSE(both);
  EXPECT_NE(both.error().message.find("no vectors or matrices beside it"), std::string::npos);
}

TEST_F(BiScaleHostile, Rtts) {
  const auto rtt = [](json& d) -> json& { return root(d)["rtts"][0]; };
  expectRefused("rtts: is not an array", [](json& d) { root(d)["rtts"] = 5; });
  expectRefused("width: is not an integer from 1", [&](json& d) { rtt(d)["width"] = 0; });
  expectRefused("views: is not an integer", [&](json& d) { rtt(d)["views"] = 65; });
  expectRefused("numbers where", [&](json& d) { rtt(d)["views"] = 3; });
  expectRefused("size is not two", [&](json& d) { rtt(d)["size"] = {1, -1}; });
  expectRefused("size: is not an array of 2", [&](json& d) { rtt(d)["size"] = {1}; });
  expectRefused("values.scales: is missing", [&](json& d) { rtt(d)["values"].erase("scales"); });
  expectRefused("encoding: is none of", [&](json& d) { rtt(d)["values"]["encoding"] = "int4"; });
}

class KeptShadowedHostile : public AssetHostile {
 public:
  KeptShadowedHostile() : AssetHostile(keptShadowed()) {}
  static json& kept(json& document, int mesh) { return primitive(document, mesh)["shadowed"]; }
};

TEST_F(KeptShadowedHostile, Members) {
  EXPECT_TRUE(readChanged([](json&) {}));
  expectRefused("shadowed: is not an object", [](json& d) { kept(d, 0) = 3; });
  expectRefused("shadowed.vectors: is not an object", [](json& d) { kept(d, 0)["vectors"] = 1; });
  expectRefused("shadowed.vectors.channels: is missing",
                [](json& d) { kept(d, 0)["vectors"].erase("channels"); });
  expectRefused("shadowed.vectors: channels is 2, not 1 or 3",
                [](json& d) { kept(d, 0)["vectors"]["channels"] = 2; });
  expectRefused("shadowed.vectors: 36 numbers where 4 receivers × 3 channels × 9 coefficients",
                [](json& d) { kept(d, 0)["vectors"]["channels"] = 3; });
  expectRefused("shadowed.vectors.encoding: is neither",
                [](json& d) { kept(d, 0)["vectors"]["encoding"] = "snorm8"; });
  expectRefused("shadowed.matrices: 324 numbers where",
                [](json& d) { kept(d, 1)["matrices"]["channels"] = 3; });
  expectRefused("shadowed.matrices: 36 numbers where", [](json& d) {
    kept(d, 1)["matrices"]["accessor"] = kept(d, 1)["vectors"]["accessor"];
  });
  expectRefused("shadowed.matrices.accessor: is not an integer",
                [](json& d) { kept(d, 1)["matrices"]["accessor"] = -1; });
  // Half of it would be shown with the other half of the interreflected one.
  expectRefused("must hold vectors and matrices where the primitive does",
                [](json& d) { kept(d, 1).erase("vectors"); });
  expectRefused("must hold vectors and matrices where the primitive does",
                [](json& d) { kept(d, 0)["matrices"] = kept(d, 1)["matrices"]; });
  expectRefused("must hold vectors and matrices where the primitive does",
                [](json& d) { primitive(d, 0).erase("vectors"); });
  expectRefused("kept beside interreflected transfer alone, and this asset's is shadowed",
                [](json& d) { root(d)["transfer"] = "shadowed"; });
  // A member that says nothing is passed over, as is one that a later version may add.
  EXPECT_TRUE(readChanged([](json& d) { kept(d, 0) = json::object(); }));
  EXPECT_TRUE(readChanged([](json& d) { kept(d, 0)["texture"] = 7; }));
}

TEST_F(KeptShadowedHostile, NumbersThatAreNotFinite) {
  asset_.transfer.meshes[1].shadowed.matrices.single[81 * 2 + 9 * 4 + 7] = std::nanf("");
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
  for (encode::EncodedMesh& mesh : expected.transfer.meshes) mesh.shadowed = {};
  test::expectSame(*without, expected);
}

}  // namespace
}  // namespace lambent::asset
