// lambent_write_formats FOLDER: one textured scene in every format and compression that is read.
// quantized.gltf alone loses something: positions have 16 bits, normals 8.
#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>

#include "lambent/image/test_codecs.h"
#include "lambent/scene/shapes.h"
#include "lambent/scene_io/gltf_write.h"
#include "lambent/scene_io/test_compressed.h"

namespace {

using namespace lambent;
using nlohmann::json;
using scene_io::Component;
using scene_io::GltfDocument;
using Path = std::filesystem::path;

constexpr int kTexels = 8;

std::vector<std::uint8_t> texels() {
  std::vector<std::uint8_t> rgba;
  for (int i = 0; i < kTexels * kTexels; ++i) {
    const auto x = std::uint8_t(i % kTexels), y = std::uint8_t(i / kTexels);
    rgba.insert(rgba.end(), {std::uint8_t(60 + 20 * x), std::uint8_t(200 - 15 * y), 120, 255});
  }
  return rgba;
}

std::string png() {
  const std::vector<std::uint8_t> rgba = texels();
  return image::makePng(kTexels, kTexels, {}, [&](int x, int y, int c) {
    return unsigned(rgba[std::size_t(4 * (y * kTexels + x) + c)]);
  });
}

/// A box on a ground that is wider.
scene::Mesh shape() {
  const scene::Mesh parts[] = {scene::translated(scene::box(Vec3(1, 1, 1), 4), Vec3(0, 0.5f, 0)),
                               scene::gridPlane(4, 4, 12, 12)};
  return scene::merge(parts);
}

void save(const Path& path, std::string_view bytes) {
  std::ofstream(path, std::ios::binary).write(bytes.data(), std::streamsize(bytes.size()));
}

void save(const Path& path, const std::vector<std::byte>& bytes) {
  save(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

/// One material of no metal with the texture, in whichever way an image is written.
void addMaterial(GltfDocument& d, const std::string& picture, bool webp) {
  const int view = d.gltf.addBufferView(std::as_bytes(std::span(picture.data(), picture.size())));
  d.j["images"] = {{{"bufferView", view}, {"mimeType", webp ? "image/webp" : "image/png"}}};
  d.j["textures"] = {webp ? json{{"extensions", {{"EXT_texture_webp", {{"source", 0}}}}}}
                          : json{{"source", 0}}};
  d.j["materials"] = {
      {{"pbrMetallicRoughness", {{"metallicFactor", 0}, {"baseColorTexture", {{"index", 0}}}}}}};
  d.primitive()["material"] = 0;
  if (webp) d.gltf.useExtension("EXT_texture_webp", true);
}

void addPlain(GltfDocument& d, const scene::Mesh& mesh) {
  const std::size_t count = mesh.positions.size();
  d.positions(mesh.positions);
  d.attribute("NORMAL", mesh.normals, Component::Float, "VEC3", count);
  d.attribute("TEXCOORD_0", mesh.uvs, Component::Float, "VEC2", count);
  const std::vector<std::uint32_t> corners = scene_io::cornersIn(mesh);
  d.indices({corners.begin(), corners.end()});
}

void writeGltf(const Path& folder, const GltfDocument& d) {
  const std::vector<std::byte> glb = *d.gltf.glb();
  std::uint32_t size = 0;
  std::memcpy(&size, glb.data() + 12, 4);
  const char* text = reinterpret_cast<const char*>(glb.data()) + 20;
  json document = json::parse(text, text + size);
  document["buffers"][0]["uri"] = "scene.bin";
  save(folder / "scene.gltf", document.dump(1));
  save(folder / "scene.bin", {glb.begin() + 20 + size + 8, glb.end()});
}

void writeQuantized(const Path& path, const scene::Mesh& mesh) {
  scene_io::MeshoptDocument d;
  const std::size_t count = mesh.positions.size();
  // Half the extent about the middle is 32767 of the node's scale.
  const float half = 2.0f;
  std::vector<std::int16_t> positions;
  std::vector<std::int8_t> normals;
  std::vector<std::uint16_t> uvs;
  for (std::size_t v = 0; v < count; ++v) {
    for (int k = 0; k < 3; ++k) {
      positions.push_back(std::int16_t(std::lround(mesh.positions[v][k] / half * 32767.0f)));
      normals.push_back(std::int8_t(std::lround(mesh.normals[v][k] * 127.0f)));
    }
    positions.push_back(0);
    normals.push_back(0);
    for (int k = 0; k < 2; ++k) uvs.push_back(std::uint16_t(std::lround(mesh.uvs[v][k] * 65535)));
  }
  using scene_io::packVertices;
  d.attribute("POSITION", packVertices(positions, count), Component::Short, "VEC3", true);
  d.attribute("NORMAL", packVertices(normals, count), Component::Byte, "VEC3", true);
  d.attribute("TEXCOORD_0", packVertices(uvs, count), Component::UnsignedShort, "VEC2", true);
  d.indices(scene_io::cornersIn(mesh), count);
  d.gltf.useExtension("KHR_mesh_quantization", true);
  d.j["nodes"][0]["scale"] = {half, half, half};
  addMaterial(d, png(), false);
  d.write(path);
}

/// v of OBJ and PLY runs upwards.
void writeObj(const Path& folder, const scene::Mesh& mesh) {
  std::string text = "mtllib scene.mtl\nusemtl painted\n";
  for (const Vec3& p : mesh.positions) text += fmt::format("v {} {} {}\n", p.x(), p.y(), p.z());
  for (const Vec2& t : mesh.uvs) text += fmt::format("vt {} {}\n", t.x(), 1.0 - double(t.y()));
  for (const Vec3& n : mesh.normals) text += fmt::format("vn {} {} {}\n", n.x(), n.y(), n.z());
  for (const scene::Triangle& t : mesh.triangles) {
    text += fmt::format("f {0}/{0}/{0} {1}/{1}/{1} {2}/{2}/{2}\n", t[0] + 1, t[1] + 1, t[2] + 1);
  }
  save(folder / "scene.obj", text);
  save(folder / "scene.mtl", "newmtl painted\nKd 1 1 1\nmap_Kd scene.png\n");
}

void writePly(const Path& path, const scene::Mesh& mesh) {
  std::string text = fmt::format(
      "ply\nformat ascii 1.0\ncomment TextureFile scene.png\nelement vertex {}\n"
      "property float x\nproperty float y\nproperty float z\nproperty float nx\n"
      "property float ny\nproperty float nz\nproperty float s\nproperty float t\n"
      "element face {}\nproperty list uchar int vertex_indices\nend_header\n",
      mesh.positions.size(), mesh.triangles.size());
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const Vec3 &p = mesh.positions[v], &n = mesh.normals[v];
    text += fmt::format("{} {} {} {} {} {} {} {}\n", p.x(), p.y(), p.z(), n.x(), n.y(), n.z(),
                        mesh.uvs[v].x(), 1.0 - double(mesh.uvs[v].y()));
  }
  for (const scene::Triangle& t : mesh.triangles) {
    text += fmt::format("3 {} {} {}\n", t[0], t[1], t[2]);
  }
  save(path, text);
}

void writeAll(const Path& folder) {
  const scene::Mesh mesh = shape();
  save(folder / "scene.png", png());
  {
    GltfDocument d;
    addPlain(d, mesh);
    addMaterial(d, png(), false);
    save(folder / "plain.glb", *d.gltf.glb());
    writeGltf(folder, d);
  }
  {
    GltfDocument d;
    addPlain(d, mesh);
    addMaterial(d, image::makeWebP(kTexels, kTexels, texels()), true);
    save(folder / "webp.glb", *d.gltf.glb());
  }
  for (const auto& [method, name] :
       {std::pair(draco::MESH_SEQUENTIAL_ENCODING, "draco-sequential.glb"),
        std::pair(draco::MESH_EDGEBREAKER_ENCODING, "draco-edgebreaker.glb")}) {
    GltfDocument d;
    scene_io::addDraco(d, scene_io::dracoOf(mesh, method), mesh.positions.size(),
                       mesh.triangles.size());
    addMaterial(d, png(), false);
    save(folder / name, *d.gltf.glb());
  }
  scene_io::MeshoptDocument packed;
  packed.addMesh(mesh);
  addMaterial(packed, png(), false);
  packed.write(folder / "meshopt.gltf");
  writeQuantized(folder / "quantized.gltf", mesh);
  writeObj(folder, mesh);
  writePly(folder / "scene.ply", mesh);
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 2) {
    std::fprintf(stderr, "usage: lambent_write_formats FOLDER\n");
    return 2;
  }
  writeAll(arguments[1]);
  return 0;
}
