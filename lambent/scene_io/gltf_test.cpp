#include <bit>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

#include <fmt/format.h>

#include <Eigen/Geometry>

#include "lambent/scene/camera.h"
#include "lambent/scene/diagnose.h"
#include "lambent/scene/shapes.h"
#include "lambent/scene_io/gltf_material.h"
#include "lambent/scene_io/gltf_read.h"
#include "lambent/scene_io/test_files.h"
#include "lambent/scene_io/test_gltf.h"

namespace lambent::scene_io {
namespace {

using nlohmann::json;

scene::Scene richScene() {
  scene::Scene s;
  scene::Texture texture;
  texture.name = "checks";
  texture.width = texture.height = 2;
  texture.rgba = {255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 9, 8, 7, 255};
  texture.wrapU = scene::Wrap::ClampToEdge;
  texture.wrapV = scene::Wrap::MirroredRepeat;
  s.textures = {texture};
  scene::Material mixed;
  mixed.name = "mixed";
  mixed.diffuse = Rgb(0.5f, 0.25f, 0.1f);
  mixed.glossy = Rgb(0.1f, 0.2f, 0.3f);
  mixed.lobeExponent = 37.25f;
  mixed.baseColorTexture = 0;
  mixed.doubleSided = true;
  mixed.emission = Rgb(0.75f, 0.5f, 0.125f);
  mixed.alphaMode = scene::AlphaMode::Mask;
  mixed.alphaCutoff = 0.25f;
  mixed.opacity = 0.9f;
  scene::addTo(s, scene::uvSphere(1.0f, 12, 8), mixed);
  scene::Material mirror;
  mirror.diffuse = Rgb::Zero();
  mirror.mirror = Rgb(0.9f, 0.8f, 0.7f);
  scene::addTo(s, scene::ring(1.0f, 1.1f, 0.3f, 24), mirror);
  scene::Mesh colored = scene::icosphere(0.5f, 2);
  for (const Vec3& p : colored.positions) colored.colors.push_back(p.array().abs());
  for (const Vec3& p : colored.positions) colored.alphas.push_back(0.5f + 0.5f * p.x());
  scene::Material veil;
  veil.alphaMode = scene::AlphaMode::Blend;
  veil.opacity = 0.75f;
  scene::addTo(s, colored, veil);
  scene::Camera camera = scene::frameAutomatically(s, 1.5f);
  camera.name = "main";
  s.cameras = {camera};
  camera.name = "plan";
  camera.orthographicHalfHeight = 2.5f;
  s.cameras.push_back(camera);
  return s;
}

TEST(Gltf, WhatIsWrittenIsReadToTheBit) {
  const TemporaryFolder folder;
  const scene::Scene s = richScene();
  ASSERT_TRUE(saveGlb(s, folder / "rich.glb"));
  const Result<LoadedScene> loaded = load(folder / "rich.glb");
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_TRUE(loaded->findings.empty());
  const scene::Scene& t = loaded->scene;
  expectSound(t);
  ASSERT_EQ(t.meshes.size(), s.meshes.size());
  for (std::size_t i = 0; i < s.meshes.size(); ++i) {
    EXPECT_EQ(t.meshes[i].name, s.meshes[i].name);
    EXPECT_EQ(t.meshes[i].material, s.meshes[i].material);
    EXPECT_EQ(t.meshes[i].positions, s.meshes[i].positions);
    EXPECT_EQ(t.meshes[i].normals, s.meshes[i].normals);
    EXPECT_EQ(t.meshes[i].uvs, s.meshes[i].uvs);
    EXPECT_EQ(t.meshes[i].triangles, s.meshes[i].triangles);
    EXPECT_EQ(t.meshes[i].alphas, s.meshes[i].alphas);
    ASSERT_EQ(t.meshes[i].colors.size(), s.meshes[i].colors.size());
    for (std::size_t v = 0; v < s.meshes[i].colors.size(); ++v) {
      EXPECT_TRUE((t.meshes[i].colors[v] == s.meshes[i].colors[v]).all());
    }
  }
  ASSERT_EQ(t.materials.size(), s.materials.size());
  for (std::size_t i = 0; i < s.materials.size(); ++i) {
    EXPECT_EQ(t.materials[i].name, s.materials[i].name);
    EXPECT_TRUE((t.materials[i].diffuse == s.materials[i].diffuse).all());
    EXPECT_TRUE((t.materials[i].glossy == s.materials[i].glossy).all());
    EXPECT_TRUE((t.materials[i].mirror == s.materials[i].mirror).all());
    EXPECT_EQ(t.materials[i].lobeExponent, s.materials[i].lobeExponent);
    EXPECT_TRUE((t.materials[i].emission == s.materials[i].emission).all());
    EXPECT_EQ(t.materials[i].baseColorTexture, s.materials[i].baseColorTexture);
    EXPECT_EQ(t.materials[i].doubleSided, s.materials[i].doubleSided);
    EXPECT_EQ(t.materials[i].alphaMode, s.materials[i].alphaMode);
    EXPECT_EQ(t.materials[i].alphaCutoff, s.materials[i].alphaCutoff);
    EXPECT_EQ(t.materials[i].opacity, s.materials[i].opacity);
  }
  ASSERT_EQ(t.textures.size(), 1u);
  EXPECT_EQ(t.textures[0].rgba, s.textures[0].rgba);
  EXPECT_EQ(t.textures[0].wrapU, scene::Wrap::ClampToEdge);
  EXPECT_EQ(t.textures[0].wrapV, scene::Wrap::MirroredRepeat);
  EXPECT_EQ(t.textures[0].mimeType, "image/png");
  ASSERT_EQ(t.cameras.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(t.cameras[i].name, s.cameras[i].name);
    EXPECT_EQ(t.cameras[i].worldFromCamera, s.cameras[i].worldFromCamera);
    EXPECT_EQ(t.cameras[i].orthographicHalfHeight, s.cameras[i].orthographicHalfHeight);
  }
  EXPECT_EQ(t.cameras[0].verticalFov, s.cameras[0].verticalFov);

  // And again: an image's own bytes are carried on.
  ASSERT_TRUE(saveGlb(t, folder / "again.glb"));
  EXPECT_EQ(load(folder / "again.glb")->scene.textures[0].encoded, t.textures[0].encoded);
  EXPECT_EQ(contentOf(folder / "again.glb"), contentOf(folder / "rich.glb"));
}

TEST(Gltf, APaneIsWrittenAsTransmission) {
  const TemporaryFolder folder;
  scene::Material pane;
  pane.diffuse = Rgb(0.1f, 0.05f, 0.2f);
  pane.transmitted = Rgb(0.3f, 0.15f, 0.6f);
  ASSERT_TRUE(saveGlb(scene::sceneOf(scene::icosphere(1, 1), pane), folder / "pane.glb"));
  const auto file = GltfFile::open(folder / "pane.glb");
  ASSERT_TRUE(file);
  const auto& material = file->json()["materials"][0];
  EXPECT_NEAR(double(material["extensions"]["KHR_materials_transmission"]["transmissionFactor"]),
              0.75, 1e-6);
  EXPECT_NEAR(double(material["pbrMetallicRoughness"]["baseColorFactor"][2]), 0.8, 1e-6);
  const auto read = load(folder / "pane.glb");
  ASSERT_TRUE(read);
  EXPECT_TRUE((read->scene.materials[0].transmitted == pane.transmitted).all());
  EXPECT_TRUE((read->scene.materials[0].diffuse == pane.diffuse).all());
}

TEST(Gltf, EditedMetallicRoughnessWinsOverExtras) {
  const TemporaryFolder folder;
  GltfBuilder gltf(richScene());
  gltf.json()["materials"][0]["pbrMetallicRoughness"]["metallicFactor"] = 0.0;
  const auto loaded = load(folder.write("edited.glb", *gltf.glb()));
  ASSERT_TRUE(loaded);
  EXPECT_FALSE(loaded->scene.materials[0].isGlossy());
  EXPECT_TRUE(loaded->scene.materials[0].diffuse.isApprox(Rgb(0.6f, 0.45f, 0.4f), 1e-5f));
}

TEST(Gltf, MetallicRoughness) {
  scene::Material m;
  applyMetallicRoughness({Rgb(0.8f, 0.4f, 0.2f), 0.25, 0.5}, m);
  EXPECT_TRUE(m.diffuse.isApprox(Rgb(0.6f, 0.3f, 0.15f), 1e-6f));
  EXPECT_TRUE(m.glossy.isApprox(Rgb(0.2f, 0.1f, 0.05f), 1e-6f));
  EXPECT_NEAR(m.lobeExponent, (2.0 / 0.0625 - 2.0) / 4.0, 1e-5);
  applyMetallicRoughness({Rgb::Ones(), 1.0, 0.05}, m);
  EXPECT_TRUE(m.isMirror());
  EXPECT_FALSE(m.isDiffuse() || m.isGlossy());
  applyMetallicRoughness({Rgb::Ones(), 1.0, 1.0}, m);
  EXPECT_EQ(m.lobeExponent, 1.0f);
  for (double e : {1.0, 4.0, 16.0, 64.0, 1000.0}) {
    EXPECT_NEAR(lobeExponentFromRoughness(roughnessFromLobeExponent(e)), e, 1e-4 * e);
  }
}

TEST(Gltf, BrightEmissionGoesIntoTheStrength) {
  const TemporaryFolder folder;
  scene::Material lamp;
  lamp.emission = Rgb(40, 20, 0);
  ASSERT_TRUE(saveGlb(scene::sceneOf(scene::icosphere(1, 1), lamp), folder / "lamp.glb"));
  EXPECT_NE(contentOf(folder / "lamp.glb").find("KHR_materials_emissive_strength"),
            std::string::npos);
  const auto lit = load(folder / "lamp.glb");
  ASSERT_TRUE(lit) << lit.error().message;
  EXPECT_TRUE(lit->scene.materials[0].emission.isApprox(Rgb(40, 20, 0), 1e-6f));
  EXPECT_TRUE(lit->findings.empty());

  // A strength without a factor emits nothing; a factor alone is what it is.
  GltfDocument d;
  d.positions(kTriangle);
  d.j["materials"] = json::parse(R"([{"extensions": {"KHR_materials_emissive_strength":
      {"emissiveStrength": 5}}}, {"emissiveFactor": [0.5, 0, 0]},
      {"emissiveFactor": [1e300, -1, 0], "extensions": {"KHR_materials_emissive_strength":
      {"emissiveStrength": 1e300}}}])");
  d.primitive()["material"] = 1;
  const auto plain = load(d.write(folder));
  ASSERT_TRUE(plain) << plain.error().message;
  EXPECT_FALSE(plain->scene.materials[0].isEmitter());
  EXPECT_TRUE(plain->scene.materials[1].emission.isApprox(Rgb(0.5f, 0, 0)));
  EXPECT_TRUE(plain->scene.materials[2].emission.isFinite().all());
  EXPECT_GE(plain->scene.materials[2].emission.minCoeff(), 0);
}

