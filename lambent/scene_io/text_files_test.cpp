// OBJ, MTL and PLY as programs and people write them: what surrounds the numbers and the names.
#include <cmath>

#include "lambent/image/decode.h"
#include "lambent/scene_io/mtl_map.h"
#include "lambent/scene_io/obj_text.h"
#include "lambent/scene_io/test_files.h"
#include "lambent/scene_io/text_file.h"
#include "lambent/scene_io/text_number.h"

namespace lambent::scene_io {
namespace {

constexpr std::string_view kTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

class TextFiles : public testing::Test {
 protected:
  LoadedScene loadText(const std::string& name, const std::string& text) {
    Result<LoadedScene> loaded = load(folder_.write(name, text));
    EXPECT_TRUE(loaded) << loaded.error().message;
    if (!loaded) return {};
    expectSound(loaded->scene);
    return std::move(*loaded);
  }
  /// A triangle whose material is `text` in a library.
  LoadedScene loadMaterial(const std::string& text) {
    folder_.write("m.mtl", "newmtl m\n" + text);
    return loadText("m.obj",
                    "mtllib m.mtl\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl m\nv 0 0 0\nv 1 0 0\nv 0 1 0\n"
                    "f 1/1 2/2 3/3\n");
  }
  void writePicture(const std::string& name) {
    const std::vector<std::uint8_t> texels = {255, 0, 0, 255};
    std::filesystem::create_directories((folder_ / name).parent_path());
    folder_.write(name, std::span<const std::byte>(image::encodePng(1, 1, 4, texels)));
  }
  void writeTwo(const std::string& name, const std::vector<std::uint8_t>& texels) {
    folder_.write(name, std::span<const std::byte>(image::encodePng(2, 1, 4, texels)));
  }
  TemporaryFolder folder_;
};

bool isLost(const Findings& findings, std::string_view code) {
  for (const Finding& finding : findings) {
    if (finding.code == code) return finding.loss;
  }
  return false;
}

double numberIn(std::string_view text) {
  const auto number = parseNumber(text.data(), text.data() + text.size());
  EXPECT_TRUE(number && number->end == text.data() + text.size()) << text;
  return number ? number->value : 0.0;
}

TEST_F(TextFiles, NumbersOfThreeDecades) {
  EXPECT_EQ(numberIn("+1.5e3"), 1500.0);
  EXPECT_EQ(numberIn("1.#INF00"), HUGE_VAL);
  EXPECT_EQ(numberIn("-1.#INF"), -HUGE_VAL);
  for (const char* text : {"nan", "-nan(ind)", "-1.#IND00", "1.#QNAN0", "1.#SNAN"}) {
    EXPECT_TRUE(std::isnan(numberIn(text))) << text;
  }
  EXPECT_EQ(numberIn("1e999"), HUGE_VAL);
  EXPECT_EQ(numberIn("1e-999"), 0.0);
  EXPECT_EQ(numberIn("0." + std::string(400, '0') + "1"), 0.0);
}

TEST_F(TextFiles, MarksLineEndsAndComments) {
  const std::string mark = "\xef\xbb\xbf";
  folder_.write("red.mtl", mark + "newmtl red\r\nKd 0.5 0.25 0 # wine\r\n");
  for (const char* end : {"\n", "\r\n", "\r"}) {
    std::string text = mark + "mtllib red.mtl # the one|v 0 0 0 # first|v 1 0 0#second|v 0 1 0|" +
                       "usemtl red # and this|f 1 2 3#done|\x1a";
    for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos;) {
      text.replace(at, 1, end);
    }
    const LoadedScene loaded = loadText("marked.obj", text);
    EXPECT_TRUE(loaded.scene.materials[0].diffuse.isApprox(Rgb(0.5f, 0.25f, 0.0f)));
    EXPECT_EQ(countOf(loaded.findings, "no-material"), 0u);
    EXPECT_EQ(countOf(loaded.findings, "statements-ignored"), 0u);
  }
}

TEST_F(TextFiles, Utf16IsNamed) {
  const auto wide = [](std::string_view text, std::string_view mark) {
    std::string out(mark);
    for (const char c : text) out += {c, '\0'};
    return out;
  };
  expectBadInput(folder_.write("wide.obj", wide(kTriangle, "\xff\xfe")), {"UTF-16", "UTF-8"});
  expectBadInput(folder_.write("bare.obj", wide(kTriangle, "")), {"UTF-16"});
  expectBadInput(folder_.write("wide.ply", wide("ply\nformat ascii 1.0\n", "\xff\xfe")),
                 {"UTF-16"});
  folder_.write("wide.mtl", wide("newmtl m\n", "\xff\xfe"));
  const Result<LoadedScene> loaded =
      load(folder_.write("m.obj", "mtllib wide.mtl\n" + std::string(kTriangle)));
  ASSERT_FALSE(loaded);
  EXPECT_NE(loaded.error().message.find("wide.mtl: is text in UTF-16"), std::string::npos);
}

TEST_F(TextFiles, DecimalCommasAreNamed) {
  expectBadInput(folder_.write("comma.obj", "v 0,5 1,5 2,5\n"), {"line 1", "decimal comma"});
  expectBadInput(
      folder_.write("comma.ply",
                    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty "
                    "float y\nproperty float z\nelement face 1\nproperty list uchar int "
                    "vertex_index\nend_header\n0,5 1,5 2,5\n0 0 0\n0 0 0\n3 0 1 2\n"),
      {"vertex 0", "0,5", "decimal comma"});
}

TEST_F(TextFiles, NamesAsTheyAreSpelled) {
  const std::string red = "newmtl red\nKd 0.5 0.25 0\n";
  std::filesystem::create_directories(folder_ / "Lib");
  folder_.write("Lib/Red Wine.mtl", red);
  folder_.write("red.mtl", red);
  for (const char* name :
       {"Lib/Red Wine.mtl", "Lib\\Red Wine.mtl", "\"Lib/Red Wine.mtl\"", "lib/red wine.MTL",
        "./Lib/Red Wine.mtl", "C:\\jobs\\Lib\\Red Wine.mtl", "/home/someone/jobs/red.mtl",
        "..\\elsewhere\\red.mtl", "RED.mtl", "gone.mtl red.mtl", "\"gone.mtl\" \"red.mtl\"",
        "Lib/Red Wine.mtl # wine"}) {
    const LoadedScene loaded = loadText(
        "names.obj", "mtllib " + std::string(name) + "\nusemtl red\n" + std::string(kTriangle));
    EXPECT_TRUE(loaded.scene.materials[0].diffuse.isApprox(Rgb(0.5f, 0.25f, 0.0f))) << name;
  }
  folder_.write("names.mtl", red);  // beside names.obj
  const LoadedScene renamed =
      loadText("names.obj", "mtllib untitled.mtl\nusemtl red\n" + std::string(kTriangle));
  EXPECT_TRUE(renamed.scene.materials[0].diffuse.isApprox(Rgb(0.5f, 0.25f, 0.0f)));
  EXPECT_EQ(countOf(renamed.findings, "file-found-beside"), 1u);
  EXPECT_EQ(libraryNames("a b.mtl \"c d.mtl\" e.MTL # f"),
            (std::vector<std::string>{"a b.mtl", "c d.mtl", "e.MTL"}));
  EXPECT_EQ(libraryNames("a b"), (std::vector<std::string>{"a", "b"}));
}

TEST_F(TextFiles, PicturesOfAnotherMachine) {
  writePicture("textures/Wood.png");
  writePicture("own.png");
  for (const char* name :
       {"C:\\Users\\someone\\pack\\textures\\Wood.png", "/Users/someone/textures/wood.PNG",
        "textures\\Wood.png", "D:own.png", "\"own.png\"", "OWN.PNG", "../../art/own.png"}) {
    const LoadedScene loaded = loadMaterial("map_Kd " + std::string(name) + "\n");
    EXPECT_EQ(loaded.scene.materials[0].baseColorTexture, 0) << name;
  }
  const LoadedScene gone = loadMaterial("map_Kd gone.png\n");
  EXPECT_TRUE(isLost(gone.findings, "texture-unreadable"));
}

TEST_F(TextFiles, NamesWithNumberSigns) {
  folder_.write("max.mtl", "newmtl Material #25\nKd 1 0 0\nnewmtl Material #26\nKd 0 1 0\n");
  const LoadedScene loaded =
      loadText("max.obj", "mtllib max.mtl\nusemtl Material #26\n" + std::string(kTriangle));
  EXPECT_EQ(loaded.scene.materials[std::size_t(loaded.scene.meshes[0].material)].name,
            "Material #26");
  const LoadedScene none =
      loadText("max.obj", "mtllib max.mtl\nusemtl Material #27\n" + std::string(kTriangle));
  EXPECT_EQ(countOf(none.findings, "no-material"), 1u);
}

TEST_F(TextFiles, OptionsOfMaps) {
  const MtlMap plain = readMtlMap("wood grain.png");
  EXPECT_EQ(plain.name, "wood grain.png");
  EXPECT_TRUE(plain.uv.isIdentity());
  const MtlMap map = readMtlMap(
      "-blendu on -s 2 3 1 -o 0.25 -0.5 0 -mm 0 1 -bm 1.0 -clamp on -imfchan r -t 1 1 1 wood "
      "2.png");
  EXPECT_EQ(map.name, "wood 2.png");
  EXPECT_EQ(map.uv.scale, Vec2(2, 3));
  EXPECT_EQ(map.uv.offset, Vec2(0.25f, -0.5f));
  EXPECT_TRUE(map.clamp);
  EXPECT_EQ(map.ignored, "-imfchan -t");
  const MtlMap behind = readMtlMap("wood.png -s 2 -o 1 1 -texres 512");
  EXPECT_EQ(behind.name, "wood.png");
  EXPECT_EQ(behind.uv.scale, Vec2(2, 1));
  EXPECT_EQ(behind.uv.offset, Vec2(1, 1));
  // (u, v) · (2, 3) + (¼, −½) with v from the bottom.
  EXPECT_TRUE(map.uv.apply(Vec2(0.5f, 0.25f)).isApprox(Vec2(1.25f, 1.0f - (0.75f * 3 - 0.5f))));
}

TEST_F(TextFiles, OptionsOfMapsMoveTheMeshesThatHaveThem) {
  writePicture("own.png");
  const LoadedScene loaded = loadMaterial("map_Kd -s 2 2 1 -o 1 0 0 -clamp on own.png\n");
  const scene::Mesh& mesh = loaded.scene.meshes[0];
  EXPECT_TRUE(mesh.uvs[0].isApprox(Vec2(1, 1)));
  EXPECT_TRUE(mesh.uvs[1].isApprox(Vec2(3, 1)));
  EXPECT_TRUE(mesh.uvs[2].isApprox(Vec2(1, -1)));
  EXPECT_EQ(loaded.scene.textures[0].wrapU, scene::Wrap::ClampToEdge);
  EXPECT_TRUE(
      isLost(loadMaterial("map_Kd -mm 0.5 1 own.png\n").findings, "texture-option-ignored"));
}

TEST_F(TextFiles, WhatMaterialsLoseIsSaid) {
  writePicture("own.png");
  const std::pair<const char*, const char*> cases[] = {
      {"map_Tr own.png", "alpha-ignored"},
      {"map_Kd own.png\nmap_d -s 2 2 1 own.png", "alpha-placed-otherwise"},
      {"illum 7", "alpha-ignored"},
      {"map_Bump own.png", "relief-ignored"},
      {"bump own.png -bm 1", "relief-ignored"},
      {"norm own.png", "relief-ignored"},
      {"map_Ks own.png", "map-ignored"},
      {"map_Pr own.png", "map-ignored"},
      {"Pc 0.5", "layer-ignored"},
      {"Kd 255 128 0", "reflectance-clamped"},
      {"Kd spectral red.rfl", "material-statement-ignored"},
      {"hue 3", "material-statement-ignored"}};
  for (const auto& [statement, code] : cases) {
    const LoadedScene loaded = loadMaterial(std::string(statement) + "\n");
    EXPECT_TRUE(isLost(loaded.findings, code)) << statement;
  }
  const LoadedScene usual = loadMaterial(
      "Ka 1 1 1\nKd 0.5 0.5 0.5\nKs 0 0 0\nKe 0 0 0\nNs 10\nNi 1.45\nd 1\nTr 0\nTf 1 1 1\n"
      "illum 2\nsharpness 60\nPc 0\nmap_Kd own.png\nmap_Ka own.png\n");
  for (const Finding& finding : usual.findings) EXPECT_FALSE(finding.loss) << finding.code;
}

TEST_F(TextFiles, MaterialsMayBeThereInPartsAlone) {
  writePicture("own.png");
  const auto opacityOf = [&](const char* statements) {
    const LoadedScene loaded = loadMaterial(std::string(statements) + "\n");
    EXPECT_EQ(countOf(loaded.findings, "alpha-ignored"), 0u) << statements;
    const scene::Material& material = loaded.scene.materials[0];
    EXPECT_EQ(material.alphaMode,
              material.opacity < 1.0f ? scene::AlphaMode::Blend : scene::AlphaMode::Opaque);
    return material.opacity;
  };
  EXPECT_EQ(opacityOf("d 1"), 1.0f);
  EXPECT_EQ(opacityOf("d 0.5"), 0.5f);
  EXPECT_EQ(opacityOf("d -halo 0.25"), 0.25f);
  EXPECT_EQ(opacityOf("Tr 0.25"), 0.75f);
  EXPECT_EQ(opacityOf("Tr 1"), 0.0f);
  EXPECT_EQ(opacityOf("d 0.5\nTr 0.25"), 0.5f);
  EXPECT_EQ(opacityOf("d 0.5\nillum 7"), 0.5f);
  EXPECT_EQ(opacityOf("d 7"), 1.0f);
}

TEST_F(TextFiles, MapsOfOpacity) {
  // Two texels: of the grey ones the alpha is the grey; of those with an alpha that.
  writeTwo("grey.png", {0, 0, 0, 255, 255, 255, 255, 255});
  writeTwo("alpha.png", {255, 255, 255, 51, 255, 255, 255, 255});
  writeTwo("red.png", {200, 0, 0, 255, 100, 0, 0, 255});
  const auto texelsOf = [&](const char* statements) {
    const LoadedScene loaded = loadMaterial(std::string(statements) + "\n");
    const scene::Material& material = loaded.scene.materials[0];
    EXPECT_EQ(material.alphaMode, scene::AlphaMode::Blend);
    return loaded.scene.textures.at(std::size_t(material.baseColorTexture)).rgba;
  };
  using Texels = std::vector<std::uint8_t>;
  EXPECT_EQ(loadMaterial("map_Kd red.png\nmap_d grey.png\n").scene.textures.size(), 1u);
  EXPECT_EQ(texelsOf("map_d grey.png"), (Texels{255, 255, 255, 0, 255, 255, 255, 255}));
  EXPECT_EQ(texelsOf("map_d alpha.png"), (Texels{255, 255, 255, 51, 255, 255, 255, 255}));
  EXPECT_EQ(texelsOf("map_Kd red.png\nmap_d grey.png"), (Texels{200, 0, 0, 0, 100, 0, 0, 255}));
  EXPECT_EQ(texelsOf("map_Kd alpha.png\nmap_d alpha.png"),
            (Texels{255, 255, 255, 51, 255, 255, 255, 255}));
}

TEST_F(TextFiles, EmissionOfMaterials) {
  const LoadedScene loaded = loadMaterial("Ke 2 1 0.5\n");
  EXPECT_TRUE(loaded.scene.materials[0].emission.isApprox(Rgb(2, 1, 0.5f)));
}

TEST_F(TextFiles, WhatAnObjLosesIsSaid) {
  const LoadedScene loaded =
      loadText("all.obj",
               "g a b\n" + std::string(kTriangle) +
                   "l 1 2\np 1\ncstype bezier\ncurv 0 1 1 2\ncall other.obj\nhello world\nmg 1\n");
  for (const char* code :
       {"no-triangles", "free-form-ignored", "call-ignored", "statements-ignored"}) {
    EXPECT_TRUE(isLost(loaded.findings, code)) << code;
  }
  EXPECT_EQ(countOf(loaded.findings, "no-triangles"), 2u);
  EXPECT_EQ(countOf(loaded.findings, "statements-ignored"), 1u);
}

TEST_F(TextFiles, SmoothingGroups) {
  // Two triangles at a right angle.
  const std::string corners = "v 0 0 0\nv 1 0 0\nv 1 0 1\nv 0 0 1\nv 0 1 0\n";
  const auto verticesWith = [&](const std::string& first, const std::string& second) {
    return loadText("s.obj", corners + first + "f 1 3 2\n" + second + "f 1 2 5\n")
        .scene.meshes[0]
        .positions.size();
  };
  EXPECT_EQ(verticesWith("", ""), 4u);  // smooth: nobody has said otherwise
  EXPECT_EQ(verticesWith("s 1\n", ""), 4u);
  EXPECT_EQ(verticesWith("s 1\n", "s 2\n"), 6u);
  EXPECT_EQ(verticesWith("s off\n", ""), 6u);
  EXPECT_EQ(verticesWith("s 0\n", ""), 6u);
  const scene::Mesh flat = loadText("s.obj", corners + "s off\nf 1 3 2\nf 1 2 5\n").scene.meshes[0];
  for (std::size_t t = 0; t < 2; ++t) {
    const Vec3 n = t == 0 ? Vec3(0, 1, 0) : Vec3(0, 0, 1);
    for (std::uint32_t v : flat.triangles[t]) EXPECT_TRUE(flat.normals[v].isApprox(n));
  }
}

TEST_F(TextFiles, ColoursCountedTo255) {
  const LoadedScene counted = loadText(
      "c.obj",
      "v 0 0 0 188 60 60\nv 1 0 0 188 60 60\nv 0 1 0 188 60 60\nv 0 0 9\nf 1 2 3\nf 1 2 4\n");
  EXPECT_NEAR(counted.scene.meshes[0].colors[0].x(), 0.5029f, 1e-4f);
  EXPECT_TRUE((counted.scene.meshes[0].colors[3] == 1.0f).all());  // has none
  const LoadedScene bright =
      loadText("c.obj", "v 0 0 0 1 1 1.5\nv 1 0 0 1 1 1\nv 0 1 0 0 0 0\nf 1 2 3\n");
  EXPECT_EQ(countOf(bright.findings, "colors-clamped"), 1u);
}

}  // namespace
}  // namespace lambent::scene_io
