// Scenes that name files outside of their folder.
#include "lambent/scene_io/linked_files.h"

#include "lambent/image/test_codecs.h"
#include "lambent/scene_io/test_files.h"

namespace lambent::scene_io {
namespace {

namespace fs = std::filesystem;

class Linked : public testing::Test {
 protected:
  Linked() {
    fs::create_directories(folder_ / "scene/below");
    folder_.write("triangle.bin", std::string_view(std::string(36, '\0')));
    folder_.write("scene/below/triangle.bin", std::string_view(bytes()));
    folder_.write("triangle.bin", std::string_view(bytes()));
  }
  static std::string bytes() {
    const float corners[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    return {reinterpret_cast<const char*>(corners), sizeof corners};
  }
  fs::path gltf(const std::string& uri) {
    return folder_.write("scene/file.gltf", std::string_view(R"({"asset": {"version": "2.0"},
      "nodes": [{"mesh": 0}], "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
      "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
      "bufferViews": [{"buffer": 0, "byteLength": 36}],
      "buffers": [{"byteLength": 36, "uri": ")" + uri + R"("}]})"));
  }
  fs::path obj(const std::string& head) {
    return folder_.write("scene/file.obj",
                         std::string_view(head + "v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n"));
  }
  TemporaryFolder folder_;
};

TEST_F(Linked, UrisStayInTheFolder) {
  for (const char* uri : {"below/triangle.bin", "./below/../below/triangle.bin",
                          "below%2Ftriangle.bin", "../scene/below/triangle.bin"}) {
    EXPECT_TRUE(load(gltf(uri))) << uri;
  }
  fs::create_symlink("../triangle.bin", folder_ / "scene/link.bin");
  fs::create_directory_symlink("..", folder_ / "scene/up");
  for (const std::string& uri :
       {std::string("../triangle.bin"), std::string("%2e%2e/triangle.bin"),
        std::string("below/../../triangle.bin"), (folder_ / "triangle.bin").string(),
        std::string("link.bin"), std::string("up/triangle.bin")}) {
    const fs::path path = gltf(uri);
    expectBadInput(path, {"buffer 0", uri, "outside", "--allow-outside"});
    EXPECT_TRUE(load(path, {.allowOutside = true, .memoryLimit = {}})) << uri;
  }
  expectBadInput(gltf("../nothing.bin"), {"outside"});
}

TEST_F(Linked, ALinkToTheFolderIsTheFolder) {
  gltf("below/triangle.bin");
  fs::create_directory_symlink("scene", folder_ / "other");
  EXPECT_TRUE(load(folder_ / "other/file.gltf"));
}

TEST_F(Linked, LibrariesAndTexturesOfObjStayInTheFolder) {
  const LoadOptions anywhere{.allowOutside = true, .memoryLimit = {}};
  const std::string png = image::makePng(2, 2, {}, [](int, int, int) { return 9u; });
  folder_.write("a.png", std::string_view(png));
  folder_.write("scene/below/b.png", std::string_view(png));
  folder_.write("a.mtl", std::string_view("newmtl a\nKd 1 0 0\n"));
  expectBadInput(obj("mtllib ../a.mtl\n"), {"material library", "a.mtl", "--allow-outside"});
  const auto allowed = load(obj("mtllib ../a.mtl\n"), anywhere);
  ASSERT_TRUE(allowed);
  EXPECT_TRUE(allowed->scene.materials[0].diffuse.isApprox(Rgb(1, 0, 0)));

  folder_.write("scene/b.mtl", std::string_view("newmtl a\nmap_Kd ../a.png\n"));
  expectBadInput(obj("mtllib b.mtl\n"), {"a texture", "a.png", "--allow-outside"});
  EXPECT_EQ(load(obj("mtllib b.mtl\n"), anywhere)->scene.textures.size(), 1u);
  // From a library in a folder below, back up to the scene's.
  fs::create_directories(folder_ / "scene/materials");
  folder_.write("scene/materials/c.mtl", std::string_view("newmtl a\nmap_Kd ../below/b.png\n"));
  EXPECT_EQ(load(obj("mtllib materials/c.mtl\n"))->scene.textures.size(), 1u);
  // What is left of another machine's folders is missing, not forbidden.
  folder_.write("scene/d.mtl", std::string_view("newmtl a\nmap_Kd C:\\textures\\a.png\n"
                                                "newmtl b\nmap_Kd /nowhere/textures/a.png\n"
                                                "newmtl c\nmap_Kd ../nowhere/a.png\n"));
  const auto missing = load(obj("mtllib d.mtl\n"));
  ASSERT_TRUE(missing);
  EXPECT_EQ(countOf(missing->findings, "texture-unreadable"), 3u);
}

TEST_F(Linked, ALibraryIsReadOnce) {
  folder_.write("scene/a.png",
                std::string_view(image::makePng(2, 2, {}, [](int, int, int) { return 9u; })));
  folder_.write("scene/a.mtl", std::string_view("newmtl a\nmap_Kd a.png\n"));
  std::string head;
  for (int i = 0; i < 50; ++i) head += "mtllib a.mtl\nmtllib below/../a.mtl\n";
  const auto loaded = load(obj(head));
  ASSERT_TRUE(loaded);
  EXPECT_EQ(loaded->scene.textures.size(), 1u);
}

TEST_F(Linked, DamagedTexturesAreErrors) {
  std::string png = image::makePng(2, 2, {}, [](int, int, int) { return 9u; });
  png[png.find("IDAT") + 15] ^= 1;
  folder_.write("scene/a.png", std::string_view(png));
  folder_.write("scene/a.mtl", std::string_view("newmtl a\nmap_Kd a.png\n"));
  const auto loaded = load(obj("mtllib a.mtl\n"));
  ASSERT_FALSE(loaded);
  EXPECT_EQ(loaded.error().kind, ErrorKind::BadInput);
  EXPECT_NE(loaded.error().message.find("a.png: the checksum"), std::string::npos);
}

}  // namespace
}  // namespace lambent::scene_io