TEST(Gltf, NodeTransformsAndInstances) {
  const TemporaryFolder folder;
  GltfDocument d;
  d.positions(kTriangle);
  d.j["scenes"] = json::parse(R"([{"nodes": [9]}, {"nodes": [0]}])");
  d.j["scene"] = 1;
  d.j["nodes"] = json::parse(R"([
    {"translation": [10, 0, 0], "children": [1, 2]},
    {"mesh": 0, "name": "turned", "rotation": [0, 0, 0.70710678, 0.70710678], "scale": [2, 1, 1]},
    {"mesh": 0, "name": "mirrored", "matrix": [-1,0,0,0, 0,1,0,0, 0,0,1,0, 0,5,0,1]}])");
  const auto loaded = load(d.write(folder));
  ASSERT_TRUE(loaded) << loaded.error().message;
  expectSound(loaded->scene);
  ASSERT_EQ(loaded->scene.meshes.size(), 2u);
  const scene::Mesh& turned = loaded->scene.meshes[0];
  EXPECT_EQ(turned.name, "turned");
  EXPECT_TRUE(turned.positions[1].isApprox(Vec3(10, 2, 0), 1e-6f));
  EXPECT_TRUE(turned.positions[2].isApprox(Vec3(9, 0, 0), 1e-6f));
  // A negative determinant turns the winding over, so that the front stays the front.
  const scene::Mesh& mirrored = loaded->scene.meshes[1];
  EXPECT_TRUE(mirrored.positions[1].isApprox(Vec3(9, 5, 0), 1e-6f));
  for (const scene::Mesh& mesh : loaded->scene.meshes) {
    for (const Vec3& n : mesh.normals) EXPECT_TRUE(n.isApprox(Vec3::UnitZ(), 1e-6f));
  }
}

