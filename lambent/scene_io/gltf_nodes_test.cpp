// Where meshes of a glTF file stand: matrices, instances, hidden nodes, skins and morph targets.
#include <nlohmann/json.hpp>

#include "lambent/scene_io/gltf_read.h"
#include "lambent/scene_io/test_gltf.h"

namespace lambent::scene_io {
namespace {

using nlohmann::json;

class GltfPlaces : public testing::Test {
 protected:
  GltfPlaces() { document_.positions(kTriangle); }
  json& node() { return document_.j["nodes"][0]; }
  Result<LoadedScene> loaded() { return load(document_.write(folder_)); }
  template <class T>
  int accessor(const std::vector<T>& values, const char* type, std::size_t count) {
    return document_.gltf.addAccessor(asBytes(values), Component::Float, type, count);
  }

  TemporaryFolder folder_;
  GltfDocument document_;
};

TEST_F(GltfPlaces, MatricesWithRoundingNoiseAreAffine) {
  for (const double w : {0.9999999, 1.0000001, 2.0}) {
    node()["matrix"] = {w, 0, 0, 1e-9, 0, w, 0, -1e-8, 0, 0, w, 0, 3 * w, 0, 0, w};
    const auto scene = loaded();
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_TRUE(scene->scene.meshes[0].positions[1].isApprox(Vec3(4, 0, 0), 1e-6f)) << w;
  }
  for (const double w : {0.0, -1.0}) {
    node()["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, w};
    expectBadInput(document_.write(folder_), {"node 0", "perspective"});
  }
  node()["matrix"] = {1, 0, 0, 0.5, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  expectBadInput(document_.write(folder_), {"node 0", "perspective"});
}

TEST_F(GltfPlaces, ARotationOfNothingTurnsNothing) {
  node()["rotation"] = {0, 0, 0, 0};
  const auto scene = loaded();
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_EQ(scene->scene.meshes[0].positions, kTriangle);
}

TEST_F(GltfPlaces, HiddenNodesAreLeftOutWithTheirChildren) {
  document_.j["nodes"] = json::parse(R"([{"mesh": 0},
      {"children": [2], "extensions": {"KHR_node_visibility": {"visible": false}}},
      {"mesh": 0, "extensions": {"KHR_node_visibility": {"visible": true}}}])");
  document_.j["scenes"][0]["nodes"] = {0, 1};
  const auto scene = loaded();
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_EQ(scene->scene.meshes.size(), 1u);
  EXPECT_EQ(countOf(scene->findings, "hidden-nodes"), 1u);
}

TEST_F(GltfPlaces, InstancesStandWhereTheirNodeAndTheyThemselvesSay) {
  node()["translation"] = {10, 0, 0};
  node()["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {
      {"TRANSLATION", accessor(std::vector<Vec3>{{0, 0, 0}, {0, 5, 0}}, "VEC3", 2)},
      {"ROTATION",
       accessor(std::vector<float>{0, 0, 0, 1, 0, 0, 0.70710678f, 0.70710678f}, "VEC4", 2)},
      {"SCALE", accessor(std::vector<Vec3>{{2, 2, 2}, {-1, 1, 1}}, "VEC3", 2)}};
  const auto scene = loaded();
  ASSERT_TRUE(scene) << scene.error().message;
  expectSound(scene->scene);
  ASSERT_EQ(scene->scene.meshes.size(), 2u);
  EXPECT_TRUE(scene->scene.meshes[0].positions[1].isApprox(Vec3(12, 0, 0), 1e-6f));
  EXPECT_TRUE(scene->scene.meshes[1].positions[1].isApprox(Vec3(10, 4, 0), 1e-6f));
  // The mirrored one keeps its front.
  for (const Vec3& n : scene->scene.meshes[1].normals) EXPECT_GT(n.z(), 0.999f);
}

TEST_F(GltfPlaces, InstancesThatDoNotFitTogetherAreRefused) {
  json& attributes = node()["extensions"]["EXT_mesh_gpu_instancing"]["attributes"];
  attributes = {{"TRANSLATION", accessor(std::vector<Vec3>(3, Vec3(1, 2, 3)), "VEC3", 3)},
                {"SCALE", accessor(std::vector<Vec3>(2, Vec3(1, 1, 1)), "VEC3", 2)}};
  expectBadInput(document_.write(folder_), {"node 0", "EXT_mesh_gpu_instancing", "SCALE"});
  attributes = {{"_ID", 0}};
  const auto scene = loaded();
  ASSERT_TRUE(scene);
  EXPECT_EQ(countOf(scene->findings, "instances-without-place"), 1u);
}

TEST_F(GltfPlaces, InstancesByTheMillionOutOfNothingAreRefused) {
  document_.j["accessors"].push_back(
      {{"componentType", 5126}, {"type", "VEC3"}, {"count", 4000000}});
  node()["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"] =
      document_.j["accessors"].size() - 1;
  expectBadInput(document_.write(folder_), {"node 0", "limit"});
}

TEST_F(GltfPlaces, MorphTargetsStandAtTheWeightsOfTheFile) {
  const int up = accessor(std::vector<Vec3>{{0, 0, 0}, {0, 0, 4}, {0, 0, 4}}, "VEC3", 3);
  const int away = accessor(std::vector<Vec3>{{9, 9, 9}, {0, 0, 0}, {0, 0, 0}}, "VEC3", 3);
  document_.primitive()["targets"] = {{{"POSITION", up}}, {{"POSITION", away}}};
  auto scene = loaded();
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_EQ(scene->scene.meshes[0].positions, kTriangle);
  EXPECT_EQ(countOf(scene->findings, "morph-targets"), 1u);
  document_.j["meshes"][0]["weights"] = {0.25, 0};
  scene = loaded();
  ASSERT_TRUE(scene);
  EXPECT_EQ(scene->scene.meshes[0].positions[1], Vec3(1, 0, 1));
  node()["weights"] = {0.5, 0};  // a node's weights stand before its mesh's
  scene = loaded();
  EXPECT_EQ(scene->scene.meshes[0].positions[1], Vec3(1, 0, 2));
  document_.primitive()["targets"][0]["POSITION"] =
      accessor(std::vector<Vec3>(2, Vec3(1, 1, 1)), "VEC3", 2);
  expectBadInput(document_.write(folder_), {"morph target", "POSITION"});
}

class GltfSkins : public GltfPlaces {
 protected:
  /// Two joints, the second above the first: vertices 0 and 1 hang on the first, 2 on both.
  GltfSkins() {
    document_.j["nodes"] = json::parse(R"([{"mesh": 0, "skin": 0, "translation": [50, 0, 0]},
        {"translation": [0, 0, 1], "children": [2]}, {"translation": [0, 2, 0]}])");
    document_.j["scenes"][0]["nodes"] = {0, 1};
    std::vector<float> inverse(32, 0.0f);
    for (const int i : {0, 5, 10, 15, 16, 21, 26, 31}) inverse[std::size_t(i)] = 1.0f;
    inverse[29] = -1.0f;  // it was bound at y = 1
    document_.j["skins"] = {
        {{"joints", {1, 2}}, {"inverseBindMatrices", accessor(inverse, "MAT4", 2)}}};
    const std::vector<std::uint8_t> joints = {0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0};
    document_.attribute("JOINTS_0", joints, Component::UnsignedByte, "VEC4", 3);
    const std::vector<float> weights = {1, 0, 0, 0, 1, 0, 0, 0, 0.5f, 0.5f, 0, 0};
    document_.attribute("WEIGHTS_0", weights, Component::Float, "VEC4", 3);
  }
};

TEST_F(GltfSkins, StandAsTheirJointsDo) {
  const auto scene = loaded();
  ASSERT_TRUE(scene) << scene.error().message;
  const std::vector<Vec3>& p = scene->scene.meshes[0].positions;
  EXPECT_TRUE(p[1].isApprox(Vec3(1, 0, 1), 1e-6f)) << p[1].transpose();
  // Joint 1 moves by (0, 0, 1), joint 2 by (0, 2 − 1, 1): the mean of both.
  EXPECT_TRUE(p[2].isApprox(Vec3(0, 1.5f, 1), 1e-6f)) << p[2].transpose();
  EXPECT_EQ(countOf(scene->findings, "skin-posed"), 1u);
}

TEST_F(GltfSkins, ThatAreNotWholeAreIgnoredAndSaid) {
  for (const char* skin : {R"({"joints": []})", R"({"joints": [1, 77]})", R"({})"}) {
    document_.j["skins"][0] = json::parse(skin);
    const auto scene = loaded();
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_EQ(scene->scene.meshes[0].positions, kTriangle);
    EXPECT_EQ(countOf(scene->findings, "skin-ignored"), 1u);
  }
  document_.j["skins"][0] = {{"joints", {1}}};
  expectBadInput(document_.write(folder_), {"joint"});
}

TEST_F(GltfPlaces, FarAwayNodesInstancesAndSkinsKeepTheirShape) {
  const Vec3d far(12958095.125, 0, 4865499.5);
  const auto check = [&](const char* what) {
    const auto scene = loaded();
    ASSERT_TRUE(scene) << what << ": " << scene.error().message;
    EXPECT_EQ(countOf(scene->findings, "degenerate-triangles"), 0u) << what;
    const std::vector<Vec3>& p = scene->scene.meshes[0].positions;
    for (std::size_t v = 0; v < 3; ++v) {
      const Vec3d whole = p[v].cast<double>() + scene->scene.origin;
      EXPECT_LT((whole - far - kTriangle[v].cast<double>()).norm(), 1e-6) << what;
    }
    EXPECT_LT(p[0].norm(), 2.0f) << what;
  };
  node()["translation"] = {far.x(), far.y(), far.z()};
  check("node");
  node().erase("translation");
  document_.j["nodes"].push_back({{"children", {0}}, {"translation", {far.x(), far.y(), far.z()}}});
  document_.j["scenes"][0]["nodes"] = {1};
  check("parent");
  document_.j["skins"] = {{{"joints", {1}}}};
  node()["skin"] = 0;
  document_.attribute("JOINTS_0", std::vector<std::uint8_t>(12, 0), Component::UnsignedByte, "VEC4",
                      3);
  document_.attribute("WEIGHTS_0", std::vector<float>{1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0},
                      Component::Float, "VEC4", 3);
  check("skin");
  // A box that a file states wrongly moves nothing.
  document_.j["nodes"] = json::parse(R"([{"mesh": 0}])");
  document_.j["scenes"][0]["nodes"] = {0};
  document_.j["accessors"][0]["min"] = {1e7, 1e7, 1e7};
  document_.j["accessors"][0]["max"] = {1e7 + 1, 1e7 + 1, 1e7 + 1};
  const auto lied = loaded();
  ASSERT_TRUE(lied);
  EXPECT_EQ(lied->scene.meshes[0].positions, kTriangle);
}

}  // namespace
}  // namespace lambent::scene_io
