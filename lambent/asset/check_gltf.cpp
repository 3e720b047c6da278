#include "lambent/asset/check_gltf.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "lambent/asset/format.h"
#include "lambent/scene_io/gltf_json.h"

namespace lambent::asset {

namespace {

using nlohmann::json;
using scene_io::arraySize;
using scene_io::asInteger;
using scene_io::Component;
using scene_io::element;
using scene_io::find;
using scene_io::integer;

static_assert(std::endian::native == std::endian::little);

const std::string kInstancing = "EXT_mesh_gpu_instancing", kDraco = "KHR_draco_mesh_compression";

std::string text(std::int64_t value) {
  return std::to_string(value);
}

/// The member of a node's transform that is not the identity's, or null. One that is spelled out
/// moves nothing.
const char* moverOf(const json& node) {
  static const json kIdentity = {{"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}},
                                 {"translation", {0, 0, 0}},
                                 {"rotation", {0, 0, 0, 1}},
                                 {"scale", {1, 1, 1}}};
  for (const char* key : {"matrix", "translation", "rotation", "scale"})
    if (const json* value = find(node, key); value != nullptr && *value != kIdentity[key])
      return key;
  return nullptr;
}

class GltfChecker {
 public:
  explicit GltfChecker(const scene_io::GltfFile& file) : file_(file), document_(file.json()) {}

  Status check();

 private:
  struct Visit {
    std::int64_t node = 0;
    std::string mover;  ///< what moves it, on the way down from the scene: "nodes[3].scale"
  };

  Error bad(const std::string& place, const std::string& what) const {
    return report::badInput(file_.path().string() + ": " + place + ": " + what);
  }
  /// An error of the file's own, which names the file, as one that names the place too.
  Error bad(const std::string& place, const Error& error) const {
    std::string message = error.message;
    if (const std::string path = file_.path().string() + ": "; message.starts_with(path))
      message.erase(0, path.size());
    return bad(place, message);
  }
  Status checkOffsets() const;
  Status visit(const json* nodes, const std::string& place, const std::string& mover);
  Status checkNode(const Visit& here);
  Status checkMesh(const json& mesh, const std::string& place);
  Status checkPrimitive(const json& primitive, const std::string& place);
  Status checkAttribute(const json& attributes, const std::string& name, const std::string& place,
                        std::optional<std::size_t>& vertices);

  Status checkIndices(const json& primitive, const std::string& place, std::size_t vertices);

  const scene_io::GltfFile& file_;
  const json& document_;
  std::vector<Visit> pending_;
  std::vector<bool> visited_, shown_;  ///< by node, by mesh
  bool anything_ = false;              ///< whether the scene shows a triangle
};

const json* transferOf(const json& primitive) {
  return find(find(primitive, "extensions"), kExtensionName);
}

bool carriesTransfer(const json& mesh) {
  const json* primitives = find(mesh, "primitives");
  return arraySize(primitives) > 0 &&
         std::any_of(primitives->begin(), primitives->end(),
                     [](const json& primitive) { return transferOf(primitive) != nullptr; });
}

/// An offset that is no number would otherwise be read as none.
Status GltfChecker::checkOffsets() const {
  for (const char* list : {"bufferViews", "accessors"}) {
    const json* entries = find(document_, list);
    for (std::size_t i = 0; i < arraySize(entries); ++i)
      for (const char* key : {"byteOffset", "byteStride"})
        if (const json* value = find((*entries)[i], key);
            value && asInteger(value).value_or(-1) < 0)
          return bad(std::string(list) + "[" + std::to_string(i) + "]." + key,
                     "is not an integer of 0 or more");
  }
  return Status::ok();
}

Status GltfChecker::check() {
  if (Status s = checkOffsets(); !s) return s;
  const std::size_t scenes = arraySize(find(document_, "scenes"));
  if (scenes == 0) return bad("scenes", "is missing: transfer belongs to a place in a scene");
  const json* chosen = find(document_, "scene");
  const std::int64_t index = chosen == nullptr ? 0 : asInteger(chosen).value_or(-1);
  const json* scene = element(document_, "scenes", index);
  if (scene == nullptr)
    return bad("scene", "is " + chosen->dump().substr(0, 100) + ", but the file has " +
                            std::to_string(scenes));
  visited_.resize(arraySize(find(document_, "nodes")));
  shown_.resize(arraySize(find(document_, "meshes")));
  const std::string place = "scenes[" + text(index) + "]";
  if (Status s = visit(find(scene, "nodes"), place + ".nodes", ""); !s) return s;
  while (!pending_.empty()) {
    const Visit here = std::move(pending_.back());
    pending_.pop_back();
    if (Status s = checkNode(here); !s) return s;
  }
  if (!anything_) return bad(place, "shows no triangles");
  return Status::ok();
}

Status GltfChecker::visit(const json* nodes, const std::string& place, const std::string& mover) {
  for (std::size_t i = arraySize(nodes); i-- > 0;) {
    const std::int64_t node = asInteger(&(*nodes)[i]).value_or(-1);
    if (node < 0 || std::size_t(node) >= visited_.size())
      return bad(place, (*nodes)[i].dump().substr(0, 100) + " is no node: the file has " +
                            std::to_string(visited_.size()));
    if (visited_[std::size_t(node)])
      return bad(place, "node " + text(node) +
                            " is reached twice: nodes form a cycle or share a child; export the "
                            "file again");
    visited_[std::size_t(node)] = true;
    pending_.push_back({node, mover});
  }
  return Status::ok();
}

Status GltfChecker::checkNode(const Visit& here) {
  const json& node = (*find(document_, "nodes"))[std::size_t(here.node)];
  const std::string place = "nodes[" + text(here.node) + "]";
  if (!node.is_object()) return bad(place, "is not an object");
  const char* own = moverOf(node);
  const std::string mover = own ? place + "." + own : here.mover;
  if (const json* shows = find(node, "mesh")) {
    const std::int64_t index = asInteger(shows).value_or(-1);
    const json* mesh = element(document_, "meshes", index);
    if (mesh == nullptr)
      return bad(place + ".mesh", shows->dump().substr(0, 100) + " is no mesh: the file has " +
                                      std::to_string(shown_.size()));
    const bool again = shown_[std::size_t(index)];
    if (carriesTransfer(*mesh)) {
      if (!mover.empty())
        return bad(mover,
                   "moves a mesh away from where its transfer was baked: bake the scene as "
                   "it stands now");
      if (find(node, "skin") != nullptr)
        return bad(place + ".skin",
                   "deforms a mesh with baked transfer: remove it, or bake the "
                   "deformed mesh");
      if (find(find(node, "extensions"), kInstancing) != nullptr)
        return bad(place + ".extensions." + kInstancing,
                   "shows a mesh with baked transfer in places where it was not baked: bake the "
                   "scene as it stands now");
      if (again)
        return bad(place + ".mesh", "shows a mesh with baked transfer that another node shows");
    }
    shown_[std::size_t(index)] = true;
    if (!again)
      if (Status s = checkMesh(*mesh, "meshes[" + text(index) + "]"); !s) return s;
  }
  return visit(find(node, "children"), place + ".children", mover);
}

Status GltfChecker::checkMesh(const json& mesh, const std::string& place) {
  const json* primitives = find(mesh, "primitives");
  for (std::size_t i = 0; i < arraySize(primitives); ++i)
    if (Status s =
            checkPrimitive((*primitives)[i], place + ".primitives[" + std::to_string(i) + "]");
        !s)
      return s;
  return Status::ok();
}

Status GltfChecker::checkPrimitive(const json& primitive, const std::string& place) {
  if (!primitive.is_object()) return bad(place, "is not an object");
  const json* transfer = transferOf(primitive);
  const std::int64_t mode = integer(primitive, "mode").value_or(4);
  const json* attributes = find(primitive, "attributes");
  if (attributes != nullptr && !attributes->is_object())
    return bad(place + ".attributes", "is not an object");
  if (transfer != nullptr) {
    if (const json* given = find(primitive, "mode"); given != nullptr && asInteger(given) != 4)
      return bad(place + ".mode", "is not triangles (4), which is all that transfer is baked for");
    if (find(primitive, "targets") != nullptr)
      return bad(place + ".targets",
                 "morph targets deform a mesh with baked transfer: remove "
                 "them, or bake the deformed mesh");
    if (find(find(primitive, "extensions"), kDraco) != nullptr)
      return bad(place + ".extensions." + kDraco,
                 "brings vertices into another sequence than their baked transfer has: leave "
                 "the mesh uncompressed");
    for (const char* name : {"POSITION", "NORMAL"})
      if (find(attributes, name) == nullptr)
        return bad(place + ".attributes." + name, "is missing, and transfer stands on it");
    for (const char* needs : {"grid", "biScale"}) {
      const json* looksUp = find(transfer, needs);
      if (looksUp == nullptr) continue;
      const std::string uvs = integer(looksUp, "texCoord") == 1 ? "TEXCOORD_1" : "TEXCOORD_0";
      if (find(attributes, uvs) == nullptr)
        return bad(place + ".attributes." + uvs,
                   std::string("is missing, and ") + needs + " is looked up with it");
    }
  } else if (mode < 4 || mode > 6 || find(attributes, "POSITION") == nullptr) {
    return Status::ok();  // nothing to see
  }
  anything_ = true;
  if (find(find(primitive, "extensions"), kDraco) != nullptr)
    return Status::ok();  // scene_io decodes and checks it
  std::optional<std::size_t> vertices;
  // A second set of texture coordinates is none of this reader's unless a grid lies on it.
  const bool second = integer(find(transfer, "grid"), "texCoord") == 1;
  for (const char* name : {"POSITION", "NORMAL", "TEXCOORD_0", "TEXCOORD_1", "COLOR_0"})
    if (second || std::string_view(name) != "TEXCOORD_1")
      if (Status s = checkAttribute(*attributes, name, place + ".attributes." + name, vertices); !s)
        return s;
  return checkIndices(primitive, place + ".indices", *vertices);
}

Status GltfChecker::checkIndices(const json& primitive, const std::string& place,
                                 std::size_t vertices) {
  const json* given = find(primitive, "indices");
  if (given == nullptr) return Status::ok();
  const Result<scene_io::AccessorView> view = file_.accessorView(asInteger(given).value_or(-1));
  if (!view) return bad(place, view.error());
  if (view->componentCount != 1 ||
      (view->component != Component::UnsignedByte && view->component != Component::UnsignedShort &&
       view->component != Component::UnsignedInt))
    return bad(place, "is no accessor of unsigned numbers");
  const std::size_t size = view->elementSize();
  for (std::size_t i = 0; i < view->count; ++i) {
    std::uint32_t index = 0;
    std::memcpy(&index, view->bytes.data() + i * view->stride, size);
    if (index >= vertices)
      return bad(place,
                 std::to_string(index) + " is no vertex: there are " + std::to_string(vertices));
  }
  return Status::ok();
}

/// `vertices` is set by POSITION, which comes first.
Status GltfChecker::checkAttribute(const json& attributes, const std::string& name,
                                   const std::string& place, std::optional<std::size_t>& vertices) {
  const json* given = find(attributes, name);
  if (given == nullptr) return Status::ok();
  const std::int64_t accessor = asInteger(given).value_or(-1);
  const bool four = scene_io::text(element(document_, "accessors", accessor), "type") == "VEC4";
  const int width = name.starts_with("TEXCOORD_") ? 2 : name == "COLOR_0" && four ? 4 : 3;
  const json* view = find(element(document_, "accessors", accessor), "bufferView");
  if (view != nullptr && !asInteger(view))
    return bad(place, "accessor " + text(accessor) + " is of a bufferView that does not exist");
  const Result<std::vector<float>> numbers = file_.accessorFloats(accessor, width);
  if (!numbers) return bad(place, numbers.error());
  const std::size_t count = numbers->size() / std::size_t(width);
  if (count == 0) return bad(place, "has no elements");
  if (vertices && *vertices != count)
    return bad(place, "has " + std::to_string(count) + " elements for " +
                          std::to_string(*vertices) + " vertices");
  vertices = count;
  for (std::size_t i = 0; i < count; ++i) {
    const float* element = numbers->data() + i * std::size_t(width);
    if (!std::all_of(element, element + width, [](float f) { return std::isfinite(f); }))
      return bad(place, "not a finite number at vertex " + std::to_string(i));
  }
  return Status::ok();
}

}  // namespace

Status checkGltf(const scene_io::GltfFile& file) {
  return GltfChecker(file).check();
}

}  // namespace lambent::asset