TEST(Gltf, NegativeScaleKeepsABodyRightSideOut) {
  const TemporaryFolder folder;
  GltfBuilder gltf(scene::sceneOf(scene::icosphere(1.0f, 2)));
  gltf.json()["nodes"][0]["scale"] = {-1.0, 2.0, 1.0};
  const auto loaded = load(folder.write("negative.glb", *gltf.glb()));
  ASSERT_TRUE(loaded);
  EXPECT_TRUE(loaded->findings.empty());
  EXPECT_GT(scene::topology(loaded->scene.meshes[0]).signedVolume, 7.5);
}

TEST(Gltf, StripsFansAndUnindexed) {
  const TemporaryFolder folder;
  const std::vector<Vec3> strip = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 2, 0}};
  const auto triangles = [&](int mode, const std::vector<Vec3>& points) {
    GltfDocument d;
    d.positions(points);
    d.primitive()["mode"] = mode;
    const auto loaded = load(d.write(folder));
    EXPECT_TRUE(loaded);
    for (const Vec3& n : loaded->scene.meshes[0].normals) EXPECT_GT(n.z(), 0.999f);
    return loaded->scene.meshes[0].triangles.size();
  };
  EXPECT_EQ(triangles(5, strip), 3u);
  EXPECT_EQ(triangles(6, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}), 2u);
  EXPECT_EQ(triangles(4, kTriangle), 1u);
}

