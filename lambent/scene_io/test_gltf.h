// glTF documents put together by hand, for the tests of this room.
#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "lambent/scene/shapes.h"
#include "lambent/scene_io/gltf_write.h"
#include "lambent/scene_io/test_files.h"

namespace lambent::scene_io {

template <class T>
inline std::span<const std::byte> asBytes(const std::vector<T>& values) {
  return std::as_bytes(std::span<const T>(values));
}

/// A glTF document put together by hand: one mesh at node 0 unless a test says otherwise.
struct GltfDocument {
  GltfBuilder gltf{scene::Scene()};
  nlohmann::json& j = gltf.json();

  GltfDocument() {
    j["scenes"] = nlohmann::json::parse(R"([{"nodes": [0]}])");
    j["nodes"] = nlohmann::json::parse(R"([{"mesh": 0}])");
    j["meshes"] = nlohmann::json::parse(R"([{"primitives": [{"attributes": {}}]}])");
  }
  nlohmann::json& primitive() { return j["meshes"][0]["primitives"][0]; }
  template <class T>
  void attribute(const char* name, const std::vector<T>& values, Component component,
                 const char* type, std::size_t count, bool normalized = false) {
    primitive()["attributes"][name] =
        gltf.addAccessor(asBytes(values), component, type, count, normalized);
  }
  void positions(const std::vector<Vec3>& values) {
    attribute("POSITION", values, Component::Float, "VEC3", values.size());
  }
  void indices(const std::vector<std::uint16_t>& values) {
    primitive()["indices"] =
        gltf.addAccessor(asBytes(values), Component::UnsignedShort, "SCALAR", values.size());
  }
  std::filesystem::path write(const TemporaryFolder& folder) const {
    return folder.write("file.glb", *gltf.glb());
  }
};

inline const std::vector<Vec3> kTriangle = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};

}  // namespace lambent::scene_io
