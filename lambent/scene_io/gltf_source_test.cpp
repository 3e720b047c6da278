// What a scene keeps of its file, and says again. tests/gltf does the same through the tool, with a
// file that says everything.
#include <gtest/gtest.h>

#include "lambent/file/json.h"
#include "lambent/scene/source.h"
#include "lambent/scene_io/gltf_read.h"
#include "lambent/scene_io/test_gltf.h"

namespace lambent::scene_io {
namespace {

using nlohmann::json;

class GltfSource : public ::testing::Test {
 protected:
  GltfSource() {
    document_.positions(kTriangle);
    document_.attribute("TEXCOORD_0", std::vector<Vec2>{{0, 0}, {1, 0}, {0, 1}}, Component::Float,
                        "VEC2", 3);
    document_.attribute("TEXCOORD_3", std::vector<Vec2>{{3, 0}, {3, 1}, {3, 2}}, Component::Float,
                        "VEC2", 3);
    document_.j["materials"] = json::parse(R"([{"pbrMetallicRoughness": {"metallicFactor": 0}}])");
    document_.primitive()["material"] = 0;
  }

  /// As it is read.
  Result<LoadedScene> read() {
    auto loaded = load(document_.write(folder_));
    if (loaded) findings_ = loaded->findings;
    return loaded;
  }
  /// As it is written again.
  json again() {
    const auto loaded = read();
    if (!loaded) ADD_FAILURE() << loaded.error().message;
    return loaded ? GltfBuilder(loaded->scene).json() : json();
  }