TEST(Gltf, QuantizedAttributes) {
  const TemporaryFolder folder;
  GltfDocument d;
  d.gltf.useExtension("KHR_mesh_quantization", true);
  // Elements of 8, 4 and 4 bytes: padded, as vertex attributes must be.
  const std::vector<std::int16_t> positions = {0, 0, 0, 0, 32767, 0, 0, 0, 0, -32768, 0, 0};
  const std::vector<std::int8_t> normals = {0, 0, -127, 0, 0, 0, -127, 0, 0, 0, -128, 0};
  const std::vector<std::uint16_t> uvs = {0, 0, 65535, 0, 0, 13107};
  const auto strided = [&](const char* name, auto& values, Component c, const char* type,
                           std::size_t stride, bool normalized) {
    const int view = d.gltf.addBufferView(asBytes(values));
    d.j["bufferViews"][view]["byteStride"] = stride;
    d.j["accessors"].push_back({{"bufferView", view},
                                {"componentType", int(c)},
                                {"type", type},
                                {"count", 3},
                                {"normalized", normalized}});
    d.primitive()["attributes"][name] = d.j["accessors"].size() - 1;
  };
  strided("POSITION", positions, Component::Short, "VEC3", 8, true);
  strided("NORMAL", normals, Component::Byte, "VEC3", 4, true);
  strided("TEXCOORD_0", uvs, Component::UnsignedShort, "VEC2", 4, true);
  auto loaded = load(d.write(folder));
  ASSERT_TRUE(loaded) << loaded.error().message;
  const scene::Mesh& mesh = loaded->scene.meshes[0];
  EXPECT_TRUE(mesh.positions[1].isApprox(Vec3(1, 0, 0)));
  EXPECT_TRUE(mesh.positions[2].isApprox(Vec3(0, -1, 0)));
  EXPECT_TRUE(mesh.normals[2].isApprox(Vec3(0, 0, -1)));
  EXPECT_TRUE(mesh.uvs[2].isApprox(Vec2(0, 0.2f), 1e-6f));

  for (json& accessor : d.j["accessors"]) accessor["normalized"] = false;
  loaded = load(d.write(folder));
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_EQ(loaded->scene.meshes[0].positions[1], Vec3(32767, 0, 0));
  EXPECT_EQ(loaded->scene.meshes[0].positions[2], Vec3(0, -32768, 0));
  EXPECT_TRUE(loaded->scene.meshes[0].normals[1].isApprox(Vec3(0, 0, -1)));
}

