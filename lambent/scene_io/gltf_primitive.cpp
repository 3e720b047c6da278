#include "lambent/scene_io/gltf_primitive.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "lambent/scene_io/gltf_component.h"
#include "lambent/scene_io/gltf_json.h"

namespace lambent::scene_io {
namespace {

using nlohmann::json;
using scene::Mesh;

/// Strips and fans as triangles (§3.7.2.1); a number of indices that does not fit is cut.
std::vector<scene::Triangle> triangulate(const std::vector<std::uint32_t>& indices, int mode) {
  std::vector<scene::Triangle> triangles;
  const std::size_t count = indices.size();
  if (mode == 4) {
    triangles.reserve(count / 3);
    for (std::size_t i = 0; i + 2 < count; i += 3) {
      triangles.push_back({indices[i], indices[i + 1], indices[i + 2]});
    }
    return triangles;
  }
  for (std::size_t i = 0; i + 2 < count; ++i) {
    if (mode == 6) {
      triangles.push_back({indices[0], indices[i + 1], indices[i + 2]});
    } else {
      const std::size_t odd = i % 2;
      triangles.push_back({indices[i], indices[i + 1 + odd], indices[i + 2 - odd]});
    }
  }
  return triangles;
}

}  // namespace

Error GltfPrimitive::bad(const std::string& message) const {
  return report::badInput(file_.path().string() + ": " + place_ + message);
}

Result<GltfPrimitive> GltfPrimitive::open(const GltfFile& file, const json& primitive,
                                          const std::string& place) {
  GltfPrimitive result(file, primitive, place);
  const json* draco = find(find(primitive, "extensions"), "KHR_draco_mesh_compression");
  if (draco == nullptr) return result;
  const auto bytes = file.bufferViewBytes(integer(draco, "bufferView").value_or(-1));
  if (!bytes) return bytes.error();
  Result<DracoPrimitive> decoded =
      DracoPrimitive::decode(*bytes, file.path().string() + ": " + place, file.budget());
  if (!decoded) return decoded.error();
  result.draco_ = std::move(*decoded);
  if (const json* ids = find(draco, "attributes"); ids != nullptr && ids->is_object()) {
    for (const auto& [name, id] : ids->items()) {
      result.dracoIds_[name] = asInteger(&id).value_or(-1);
    }
  }
  return result;
}

bool GltfPrimitive::has(const std::string& attribute) const {
  return integer(find(primitive_, "attributes"), attribute).has_value() ||
         dracoIds_.contains(attribute);
}

Result<std::vector<float>> GltfPrimitive::floats(const std::string& attribute, int width) const {
  const std::int64_t accessor = integer(find(primitive_, "attributes"), attribute).value_or(-1);
  const auto id = dracoIds_.find(attribute);
  if (id == dracoIds_.end()) return file_.accessorFloats(accessor, width);
  const json* object = element(file_.json(), "accessors", accessor);
  return draco_->floats(id->second, width, flag(object, "normalized"));
}

Result<std::vector<float>> GltfPrimitive::floats(const std::string& attribute, int width,
                                                 std::size_t count) const {
  Result<std::vector<float>> values = floats(attribute, width);
  if (values && values->size() != std::size_t(width) * count) {
    return bad(": " + attribute + " has not as many elements as POSITION");
  }
  return values;
}

Result<std::vector<scene::Triangle>> GltfPrimitive::triangles(std::size_t vertices) const {
  if (draco_ && draco_->vertices() != vertices) {
    return bad(": POSITION has not as many elements as Draco has vertices; export the file again");
  }
  if (draco_) return draco_->triangles();
  std::vector<std::uint32_t> indices;
  if (const auto accessor = integer(primitive_, "indices")) {
    Result<std::vector<std::uint32_t>> read = file_.accessorIntegers(*accessor, 1);
    if (!read) return read.error();
    indices = std::move(*read);
  } else {
    indices.resize(vertices);
    for (std::size_t i = 0; i < vertices; ++i) indices[i] = std::uint32_t(i);
  }
  for (std::size_t i = 0; i < indices.size(); ++i) {
    if (indices[i] < vertices) continue;
    return bad(": index " + std::to_string(i) + " (triangle " + std::to_string(i / 3) +
               ") refers to vertex " + std::to_string(indices[i]) + " of " +
               std::to_string(vertices) + "; export the file again");
  }
  return triangulate(indices, int(integer(primitive_, "mode").value_or(4)));
}

Status GltfPrimitive::readColors(Mesh& mesh) const {
  if (!has("COLOR_0")) return Status::ok();
  const std::int64_t accessor = integer(find(primitive_, "attributes"), "COLOR_0").value_or(-1);
  const bool hasAlpha = text(element(file_.json(), "accessors", accessor), "type") == "VEC4";
  const int width = hasAlpha ? 4 : 3;
  const std::size_t count = mesh.positions.size();
  const Result<std::vector<float>> colors = floats("COLOR_0", width, count);
  if (!colors) return colors.error();
  mesh.colors.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    mesh.colors[i] = Rgb(Eigen::Map<const Eigen::Array3f>(colors->data() + width * i));
    if (hasAlpha) mesh.alphas.push_back((*colors)[4 * i + 3]);
  }
  return Status::ok();
}

