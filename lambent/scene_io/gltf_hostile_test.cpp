// Files that are damaged, or made to do harm.
#include <limits>
#include <nlohmann/json.hpp>

#include "lambent/image/test_codecs.h"
#include "lambent/scene/shapes.h"
#include "lambent/scene_io/gltf_read.h"
#include "lambent/scene_io/test_files.h"

namespace lambent::scene_io {
namespace {

using nlohmann::json;

GltfBuilder triangle() {
  scene::Mesh mesh = scene::gridPlane(1, 1, 1, 1);
  mesh.name = "tile";
  return GltfBuilder(scene::sceneOf(std::move(mesh)));
}

class GltfHostile : public testing::Test {
 protected:
  std::filesystem::path write(const GltfBuilder& gltf) {
    return folder_.write("file.glb", *gltf.glb());
  }
  TemporaryFolder folder_;
};

TEST_F(GltfHostile, MissingEmptyAndForeignFiles) {
  expectBadInput(folder_ / "none.glb", {"No such file"});
  expectBadInput(folder_.write("empty.glb", std::string_view()), {"empty"});
  expectBadInput(folder_.write("magic.glb", std::string_view("glTX\2\0\0\0 something else")),
                 {"does not begin with \"glTF\""});
  expectBadInput(folder_.write("text.gltf", std::string_view("{\"asset\": ")), {"JSON"});
  expectBadInput(folder_.write("old.gltf", std::string_view(R"({"asset": {"version": "1.0"}})")),
                 {"version"});
  expectBadInput(folder_.write("a.stl", std::string_view("solid")), {".glb, .gltf, .obj or .ply"});
  std::filesystem::create_directory(folder_ / "folder.glb");
  expectBadInput(folder_ / "folder.glb", {});
}

TEST_F(GltfHostile, NoTriangles) {
  expectBadInput(write(GltfBuilder(scene::Scene())), {"no triangles"});
  GltfBuilder gltf = triangle();
  gltf.json()["meshes"][0]["primitives"][0]["mode"] = 0;
  expectBadInput(write(gltf), {"no triangles"});
}

TEST_F(GltfHostile, PositionsThatAreNotFiniteNameTheVertex) {
  for (float bad :
       {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), 1e30f}) {
    scene::Mesh mesh = scene::gridPlane(1, 1, 2, 2);
    mesh.name = "tile";
    mesh.positions[4].y() = bad;
    expectBadInput(write(GltfBuilder(scene::sceneOf(mesh))), {"mesh \"tile\"", "vertex 4"});
  }
}

TEST_F(GltfHostile, IndicesOutOfRangeNameTriangleAndIndex) {
  scene::Mesh mesh = scene::gridPlane(1, 1, 1, 1);
  mesh.triangles[1][2] = 77;
  expectBadInput(write(GltfBuilder(scene::sceneOf(mesh))),
                 {"index 5", "triangle 1", "vertex 77 of 4"});
}

TEST_F(GltfHostile, AccessorsBeyondTheirBuffers) {
  const auto broken = [&](auto change, std::initializer_list<std::string> parts) {
    GltfBuilder gltf = triangle();
    change(gltf.json());
    expectBadInput(write(gltf), parts);
  };
  for (const json& count : {json(5), json(4000000000u), json(9e15), json(-1), json("4")}) {
    broken([&](json& j) { j["accessors"][0]["count"] = count; }, {"accessor 0"});
  }
  broken([](json& j) { j["accessors"][0]["byteOffset"] = 1 << 30; }, {"accessor 0", "beyond"});
  broken([](json& j) { j["accessors"][0]["byteOffset"] = -8; }, {"accessor 0"});
  broken([](json& j) { j["accessors"][0]["componentType"] = 5124; }, {"componentType"});
  broken([](json& j) { j["accessors"][0]["type"] = "VEC9"; }, {"type"});
  broken([](json& j) { j["accessors"][0]["bufferView"] = 99; }, {"bufferView 99"});
  broken([](json& j) { j["bufferViews"][0]["byteLength"] = 1u << 31; }, {"bufferView 0", "beyond"});
  broken([](json& j) { j["bufferViews"][0]["byteOffset"] = 9e15; }, {"bufferView 0"});
  broken([](json& j) { j["bufferViews"][0]["byteStride"] = 1; }, {"byteStride"});
  broken([](json& j) { j["bufferViews"][0]["buffer"] = 3; }, {"buffer"});
  broken(
      [](json& j) {
        j["accessors"][0].erase("bufferView");
        j["accessors"][0]["count"] = 4000000000u;
      },
      {"absurd"});
  broken([](json& j) { j["nodes"][0]["mesh"] = 12; }, {"mesh 12"});
  broken([](json& j) { j["meshes"][0]["primitives"][0]["material"] = 5; }, {"material 5"});
  broken([](json& j) { j["nodes"][0]["scale"] = {1, "x", 1}; }, {"node 0", "transform"});
}

TEST_F(GltfHostile, NodeCycles) {
  GltfBuilder gltf = triangle();
  gltf.json()["nodes"][0]["children"] = {0};
  expectBadInput(write(gltf), {"node 0", "twice"});
  gltf = triangle();
  gltf.json()["nodes"].push_back({{"children", {2}}});
  gltf.json()["nodes"].push_back({{"children", {1}}});
  gltf.json()["scenes"][0]["nodes"] = {1};
  expectBadInput(write(gltf), {"twice"});
  gltf.json()["scenes"][0]["nodes"] = {-1};
  expectBadInput(write(gltf), {"node -1"});
  gltf.json().erase("scenes");
  EXPECT_TRUE(load(write(gltf)));  // the cycle has no root
}

TEST_F(GltfHostile, DeepNodesAndDeepJson) {
  GltfBuilder gltf = triangle();
  json& nodes = gltf.json()["nodes"];
  for (int i = 1; i < 20000; ++i) nodes.push_back({{"children", {i + 1}}});
  nodes.push_back({{"mesh", 0}});
  gltf.json()["scenes"][0]["nodes"] = {1};
  EXPECT_TRUE(load(write(gltf)));
  std::string deep = R"({"asset": {"version": "2.0"}, "extras": )" + std::string(100000, '[');
  expectBadInput(folder_.write("deep.gltf", deep), {});
  expectBadInput(folder_.write("deep.gltf", deep + std::string(100000, ']') + "}"), {});
}

TEST_F(GltfHostile, RequiredExtensionsAreNamedWithARemedy) {
  for (const char* name : {"KHR_texture_basisu", "KHR_gaussian_splatting", "ACME_shapes"}) {
    GltfBuilder gltf = triangle();
    gltf.useExtension(name, true);
    expectBadInput(write(gltf), {name});
  }
  for (const char* name : {"KHR_materials_unlit", "KHR_texture_transform",
                           "KHR_draco_mesh_compression", "KHR_materials_sheen"}) {
    GltfBuilder gltf = triangle();
    gltf.useExtension(name, true);
    EXPECT_TRUE(load(write(gltf)));
  }
}

TEST_F(GltfHostile, ByteStrideOfNothingIsNone) {
  GltfBuilder gltf = triangle();
  for (json& view : gltf.json()["bufferViews"]) view["byteStride"] = 0;
  const auto loaded = load(write(gltf));
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_EQ(loaded->scene.meshes[0].positions, scene::gridPlane(1, 1, 1, 1).positions);
}

TEST_F(GltfHostile, DamagedPicturesAndThoseThatClaimTooMuchAreRefused) {
  scene::Material material;
  material.baseColorTexture = 0;
  scene::Scene s = scene::sceneOf(scene::gridPlane(1, 1, 1, 1), material);
  scene::Texture texture;
  texture.width = texture.height = 1;
  texture.rgba.assign(4, 255);
  s.textures = {texture};
  std::string glb;
  {
    const auto bytes = *GltfBuilder(s).glb();
    glb.assign(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  }
  const std::size_t header = glb.find("IHDR");
  ASSERT_NE(header, std::string::npos);
  std::string damaged = glb;
  damaged[glb.find("IDAT") + 9] ^= 1;
  expectBadInput(folder_.write("image.glb", std::string_view(damaged)),
                 {"image 0", "the checksum of a chunk is wrong at byte 33"});
  // 16384 × 16384, with a checksum that is right.
  const std::string huge("IHDR\0\0\x40\0\0\0\x40\0", 12);
  const std::string rest = glb.substr(header + 12, 5);
  glb.replace(header, 21, image::pngChunk("IHDR", huge.substr(4) + rest).substr(4));
  expectBadInput(folder_.write("image.glb", std::string_view(glb)),
                 {"image 0", "16384×16384 pixels, which cannot come out of"});
}

TEST_F(GltfHostile, TruncatedAndDamagedFilesNeverCrash) {
  scene::Material material;
  material.baseColorTexture = 0;
  scene::Scene s = scene::sceneOf(scene::uvSphere(1, 4, 3), material);
  scene::Texture texture;
  texture.width = texture.height = 4;
  texture.rgba.assign(64, 200);
  s.textures = {texture};
  s.cameras.emplace_back();
  const auto bytes = *GltfBuilder(s).glb();
  const std::string glb(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  abuse(folder_, "abused.glb", glb, 37, 3000);
}

}  // namespace
}  // namespace lambent::scene_io
