#include "lambent/scene_io/gltf_nodes.h"

#include <cmath>
#include <optional>
#include <string>

#include <Eigen/Geometry>

#include "lambent/scene_io/gltf_json.h"

namespace lambent::scene_io {
namespace {

using Eigen::Matrix4d;
using nlohmann::json;

/// What inversions and exports by way of floats leave in the last row of an affine matrix.
constexpr double kRowNoise = 1e-4;

/// Rotations that say nothing, (0, 0, 0, 0), are met in files and turn nothing.
Matrix4d composed(const Vec3d& translation, Eigen::Quaterniond rotation, const Vec3d& scale) {
  if (rotation.norm() > 1e-12) {
    rotation.normalize();
  } else {
    rotation.setIdentity();
  }
  Matrix4d m = Matrix4d::Identity();
  m.topLeftCorner<3, 3>() = rotation.toRotationMatrix() * scale.asDiagonal();
  m.topRightCorner<3, 1>() = translation;
  return m;
}

std::optional<Matrix4d> localTransform(const json& node) {
  if (find(node, "matrix") != nullptr) {
    const auto values = numbers(&node, "matrix", 16);
    if (!values) return {};
    Matrix4d m;
    for (int i = 0; i < 16; ++i) m(i % 4, i / 4) = (*values)[i];
    const double w = m(3, 3);
    if (!(w > kRowNoise) || m.row(3).head<3>().cwiseAbs().maxCoeff() > kRowNoise * w) return {};
    if (w != 1.0) m /= w;
    m.row(3) = Eigen::RowVector4d(0, 0, 0, 1);
    return m;
  }
  const auto vector = [&](const char* key, std::vector<double> otherwise) {
    return find(node, key) == nullptr ? std::optional(otherwise)
                                      : numbers(&node, key, otherwise.size());
  };
  const auto t = vector("translation", {0, 0, 0}), r = vector("rotation", {0, 0, 0, 1}),
             s = vector("scale", {1, 1, 1});
  if (!t || !r || !s) return {};
  return composed(Vec3d((*t)[0], (*t)[1], (*t)[2]),
                  Eigen::Quaterniond((*r)[3], (*r)[0], (*r)[1], (*r)[2]),
                  Vec3d((*s)[0], (*s)[1], (*s)[2]));
}

/// Those of the scene that is shown; without scenes, those that are nobody's child.
std::vector<std::int64_t> rootsOf(const json& document) {
  std::vector<std::int64_t> roots;
  if (arraySize(find(document, "scenes")) > 0) {
    const json* scene = element(document, "scenes", integer(document, "scene").value_or(0));
    const json* nodes = find(scene, "nodes");
    for (std::size_t i = 0; i < arraySize(nodes); ++i) {
      roots.push_back(asInteger(&(*nodes)[i]).value_or(-1));
    }
    return roots;
  }
  const std::size_t count = arraySize(find(document, "nodes"));
  std::vector<bool> isChild(count);
  for (std::size_t i = 0; i < count; ++i) {
    const json* children = find((*find(document, "nodes"))[i], "children");
    for (std::size_t c = 0; c < arraySize(children); ++c) {
      const std::int64_t child = asInteger(&(*children)[c]).value_or(-1);
      if (child >= 0 && std::size_t(child) < count) isChild[std::size_t(child)] = true;
    }
  }
  for (std::size_t i = 0; i < count; ++i) {
    if (!isChild[i]) roots.push_back(std::int64_t(i));
  }
  return roots;
}

bool isHidden(const json& node) {
  const json* visible = find(find(find(node, "extensions"), "KHR_node_visibility"), "visible");
  return visible != nullptr && visible->is_boolean() && !visible->get<bool>();
}

}  // namespace

Result<std::vector<GltfNode>> nodesOf(const GltfFile& file, Diagnosis& diagnosis) {
  const json& document = file.json();
  const auto bad = [&](const std::string& message) {
    return report::badInput(file.path().string() + ": " + message);
  };
  std::vector<GltfNode> placed, pending;
  std::vector<bool> visited(arraySize(find(document, "nodes")));
  const auto push = [&](std::int64_t node, const GltfNode& parent) -> Status {
    const std::string name = "node " + std::to_string(node);
    if (node < 0 || std::size_t(node) >= visited.size()) {
      return bad(name + " is referred to and does not exist");
    }
    // glTF nodes form trees: a node met twice has two parents or is its own ancestor.
    if (visited[std::size_t(node)]) {
      return bad(name + " is reached twice: nodes form a cycle or share a child; export it again");
    }
    visited[std::size_t(node)] = true;
    pending.push_back({node, parent.worldFromNode, parent.hidden, parent.index});
    return Status::ok();
  };
  const GltfNode world{-1, Matrix4d::Identity(), false, -1};
  const std::vector<std::int64_t> first = rootsOf(document);
  for (auto it = first.rbegin(); it != first.rend(); ++it) {
    if (Status status = push(*it, world); !status) return status.error();
  }
  std::size_t hidden = 0;
  while (!pending.empty()) {
    GltfNode current = pending.back();
    pending.pop_back();
    const json& node = *element(document, "nodes", current.index);
    const auto local = localTransform(node);
    if (!local) {
      return bad("node " + std::to_string(current.index) +
                 " has a transform that is not valid: it holds something else than finite numbers, "
                 "or a perspective; apply transforms and export it again");
    }
    current.worldFromNode *= *local;
    current.hidden |= isHidden(node);
    hidden += current.hidden && find(node, "mesh") != nullptr;
    placed.push_back(current);
    const json* children = find(node, "children");
    for (std::size_t i = arraySize(children); i-- > 0;) {
      if (Status status = push(asInteger(&(*children)[i]).value_or(-1), current); !status) {
        return status.error();
      }
    }
  }
  if (hidden > 0) {
    diagnosis.lose(Severity::Note, "hidden-nodes", hidden,
                   "meshes are hidden by KHR_node_visibility and were left out: they keep no light "
                   "away; show them in the program that made the file if they should");
  }
  return placed;
}

std::vector<const GltfNode*> nodesByIndex(const GltfFile& file,
                                          const std::vector<GltfNode>& nodes) {
  std::vector<const GltfNode*> byIndex(arraySize(find(file.json(), "nodes")), nullptr);
  for (const GltfNode& node : nodes) byIndex[std::size_t(node.index)] = &node;
  return byIndex;
}

Result<std::vector<Matrix4d>> instancesOf(const GltfFile& file, const json& node,
                                          std::int64_t index, Diagnosis& diagnosis) {
  const json* extension = find(find(node, "extensions"), "EXT_mesh_gpu_instancing");
  const json* attributes = find(extension, "attributes");
  if (attributes == nullptr || !attributes->is_object())
    return std::vector<Matrix4d>{Matrix4d::Identity()};
  const std::string place =
      file.path().string() + ": node " + std::to_string(index) + ", EXT_mesh_gpu_instancing";
  for (const auto& [name, ignored] : attributes->items())
    if (name != "TRANSLATION" && name != "ROTATION" && name != "SCALE")
      diagnosis.lose(Severity::Note, "instance-attributes", 1,
                     "attributes of instances are not kept: every instance is a mesh of its own, "
                     "and only where it stands is known; make nodes of them that say the rest in "
                     "their extras",
                     place + ": " + name.substr(0, 100));
  struct Part {
    const char* name;
    int width;
    std::vector<float> values;
  };
  Part parts[] = {{"TRANSLATION", 3, {}}, {"ROTATION", 4, {}}, {"SCALE", 3, {}}};
  std::optional<std::size_t> count;
  for (Part& part : parts) {
    const auto accessor = integer(attributes, part.name);
    if (!accessor) continue;
    Result<std::vector<float>> values = file.accessorFloats(*accessor, part.width);
    if (!values) return values.error();
    part.values = std::move(*values);
    const std::size_t here = part.values.size() / std::size_t(part.width);
    if (count && *count != here) {
      return report::badInput(place + ": " + part.name + " is not of as many instances as the " +
                              "others; export the file again");
    }
    count = here;
  }
  if (!count) {
    diagnosis.lose(Severity::Warning, "instances-without-place", 1,
                   "nodes have instances that stand nowhere; their mesh was taken once", place);
    return std::vector<Matrix4d>{Matrix4d::Identity()};
  }
  const std::uint64_t taken = std::uint64_t(*count) * sizeof(Matrix4d);
  if (Status fits = file.budget().hold(taken, place); !fits) return fits.error();
  file.budget().release(taken);  // gone when the node is done
  if (Status fits = file.budget().work(taken, place); !fits) return fits.error();
  std::vector<Matrix4d> instances(*count);
  const auto vector = [&](const Part& part, std::size_t i, double otherwise) -> Vec3d {
    if (part.values.empty()) return Vec3d::Constant(otherwise);
    return Eigen::Map<const Eigen::Vector3f>(part.values.data() + 3 * i).cast<double>();
  };
  for (std::size_t i = 0; i < *count; ++i) {
    Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
    if (const std::vector<float>& r = parts[1].values; !r.empty()) {
      rotation = {r[4 * i + 3], r[4 * i], r[4 * i + 1], r[4 * i + 2]};
    }
    instances[i] = composed(vector(parts[0], i, 0.0), rotation, vector(parts[2], i, 1.0));
    if (!instances[i].allFinite()) {
      return report::badInput(place + ": instance " + std::to_string(i) +
                              " has a transform that is not of finite numbers; export it again");
    }
  }
  return instances;
}

}  // namespace lambent::scene_io
