#include "lambent/scene_io/gltf_write.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstring>
#include <nlohmann/json.hpp>

#include "lambent/file/atomic_file.h"
#include "lambent/file/json.h"
#include "lambent/image/decode.h"
#include "lambent/scene_io/gltf_component.h"
#include "lambent/scene_io/gltf_material.h"
#include "lambent/scene_io/gltf_origin.h"
#include "lambent/scene_io/gltf_write_source.h"
#include "lambent/scene_io/vertex_bytes.h"

namespace lambent::scene_io {
namespace {

using Json = nlohmann::json;

constexpr int kArrayBuffer = 34962, kElementArrayBuffer = 34963;

template <class T>
std::span<const std::byte> asBytes(const std::vector<T>& values) {
  return std::as_bytes(std::span<const T>(values));
}

int wrapCode(scene::Wrap wrap) {
  switch (wrap) {
    case scene::Wrap::ClampToEdge:
      return 33071;
    case scene::Wrap::MirroredRepeat:
      return 33648;
    case scene::Wrap::Repeat:
      break;
  }
  return 10497;
}

/// Appends to an array member and returns the new element's index.
int append(Json& document, const char* key, Json value) {
  Json& array = file::arrayAt(document, key);
  array.push_back(std::move(value));
  return int(array.size() - 1);
}

std::vector<std::array<float, 4>> withAlphas(const scene::Mesh& mesh) {
  std::vector<std::array<float, 4>> colors(mesh.alphas.size(), {1.0f, 1.0f, 1.0f, 1.0f});
  for (std::size_t v = 0; v < colors.size(); ++v) {
    for (int c = 0; c < 3 && !mesh.colors.empty(); ++c)
      colors[v][std::size_t(c)] = mesh.colors[v][c];
    colors[v][3] = mesh.alphas[v];
  }
  return colors;
}

void setName(Json& object, const std::string& name) {
  if (!name.empty()) object["name"] = name;
}

}  // namespace

struct GltfBuilder::Impl {
  Json document = Json::object();
  std::vector<std::byte> binary;

