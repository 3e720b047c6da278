// Pictures of glTF files: kinds, damage, and how often they are decoded.
#include <nlohmann/json.hpp>

#include "lambent/image/decode.h"
#include "lambent/image/test_codecs.h"
#include "lambent/scene/shapes.h"
#include "lambent/scene_io/gltf_read.h"
#include "lambent/scene_io/test_files.h"

namespace lambent::scene_io {
namespace {

using nlohmann::json;

std::span<const std::byte> pictureBytes(const std::string& text) {
  return std::as_bytes(std::span(text.data(), text.size()));
}

/// A tile whose materials all look at texture 0, of image 0.
class GltfPictures : public testing::Test {
 protected:
  GltfPictures() {
    gltf_.json()["materials"] =
        json::parse(R"([{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}])");
    gltf_.json()["textures"] = json::parse(R"([{"source": 0}])");
  }
  void picture(const std::string& bytes, const char* mimeType) {
    gltf_.json()["images"].push_back(
        {{"bufferView", gltf_.addBufferView(pictureBytes(bytes))}, {"mimeType", mimeType}});
  }
  std::filesystem::path write() { return folder_.write("file.glb", *gltf_.glb()); }

  TemporaryFolder folder_;
  GltfBuilder gltf_{scene::sceneOf(scene::gridPlane(1, 1, 1, 1))};
};

std::string redPng(int size) {
  return image::makePng(size, size, {}, [](int, int, int c) { return c == 0 ? 255u : 0u; });
}

TEST_F(GltfPictures, WebP) {
  const std::vector<std::uint8_t> rgba{10, 20, 30, 255, 40, 50, 60, 255};
  picture(image::makeWebP(2, 1, rgba), "image/webp");
  gltf_.json()["textures"] =
      json::parse(R"([{"extensions": {"EXT_texture_webp": {"source": 0}}}])");
  gltf_.useExtension("EXT_texture_webp", true);
  const auto loaded = load(write());
  ASSERT_TRUE(loaded) << loaded.error().message;
  ASSERT_EQ(loaded->scene.textures.size(), 1u);
  EXPECT_EQ(loaded->scene.textures[0].rgba, rgba);
  // Written anew as PNG, which every viewer reads.
  GltfBuilder again(loaded->scene);
  EXPECT_EQ(again.json()["images"][0]["mimeType"], "image/png");
  const auto back = load(folder_.write("again.glb", *again.glb()));
  ASSERT_TRUE(back);
  EXPECT_EQ(back->scene.textures[0].rgba, rgba);
}

TEST_F(GltfPictures, KindsThatAreNotReadAreLeftOutAndSaid) {
  picture("DDS picture", "image/vnd-ms.dds");
  const auto loaded = load(write());
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_EQ(countOf(loaded->findings, "texture-unreadable"), 1u);
  EXPECT_EQ(loaded->scene.materials[0].baseColorTexture, -1);
}

TEST_F(GltfPictures, DamageIsAnErrorWhateverThePictureIsFor) {
  std::string damaged = redPng(8);
  damaged[damaged.find("IDAT") + 20] ^= 1;
  picture(damaged, "image/png");
  for (const char* material :
       {R"({"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}})",
        R"({"pbrMetallicRoughness": {"metallicRoughnessTexture": {"index": 0}}})",
        R"({"emissiveFactor": [1, 1, 1], "emissiveTexture": {"index": 0}})"}) {
    gltf_.json()["materials"] = json::array({json::parse(material)});
    expectBadInput(write(), {"image 0", "checksum"});
  }
}

TEST_F(GltfPictures, OnePictureForEverything) {
  picture(redPng(64), "image/png");
  gltf_.json()["samplers"] = json::parse(R"([{"wrapS": 33071}])");
  gltf_.json()["textures"] = json::parse(R"([{"source": 0}, {"source": 0, "sampler": 0}])");
  gltf_.json()["materials"] = json::parse(R"([
    {"pbrMetallicRoughness": {"metallicRoughnessTexture": {"index": 0}}},
    {"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}},
    {"pbrMetallicRoughness": {"baseColorTexture": {"index": 1}}},
    {"emissiveFactor": [1, 1, 1], "emissiveTexture": {"index": 1}}])");
  const auto loaded = load(write());
  ASSERT_TRUE(loaded) << loaded.error().message;
  const scene::Scene& s = loaded->scene;
  ASSERT_EQ(s.textures.size(), 2u);
  EXPECT_EQ(s.textures[0].rgba.size(), 4u * 64 * 64);
  EXPECT_EQ(s.textures[0].rgba, s.textures[1].rgba);
  EXPECT_EQ(s.textures[0].encoded, s.textures[1].encoded);
  EXPECT_EQ(s.textures[1].wrapU, scene::Wrap::ClampToEdge);
  EXPECT_TRUE(s.materials[3].emission.isApprox(Rgb(1, 0, 0)));
  EXPECT_FALSE(s.materials[0].isGlossy());  // blue is metallic, and 0
}

TEST_F(GltfPictures, ManyMaterialsCostOnePicture) {
  const std::string png = redPng(64);
  picture(png, "image/png");
  json material =
      json::parse(R"({"pbrMetallicRoughness": {"metallicRoughnessTexture": {"index": 0}}})");
  gltf_.json()["materials"] = json::array();
  for (int i = 0; i < 1000; ++i) gltf_.json()["materials"].push_back(material);
  // Room for the tile, one picture and the materials as text, and for eight times as much to go
  // through.
  EXPECT_TRUE(load(write(), {.memoryLimit = 131072}));
}

TEST_F(GltfPictures, ABudgetForAllOfThem) {
  json texture = json::parse(R"({"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}})");
  gltf_.json()["textures"] = gltf_.json()["materials"] = json::array();
  for (int i = 0; i < 10; ++i) {
    picture(redPng(64), "image/png");
    gltf_.json()["textures"].push_back({{"source", i}});
    texture["pbrMetallicRoughness"]["baseColorTexture"]["index"] = i;
    gltf_.json()["materials"].push_back(texture);
  }
  EXPECT_TRUE(load(write(), {.memoryLimit = 1 << 20}));
  const auto refused = load(write(), {.memoryLimit = 100000});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().kind, ErrorKind::BadInput);
  for (const char* words : {"file.glb: image 3", "64×64", "16.0 KiB", "limit of 97.7 KiB"}) {
    EXPECT_NE(refused.error().message.find(words), std::string::npos) << refused.error().message;
  }
}

}  // namespace
}  // namespace lambent::scene_io
