// The files against spec/: every member that is written is in the schema, every member that the
// schema requires is written, and the committed samples read as what they are meant to be.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "lambent/asset/asset.h"
#include "lambent/asset/format.h"
#include "lambent/asset/samples.h"
#include "lambent/asset/test_support.h"
#include "lambent/transfer/names.h"

namespace lambent::asset {
namespace {

using nlohmann::json;

json schema(const std::string& what) {
  std::ifstream file(test::kSpec / test::kName / "schema" /
                     (what + "." + test::kName + ".schema.json"));
  EXPECT_TRUE(file);
  return json::parse(file, nullptr, false);
}

/// Keys, enumerations and required members, through nested objects. The whole of JSON schema is
/// checked by tests/gltf with a full validator.
void expectDescribed(const json& value, const json& schemaObject, const std::string& place) {
  SCOPED_TRACE(place);
  for (const auto& [key, member] : value.items()) {
    ASSERT_TRUE(schemaObject["properties"].contains(key)) << key;
    const json& described = schemaObject["properties"][key];
    if (described.contains("enum")) {
      EXPECT_NE(std::find(described["enum"].begin(), described["enum"].end(), member),
                described["enum"].end())
          << member;
    }
    if (member.is_object()) expectDescribed(member, described, place + "." + key);
  }
  for (const json& required : schemaObject.value("required", json::array()))
    EXPECT_TRUE(value.contains(required.get<std::string>())) << required;
}

TEST(Spec, WhatIsWrittenIsWhatTheSchemaSays) {
  const test::Folder folder;
  ASSERT_TRUE(write(everyLayout(), folder / "asset.glb"));
  const json document = json::parse(test::Glb::parse(test::bytesOf(folder / "asset.glb")).json);
  EXPECT_EQ(document["extensionsUsed"], json::array({test::kName}));
  EXPECT_FALSE(document.contains("extensionsRequired"));
  expectDescribed(document["extensions"][test::kName], schema("glTF"), "root");
  const json primitives = schema("mesh.primitive");
  for (std::size_t i = 0; i < 3; ++i)
    expectDescribed(document["meshes"][i]["primitives"][0]["extensions"][test::kName], primitives,
                    "mesh " + std::to_string(i));
  EXPECT_FALSE(document["meshes"][3]["primitives"][0].contains("extensions"));  // the mirror
}

TEST(Spec, BiScaleIsWhatTheSchemaSays) {
  const test::Folder folder;
  ASSERT_TRUE(write(relief(), folder / "asset.glb"));
  const json document = json::parse(test::Glb::parse(test::bytesOf(folder / "asset.glb")).json);
  const json root = schema("glTF");
  expectDescribed(document["extensions"][test::kName], root, "root");
  expectDescribed(document["extensions"][test::kName]["rtts"][0],
                  root["properties"]["rtts"]["items"], "rtt");
  const json described = schema("mesh.primitive");
  for (std::size_t i = 0; i < 2; ++i) {
    const json& object = document["meshes"][i]["primitives"][0]["extensions"][test::kName];
    for (const auto& [key, member] : object["biScale"].items()) {
      EXPECT_TRUE(described["properties"]["biScale"]["properties"].contains(key)) << key;
      if (key == "shadowed") expectDescribed(member, described["$defs"]["localMatrices"], key);
    }
  }
}

TEST(Spec, ALayerIsWhatTheSchemaSays) {
  const test::Folder folder;
  ASSERT_TRUE(write(layered(), folder / "asset.glb"));
  const json document = json::parse(test::Glb::parse(test::bytesOf(folder / "asset.glb")).json);
  const auto biScaleOf = [&](int mesh) {
    return document["meshes"][mesh]["primitives"][0]["extensions"][test::kName]["biScale"];
  };
  EXPECT_FALSE(biScaleOf(0).contains("layer"));
  EXPECT_EQ(biScaleOf(1)["layer"], true);
  const json described = schema("mesh.primitive")["properties"]["biScale"]["properties"];
  EXPECT_EQ(described["layer"]["type"], "boolean");
  EXPECT_EQ(document["materials"][1]["alphaMode"], "BLEND");
}

TEST(Spec, KeptShadowedTransferIsWhatTheSchemaSays) {
  const test::Folder folder;
  ASSERT_TRUE(write(keptShadowed(), folder / "asset.glb"));
  const json document = json::parse(test::Glb::parse(test::bytesOf(folder / "asset.glb")).json);
  EXPECT_EQ(document["extensions"][test::kName]["version"], "1.6");
  const json described = schema("mesh.primitive");
  for (std::size_t i = 0; i < 2; ++i)
    expectDescribed(document["meshes"][i]["primitives"][0]["extensions"][test::kName], described,
                    "mesh " + std::to_string(i));
}

TEST(Spec, AGridOverTheSecondSetOfUvsIsWhatTheSchemaSays) {
  const test::Folder folder;
  ASSERT_TRUE(write(secondUvs(), folder / "asset.glb"));
  const json document = json::parse(test::Glb::parse(test::bytesOf(folder / "asset.glb")).json);
  const json& primitive = document["meshes"][0]["primitives"][0];
  EXPECT_TRUE(primitive["attributes"].contains("TEXCOORD_1"));
  const json& object = primitive["extensions"][test::kName];
  EXPECT_EQ(object["grid"]["texCoord"], 1);
  expectDescribed(object, schema("mesh.primitive"), "mesh 0");
}

TEST(Spec, SchemaNamesEveryEnumeration) {
  const json primitives = schema("mesh.primitive");
  const json root = schema("glTF");
  for (const json& name : root["properties"]["transfer"]["enum"])
    EXPECT_TRUE(transfer::kindNamed(name.get<std::string>())) << name;
  const transfer::Receivers atVertices, atTexels{{}, {}, transfer::AtTexels{}};
  EXPECT_EQ(primitives["properties"]["layout"]["enum"],
            json::array({transfer::layoutOf(atVertices), transfer::layoutOf(atTexels)}));
  for (const json& name : primitives["properties"]["vectors"]["properties"]["albedo"]["enum"])
    EXPECT_TRUE(transfer::albedoNamed(name.get<std::string>())) << name;
  for (const json& name : primitives["$defs"]["encoding"]["enum"])
    EXPECT_TRUE(transfer::encodingNamed(name.get<std::string>())) << name;
  for (const json& name : primitives["$defs"]["localMatrices"]["properties"]["encoding"]["enum"])
    EXPECT_TRUE(transfer::encodingNamed(name.get<std::string>())) << name;
}

TEST(Spec, CommittedSamplesReadAsMeant) {
  for (const auto& [name, asset] : samples()) {
    SCOPED_TRACE(name);
    const Result<Asset> read = asset::read(test::kSpec / "samples" / name);
    ASSERT_TRUE(read) << read.error().message
                      << "\nafter a change of the samples: lambent_write_samples spec/samples";
    test::expectSame(*read, asset);
  }
}

// As these versions wrote them: what has been baked stays readable.
TEST(Spec, FilesOfOlderVersionsReadAsMeant) {
  for (const auto& [file, asset] :
       {std::pair{"1.0/every-layout.glb", everyLayout()}, std::pair{"1.1/bi-scale.glb", biScale()},
        std::pair{"1.2/kept-shadowed.glb", keptShadowed()},
        std::pair{"1.3/second-uvs.glb", secondUvs()}}) {
    SCOPED_TRACE(file);
    const json document =
        json::parse(test::Glb::parse(test::bytesOf(test::kSpec / "samples" / file)).json);
    EXPECT_EQ(document["extensions"][test::kName]["version"], std::string(file).substr(0, 3));
    const Result<Asset> read = asset::read(test::kSpec / "samples" / file);
    ASSERT_TRUE(read) << read.error().message;
    test::expectSame(*read, asset);
  }
}

TEST(Spec, TheSquareIsWhatAHandCalculates) {
  const Result<Asset> read = asset::read(test::kSpec / "samples" / "unoccluded-square.glb");
  ASSERT_TRUE(read) << read.error().message;
  const std::vector<float> m =
      decode(std::get<transfer::Surface<transfer::Numbers>>(read->transfer.meshes[0])
                 .responses.find(read->transfer.kind)
                 ->diffuse->vectors.numbers);
  ASSERT_EQ(m.size(), 4u * 9u);
  // ρ/π · Â_l · y_i(+y) with ρ = ½: ½ y_00, ⅓ y_1−1, and ⅛ of y_20 = −√(5/16π), y_22 = −√(15/16π).
  const double expected[9] = {0.5 * 0.28209479, 0.48860251 / 3, 0, 0, 0, 0, -0.31539157 / 8, 0,
                              -0.54627422 / 8};
  for (std::size_t i = 0; i < m.size(); ++i) EXPECT_NEAR(m[i], expected[i % 9], 1e-7) << i;
  // White light from everywhere, L = (√4π, 0, …): exit radiance is ρ.
  EXPECT_NEAR(m[0] * std::sqrt(4.0 * kPi), 0.5, 1e-6);
}

}  // namespace
}  // namespace lambent::asset