  Json materialJson(const scene::Material& material);
  void use(const char* key, std::string_view extension);
  Json camera(const scene::Camera& camera, float diagonal);
};

Json GltfBuilder::Impl::materialJson(const scene::Material& material) {
  const MetallicRoughness pbr = metallicRoughnessOf(material);
  const bool opaque = material.alphaMode == scene::AlphaMode::Opaque;
  const double opacity = opaque ? 1.0 : double(material.opacity);
  Json metallicRoughness = {
      {"baseColorFactor", {pbr.baseColor.x(), pbr.baseColor.y(), pbr.baseColor.z(), opacity}},
      {"metallicFactor", pbr.metallic},
      {"roughnessFactor", pbr.roughness}};
  if (material.baseColorTexture >= 0) {
    metallicRoughness["baseColorTexture"] = {{"index", material.baseColorTexture}};
  }
  Json object = {{"pbrMetallicRoughness", std::move(metallicRoughness)},
                 {"extras", extrasOf(material)}};
  if (material.doubleSided) object["doubleSided"] = true;
  if (!opaque) {
    const bool mask = material.alphaMode == scene::AlphaMode::Mask;
    object["alphaMode"] = mask ? "MASK" : "BLEND";
    if (mask) object["alphaCutoff"] = material.alphaCutoff;
  }
  if (const double share = transmissionOf(material); share > 0.0) {
    file::objectAt(object,
                   "extensions")["KHR_materials_transmission"] = {{"transmissionFactor", share}};
    use("extensionsUsed", "KHR_materials_transmission");
  }
  if (material.isEmitter()) {
    // A factor is at most 1; what is brighter goes into the strength.
    const float strength = std::max(material.emission.maxCoeff(), 1.0f);
    const Rgb factor = material.emission / strength;
    object["emissiveFactor"] = {factor.x(), factor.y(), factor.z()};
    if (strength > 1.0f) {
      file::objectAt(object, "extensions")["KHR_materials_emissive_strength"] = {
          {"emissiveStrength", strength}};
      use("extensionsUsed", "KHR_materials_emissive_strength");
    }
  }
  setName(object, material.name);
  return object;
}

void GltfBuilder::Impl::use(const char* key, std::string_view extension) {
  Json& list = file::arrayAt(document, key);
  if (std::find(list.begin(), list.end(), extension) == list.end()) list.push_back(extension);
}

Json GltfBuilder::Impl::camera(const scene::Camera& camera, float diagonal) {
  const float zNear = std::max(1e-3f * diagonal, 1e-6f), zFar = 10.0f * std::max(diagonal, 1e-3f);
  Json object = Json::object();
  if (camera.orthographicHalfHeight) {
    const float half = *camera.orthographicHalfHeight;
    object = {{"type", "orthographic"},
              {"orthographic", {{"xmag", half}, {"ymag", half}, {"znear", zNear}, {"zfar", zFar}}}};
  } else {
    object = {{"type", "perspective"},
              {"perspective", {{"yfov", camera.verticalFov}, {"znear", zNear}}}};
  }
  setName(object, camera.name);
  return object;
}

GltfBuilder::GltfBuilder(const scene::Scene& scene) : impl_(std::make_unique<Impl>()) {
  Json& document = impl_->document;
  document["asset"] = {{"version", "2.0"}, {"generator", "Lambent"}};
  document["scene"] = 0;
  document["scenes"] = Json::array({Json::object()});
  if (!scene.origin.isZero(0.0)) {
    document["scenes"][0]["extras"] = originExtras(scene.origin);
  }

  std::optional<SourceWriter> source;
  if (scene.source) {
    source.emplace(scene, document, [this](const std::vector<std::uint8_t>& picture) {
      return addBufferView(asBytes(picture));
    });
    source->writeHead();
  }

  for (const scene::Texture& texture : scene.textures) {
    std::vector<std::byte> png;
    const bool carried = !texture.encoded.empty() &&
                         (texture.mimeType == "image/png" || texture.mimeType == "image/jpeg");
    if (!carried) png = image::encodePng(texture.width, texture.height, 4, texture.rgba);
    Json image = {{"bufferView", addBufferView(carried ? asBytes(texture.encoded) : png)},
                  {"mimeType", carried ? texture.mimeType : "image/png"}};
    setName(image, texture.name);
    const bool known = source && texture.source >= 0;
    Json object = {{"source", document.contains("images") ? document["images"].size() : 0}};
    if (known) {
      source->dressTexture(texture, image, object);
    } else {
      object["sampler"] = append(document, "samplers",
                                 {{"magFilter", 9729},
                                  {"minFilter", 9987},
                                  {"wrapS", wrapCode(texture.wrapU)},
                                  {"wrapT", wrapCode(texture.wrapV)}});
    }
    const int place = append(document, "images", std::move(image));
    append(document, "textures", std::move(object));
    if (known) source->note(texture, place);
  }
  for (const scene::Material& material : scene.materials) {
    Json object = impl_->materialJson(material);
    if (source) object = source->material(material, object);
    append(document, "materials", std::move(object));
  }

  for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
    const scene::Mesh& mesh = scene.meshes[i];
    assert(!mesh.positions.empty() && !mesh.triangles.empty());
    const std::size_t count = mesh.positions.size();
    Json attributes = Json::object();
    const int positions =
        addAccessor(asBytes(mesh.positions), Component::Float, "VEC3", count, false, kArrayBuffer);
    const scene::Box box = scene::bounds(mesh);
    Json& accessor = document["accessors"][positions];
    accessor["min"] = {box.lower.x(), box.lower.y(), box.lower.z()};
    accessor["max"] = {box.upper.x(), box.upper.y(), box.upper.z()};
    attributes["POSITION"] = positions;
    const auto attribute = [&](const char* name, std::span<const std::byte> bytes,
                               std::string_view type) {
      if (bytes.empty()) return;
      attributes[name] = addAccessor(bytes, Component::Float, type, count, false, kArrayBuffer);
    };
    attribute("NORMAL", asBytes(mesh.normals), "VEC3");
    attribute("TEXCOORD_0", asBytes(mesh.uvs), "VEC2");
    attribute("TEXCOORD_1", asBytes(mesh.texelUvs), "VEC2");
    if (mesh.alphas.empty())
      attribute("COLOR_0", asBytes(mesh.colors), "VEC3");
    else
      attribute("COLOR_0", asBytes(withAlphas(mesh)), "VEC4");
    if (source) addOthers(mesh, source->uvSlotsOf(mesh), attributes);

    int indices = 0;
    const std::size_t indexCount = 3 * mesh.triangles.size();
    if (count < 65535) {  // 65535 itself means "restart" to some devices
      std::vector<std::uint16_t> small;
      small.reserve(indexCount);
      for (const scene::Triangle& t : mesh.triangles) {
        for (std::uint32_t v : t) small.push_back(std::uint16_t(v));
      }
      indices = addAccessor(asBytes(small), Component::UnsignedShort, "SCALAR", indexCount, false,
                            kElementArrayBuffer);
    } else {
      indices = addAccessor(asBytes(mesh.triangles), Component::UnsignedInt, "SCALAR", indexCount,
                            false, kElementArrayBuffer);
    }
    Json primitive = {{"attributes", std::move(attributes)}, {"indices", indices}, {"mode", 4}};
    if (mesh.material >= 0 && std::size_t(mesh.material) < scene.materials.size()) {
      primitive["material"] = mesh.material;
    }
    Json meshJson = {{"primitives", Json::array({std::move(primitive)})}};
    setName(meshJson, mesh.name);
    if (source) source->dressMesh(mesh, meshJson);
    append(document, "meshes", std::move(meshJson));
  }
  const bool treed = source && source->writeNodes();
  for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
    if (treed && scene.meshes[i].source.node >= 0) continue;
    Json node = {{"mesh", i}};
    setName(node, scene.meshes[i].name);
    file::arrayAt(document["scenes"][0], "nodes")
        .push_back(append(document, "nodes", std::move(node)));
  }

  const float diagonal = scene.cameras.empty() ? 0.0f : bounds(scene).diagonal();
  for (const scene::Camera& camera : scene.cameras) {
    if (treed && camera.source >= 0) continue;
    Json node = {{"camera", append(document, "cameras", impl_->camera(camera, diagonal))}};
    Json matrix = Json::array();
    for (int column = 0; column < 4; ++column) {
      for (int row = 0; row < 4; ++row) matrix.push_back(camera.worldFromCamera(row, column));
    }
    if (!camera.worldFromCamera.isIdentity(0.0f)) node["matrix"] = std::move(matrix);
    setName(node, camera.name);
    file::arrayAt(document["scenes"][0], "nodes")
        .push_back(append(document, "nodes", std::move(node)));
  }
  if (source) source->declareExtensions();
}