TEST(Gltf, SparseAccessors) {
  const TemporaryFolder folder;
  GltfDocument d;
  d.positions(kTriangle);
  const std::vector<std::uint8_t> places = {2};
  const std::vector<Vec3> values = {{0, 7, 0}};
  d.j["accessors"][0]["sparse"] = {
      {"count", 1},
      {"indices", {{"bufferView", d.gltf.addBufferView(asBytes(places))}, {"componentType", 5121}}},
      {"values", {{"bufferView", d.gltf.addBufferView(asBytes(values))}}}};
  const auto loaded = load(d.write(folder));
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_EQ(loaded->scene.meshes[0].positions[2], Vec3(0, 7, 0));
  d.j["accessors"][0]["sparse"]["count"] = 5;
  expectBadInput(d.write(folder), {"sparse", "beyond"});
}

TEST(Gltf, VertexColoursAndTextureTransform) {
  const TemporaryFolder folder;
  GltfDocument d;
  d.positions(kTriangle);
  d.attribute("COLOR_0", std::vector<std::uint8_t>{255, 0, 51, 255, 0, 0, 0, 9, 1, 2, 3, 4},
              Component::UnsignedByte, "VEC4", 3, true);
  d.attribute("TEXCOORD_1", std::vector<Vec2>{{0, 0}, {1, 0}, {0, 1}}, Component::Float, "VEC2", 3);
  d.j["materials"] = json::parse(R"([{"pbrMetallicRoughness": {"metallicFactor": 0,
    "baseColorTexture": {"index": 0, "texCoord": 0, "extensions": {"KHR_texture_transform":
      {"offset": [0.5, 0.25], "rotation": 1.57079632679, "scale": [2, 4], "texCoord": 1}}}}}])");
  d.primitive()["material"] = 0;
  const auto loaded = load(d.write(folder));
  ASSERT_TRUE(loaded) << loaded.error().message;
  const scene::Mesh& mesh = loaded->scene.meshes[0];
  EXPECT_TRUE(mesh.colors[0].isApprox(Rgb(1, 0, 0.2f), 1e-6f));
  // The extension's matrix: scale, then (x, y) → (x cos + y sin, −x sin + y cos), then offset.
  EXPECT_TRUE(mesh.uvs[1].isApprox(Vec2(0.5f, 0.25f - 2.0f), 1e-5f));
  EXPECT_TRUE(mesh.uvs[2].isApprox(Vec2(0.5f + 4.0f, 0.25f), 1e-5f));
  EXPECT_EQ(countOf(loaded->findings, "texture-unreadable"), 1u);
}

TEST(Gltf, TextFormWithDataUriAndWithFileBeside) {
  const TemporaryFolder folder;
  GltfDocument d;
  d.positions(kTriangle);
  json j = d.j;
  std::string bytes(36, '\0');
  std::memcpy(bytes.data(), kTriangle.data(), 36);
  j["buffers"] = {{{"byteLength", 36}, {"uri", "bin%20file.bin"}}};
  folder.write("bin file.bin", std::string_view(bytes));
  auto loaded = load(folder.write("a.gltf", j.dump()));
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_EQ(loaded->scene.meshes[0].positions, kTriangle);

  j["buffers"][0]["uri"] =
      "data:application/octet-stream;base64,"
      "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA";
  loaded = load(folder.write("b.gltf", j.dump()));
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_EQ(loaded->scene.meshes[0].positions, kTriangle);

  j["buffers"][0]["uri"] = "missing.bin";
  expectBadInput(folder.write("c.gltf", j.dump()), {"missing.bin", "does not exist"});
  j["buffers"][0]["uri"] = "https://example.com/x.bin";
  expectBadInput(folder.write("d.gltf", j.dump()), {"network"});
  j["buffers"][0]["uri"] = ".";
  expectBadInput(folder.write("e.gltf", j.dump()), {"not a regular file"});
  j["buffers"][0]["uri"] = "data:;base64,AAAA";
  expectBadInput(folder.write("f.gltf", j.dump()), {"buffer 0", "truncated"});
}

