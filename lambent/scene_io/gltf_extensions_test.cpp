// What glTF's extensions say about materials, and what is said of those that are not read.
#include <nlohmann/json.hpp>

#include "lambent/image/test_codecs.h"
#include "lambent/scene_io/gltf_read.h"
#include "lambent/scene_io/gltf_specular.h"
#include "lambent/scene_io/test_gltf.h"

namespace lambent::scene_io {
namespace {

using nlohmann::json;

const Finding* findingOf(const Findings& findings, std::string_view code) {
  for (const Finding& finding : findings) {
    if (finding.code == code) return &finding;
  }
  return nullptr;
}

class GltfExtensions : public testing::Test {
 protected:
  GltfExtensions() {
    document_.positions(kTriangle);
    document_.attribute("TEXCOORD_0", std::vector<Vec2>{{0, 0}, {1, 0}, {0, 1}}, Component::Float,
                        "VEC2", 3);
    document_.primitive()["material"] = 0;
  }
  /// Texture 0 is of one colour.
  void texture(std::array<unsigned, 3> color) {
    const std::string png = image::makePng(
        4, 4, {}, [&](int, int, int c) { return c < 3 ? color[std::size_t(c)] : 255u; });
    const auto bytes = std::as_bytes(std::span(png.data(), png.size()));
    document_.j["images"] = {
        {{"bufferView", document_.gltf.addBufferView(bytes)}, {"mimeType", "image/png"}}};
    document_.j["textures"] = json::parse(R"([{"source": 0}])");
  }
  /// The scene of one material.
  LoadedScene with(const char* material) {
    document_.j["materials"] = json::array({json::parse(material)});
    const auto loaded = load(document_.write(folder_));
    EXPECT_TRUE(loaded) << loaded.error().message;
    return loaded ? *loaded : LoadedScene();
  }

  TemporaryFolder folder_;
  GltfDocument document_;
};

TEST_F(GltfExtensions, EachThatIsNotReadIsOneFindingThatNamesIt) {
  document_.j["extensionsUsed"] = {"KHR_materials_diffuse_transmission",
                                   "KHR_texture_transform",
                                   "ACME_flavour",
                                   "KHR_lights_punctual",
                                   "KHR_materials_sheen",
                                   "EXT_nobody_uses"};
  document_.j["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}}};
  document_.j["nodes"][0]["extensions"]["KHR_lights_punctual"] = {{"light", 0}};
  document_.j["meshes"][0]["extensions"]["ACME_flavour"] = {{"salt", 1}};
  document_.j["extras"]["extensions"]["ACME_in_extras"] = 1;
  const LoadedScene loaded = with(R"({"extensions": {"KHR_materials_diffuse_transmission":
      {"diffuseTransmissionFactor": 1}, "KHR_materials_sheen": {}, "KHR_materials_ior": {"ior": 1.5}}})");
  struct Expected {
    const char* name;
    Severity severity;
    std::uint64_t count;
    const char* says;
  };
  for (const Expected& e :
       {Expected{"KHR_materials_diffuse_transmission", Severity::Warning, 1, "leaves"},
        Expected{"KHR_lights_punctual", Severity::Warning, 2, "--light"},
        Expected{"KHR_materials_sheen", Severity::Warning, 1, "sheen"},
        Expected{"ACME_flavour", Severity::Warning, 1, "not known"},
        Expected{"EXT_nobody_uses", Severity::Note, 0, "nothing uses it"}}) {
    const Finding* finding = findingOf(loaded.findings, "extension-" + std::string(e.name));
    ASSERT_NE(finding, nullptr) << e.name;
    EXPECT_EQ(finding->severity, e.severity) << e.name;
    EXPECT_EQ(finding->count, e.count) << e.name;
    EXPECT_NE(finding->message.find(e.name), std::string::npos) << finding->message;
    EXPECT_NE(finding->message.find(e.says), std::string::npos) << finding->message;
  }
  for (const Finding& finding : loaded.findings) {
    EXPECT_EQ(finding.message.find("ACME_in_extras"), std::string::npos);
    EXPECT_EQ(finding.message.find("KHR_texture_transform"), std::string::npos);
    EXPECT_EQ(finding.message.find("KHR_materials_ior"), std::string::npos);
  }
}

TEST_F(GltfExtensions, APanePassesItsShareOfWhatIsNoMetal) {
  const LoadedScene loaded = with(R"({"extensions": {"KHR_materials_transmission":
      {"transmissionFactor": 0.75}}, "pbrMetallicRoughness": {"baseColorFactor": [0.8, 0.4, 0.2, 1],
      "metallicFactor": 0.5}})");
  const scene::Material& m = loaded.scene.materials[0];
  EXPECT_TRUE(m.transmitted.isApprox(Rgb(0.3f, 0.15f, 0.075f)));
  EXPECT_TRUE(m.diffuse.isApprox(Rgb(0.1f, 0.05f, 0.025f)));
  EXPECT_TRUE(m.glossy.isApprox(Rgb(0.4f, 0.2f, 0.1f)));
  EXPECT_EQ(findingOf(loaded.findings, "extension-KHR_materials_transmission"), nullptr);
}