void GltfBuilder::addOthers(const scene::Mesh& mesh, const std::vector<UvSlot>& sets,
                            Json& attributes) {
  const auto add = [&](const std::string& name, const scene::VertexNumbers& numbers) {
    const VertexBytes packed = vertexBytes(numbers);
    const int view = addBufferView(packed.bytes, kArrayBuffer);
    if (packed.stride != packed.elementSize)
      impl_->document["bufferViews"][view]["byteStride"] = packed.stride;
    Json accessor = {{"bufferView", view},
                     {"componentType", numbers.component},
                     {"type", packed.type},
                     {"count", mesh.positions.size()}};
    if (numbers.normalized) accessor["normalized"] = true;
    attributes[name] = append(impl_->document, "accessors", std::move(accessor));
  };
  for (const UvSlot& slot : sets) {
    const std::string name = "TEXCOORD_" + std::to_string(slot.slot);
    if (slot.numbers != nullptr)
      add(name, *slot.numbers);
    else
      attributes[name] = addAccessor(asBytes(*slot.uvs), Component::Float, "VEC2",
                                     mesh.positions.size(), false, kArrayBuffer);
  }
  int color = 1;
  for (const scene::VertexNumbers& numbers : mesh.others) {
    std::string name = numbers.name;
    if (name.starts_with("TEXCOORD_")) continue;
    // Colours are numbered without a gap.
    if (name.starts_with("COLOR_"))
      name = attributes.contains("COLOR_0") ? "COLOR_" + std::to_string(color++) : "_" + name;
    add(name, numbers);
  }
}

