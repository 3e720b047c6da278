#include "lambent/scene_io/obj.h"

#include "lambent/image/decode.h"
#include "lambent/scene/diagnose.h"
#include "lambent/scene/shapes.h"
#include "lambent/scene_io/test_files.h"

namespace lambent::scene_io {
namespace {

class Obj : public testing::Test {
 protected:
  std::filesystem::path write(std::string_view text) { return folder_.write("file.obj", text); }
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

TEST_F(Obj, CornersBecomeVertices) {
  const scene::Scene s = loadText(R"(# a quad and a triangle
v 0 0 0
v +1 0 0
v 1 1.0e0 0 1.0
v 0 1 0
vt 0 0
vt 1 0
vt 1 1
vt 0 1
vn 0 0 2
f 1/1/1 2/2/1 3/3/1 4/4/1
f -4/1/1 -3//1 -2/3
)");
  ASSERT_EQ(s.meshes.size(), 1u);
  const scene::Mesh& mesh = s.meshes[0];
  EXPECT_EQ(mesh.triangles.size(), 3u);
  EXPECT_EQ(mesh.positions.size(), 6u);           // 1/1/1 is shared, 2//1 and 3/3 are new
  EXPECT_TRUE(mesh.uvs[0].isApprox(Vec2(0, 1)));  // v from the top
  for (const Vec3& n : mesh.normals) EXPECT_TRUE(n.isApprox(Vec3::UnitZ()));
  EXPECT_EQ(countOf(findings_, "zero-normals"), 1u);  // 3/3 brought none
}

TEST_F(Obj, LinesThatContinueAndWindowsLineEnds) {
  const scene::Scene s =
      loadText("v 0 0 0\r\nv 1 0 0\r\nv 0 1 0\r\nf 1 \\\r\n 2 3 # end\r\nl 1 2\r\n");
  EXPECT_EQ(s.meshes[0].triangles.size(), 1u);
  EXPECT_EQ(countOf(findings_, "no-triangles"), 1u);
}

TEST_F(Obj, MadeNormalsAreSmoothAcrossTextureSeams) {
  const scene::Scene s = loadText(R"(v 0 0 0
v 1 0 1
v 0 1 0
v -1 0 1
vt 0 0
vt 1 1
f 1/1 2/1 3/1
f 1/2 3/2 4/2
)");
  const scene::Mesh& mesh = s.meshes[0];
  EXPECT_EQ(mesh.positions.size(), 6u);
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t j = 0; j < 6; ++j) {
      if (mesh.positions[i] == mesh.positions[j]) {
        EXPECT_TRUE(mesh.normals[i].isApprox(mesh.normals[j]));
      }
    }
  }
  EXPECT_EQ(countOf(findings_, "normals-made"), 6u);
}

TEST_F(Obj, MaterialsMakeMeshesAndMeanWhatTheyShould) {
  folder_.write("my materials.mtl", R"(newmtl red clay
Kd 0.6 0.2 0.1
Ks 0.5 0.5 0.5
Ns 250
illum 2
newmtl lacquer
Kd 0.3 0.3 0.3
Ks 0.2 0.2 0.2
Ns 40
illum 2
newmtl silver
Kd 0.1 0.1 0.1
Ks 0.9 0.9 0.9
illum 3
newmtl matte
Kd 0.4 0.4 0.4
Ks 1 1 1
illum 1
newmtl bright
Kd 1 1 1
Ks 1 1 1
Ns 10
illum 2
newmtl picture
Kd 0 0 0
map_Kd -s 1 1 1 -clamp on wood grain.png
newmtl pbr
Kd 0.8 0.8 0.8
Pm 1
Pr 0
)");
  const std::vector<std::uint8_t> texels = {255, 0, 0, 255};
  folder_.write("wood grain.png", std::span<const std::byte>(image::encodePng(1, 1, 4, texels)));
  std::string text = "mtllib my materials.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\n";
  for (const char* name :
       {"red clay", "lacquer", "silver", "matte", "bright", "picture", "pbr", "lacquer"}) {
    text += "usemtl " + std::string(name) + "\nf 1/1 2/1 3/1\n";
  }
  const scene::Scene s = loadText(text);
  ASSERT_EQ(s.meshes.size(), 7u);
  const auto material = [&](const std::string& name) {
    for (const scene::Material& m : s.materials) {
      if (m.name == name) return m;
    }
    ADD_FAILURE() << name;
    return scene::Material();
  };
  EXPECT_FALSE(material("red clay").isGlossy());  // what exporters write for anything
  EXPECT_TRUE(material("red clay").diffuse.isApprox(Rgb(0.6f, 0.2f, 0.1f)));
  EXPECT_TRUE(material("lacquer").glossy.isApprox(Rgb::Constant(0.2f)));
  EXPECT_EQ(material("lacquer").lobeExponent, 40.0f);
  EXPECT_TRUE(material("silver").isMirror());
  EXPECT_TRUE(material("silver").mirror.isApprox(Rgb::Constant(0.9f)));
  EXPECT_FALSE(material("matte").isGlossy());
  EXPECT_TRUE(material("bright").diffuse.isApprox(Rgb::Constant(0.5f)));
  EXPECT_TRUE(material("bright").glossy.isApprox(Rgb::Constant(0.5f)));
  EXPECT_TRUE(material("picture").diffuse.isApprox(Rgb::Ones()));
  EXPECT_EQ(material("picture").baseColorTexture, 0);
  EXPECT_EQ(s.textures[0].rgba, texels);
  EXPECT_TRUE(material("pbr").isMirror());
  EXPECT_EQ(s.meshes[1].triangles.size(), 2u);  // both stretches of lacquer
}

TEST_F(Obj, MissingMaterialsAndTexturesAreSaid) {
  const scene::Scene s =
      loadText("mtllib none.mtl\nusemtl gone\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  EXPECT_EQ(countOf(findings_, "material-file-missing"), 1u);
  EXPECT_EQ(countOf(findings_, "no-material"), 1u);
  EXPECT_TRUE(s.materials[0].isDiffuse());
}

TEST_F(Obj, VertexColoursAreSrgb) {
  const scene::Scene s = loadText("v 0 0 0 1 0 0.5\nv 1 0 0 1 0 0\nv 0 1 0 1 1 1\nf 1 2 3\n");
  ASSERT_EQ(s.meshes[0].colors.size(), 3u);
  EXPECT_NEAR(s.meshes[0].colors[0].z(), 0.2140411f, 1e-5f);
  EXPECT_TRUE(s.materials[0].diffuse.isApprox(Rgb::Ones()));
}

TEST_F(Obj, BadFilesNameThePlace) {
  expectBadInput(folder_ / "none.obj", {"No such file"});
  expectBadInput(write(""), {"no triangles"});
  expectBadInput(write("v 0 0 0\nv 1 0 0\nv 0 1 0\n"), {"no triangles", "only vertices"});
  expectBadInput(write("v 0 0\n"), {"line 1", "three numbers"});
  expectBadInput(write("v 0 0 x\n"), {"line 1"});
  expectBadInput(write("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n"), {"face 0", "vertex 9 of 3"});
  expectBadInput(write("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 -9\n"), {"line 4", "vertex -9"});
  expectBadInput(write("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 0 1 2\n"), {"line 4", "vertex 0"});
  expectBadInput(write("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1/4 2/1 3/1\nvt 0 0\n"), {"vt 4 of 1"});
  expectBadInput(write("v 0 0 0\nv 1 0 0\nv 0 1 0\nf a b c\n"), {"line 4"});
  expectBadInput(write("v 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n"), {"vertex 1", "finite"});
  expectBadInput(write("v 0 0 0\nv 1e99 0 0\nv 0 1 0\nf 1 2 3\n"), {"vertex 1", "finite"});
}

TEST_F(Obj, TruncatedAndDamagedFilesNeverCrash) {
  std::string text = "mtllib a.mtl\no thing\nusemtl red\n";
  const scene::Mesh mesh = scene::uvSphere(1, 5, 4);
  for (const Vec3& p : mesh.positions) {
    text += "v " + std::to_string(p.x()) + " " + std::to_string(p.y()) + " " +
            std::to_string(p.z()) + "\nvt 0.5 0.25\nvn 0 1 0\n";
  }
  for (const auto& [a, b, c] : mesh.triangles) {
    for (std::uint32_t v : {a, b, c}) {
      const std::string n = std::to_string(v + 1);
      text += (v == a ? "f " : " ") + n + "/" + n + "/" + n;
    }
    text += "\n";
  }
  folder_.write("a.mtl", "newmtl red\nKd 1 0 0\nmap_Kd -o 1 2 nothing.png\n");
  abuse(folder_, "abused.obj", text, 53, 2000);
}

}  // namespace
}  // namespace lambent::scene_io
