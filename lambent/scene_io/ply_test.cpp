#include "lambent/scene_io/ply.h"

#include <algorithm>
#include <bit>
#include <cstring>

#include "lambent/scene/diagnose.h"
#include "lambent/scene/shapes.h"
#include "lambent/scene_io/test_files.h"

namespace lambent::scene_io {
namespace {

class Ply : public testing::Test {
 protected:
  std::filesystem::path write(std::string_view text) { return folder_.write("file.ply", text); }
  scene::Scene loadText(std::string_view text) {
    Result<LoadedScene> loaded = load(write(text));
    EXPECT_TRUE(loaded) << loaded.error().message;
    if (!loaded) return {};
    findings_ = loaded->findings;
    expectSound(loaded->scene);
    return std::move(loaded->scene);
  }
  TemporaryFolder folder_;
  Findings findings_;
};

template <class T>
void put(std::string& out, T value, bool big) {
  char bytes[sizeof(T)];
  std::memcpy(bytes, &value, sizeof(T));
  if (big != (std::endian::native == std::endian::big)) std::reverse(bytes, bytes + sizeof(T));
  out.append(bytes, sizeof(T));
}

/// A binary file with things to skip: a property, a list among the vertices' properties, and an
/// element.
std::string binary(const scene::Mesh& mesh, bool big) {
  std::string out = "ply\nformat binary_" + std::string(big ? "big" : "little") +
                    "_endian 1.0\ncomment made by hand\nelement camera 2\nproperty double fov\n"
                    "element vertex " +
                    std::to_string(mesh.positions.size()) +
                    "\nproperty double x\nproperty float y\nproperty float z\n"
                    "property uchar quality\nproperty list uchar short extra\n"
                    "property float nx\nproperty float ny\nproperty float nz\n"
                    "element face " +
                    std::to_string(mesh.triangles.size()) +
                    "\nproperty uchar flags\nproperty list uint16 uint vertex_index\nend_header\n";
  put(out, 1.0, big), put(out, 2.0, big);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const Vec3 &p = mesh.positions[i], &n = mesh.normals[i];
    put(out, double(p.x()), big), put(out, p.y(), big), put(out, p.z(), big);
    put(out, std::uint8_t(7), big), put(out, std::uint8_t(1), big), put(out, std::int16_t(5), big);
    put(out, n.x(), big), put(out, n.y(), big), put(out, n.z(), big);
  }
  for (const scene::Triangle& t : mesh.triangles) {
    put(out, std::uint8_t(0), big), put(out, std::uint16_t(3), big);
    for (std::uint32_t v : t) put(out, v, big);
  }
  return out;
}

TEST_F(Ply, BinaryOfBothEndians) {
  const scene::Mesh mesh = scene::icosphere(1.0f, 2);
  for (bool big : {false, true}) {
    const scene::Scene s = loadText(binary(mesh, big));
    ASSERT_EQ(s.meshes.size(), 1u);
    EXPECT_EQ(s.meshes[0].positions, mesh.positions);
    EXPECT_EQ(s.meshes[0].triangles, mesh.triangles);
    for (std::size_t i = 0; i < mesh.normals.size(); ++i) {
      EXPECT_TRUE(s.meshes[0].normals[i].isApprox(mesh.normals[i], 1e-6f));
    }
    ASSERT_EQ(findings_.size(), 1u);  // quality, extra and flags are said, and lose nothing
    EXPECT_EQ(countOf(findings_, "properties-ignored"), 3u);
    EXPECT_FALSE(findings_[0].loss);
  }
}

TEST_F(Ply, AsciiWithColoursUvsAndPolygons) {
  const scene::Scene s = loadText(R"(ply
format ascii 1.0
obj_info nothing
comment TextureFile none.png
element vertex 5
property float x
property float y
property float z
property float s
property float t
property uchar red
property uchar green
property uchar blue
property uchar alpha
element face 2
property list uchar int vertex_indices
element edge 1
property int vertex1
property int vertex2
end_header
0 0 0 0 0 255 128 0 255
1 0 0 1 0 255 128 0 255
1 1 0 1 1 255 128 0 255
0 1 0 0 1 255 128 0 255
9 9 9 0 0 1 1 1 1
4 0 1 2 3
2 0 1
0 1
)");
  const scene::Mesh& mesh = s.meshes[0];
  EXPECT_EQ(mesh.triangles.size(), 2u);
  EXPECT_EQ(mesh.positions.size(), 4u);
  EXPECT_EQ(countOf(findings_, "unused-vertices"), 1u);
  EXPECT_EQ(countOf(findings_, "small-faces"), 1u);
  EXPECT_EQ(countOf(findings_, "normals-made"), 4u);
  EXPECT_EQ(countOf(findings_, "texture-unreadable"), 1u);
  EXPECT_TRUE(mesh.uvs[2].isApprox(Vec2(1, 0)));
  EXPECT_NEAR(mesh.colors[0].y(), 0.2158605f, 1e-5f);
  EXPECT_TRUE(s.materials[0].diffuse.isApprox(Rgb::Ones()));
}

TEST_F(Ply, FloatColoursAreLinear) {
  const scene::Scene s = loadText(
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
      "property float z\nproperty float red\nproperty float green\nproperty float blue\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
      "0 0 0 0.5 0.25 2\n1 0 0 1 1 1\n0 1 0 1 1 1\n3 0 1 2\n");
  EXPECT_TRUE(s.meshes[0].colors[0].isApprox(Rgb(0.5f, 0.25f, 1.0f)));
  EXPECT_EQ(countOf(findings_, "colors-clamped"), 1u);
}

TEST_F(Ply, TriangleStrips) {
  const scene::Scene s = loadText(
      "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\n"
      "property float z\nelement tristrips 1\nproperty list int int vertex_indices\nend_header\n"
      "0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 2 0\n8 0 1 2 3 -1 2 3 4\n");
  EXPECT_EQ(s.meshes[0].triangles.size(), 3u);
  for (const Vec3& n : s.meshes[0].normals) EXPECT_TRUE(n.isApprox(Vec3::UnitZ()));
}

std::string asciiHeader(const std::string& vertices, const std::string& faces) {
  return "ply\nformat ascii 1.0\nelement vertex " + vertices +
         "\nproperty float x\nproperty float y\nproperty float z\nelement face " + faces +
         "\nproperty list uchar int vertex_indices\nend_header\n";
}

TEST_F(Ply, BadFilesNameThePlace) {
  const std::string corners = "0 0 0\n1 0 0\n0 1 0\n";
  expectBadInput(folder_ / "none.ply", {"No such file"});
  expectBadInput(write("plx\n"), {"does not begin with \"ply\""});
  expectBadInput(write("ply\nformat ascii 1.0\n"), {"truncated"});
  expectBadInput(write("ply\nformat binary_middle_endian 1.0\n"), {"line 2", "format"});
  expectBadInput(write("ply\nformat ascii 1.0\nelement vertex -3\n"), {"line 3", "count"});
  expectBadInput(write("ply\nformat ascii 1.0\nproperty float x\n"), {"line 3"});
  expectBadInput(write(asciiHeader("3", "0") + corners), {"3 points and no triangles"});
  expectBadInput(write(asciiHeader("0", "0")), {"no triangles"});
  expectBadInput(write(asciiHeader("3", "1") + corners + "3 0 1 7\n"), {"face 0", "vertex 7 of 3"});
  expectBadInput(write(asciiHeader("3", "1") + corners + "3 0 1 -1\n"), {"vertex -1 of 3"});
  expectBadInput(write(asciiHeader("3", "1") + "0 0 0\nnan 0 0\n0 1 0\n3 0 1 2\n"),
                 {"vertex 1", "finite"});
  expectBadInput(write(asciiHeader("3", "2") + corners + "3 0 1 2\n"), {"face", "truncated"});
  expectBadInput(write(asciiHeader("3", "1") + corners + "300000000 0 1 2\n"), {"face 0"});
  expectBadInput(write(asciiHeader("3", "1") + corners + "3 0 0 0\n"), {"without area"});
}

TEST_F(Ply, CountsBeyondTheFileAreSeenBeforeMemoryIsAsked) {
  expectBadInput(write(asciiHeader("4294967295", "1") + "0 0 0\n"), {"promises 4294967295"});
  expectBadInput(write(asciiHeader("18446744073709551615", "1") + "0 0 0\n"), {"promises"});
  expectBadInput(write(asciiHeader("99999999999999999999999", "1") + "0 0 0\n"), {"count"});
  std::string huge = binary(scene::icosphere(1, 0), false);
  huge.replace(huge.find("face 20"), 7, "face 4000000000");
  expectBadInput(write(huge), {"face", "4000000000"});
  // An element without properties takes no bytes and no time.
  EXPECT_TRUE(load(write("ply\nformat ascii 1.0\nelement nothing 4000000000\n" +
                         asciiHeader("3", "1").substr(21) + "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n")));
}

TEST_F(Ply, TruncatedAndDamagedFilesNeverCrash) {
  const scene::Mesh mesh = scene::icosphere(1, 1);
  abuse(folder_, "abused.ply", binary(mesh, false), 41, 2000);
  abuse(folder_, "abused.ply", binary(mesh, true), 97, 500);
  std::string text = asciiHeader("42", "80");
  for (const Vec3& p : mesh.positions) {
    text +=
        std::to_string(p.x()) + " " + std::to_string(p.y()) + " " + std::to_string(p.z()) + "\n";
  }
  for (const auto& [a, b, c] : mesh.triangles) {
    text += "3 " + std::to_string(a) + " " + std::to_string(b) + " " + std::to_string(c) + "\n";
  }
  ASSERT_EQ(loadText(text).meshes[0].triangles.size(), 80u);
  abuse(folder_, "abused.ply", text, 47, 2000);
}

}  // namespace
}  // namespace lambent::scene_io
