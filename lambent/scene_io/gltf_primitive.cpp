#include "lambent/scene_io/gltf_primitive.h"

#include <tuple>

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
  }
  if (Status status = readColors(mesh); !status) return status.error();
  Result<std::vector<scene::Triangle>> read = triangles(count);
  if (!read) return read.error();
  mesh.triangles = std::move(*read);
  return mesh;
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