TEST(Gltf, UrisAsOtherMachinesWriteThem) {
  const TemporaryFolder folder;
  GltfDocument d;
  d.positions(kTriangle);
  json j = d.j;
  std::string bytes(36, '\0');
  std::memcpy(bytes.data(), kTriangle.data(), 36);
  std::filesystem::create_directories(folder / "parts");
  folder.write("parts/a 100% b.bin", std::string_view(bytes));
  std::string escaped = "data:application/gltf-buffer,";
  for (const char c : bytes) escaped += fmt::format("%{:02x}", static_cast<unsigned char>(c));
  for (const std::string& uri :
       {std::string("parts\\a 100% b.bin"), std::string("parts/A%20100%25%20B.BIN"),
        std::string("./parts/a 100% b.bin"), escaped,
        std::string("DATA:;base64,") + "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA",
        std::string("data:image/odd;charset=utf-8;BASE64,"
                    "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA")}) {
    j["buffers"] = {{{"byteLength", 36}, {"uri", uri}}};
    const auto loaded = load(folder.write("a.gltf", j.dump()));
    ASSERT_TRUE(loaded) << uri << ": " << loaded.error().message;
    EXPECT_EQ(loaded->scene.meshes[0].positions, kTriangle);
  }
  folder.write("beside.bin", std::string_view(bytes));
  for (const char* uri : {"C:\\Users\\me\\beside.bin", "file:///C:/Users/me/beside.bin"}) {
    j["buffers"][0]["uri"] = uri;
    EXPECT_TRUE(load(folder.write("b.gltf", j.dump()))) << uri;
  }
  j["buffers"][0]["uri"] = "file:///etc/passwd";
  expectBadInput(folder.write("c.gltf", j.dump()), {"outside of the scene's folder"});
  j["buffers"][0]["uri"] = "data:nothing";
  expectBadInput(folder.write("d.gltf", j.dump()), {"buffer 0", "no data"});
}

TEST(Gltf, ColoursThatAreCountedTo255) {
  const TemporaryFolder folder;
  GltfDocument d;
  d.positions(kTriangle);
  d.attribute("COLOR_0", std::vector<std::uint8_t>{255, 0, 51, 9, 0, 255, 0, 9, 1, 2, 3, 9},
              Component::UnsignedByte, "VEC4", 3, false);
  const auto loaded = load(d.write(folder));
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_TRUE(loaded->scene.meshes[0].colors[0].isApprox(Rgb(1, 0, 0.0331f), 1e-4f));  // sRGB
  EXPECT_EQ(countOf(loaded->findings, "colors-clamped"), 0u);
}

TEST(Gltf, ContainersThatAreNotQuiteRight) {
  const TemporaryFolder folder;
  GltfDocument d;
  d.positions(kTriangle);
  json j = d.j;
  j["buffers"] = {{{"byteLength", 38}, {"uri", "a.bin"}}};  // two more than there are
  std::string bytes(36, '\0');
  std::memcpy(bytes.data(), kTriangle.data(), 36);
  folder.write("a.bin", std::string_view(bytes));
  EXPECT_TRUE(load(folder.write("a.gltf", j.dump())));
  EXPECT_TRUE(load(folder.write("json.glb", " \n" + j.dump())));
  EXPECT_TRUE(load(folder.write("marked.glb", "\xef\xbb\xbf" + j.dump())));
  j["buffers"][0]["byteLength"] = 40;
  expectBadInput(folder.write("b.gltf", j.dump()), {"buffer 0", "truncated"});
}

