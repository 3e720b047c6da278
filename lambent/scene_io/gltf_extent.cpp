#include "lambent/scene_io/gltf_extent.h"

#include <map>

#include "lambent/scene_io/gltf_deform.h"
#include "lambent/scene_io/gltf_json.h"

namespace lambent::scene_io {
namespace {

using Eigen::Matrix4d;
using nlohmann::json;

class Extent {
 public:
  Extent(const GltfFile& file, const std::vector<GltfNode>& nodes, bool stated)
      : file_(file),
        document_(file.json()),
        nodes_(nodes),
        nodeAt_(nodesByIndex(file, nodes)),
        stated_(stated) {}

  Result<DoubleBox> box() {
    for (const GltfNode& node : nodes_) {
      const json& object = *element(document_, "nodes", node.index);
      const json* mesh = element(document_, "meshes", integer(object, "mesh").value_or(-1));
      if (node.hidden || mesh == nullptr) continue;
      const Result<std::vector<Matrix4d>> places = placesOf(node, object);
      if (!places) return places.error();
      const json* primitives = find(*mesh, "primitives");
      for (std::size_t i = 0; i < arraySize(primitives); ++i) {
        const Result<DoubleBox> local = localBox((*primitives)[i]);
        if (!local) return local.error();
        for (const Matrix4d& place : *places) extend(*local, place);
      }
    }
    return whole_;
  }

 private:
  /// What a vertex of the node's mesh may be moved by.
  Result<std::vector<Matrix4d>> placesOf(const GltfNode& node, const json& object) {
    Diagnosis unheard;  // it is said when the mesh is read
    if (find(object, "skin") != nullptr) {
      const Result<std::optional<GltfSkin>> skin =
          GltfSkin::of(file_, integer(object, "skin").value_or(-1), nodeAt_, unheard);
      if (!skin) return skin.error();
      if (!*skin) return std::vector<Matrix4d>{Matrix4d::Identity()};
      return (*skin)->joints();
    }
    Result<std::vector<Matrix4d>> places = instancesOf(file_, object, node.index, unheard);
    if (!places) return places;
    for (Matrix4d& place : *places) place = node.worldFromNode * place;
    return places;
  }

  Result<DoubleBox> localBox(const json& primitive) {
    const std::int64_t accessor = integer(find(primitive, "attributes"), "POSITION").value_or(-1);
    const auto known = boxes_.find(accessor);
    if (known != boxes_.end()) return known->second;
    DoubleBox box;
    const json* object = element(document_, "accessors", accessor);
    const bool packed =
        find(find(primitive, "extensions"), "KHR_draco_mesh_compression") != nullptr;
    const auto lower = numbers(object, "min", 3), upper = numbers(object, "max", 3);
    const bool floats = integer(object, "componentType") == int(Component::Float);
    if (lower && upper && floats && (stated_ || packed)) {
      box.extend(Vec3d((*lower)[0], (*lower)[1], (*lower)[2]));
      box.extend(Vec3d((*upper)[0], (*upper)[1], (*upper)[2]));
    } else if (object != nullptr && !packed) {
      const Result<std::vector<float>> positions = file_.accessorFloats(accessor, 3);
      if (!positions) return positions.error();
      for (std::size_t i = 0; i + 2 < positions->size(); i += 3) {
        box.extend(Vec3(positions->data() + i).cast<double>());
      }
    }
    return boxes_.emplace(accessor, box).first->second;
  }

  void extend(const DoubleBox& local, const Matrix4d& place) {
    if (!(local.lower.x() <= local.upper.x())) return;
    for (int corner = 0; corner < 8; ++corner) {
      Vec3d p;
      for (int axis = 0; axis < 3; ++axis) {
        p[axis] = (corner >> axis & 1 ? local.upper : local.lower)[axis];
      }
      whole_.extend(place.topLeftCorner<3, 3>() * p + place.col(3).head<3>());
    }
  }

  const GltfFile& file_;
  const json& document_;
  const std::vector<GltfNode>& nodes_;
  std::vector<const GltfNode*> nodeAt_;
  bool stated_;
  std::map<std::int64_t, DoubleBox> boxes_;  ///< by accessor
  DoubleBox whole_;
};

}  // namespace

Result<Vec3d> farOriginOf(const GltfFile& file, const std::vector<GltfNode>& nodes) {
  const Result<DoubleBox> stated = Extent(file, nodes, true).box();
  if (!stated) return stated.error();
  if (farOrigin(*stated).isZero(0.0)) return Vec3d(Vec3d::Zero());
  const Result<DoubleBox> measured = Extent(file, nodes, false).box();
  if (!measured) return measured.error();
  return farOrigin(*measured);
}

}  // namespace lambent::scene_io
