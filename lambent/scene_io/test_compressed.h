// glTF compressed by Draco's and meshoptimizer's own encoders, for tests.
#pragma once

#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <meshoptimizer.h>

#include <cstring>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "lambent/scene_io/test_gltf.h"

namespace lambent::scene_io {

/// Positions, normals and UVs as they are, without quantisation.
inline std::vector<char> dracoOf(const scene::Mesh& mesh, int method) {
  draco::TriangleSoupMeshBuilder builder;
  builder.Start(int(mesh.triangles.size()));
  const int position =
      builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
  const int normal = builder.AddAttribute(draco::GeometryAttribute::NORMAL, 3, draco::DT_FLOAT32);
  const int uv = builder.AddAttribute(draco::GeometryAttribute::TEX_COORD, 2, draco::DT_FLOAT32);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto [a, b, c] = mesh.triangles[t];
    const draco::FaceIndex face(static_cast<std::uint32_t>(t));
    builder.SetAttributeValuesForFace(position, face, mesh.positions[a].data(),
                                      mesh.positions[b].data(), mesh.positions[c].data());
    builder.SetAttributeValuesForFace(normal, face, mesh.normals[a].data(), mesh.normals[b].data(),
                                      mesh.normals[c].data());
    builder.SetAttributeValuesForFace(uv, face, mesh.uvs[a].data(), mesh.uvs[b].data(),
                                      mesh.uvs[c].data());
  }
  const std::unique_ptr<draco::Mesh> made = builder.Finalize();
  draco::Encoder encoder;  // without quantisation: floats as they are
  encoder.SetEncodingMethod(method);
  draco::EncoderBuffer buffer;
  if (!encoder.EncodeMeshToBuffer(*made, &buffer).ok()) return {};
  return {buffer.data(), buffer.data() + buffer.size()};
}

/// A document whose primitive is Draco's, with accessors that hold no bytes.
inline void addDraco(GltfDocument& d, const std::vector<char>& stream, std::size_t vertices,
                     std::size_t triangles) {
  const int view = d.gltf.addBufferView(asBytes(stream));
  const auto accessor = [&](int component, const char* type, std::size_t count) {
    d.j["accessors"].push_back({{"componentType", component}, {"type", type}, {"count", count}});
    return d.j["accessors"].size() - 1;
  };
  nlohmann::json& primitive = d.primitive();
  primitive["attributes"] = {{"POSITION", accessor(5126, "VEC3", vertices)},
                             {"NORMAL", accessor(5126, "VEC3", vertices)},
                             {"TEXCOORD_0", accessor(5126, "VEC2", vertices)}};
  primitive["indices"] = accessor(5123, "SCALAR", 3 * triangles);
  primitive["extensions"]["KHR_draco_mesh_compression"] = {
      {"bufferView", view}, {"attributes", {{"POSITION", 0}, {"NORMAL", 1}, {"TEXCOORD_0", 2}}}};
  d.gltf.useExtension("KHR_draco_mesh_compression", true);
}

/// What meshoptimizer made, and the extension's object but for the place in a buffer.
struct Packed {
  std::vector<unsigned char> bytes;
  nlohmann::json object;
};

template <class T>
Packed packVertices(const std::vector<T>& values, std::size_t count) {
  const std::size_t stride = sizeof(T) * values.size() / count;
  Packed packed;
  packed.bytes.resize(meshopt_encodeVertexBufferBound(count, stride));
  packed.bytes.resize(meshopt_encodeVertexBuffer(packed.bytes.data(), packed.bytes.size(),
                                                 values.data(), count, stride));
  packed.object = {{"byteStride", stride}, {"count", count}, {"mode", "ATTRIBUTES"}};
  return packed;
}

inline std::vector<std::uint32_t> cornersIn(const scene::Mesh& mesh) {
  std::vector<std::uint32_t> corners;
  for (const scene::Triangle& t : mesh.triangles) corners.insert(corners.end(), t.begin(), t.end());
  return corners;
}

/// A document whose buffer views are compressed; in the fallback's place there is nothing.
struct MeshoptDocument : GltfDocument {
  std::size_t fallback = 0;  ///< bytes that the views claim there

  /// Returns the buffer view.
  int add(const Packed& packed) {
    const int raw = gltf.addBufferView(asBytes(packed.bytes));
    nlohmann::json& views = j["bufferViews"];
    nlohmann::json object = packed.object;
    object["buffer"] = 0;
    object["byteOffset"] = views[raw]["byteOffset"];
    object["byteLength"] = packed.bytes.size();
    const std::size_t size = std::size_t(object["count"]) * std::size_t(object["byteStride"]);
    views.push_back({{"buffer", 1}, {"byteOffset", fallback}, {"byteLength", size}});
    if (object["mode"] == "ATTRIBUTES") views.back()["byteStride"] = object["byteStride"];
    views.back()["extensions"]["EXT_meshopt_compression"] = std::move(object);
    fallback += size;
    return int(views.size() - 1);
  }
  std::size_t accessor(const Packed& packed, Component component, const char* type,
                       bool normalized = false) {
    const int view = add(packed);
    j["accessors"].push_back({{"bufferView", view},
                              {"componentType", int(component)},
                              {"type", type},
                              {"count", packed.object["count"]},
                              {"normalized", normalized}});
    return j["accessors"].size() - 1;
  }
  void attribute(const char* name, const Packed& packed, Component component, const char* type,
                 bool normalized = false) {
    primitive()["attributes"][name] = accessor(packed, component, type, normalized);
  }
  void indices(const std::vector<std::uint32_t>& values, std::size_t vertices) {
    Packed packed;
    packed.bytes.resize(meshopt_encodeIndexBufferBound(values.size(), vertices));
    packed.bytes.resize(meshopt_encodeIndexBuffer(packed.bytes.data(), packed.bytes.size(),
                                                  values.data(), values.size()));
    packed.object = {{"byteStride", 4}, {"count", values.size()}, {"mode", "TRIANGLES"}};
    primitive()["indices"] = accessor(packed, Component::UnsignedInt, "SCALAR");
  }
  void addMesh(const scene::Mesh& mesh) {
    const std::size_t count = mesh.positions.size();
    attribute("POSITION", packVertices(mesh.positions, count), Component::Float, "VEC3");
    attribute("NORMAL", packVertices(mesh.normals, count), Component::Float, "VEC3");
    attribute("TEXCOORD_0", packVertices(mesh.uvs, count), Component::Float, "VEC2");
    indices(cornersIn(mesh), count);
  }
  /// The builder writes the first buffer, into a data URI here; the second is the fallback.
  std::filesystem::path write(const std::filesystem::path& path) {
    gltf.useExtension("EXT_meshopt_compression", true);
    const std::vector<std::byte> glb = *gltf.glb();
    const char* chunk = reinterpret_cast<const char*>(glb.data()) + 20;
    std::uint32_t size = 0;
    std::memcpy(&size, glb.data() + 12, 4);
    nlohmann::json document = nlohmann::json::parse(chunk, chunk + size);
    std::string uri = "data:application/octet-stream,";
    for (std::size_t at = 20 + size + 8; at < glb.size(); ++at) {
      constexpr char kDigits[] = "0123456789ABCDEF";
      const auto byte = std::to_integer<unsigned>(glb[at]);
      uri += {'%', kDigits[byte >> 4], kDigits[byte & 15]};
    }
    document["buffers"][0]["uri"] = uri;
    document["buffers"].push_back(
        {{"byteLength", fallback},
         {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}});
    std::ofstream(path) << document.dump();
    return path;
  }
};

}  // namespace lambent::scene_io