TEST(Gltf, MembersOfAnotherTypeAreSaid) {
  const TemporaryFolder folder;
  GltfDocument d;
  d.positions(kTriangle);
  d.j["materials"] = json::parse(R"([{"pbrMetallicRoughness": ["not an object"]}])");
  d.j["nodes"][0]["children"] = "none";
  const auto loaded = load(d.write(folder));
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_EQ(countOf(loaded->findings, "wrong-types"), 2u);
  d.j["meshes"][0]["primitives"] = json::parse(R"({"attributes": {"POSITION": 0}})");
  expectBadInput(d.write(folder), {"no triangles", "members are of another type"});
}

TEST(Gltf, SparseIndicesAndIndicesWithoutBytes) {
  const TemporaryFolder folder;
  GltfDocument d;
  d.positions({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}});
  d.indices({0, 1, 2, 0, 0, 0});
  const std::vector<std::uint8_t> places = {3, 4, 5};
  const std::vector<std::uint16_t> values = {1, 3, 2};
  d.j["accessors"][1]["sparse"] = {
      {"count", 3},
      {"indices", {{"bufferView", d.gltf.addBufferView(asBytes(places))}, {"componentType", 5121}}},
      {"values", {{"bufferView", d.gltf.addBufferView(asBytes(values))}}}};
  const auto loaded = load(d.write(folder));
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_EQ(loaded->scene.meshes[0].triangles.size(), 2u);
}

TEST(Gltf, MaterialsThatFilesLeaveOut) {
  const TemporaryFolder folder;
  GltfDocument d;
  d.positions(kTriangle);
  const auto loaded = load(d.write(folder));
  ASSERT_TRUE(loaded);
  EXPECT_TRUE(loaded->scene.materials.back().isDiffuse());
  EXPECT_FALSE(loaded->scene.materials.back().isGlossy());
  EXPECT_EQ(countOf(loaded->findings, "no-material"), 1u);
}

TEST(Gltf, CamerasUnderScaledNodesStayRigid) {
  const TemporaryFolder folder;
  GltfBuilder gltf(richScene());
  json& camera = gltf.json()["nodes"][3];
  camera.erase("matrix");
  camera["scale"] = {2.0, 3.0, 4.0};
  camera["translation"] = {1.0, 2.0, 3.0};
  const auto loaded = load(folder.write("cameras.glb", *gltf.glb()));
  ASSERT_TRUE(loaded);
  Mat4 expected = Mat4::Identity();
  expected.topRightCorner<3, 1>() = Vec3(1, 2, 3);
  EXPECT_TRUE(loaded->scene.cameras[0].worldFromCamera.isApprox(expected));
}

TEST(Gltf, OriginsAndAccessorsForExtensions) {
  const TemporaryFolder folder;
  GltfBuilder gltf(richScene());
  const std::vector<std::uint16_t> payload = {1, 2, 3, 4, 5};
  const int accessor =
      gltf.addAccessor(asBytes(payload), Component::UnsignedShort, "SCALAR", payload.size());
  gltf.useExtension("LAMBENT_test");
  gltf.useExtension("LAMBENT_test");
  gltf.json()["meshes"][1]["primitives"][0]["extensions"]["LAMBENT_test"] = {{"data", accessor}};
  const auto file = GltfFile::open(folder.write("extended.glb", *gltf.glb()));
  ASSERT_TRUE(file);
  EXPECT_EQ(file->json()["extensionsUsed"].size(), 1u);
  const auto loaded = loadGltf(*file, {.keepAllVertices = true});
  ASSERT_TRUE(loaded);
  ASSERT_EQ(loaded->origins.size(), 3u);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(loaded->origins[i].node, i);
    EXPECT_EQ(loaded->origins[i].mesh, i);
    EXPECT_TRUE(loaded->origins[i].verticesKept);
  }
  const json& primitive = file->json()["meshes"][1]["primitives"][0];
  const auto bytes = file->accessorBytes(primitive["extensions"]["LAMBENT_test"]["data"]);
  ASSERT_TRUE(bytes);
  ASSERT_EQ(bytes->size(), 10u);
  EXPECT_EQ(std::memcmp(bytes->data(), payload.data(), 10), 0);
  EXPECT_FALSE(file->accessorBytes(-1));
  EXPECT_FALSE(file->accessorBytes(1 << 20));
}

}  // namespace
}  // namespace lambent::scene_io
