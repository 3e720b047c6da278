// glTF compressed by Draco and by meshoptimizer: what comes out is what went in.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "lambent/scene/shapes.h"
#include "lambent/scene_io/gltf_read.h"
#include "lambent/scene_io/test_compressed.h"

namespace lambent::scene_io {
namespace {

using nlohmann::json;

/// Triangles as sets of corners, in an order of their own.
std::vector<std::array<float, 24>> cornersOf(const scene::Mesh& mesh) {
  std::vector<std::array<float, 24>> triangles;
  for (const scene::Triangle& t : mesh.triangles) {
    std::array<std::array<float, 8>, 3> corners;
    for (int k = 0; k < 3; ++k) {
      const Vec3 &p = mesh.positions[t[k]], &n = mesh.normals[t[k]];
      const Vec2 uv = mesh.uvs.empty() ? Vec2(0, 0) : mesh.uvs[t[k]];
      corners[k] = {p.x(), p.y(), p.z(), n.x(), n.y(), n.z(), uv.x(), uv.y()};
    }
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    std::array<float, 24> flat;
    for (int i = 0; i < 24; ++i) flat[i] = corners[i / 8][i % 8];
    triangles.push_back(flat);
  }
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

TEST(GltfDraco, GivesBackWhatWentIn) {
  const TemporaryFolder folder;
  const scene::Mesh mesh = scene::box(Vec3(1, 2, 3), 3);
  for (const int method : {draco::MESH_SEQUENTIAL_ENCODING, draco::MESH_EDGEBREAKER_ENCODING}) {
    GltfDocument d;
    addDraco(d, dracoOf(mesh, method), mesh.positions.size(), mesh.triangles.size());
    const auto loaded = load(d.write(folder));
    ASSERT_TRUE(loaded) << loaded.error().message;
    expectSound(loaded->scene);
    EXPECT_EQ(cornersOf(loaded->scene.meshes[0]), cornersOf(mesh)) << method;
    d.j.erase("extensionsRequired");
    EXPECT_TRUE(load(d.write(folder)));  // what is not declared required is read as well
  }
}

TEST(GltfDraco, DamageIsAnErrorThatNamesIt) {
  const TemporaryFolder folder;
  const scene::Mesh mesh = scene::uvSphere(1, 8, 5);
  for (const int method : {draco::MESH_SEQUENTIAL_ENCODING, draco::MESH_EDGEBREAKER_ENCODING}) {
    const std::vector<char> whole = dracoOf(mesh, method);
    const auto with = [&](const std::vector<char>& stream) {
      GltfDocument d;
      addDraco(d, stream, mesh.positions.size(), mesh.triangles.size());
      return d.write(folder);
    };
    expectBadInput(with({whole.begin(), whole.begin() + long(whole.size() / 2)}),
                   {"mesh 0", "Draco", "damaged", "gltf-transform"});
    expectBadInput(with(std::vector<char>(40, 'x')), {"mesh 0", "Draco"});
    GltfDocument d;
    addDraco(d, whole, mesh.positions.size(), mesh.triangles.size());
    const auto glb = *d.gltf.glb();
    abuse(folder, "draco.glb", {reinterpret_cast<const char*>(glb.data()), glb.size()}, 97, 1500);
    d.primitive()["extensions"]["KHR_draco_mesh_compression"]["attributes"]["POSITION"] = 9;
    expectBadInput(d.write(folder), {"attribute 9"});
  }
}

TEST(GltfDraco, StreamsThatClaimTooMuchAreRefused) {
  const TemporaryFolder folder;
  // A header of version 2.2 and a count of faces and points that no bytes stand behind.
  for (const char method : {0, 1}) {
    std::vector<char> stream = {'D', 'R', 'A', 'C', 'O', 2, 2, 1, method, 0, 0};
    if (method == 1) stream.push_back(0);
    for (int i = 0; i < 2; ++i) {
      for (const int byte : {0xff, 0xff, 0xff, 0xff, 0x07}) stream.push_back(char(byte));
    }
    stream.resize(200, 0);
    GltfDocument d;
    addDraco(d, stream, 3, 1);
    expectBadInput(d.write(folder), {"mesh 0", "limit"});
  }
}

class GltfMeshopt : public testing::Test {
 protected:
  std::filesystem::path write() { return document_.write(folder_ / "packed.gltf"); }

  TemporaryFolder folder_;
  MeshoptDocument document_;
};

TEST_F(GltfMeshopt, GivesBackWhatWentIn) {
  const scene::Mesh mesh = scene::box(Vec3(1, 2, 3), 5);
  document_.addMesh(mesh);
  const auto loaded = load(write());
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_EQ(loaded->scene.meshes[0].positions, mesh.positions);
  EXPECT_EQ(loaded->scene.meshes[0].normals, mesh.normals);
  EXPECT_EQ(cornersOf(loaded->scene.meshes[0]), cornersOf(mesh));
}

TEST_F(GltfMeshopt, FiltersAreUndone) {
  const scene::Mesh mesh = scene::uvSphere(1, 24, 12);
  const std::size_t count = mesh.positions.size();
  std::vector<float> normals;
  for (const Vec3& n : mesh.normals) normals.insert(normals.end(), {n.x(), n.y(), n.z(), 0.0f});
  std::vector<std::int8_t> octahedral(4 * count);
  meshopt_encodeFilterOct(octahedral.data(), count, 4, 8, normals.data());
  std::vector<std::int32_t> exponential(3 * count);
  meshopt_encodeFilterExp(exponential.data(), count, 12, 20,
                          reinterpret_cast<const float*>(mesh.positions.data()));
  Packed positions = packVertices(exponential, count), directions = packVertices(octahedral, count);
  positions.object["filter"] = "EXPONENTIAL";
  directions.object["filter"] = "OCTAHEDRAL";
  document_.attribute("POSITION", positions, Component::Float, "VEC3");
  document_.attribute("NORMAL", directions, Component::Byte, "VEC3", true);
  std::vector<std::uint32_t> corners;
  for (const scene::Triangle& t : mesh.triangles) corners.insert(corners.end(), t.begin(), t.end());
  document_.indices(corners, count);
  const auto loaded = load(write());
  ASSERT_TRUE(loaded) << loaded.error().message;
  ASSERT_EQ(loaded->scene.meshes[0].positions.size(), count);
  for (std::size_t v = 0; v < count; ++v) {
    EXPECT_LT((loaded->scene.meshes[0].positions[v] - mesh.positions[v]).norm(), 1e-5f);
    EXPECT_LT((loaded->scene.meshes[0].normals[v] - mesh.normals[v]).norm(), 0.03f);
  }
}

TEST_F(GltfMeshopt, WhatIsDamagedOrClaimsTooMuchIsRefused) {
  document_.addMesh(scene::box(Vec3::Ones(), 3));
  json& object = document_.j["bufferViews"][1]["extensions"]["EXT_meshopt_compression"];
  const json whole = object;
  const auto refused = [&](const char* key, const json& value,
                           std::initializer_list<std::string> says) {
    object = whole;
    object[key] = value;
    expectBadInput(write(), says);
  };
  refused("count", 4000000000u, {"bufferView 1", "cannot come out of"});
  refused("count", -1, {"bufferView 1", "gltf-transform"});
  refused("count", 1e15, {"bufferView 1"});
  refused("mode", "SPLINES", {"bufferView 1", "gltf-transform"});
  refused("filter", "BLUR", {"bufferView 1"});
  refused("byteStride", 13, {"bufferView 1"});
  refused("byteStride", 0, {"bufferView 1"});
  refused("mode", "TRIANGLES", {"bufferView 1"});
  refused("byteLength", 7, {"bufferView 1", "damaged"});
  refused("byteLength", 1u << 30, {"bufferView 1", "beyond"});
  refused("buffer", 1, {"bufferView 1"});
  object = whole;
  EXPECT_TRUE(load(write()));
}

}  // namespace
}  // namespace lambent::scene_io