Result<Mesh> GltfPrimitive::mesh(const TextureUse& use) const {
  Mesh mesh;
  if (!has("POSITION")) return mesh;
  const Result<std::vector<float>> positions = floats("POSITION", 3);
  if (!positions) return positions.error();
  const std::size_t count = positions->size() / 3;
  mesh.positions.resize(count);
  for (std::size_t i = 0; i < count; ++i) mesh.positions[i] = Vec3(positions->data() + 3 * i);
  if (has("NORMAL")) {
    const Result<std::vector<float>> normals = floats("NORMAL", 3, count);
    if (!normals) return normals.error();
    mesh.normals.resize(count);
    for (std::size_t i = 0; i < count; ++i) mesh.normals[i] = Vec3(normals->data() + 3 * i);
  }
  const std::string uvName = "TEXCOORD_" + std::to_string(use.texCoord);
  if (has(uvName)) {
    const Result<std::vector<float>> uvs = floats(uvName, 2, count);
    if (!uvs) return uvs.error();
    mesh.uvs.resize(count);
    for (std::size_t i = 0; i < count; ++i) mesh.uvs[i] = use.apply(Vec2(uvs->data() + 2 * i));
    if (!use.moves()) mesh.source.uvSet = use.texCoord;
  }
  if (Status status = readColors(mesh); !status) return status.error();
  Result<std::vector<scene::Triangle>> read = triangles(count);
  if (!read) return read.error();
  mesh.triangles = std::move(*read);
  return mesh;
}

namespace {

/// glTF wants texture coordinates, colours and tangents in these components alone.
bool isPlain(Component component, bool normalized) {
  return component == Component::Float || (normalized && (component == Component::UnsignedByte ||
                                                          component == Component::UnsignedShort));
}

/// A tangent is of unit length and has a hand.
bool makeTangentsWhole(std::vector<float>& values) {
  for (std::size_t i = 0; i + 3 < values.size(); i += 4) {
    Eigen::Map<Vec3> tangent(values.data() + i);
    const float squared = tangent.squaredNorm();
    if (!(squared > 1e-12f)) return false;
    if (std::abs(squared - 1.0f) > 1e-6f) tangent.normalize();
    values[i + 3] = values[i + 3] < 0.0f ? -1.0f : 1.0f;
  }
  return true;
}

/// A file may give a mesh as many as it likes.
constexpr std::size_t kMostOthers = 32;

}  // namespace

