// The tree of a source's nodes, around the meshes and cameras of a scene in world space.
#include <array>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "lambent/file/json.h"
#include "lambent/scene_io/gltf_json.h"
#include "lambent/scene_io/gltf_write_source.h"

namespace lambent::scene_io {
namespace {

using Eigen::Matrix4d;
using nlohmann::json;

const std::string kLamps = "KHR_lights_punctual";

/// glTF wants translation, rotation and scale of a matrix: what is sheared is straightened, as
/// cameras and lamps are seen to be.
Matrix4d straightened(const Matrix4d& world) {
  Matrix4d straight = world;
  const Eigen::Matrix3d axes = world.topLeftCorner<3, 3>();
  const Eigen::Vector3d lengths = axes.colwise().norm();
  Eigen::Matrix3d unit = axes;
  for (int k = 0; k < 3; ++k) unit.col(k) /= std::max(lengths[k], 1e-30);
  const double skew = (unit.transpose() * unit - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  if (!(lengths.minCoeff() > 1e-30) || !unit.allFinite()) {
    straight.topLeftCorner<3, 3>().setIdentity();
  } else if (skew > 1e-6) {
    const Eigen::Vector3d back = unit.col(2), right = unit.col(1).cross(back).normalized();
    straight.topLeftCorner<3, 3>() << right, back.cross(right), back;
  }
  return straight;
}

void setMatrix(json& node, const Matrix4d& world) {
  const Matrix4d matrix = straightened(world);
  if (matrix.isIdentity(0.0)) return;
  json numbers = json::array();
  for (int column = 0; column < 4; ++column)
    for (int row = 0; row < 4; ++row) numbers.push_back(matrix(row, column));
  node["matrix"] = std::move(numbers);
}

constexpr std::array kTransforms = {"matrix", "translation", "rotation", "scale"};

}  // namespace

/// Meshes below the tree come first, in the sequence of its nodes; cameras likewise.
bool SourceWriter::hasSequence(const std::vector<std::vector<int>>& meshesAt) const {
  int next = 0;
  for (const std::vector<int>& meshes : meshesAt)
    for (const int mesh : meshes)
      if (mesh != next++) return false;
  int last = -1;
  bool loose = false;
  for (const scene::Camera& camera : scene_.cameras) {
    if (camera.source >= 0 && (loose || camera.source <= last)) return false;
    loose |= camera.source < 0;
    last = std::max(last, camera.source);
  }
  return true;
}

int SourceWriter::cameraOf(int sourceCamera) {
  const json* before = fromList("cameras", sourceCamera);
  if (before == nullptr) return -1;
  const auto [known, isNew] = cameras_.try_emplace(sourceCamera, -1);
  if (isNew) {
    json& list = file::arrayAt(document_, "cameras");
    known->second = int(list.size());
    list.push_back(*before);
  }
  return known->second;
}

bool SourceWriter::writeNodes() {
  const std::size_t count = source_.nodes.size();
  std::vector<std::vector<int>> meshesAt(count);
  for (std::size_t m = 0; m < scene_.meshes.size(); ++m)
    if (const int at = scene_.meshes[m].source.node; at >= 0 && std::size_t(at) < count)
      meshesAt[std::size_t(at)].push_back(int(m));
  if (!hasSequence(meshesAt)) return false;

  std::vector<bool> holdsMesh(count);
  for (std::size_t i = count; i-- > 0;) {
    if (!meshesAt[i].empty()) holdsMesh[i] = true;
    if (const int parent = source_.nodes[i].parent; holdsMesh[i] && parent >= 0)
      holdsMesh[std::size_t(parent)] = true;
  }
  std::vector<std::size_t> written(count);
  json& nodes = file::arrayAt(document_, "nodes");
  const auto append = [&](json node, int parent) {
    const std::size_t index = nodes.size();
    nodes.push_back(std::move(node));
    json& above = parent < 0 ? document_["scenes"][0] : nodes[written[std::size_t(parent)]];
    file::arrayAt(above, parent < 0 ? "nodes" : "children").push_back(index);
    return index;
  };
  for (std::size_t i = 0; i < count; ++i) {
    const scene::SourceNode& from = source_.nodes[i];
    const json* before = fromList("nodes", from.number);
    json node = before != nullptr ? *before : json::object();
    for (const char* key : {"children", "mesh", "skin", "weights", "camera"}) node.erase(key);
    const bool follows = from.parent >= 0 && !holdsMesh[std::size_t(from.parent)];
    if (holdsMesh[i] || !follows)
      for (const char* key : kTransforms) node.erase(key);
    if (!holdsMesh[i] && !follows) setMatrix(node, from.worldFromNode);

    // What stands somewhere, at a node that does no longer.
    json standing = json::object();
    if (const int camera = cameraOf(int(integer(before, "camera").value_or(-1))); camera >= 0)
      standing["camera"] = camera;
    if (const json* lamp = find(find(node, "extensions"), kLamps); lamp && holdsMesh[i]) {
      standing["extensions"][kLamps] = *lamp;
      node["extensions"].erase(kLamps);
      if (node["extensions"].empty()) node.erase("extensions");
    }
    if (!holdsMesh[i]) {
      node.update(standing);
      standing.clear();
    }
    const std::vector<int>& meshes = meshesAt[i];
    if (meshes.size() == 1) node["mesh"] = meshes[0];
    const std::string name = text(before, "name");
    written[i] = append(std::move(node), from.parent);
    for (const int mesh : meshes) {
      if (meshes.size() == 1) break;
      json part = {{"mesh", mesh}};
      if (const std::string& called = scene_.meshes[std::size_t(mesh)].name; !called.empty())
        part["name"] = called;
      append(std::move(part), int(i));
    }
    if (standing.empty()) continue;
    if (!name.empty()) standing["name"] = name;
    setMatrix(standing, from.worldFromNode);
    append(std::move(standing), int(i));
  }
  return true;
}

}  // namespace lambent::scene_io