GltfBuilder::GltfBuilder(GltfBuilder&&) noexcept = default;
GltfBuilder& GltfBuilder::operator=(GltfBuilder&&) noexcept = default;
GltfBuilder::~GltfBuilder() = default;

nlohmann::json& GltfBuilder::json() {
  return impl_->document;
}

int GltfBuilder::addBufferView(std::span<const std::byte> bytes, std::optional<int> target) {
  assert(!bytes.empty());
  std::vector<std::byte>& binary = impl_->binary;
  binary.resize((binary.size() + 3) / 4 * 4);
  Json view = {{"buffer", 0}, {"byteOffset", binary.size()}, {"byteLength", bytes.size()}};
  if (target) view["target"] = *target;
  binary.insert(binary.end(), bytes.begin(), bytes.end());
  return append(impl_->document, "bufferViews", std::move(view));
}

int GltfBuilder::addAccessor(std::span<const std::byte> bytes, Component component,
                             std::string_view type, std::size_t count, bool normalized,
                             std::optional<int> target) {
  assert(bytes.size() == count * componentSize(component) * std::size_t(componentCountOf(type)));
  Json accessor = {{"bufferView", addBufferView(bytes, target)},
                   {"componentType", int(component)},
                   {"type", type},
                   {"count", count}};
  if (normalized) accessor["normalized"] = true;
  return append(impl_->document, "accessors", std::move(accessor));
}

void GltfBuilder::useExtension(std::string_view name, bool required) {
  impl_->use("extensionsUsed", name);
  if (required) impl_->use("extensionsRequired", name);
}

Result<std::vector<std::byte>> GltfBuilder::glb() const {
  Json document = impl_->document;
  const std::vector<std::byte>& binary = impl_->binary;
  if (!binary.empty()) {
    document["buffers"] = Json::array({{{"byteLength", binary.size()}}});
  }
  // Names come from files and need not be UTF-8: what is not is replaced.
  std::string header = document.dump(-1, ' ', false, Json::error_handler_t::replace);
  header.resize((header.size() + 3) / 4 * 4, ' ');
  const std::size_t padded = (binary.size() + 3) / 4 * 4;
  const std::uint64_t total =
      12 + 8 + header.size() + (binary.empty() ? 0 : 8 + std::uint64_t(padded));
  if (total > 0xffffffffu) {
    return report::failed("the .glb would be " + std::to_string(total >> 20) +
                          " MiB, and the format ends at 4 GiB; use fewer bands or 16-bit numbers");
  }
  std::vector<std::byte> file;
  file.reserve(total);
  const auto word = [&](std::uint64_t value) {
    for (int i = 0; i < 4; ++i) file.push_back(std::byte(value >> (8 * i) & 0xff));
  };
  const auto raw = [&](const void* data, std::size_t size) {
    const auto* first = static_cast<const std::byte*>(data);
    file.insert(file.end(), first, first + size);
  };
  word(0x46546c67), word(2), word(total);
  word(header.size()), word(0x4e4f534a);
  raw(header.data(), header.size());
  if (!binary.empty()) {
    word(padded), word(0x004e4942);
    raw(binary.data(), binary.size());
    file.resize(total);
  }
  return file;
}

Status saveGlb(const scene::Scene& scene, const std::filesystem::path& path) {
  Result<std::vector<std::byte>> bytes = GltfBuilder(scene).glb();
  if (!bytes) return bytes.error();
  return file::writeAtomically(path, *bytes);
}

}  // namespace lambent::scene_io
