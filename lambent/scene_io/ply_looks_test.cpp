// PLY: what belongs to faces and their corners, colours however they are counted, odd headers.
#include "lambent/image/decode.h"
#include "lambent/scene_io/ply.h"
#include "lambent/scene_io/test_files.h"

namespace lambent::scene_io {
namespace {

/// A square of two triangles in the plane z = 0.
struct PlyText {
  std::string head, vertexProperties, faceProperties;
  std::vector<std::string> vertices = {"", "", "", ""}, faces = {"", ""};

  std::string text() const {
    const char* corners[] = {"0 0 0", "1 0 0", "1 1 0", "0 1 0"};
    const char* triangles[] = {"3 0 1 2", "3 0 2 3"};
    std::string out = "ply\nformat ascii 1.0\n" + head +
                      "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n" +
                      vertexProperties +
                      "element face 2\nproperty list uchar int vertex_indices\n" + faceProperties +
                      "end_header\n";
    for (std::size_t i = 0; i < 4; ++i) out += corners[i] + (" " + vertices[i]) + "\n";
    for (std::size_t i = 0; i < 2; ++i) out += triangles[i] + (" " + faces[i]) + "\n";
    return out;
  }
};

class PlyLooks : public testing::Test {
 protected:
  LoadedScene loadText(const std::string& text) {
    Result<LoadedScene> loaded = load(folder_.write("looks.ply", text));
    EXPECT_TRUE(loaded) << loaded.error().message;
    if (!loaded) return {};
    expectSound(loaded->scene);
    return std::move(*loaded);
  }
  void writePicture(const std::string& name, std::uint8_t red) {
    const std::vector<std::uint8_t> texels = {red, 0, 0, 255};
    folder_.write(name, std::span<const std::byte>(image::encodePng(1, 1, 4, texels)));
  }
  static bool has(const Findings& findings, std::string_view code) {
    for (const Finding& finding : findings) {
      if (finding.code == code) return true;
    }
    return false;
  }
  /// Colours of four vertices of this type.
  Rgb firstColor(const std::string& type, const std::string& color) {
    PlyText ply;
    for (const char* name : {"red", "green", "blue"}) {
      ply.vertexProperties += "property " + type + " " + name + "\n";
    }
    for (std::string& vertex : ply.vertices) vertex = color;
    return loadText(ply.text()).scene.meshes[0].colors[0];
  }
  TemporaryFolder folder_;
};

TEST_F(PlyLooks, ColoursHoweverTheyAreCounted) {
  const Rgb right(0.5029f, 0.0452f, 0.0452f);
  EXPECT_TRUE(firstColor("uchar", "188 60 60").isApprox(right, 1e-3f));
  EXPECT_TRUE(firstColor("char", "-68 60 60").isApprox(right, 1e-3f));
  EXPECT_TRUE(firstColor("int", "188 60 60").isApprox(right, 1e-3f));
  EXPECT_TRUE(firstColor("ushort", "48316 15420 15420").isApprox(right, 1e-3f));
  EXPECT_TRUE(firstColor("float", "188.0 60.0 60.0").isApprox(right, 1e-3f));
  EXPECT_TRUE(firstColor("double", "188 60 60").isApprox(right, 1e-3f));
  EXPECT_TRUE(firstColor("float", "0.5 0.25 1").isApprox(Rgb(0.5f, 0.25f, 1.0f)));  // linear
}

TEST_F(PlyLooks, TransparencyIsSaid) {
  PlyText ply;
  ply.vertexProperties = "property uchar alpha\n";
  ply.vertices = {"255", "255", "255", "255"};
  EXPECT_FALSE(has(loadText(ply.text()).findings, "alpha-ignored"));
  ply.vertices[2] = "128";
  EXPECT_TRUE(has(loadText(ply.text()).findings, "alpha-ignored"));
  ply.vertexProperties = "property float alpha\n";
  ply.vertices = {"1", "1", "1", "1"};
  EXPECT_FALSE(has(loadText(ply.text()).findings, "alpha-ignored"));
}

TEST_F(PlyLooks, ColoursOfFaces) {
  PlyText ply;
  ply.faceProperties = "property uchar red\nproperty uchar green\nproperty uchar blue\n";
  ply.faces = {"188 60 60", "60 188 60"};
  const scene::Mesh mesh = loadText(ply.text()).scene.meshes[0];
  EXPECT_EQ(mesh.positions.size(), 6u);  // the two on the diagonal have two colours
  for (const std::uint32_t v : mesh.triangles[0]) EXPECT_NEAR(mesh.colors[v].x(), 0.5029f, 1e-4f);
  for (const std::uint32_t v : mesh.triangles[1]) EXPECT_NEAR(mesh.colors[v].y(), 0.5029f, 1e-4f);
  for (const Vec3& n : mesh.normals) EXPECT_TRUE(n.isApprox(Vec3(0, 0, 1)));
}

TEST_F(PlyLooks, CoordinatesOfCorners) {
  writePicture("one.png", 255);
  PlyText ply;
  ply.head = "comment TextureFile one.png\n";
  ply.faceProperties = "property list uchar float texcoord\n";
  ply.faces = {"6 0 0 1 0 1 1", "6 0 0 0.5 0.5 0 1"};
  const LoadedScene loaded = loadText(ply.text());
  const scene::Mesh& mesh = loaded.scene.meshes[0];
  EXPECT_EQ(mesh.positions.size(), 5u);  // corner 2 has two places in the picture
  EXPECT_TRUE(mesh.uvs[mesh.triangles[0][2]].isApprox(Vec2(1, 0)));
  EXPECT_TRUE(mesh.uvs[mesh.triangles[1][1]].isApprox(Vec2(0.5f, 0.5f)));
  EXPECT_EQ(loaded.scene.materials[0].baseColorTexture, 0);
  ply.faces[1] = "0";
  EXPECT_TRUE(has(loadText(ply.text()).findings, "corner-uvs-ignored"));
}

TEST_F(PlyLooks, PolygonsKeepTheCoordinatesOfTheirCorners) {
  const LoadedScene loaded = loadText(
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float "
      "z\nelement face 1\nproperty list uchar int vertex_index\nproperty list uchar float "
      "texcoord\n"
      "end_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3 8 0 0 1 0 1 1 0 1\n");
  const scene::Mesh& mesh = loaded.scene.meshes[0];
  for (std::size_t v = 0; v < 4; ++v) {
    EXPECT_TRUE(mesh.uvs[v].isApprox(Vec2(mesh.positions[v].x(), 1.0f - mesh.positions[v].y())));
  }
}

TEST_F(PlyLooks, SeveralTextures) {
  writePicture("one.png", 255);
  writePicture("two.png", 128);
  PlyText ply;
  ply.head = "comment TextureFile one.png\ncomment TextureFile two.png\n";
  ply.faceProperties = "property list uchar float texcoord\nproperty int texnumber\n";
  ply.faces = {"6 0 0 1 0 1 1 0", "6 0 0 1 1 0 1 1"};
  const LoadedScene loaded = loadText(ply.text());
  ASSERT_EQ(loaded.scene.meshes.size(), 2u);
  ASSERT_EQ(loaded.scene.textures.size(), 2u);
  EXPECT_EQ(loaded.scene.textures[1].rgba[0], 128);
  EXPECT_EQ(loaded.scene.materials[std::size_t(loaded.scene.meshes[1].material)].baseColorTexture,
            1);
  ply.faceProperties = "property list uchar float texcoord\n";
  ply.faces = {"6 0 0 1 0 1 1", "6 0 0 1 1 0 1"};
  EXPECT_TRUE(has(loadText(ply.text()).findings, "textures-ignored"));
}

TEST_F(PlyLooks, ATextureWithoutCoordinatesIsSaid) {
  writePicture("one.png", 255);
  PlyText ply;
  ply.head = "comment TextureFile one.png\n";
  EXPECT_TRUE(has(loadText(ply.text()).findings, "texture-without-uvs"));
}

TEST_F(PlyLooks, OddHeaders) {
  PlyText ply;
  ply.head = "Created by an old exporter\nobj_info num_cols 3\ncomment hello\n\n";
  const LoadedScene skipped = loadText(ply.text());
  EXPECT_EQ(countOf(skipped.findings, "header-lines-skipped"), 1u);
  const LoadedScene marked = loadText("\xef\xbb\xbf" + PlyText().text());
  EXPECT_EQ(marked.scene.meshes[0].triangles.size(), 2u);
  PlyText edges;
  edges.head = "element edge 1\nproperty int vertex1\nproperty int vertex2\n";
  std::string text = edges.text();
  text.insert(text.find("end_header\n") + 11, "0 1\n");
  EXPECT_TRUE(has(loadText(text).findings, "element-ignored"));
}

TEST_F(PlyLooks, LineEndsOfAHeaderBeforeABinaryBody) {
  for (const std::string end : {"\n", "\r\n", "\r"}) {
    std::string text =
        "ply|format binary_little_endian 1.0|element vertex 3|property uchar x|property uchar y|"
        "property uchar z|element face 1|property list uchar uchar vertex_index|end_header|";
    for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += end.size()) {
      text.replace(at, 1, end);
    }
    // The first byte of the body is a line feed.
    text += std::string("\x0a\x00\x00\x0b\x00\x00\x0a\x01\x00\x03\x00\x01\x02", 13);
    const LoadedScene loaded = loadText(text);
    ASSERT_EQ(loaded.scene.meshes.size(), 1u);
    EXPECT_EQ(loaded.scene.meshes[0].positions[0].x(), 10.0f);
  }
}

}  // namespace
}  // namespace lambent::scene_io