  TemporaryFolder folder_;
  GltfDocument document_;
  Findings findings_;
};

TEST_F(GltfSource, SaysWhoseItIs) {
  document_.j["asset"] = json::parse(
      R"({"version": "2.0", "generator": "X", "copyright": "C", "extras": {"license": "L"}})");
  document_.j["scenes"][0]["name"] = "Room";
  const auto loaded = read();
  ASSERT_TRUE(loaded);
  const scene::Source& source = *loaded->scene.source;
  EXPECT_EQ(source.copyright, "C");
  EXPECT_EQ(source.generator, "X");
  EXPECT_EQ(source.title, "Room");
  EXPECT_EQ(source.assetExtras, R"({"license":"L"})");
  document_.j["asset"]["generator"] = GltfBuilder(loaded->scene).json()["asset"]["generator"];
  EXPECT_EQ(document_.j["asset"]["generator"], "Lambent (from: X)");
  EXPECT_EQ(again()["asset"], document_.j["asset"]);
}

TEST_F(GltfSource, WhatLostItsTransferIsToldFromWhatWasNeverBaked) {
  const auto isStripped = [&] {
    EXPECT_TRUE(read());
    return std::any_of(findings_.begin(), findings_.end(),
                       [](const report::Finding& f) { return f.code == "transfer-stripped"; });
  };
  EXPECT_FALSE(isStripped());
  document_.j["asset"]["extras"] = {{"lambent", {{"baked", "1.3"}}}, {"license", "L"}};
  EXPECT_TRUE(isStripped());
  EXPECT_EQ(again()["asset"]["extras"], json({{"license", "L"}}));
  document_.j["extensions"]["LAMBENT_radiance_transfer"] = json::object();
  EXPECT_FALSE(isStripped());
}

TEST_F(GltfSource, SetsOfCoordinatesMoveUp) {
  document_.j["materials"][0]["occlusionTexture"] = {{"index", 0}, {"texCoord", 3}};
  document_.j["materials"][0]["normalTexture"] = {{"index", 0}};
  document_.j["textures"] = {{{"source", 0}}};
  const auto png = std::string("\x89PNG\r\n\x1a\n and then anything: nobody looks at it");
  document_.j["images"] = {
      {{"bufferView", document_.gltf.addBufferView(std::as_bytes(std::span(png)))},
       {"mimeType", "image/png"}}};
  const json written = again();
  const json& material = written["materials"][0];
  EXPECT_EQ(material["occlusionTexture"]["texCoord"], 1);
  EXPECT_FALSE(material["normalTexture"].contains("texCoord"));
  const json& attributes = written["meshes"][0]["primitives"][0]["attributes"];
  EXPECT_TRUE(attributes.contains("TEXCOORD_1"));
  EXPECT_FALSE(attributes.contains("TEXCOORD_3"));
  EXPECT_EQ(written["images"].size(), 1u);
}

TEST_F(GltfSource, WhatMarksAPlaceStandsThereFarFromTheOrigin) {
  document_.j["nodes"] = json::parse(R"([
      {"mesh": 0, "translation": [5000000, 0, 0], "children": [1]},
      {"name": "mark", "translation": [0, 2, 0]}])");
  const auto loaded = read();
  ASSERT_TRUE(loaded);
  const double origin = loaded->scene.origin.x();
  EXPECT_NEAR(origin, 5000000.0, 2.0);
  const json written = GltfBuilder(loaded->scene).json();
  EXPECT_EQ(written["nodes"][0]["children"], json::array({1}));
  EXPECT_FALSE(written["nodes"][0].contains("translation"));
  EXPECT_EQ(written["nodes"][1]["matrix"][12], 5000000.0 - origin);
  EXPECT_EQ(written["nodes"][1]["matrix"][13], 2.0);
  EXPECT_EQ(written["scenes"][0]["extras"]["lambent"]["origin"][0], origin);
}

TEST_F(GltfSource, ShearedAndFlatNodesStandStraight) {
  document_.j["nodes"] = json::parse(R"([{"mesh": 0},
      {"scale": [1, 3, 1], "children": [2]}, {"rotation": [0, 0, 0.3826834, 0.9238795]},
      {"scale": [0, 0, 0], "translation": [1, 2, 3]}])");
  document_.j["scenes"][0]["nodes"] = {0, 1, 3};
  document_.j["nodes"][1]["matrix"] = {1, 0, 0, 0, 0.5, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  document_.j["nodes"][1].erase("scale");
  const json written = again();
  const json& m = written["nodes"][1]["matrix"];
  const auto dot = [&](int a, int b) {
    double sum = 0.0;
    for (int k = 0; k < 3; ++k)
      sum += m[std::size_t(4 * a + k)].get<double>() * m[std::size_t(4 * b + k)].get<double>();
    return sum;
  };
  EXPECT_NEAR(dot(0, 1), 0.0, 1e-12);
  EXPECT_NEAR(dot(1, 1), 1.0, 1e-12);
  EXPECT_EQ(written["nodes"][3]["matrix"],
            json::array({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 1, 2, 3, 1}));
}

TEST_F(GltfSource, ScenesThatWereChangedAreWrittenFlat) {
  document_.j["nodes"] = json::parse(R"([{"name": "a", "mesh": 0}, {"name": "b", "mesh": 0}])");
  document_.j["scenes"][0]["nodes"] = {0, 1};
  auto loaded = read();
  ASSERT_TRUE(loaded);
  std::swap(loaded->scene.meshes[0], loaded->scene.meshes[1]);
  const json written = GltfBuilder(loaded->scene).json();
  ASSERT_EQ(written["nodes"].size(), 2u);
  EXPECT_EQ(written["nodes"][0]["name"], "b");
  EXPECT_EQ(written["nodes"][0]["mesh"], 0);
}

TEST_F(GltfSource, PicturesThatAreNotThereGoWithTheirPlace) {
  document_.j["materials"][0]["normalTexture"] = {{"index", 0}};
  document_.j["materials"][0]["occlusionTexture"] = {{"index", 7}};
  document_.j["textures"] = {{{"source", 0}}};
  document_.j["images"] = {{{"uri", "../../elsewhere.png"}}};
  const json written = again();
  EXPECT_FALSE(written["materials"][0].contains("normalTexture"));
  EXPECT_FALSE(written["materials"][0].contains("occlusionTexture"));
  EXPECT_FALSE(written.contains("images"));
  EXPECT_EQ(countOf(findings_, "picture-lost"), 2u);
}

TEST_F(GltfSource, TangentsGoWithTheNormalsThatTheyWereMadeFor) {
  document_.attribute("TANGENT", std::vector<Eigen::Vector4f>(3, {2, 0, 0, -0.5f}),
                      Component::Float, "VEC4", 3);
  document_.attribute("NORMAL", std::vector<Vec3>(3, {0, 0, 1}), Component::Float, "VEC3", 3);
  auto loaded = read();
  ASSERT_TRUE(loaded);
  const auto tangents = [&] {
    for (const scene::VertexNumbers& numbers : loaded->scene.meshes[0].others)
      if (numbers.areTangents()) return numbers.values;
    return std::vector<float>();
  };
  ASSERT_EQ(tangents().size(), 12u);
  EXPECT_EQ(tangents()[0], 1.0f);
  EXPECT_EQ(tangents()[3], -1.0f);
  document_.attribute("NORMAL", std::vector<Vec3>(3, {0, 0, -1}), Component::Float, "VEC3", 3);
  loaded = read();
  ASSERT_TRUE(loaded);
  EXPECT_TRUE(tangents().empty());
  EXPECT_EQ(countOf(findings_, "tangents-dropped"), 1u);
}

TEST_F(GltfSource, AnythingMayStandAnywhere) {
  const json values = json::parse(
      R"([null, true, -1, 1e300, "text", [], [[[]]], {}, {"index": 0}, {"extensions": 3}])");
  const char* places[] = {"/asset/extras",
                          "/asset/extensions",
                          "/asset/copyright",
                          "/extras",
                          "/extensions/KHR_lights_punctual",
                          "/extensions/KHR_materials_variants",
                          "/scenes/0/extras",
                          "/scenes/0/name",
                          "/nodes/0/name",
                          "/nodes/0/extras",
                          "/nodes/0/extensions/KHR_lights_punctual",
                          "/nodes/0/camera",
                          "/cameras",
                          "/meshes/0/name",
                          "/meshes/0/extras",
                          "/meshes/0/extensions",
                          "/meshes/0/primitives/0/extras",
                          "/meshes/0/primitives/0/extensions",
                          "/meshes/0/primitives/0/extensions/KHR_materials_variants",
                          "/meshes/0/primitives/0/attributes/TANGENT",
                          "/meshes/0/primitives/0/attributes/_X",
                          "/materials/0/extras",
                          "/materials/0/name",
                          "/materials/0/extensions",
                          "/materials/0/extensions/KHR_materials_sheen",
                          "/materials/0/normalTexture",
                          "/materials/0/normalTexture/extensions",
                          "/materials/0/normalTexture/extensions/KHR_texture_transform",
                          "/materials/0/pbrMetallicRoughness",
                          "/materials/0/doubleSided",
                          "/materials/0/emissiveFactor",
                          "/materials/0",
                          "/textures",
                          "/textures/0",
                          "/images",
                          "/images/0",
                          "/samplers",
                          "/samplers/0",
                          "/textures/0/sampler"};
  document_.j["materials"][0]["normalTexture"] = {{"index", 0}, {"texCoord", 3}};
  document_.j["textures"] = {{{"source", 0}, {"sampler", 0}}};
  const auto png = std::string("\x89PNG\r\n\x1a\n");
  document_.j["images"] = {
      {{"bufferView", document_.gltf.addBufferView(std::as_bytes(std::span(png)))}}};
  const json sound = document_.j;
  for (const char* place : places) {
    for (const json& value : values) {
      document_.j = sound;
      json patch = json::array();
      const auto add = [&](const std::string& path, const json& what) {
        json step = json::object();
        step["op"] = "add", step["path"] = path, step["value"] = what;
        patch.insert(patch.begin(), std::move(step));
      };
      add(place, value);
      for (std::string path = place; (path = path.substr(0, path.rfind('/'))).size() > 1;)
        if (!sound.contains(json::json_pointer(path))) add(path, json::object());
      document_.j = sound.patch(patch);
      const auto loaded = load(document_.write(folder_));
      if (!loaded) continue;
      GltfBuilder written(loaded->scene);
      file::objectAt(written.json(), "extensions")["LAMBENT_radiance_transfer"] = 1;
      json& primitive = written.json()["meshes"][0]["primitives"][0];
      file::objectAt(primitive, "extensions")["LAMBENT_radiance_transfer"] = 1;
      const auto bytes = written.glb();
      ASSERT_TRUE(bytes);
      EXPECT_TRUE(load(folder_.write("again.glb", *bytes))) << place << " " << value;
    }
  }
}

}  // namespace
}  // namespace lambent::scene_io