Result<std::optional<scene::VertexNumbers>> GltfPrimitive::other(const std::string& name,
                                                                 std::size_t count,
                                                                 std::string& why) const {
  const std::int64_t index = integer(find(primitive_, "attributes"), name).value_or(-1);
  const json* accessor = element(file_.json(), "accessors", index);
  const int width = componentCountOf(text(accessor, "type"));
  const auto component = componentOf(integer(accessor, "componentType"));
  const std::optional<scene::VertexNumbers> none;
  why = "is not of one to four numbers for each vertex";
  if (width < 1 || width > 4 || text(accessor, "type") == "MAT2" || !component ||
      *component == Component::UnsignedInt || integer(accessor, "count") != std::int64_t(count))
    return none;
  if ((name.starts_with("TEXCOORD_") && width != 2) || (name.starts_with("COLOR_") && width < 3) ||
      (name == "TANGENT" && width != 4))
    return none;
  const std::string place = file_.path().string() + ": " + place_ + ": " + name;
  if (Status fits = file_.budget().work(std::uint64_t(width) * count * sizeof(float), place); !fits)
    return fits.error();
  Result<std::vector<float>> values = floats(name, width);
  if (!values || values->size() != std::size_t(width) * count) return none;
  why = "has numbers that are not finite";
  const bool finite =
      std::all_of(values->begin(), values->end(), [](float f) { return std::isfinite(f); });
  if (!finite) return none;
  scene::VertexNumbers numbers{name, width, std::move(*values), int(*component),
                               flag(accessor, "normalized")};
  why = "has no direction somewhere";
  if (numbers.areTangents() && !makeTangentsWhole(numbers.values)) return none;
  if (!name.starts_with('_') && !isPlain(*component, numbers.normalized)) {
    numbers.component = int(Component::Float);
    numbers.normalized = false;
  }
  return std::optional(std::move(numbers));
}

Status GltfPrimitive::readOthers(const TextureUse& use, bool wanted, Mesh& mesh,
                                 Diagnosis& diagnosis) const {
  const json* attributes = find(primitive_, "attributes");
  if (attributes == nullptr || !attributes->is_object()) return Status::ok();
  const std::string uvs = "TEXCOORD_" + std::to_string(use.texCoord);
  for (const auto& [name, ignored] : attributes->items()) {
    const bool isCoordinates = name.starts_with("TEXCOORD_");
    if (name == "POSITION" || name == "NORMAL" || name == "COLOR_0" ||
        name.starts_with("JOINTS_") || name.starts_with("WEIGHTS_") ||
        (name == uvs && !(use.moves() && wanted)))
      continue;
    std::string why = "is not of a kind that glTF knows";
    std::optional<scene::VertexNumbers> numbers;
    if (isCoordinates || name.starts_with("COLOR_") || name == "TANGENT" || name.starts_with('_')) {
      Result<std::optional<scene::VertexNumbers>> read = other(name, mesh.positions.size(), why);
      if (!read) return read.error();
      numbers = std::move(*read);
    }
    if (numbers && mesh.others.size() >= kMostOthers) {
      why = "comes after so many others";
      numbers.reset();
    }
    if (numbers) {
      mesh.others.push_back(std::move(*numbers));
      continue;
    }
    diagnosis.lose(
        Severity::Note, "attributes-lost", 1,
        "attributes of vertices are not kept, and not in what is written: light does not "
        "ask for them, other programs might; export them as glTF has it",
        place_ + ": " + name.substr(0, 100) + " " + why);
  }
  return Status::ok();
}

Result<bool> GltfPrimitive::pose(const GltfSkin& skin, Mesh& mesh) const {
  std::vector<float> joints, weights;
  const std::size_t count = mesh.positions.size();
  for (int set = 0; set < 2 && has("JOINTS_" + std::to_string(set)); ++set) {
    const std::string number = std::to_string(set);
    Result<std::vector<float>> j = floats("JOINTS_" + number, 4, count);
    if (!j) return j.error();
    Result<std::vector<float>> w = floats("WEIGHTS_" + number, 4, count);
    if (!w) return w.error();
    if (set == 0) {
      joints = std::move(*j);
      weights = std::move(*w);
      continue;
    }
    std::vector<float> bothJoints, bothWeights;
    for (std::size_t v = 0; v < 4 * count; v += 4) {
      for (const auto& [from, second, to] :
           {std::tuple(&joints, &*j, &bothJoints), std::tuple(&weights, &*w, &bothWeights)}) {
        to->insert(to->end(), from->begin() + v, from->begin() + v + 4);
        to->insert(to->end(), second->begin() + v, second->begin() + v + 4);
      }
    }
    joints = std::move(bothJoints);
    weights = std::move(bothWeights);
  }
  if (joints.empty()) return false;
  if (!skin.pose(joints, weights, mesh)) {
    return bad(" has a vertex at a joint that its skin does not have; export the file again");
  }
  return true;
}

}  // namespace lambent::scene_io