TEST_F(GltfExtensions, InventedNamesWithoutEndAreFewFindings) {
  for (int i = 0; i < 1000; ++i) {
    document_.j["extensionsUsed"].push_back("ACME_" + std::to_string(i));
  }
  EXPECT_LT(with("{}").findings.size(), 50u);
}

TEST_F(GltfExtensions, UnlitIsDiffuseWhateverMetalTheFileForgot) {
  const LoadedScene loaded = with(R"({"extensions": {"KHR_materials_unlit": {}},
      "pbrMetallicRoughness": {"baseColorFactor": [0.8, 0.4, 0.2, 1]}})");
  const scene::Material& m = loaded.scene.materials[0];
  EXPECT_TRUE(m.diffuse.isApprox(Rgb(0.8f, 0.4f, 0.2f)));
  EXPECT_FALSE(m.isGlossy() || m.isMirror());
  EXPECT_EQ(countOf(loaded.findings, "unlit"), 1u);
}

TEST_F(GltfExtensions, SpecularGlossiness) {
  texture({188, 60, 60});
  LoadedScene loaded = with(R"({"extensions": {"KHR_materials_pbrSpecularGlossiness":
      {"diffuseTexture": {"index": 0}, "diffuseFactor": [1, 0.5, 1, 1],
       "specularFactor": [0, 0, 0], "glossinessFactor": 0.2}}})");
  scene::Material m = loaded.scene.materials[0];
  EXPECT_TRUE(m.diffuse.isApprox(Rgb(1, 0.5f, 1)));
  EXPECT_FALSE(m.isGlossy() || m.isMirror());
  EXPECT_EQ(m.baseColorTexture, 0);
  // A metal: its specular colour is all that it has.
  loaded = with(R"({"extensions": {"KHR_materials_pbrSpecularGlossiness":
      {"diffuseTexture": {"index": 0}, "diffuseFactor": [0, 0, 0, 1],
       "specularFactor": [1, 0.8, 0.3], "glossinessFactor": 0.5}}})");
  m = loaded.scene.materials[0];
  EXPECT_TRUE(m.glossy.isApprox(Rgb(1, 0.8f, 0.3f), 1e-5f)) << m.glossy.transpose();
  EXPECT_EQ(m.baseColorTexture, -1);
  EXPECT_EQ(countOf(loaded.findings, "mean-diffuse"), 1u);
  loaded = with(R"({"extensions": {"KHR_materials_pbrSpecularGlossiness":
      {"diffuseFactor": [0, 0, 0, 1], "specularFactor": [0.9, 0.9, 0.9]}}})");
  EXPECT_TRUE(loaded.scene.materials[0].isMirror());
  // With metallic-roughness beside it for those who read only that, it is believed.
  loaded = with(R"({"pbrMetallicRoughness": {"baseColorFactor": [0, 1, 0, 1]},
      "extensions": {"KHR_materials_pbrSpecularGlossiness": {"diffuseFactor": [0.5, 0, 0, 1],
       "specularFactor": [0.04, 0.04, 0.04]}}})");
  EXPECT_TRUE(loaded.scene.materials[0].diffuse.isApprox(Rgb(0.48f, 0, 0), 1e-5f));
  EXPECT_FALSE(loaded.scene.materials[0].isGlossy());
}

TEST_F(GltfExtensions, IndexOfRefractionAndSpecular) {
  const auto f0 = [](const char* material) {
    return reflectanceAtNormal(json::parse(material), Rgb::Ones(), 1.0);
  };
  EXPECT_TRUE(f0("{}").isApprox(Rgb::Constant(0.04f), 1e-5f));
  EXPECT_TRUE(f0(R"({"extensions": {"KHR_materials_ior": {"ior": 2.0}}})")
                  .isApprox(Rgb::Constant(1.0f / 9.0f), 1e-5f));
  EXPECT_TRUE(f0(R"({"extensions": {"KHR_materials_ior": {"ior": 0}}})").isApprox(Rgb::Ones()));
  EXPECT_TRUE(f0(R"({"extensions": {"KHR_materials_specular":
      {"specularFactor": 0.5, "specularColorFactor": [1, 2, 0]}}})")
                  .isApprox(Rgb(0.02f, 0.04f, 0.0f), 1e-5f));
  // What most dielectrics reflect is left out; a diamond has a glossy part.
  EXPECT_TRUE(glossyPart(Rgb::Constant(0.05f)).isZero());
  EXPECT_TRUE(glossyPart(Rgb(1, 0.5f, 0)).isApprox(Rgb(1, 0.5f, 0)));
  const LoadedScene plain = with(R"({"pbrMetallicRoughness": {"metallicFactor": 0},
      "extensions": {"KHR_materials_ior": {"ior": 1.45}, "KHR_materials_specular": {}}})");
  EXPECT_FALSE(plain.scene.materials[0].isGlossy());
  EXPECT_TRUE(plain.scene.materials[0].diffuse.isApprox(Rgb::Ones()));
  const LoadedScene diamond = with(R"({"pbrMetallicRoughness": {"metallicFactor": 0,
      "roughnessFactor": 0.5}, "extensions": {"KHR_materials_ior": {"ior": 2.42}}})");
  const scene::Material& m = diamond.scene.materials[0];
  EXPECT_TRUE(m.isGlossy());
  EXPECT_LE((m.diffuse + m.glossy).maxCoeff(), 1.0001f);
  EXPECT_EQ(countOf(diamond.findings, "glossy-dielectric"), 1u);
}

TEST_F(GltfExtensions, TexturesInFormatsThatAreNotReadNameThem) {
  document_.j["textures"] =
      json::parse(R"([{"extensions": {"KHR_texture_basisu": {"source": 0}}}])");
  document_.j["images"] = json::parse(R"([{"uri": "a.ktx2"}])");
  const LoadedScene loaded =
      with(R"({"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}})");
  const Finding* finding = findingOf(loaded.findings, "texture-unreadable");
  ASSERT_NE(finding, nullptr);
  EXPECT_NE(finding->message.find("KHR_texture_basisu"), std::string::npos) << finding->message;
  EXPECT_NE(findingOf(loaded.findings, "extension-KHR_texture_basisu"), nullptr);
}

TEST_F(GltfExtensions, TexelsTakeTheSecondSetWhereThereIsNoTexture) {
  const std::vector<Vec2> second = {{0.1f, 0.2f}, {0.9f, 0.2f}, {0.1f, 0.7f}};
  document_.attribute("TEXCOORD_1", second, Component::Float, "VEC2", 3);
  with("{}");
  auto loaded = load(folder_ / "file.glb", {.layout = true});
  ASSERT_TRUE(loaded);
  EXPECT_EQ(loaded->scene.meshes[0].uvs, second);
  EXPECT_NE(load(folder_ / "file.glb")->scene.meshes[0].uvs, second);
  texture({9, 99, 199});
  with(R"({"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}})");
  loaded = load(folder_ / "file.glb", {.layout = true});
  ASSERT_TRUE(loaded);
  EXPECT_NE(loaded->scene.meshes[0].uvs, second);
  EXPECT_EQ(countOf(loaded->findings, "layout-ignored"), 1u);
}

TEST_F(GltfExtensions, MadeNormalsAreFlatUnlessSmoothIsAskedFor) {
  document_.positions({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
  document_.primitive()["attributes"].erase("TEXCOORD_0");
  document_.indices({0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3});
  EXPECT_EQ(with("{}").scene.meshes[0].positions.size(), 12u);
  const auto smooth = load(document_.write(folder_), {.crease = 3.1f});
  ASSERT_TRUE(smooth);
  EXPECT_EQ(smooth->scene.meshes[0].positions.size(), 4u);
}

}  // namespace
}  // namespace lambent::scene_io
