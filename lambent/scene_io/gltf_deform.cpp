#include "lambent/scene_io/gltf_deform.h"

#include <algorithm>

#include <Eigen/LU>

#include "lambent/scene_io/gltf_json.h"

namespace lambent::scene_io {
namespace {

using Eigen::Matrix4d;
using nlohmann::json;

std::vector<double> weightsOf(const json& object) {
  const json* given = find(object, "weights");
  return numbers(&object, "weights", arraySize(given)).value_or(std::vector<double>());
}

}  // namespace

std::vector<double> morphWeights(const json& node, const json& mesh) {
  std::vector<double> weights = weightsOf(find(node, "weights") != nullptr ? node : mesh);
  const bool moves = std::any_of(weights.begin(), weights.end(), [](double w) { return w != 0.0; });
  return moves ? weights : std::vector<double>();
}

Status morph(const GltfFile& file, const json& primitive, const std::vector<double>& weights,
             const std::string& place, scene::Mesh& mesh, Diagnosis& diagnosis) {
  const json* targets = find(primitive, "targets");
  if (arraySize(targets) == 0) return Status::ok();
  diagnosis.lose(
      Severity::Note, "morph-targets", 1,
      "primitives have morph targets, which were taken at the weights that the file gives: the "
      "asset has that shape alone; to bake another, set its weights and export the file again",
      place);
  const auto add = [&](const json& target, const char* name, float weight,
                       std::vector<Vec3>& to) -> Status {
    const auto accessor = integer(target, name);
    if (!accessor || to.empty()) return Status::ok();
    const Result<std::vector<float>> offsets = file.accessorFloats(*accessor, 3);
    if (!offsets) return offsets.error();
    const std::string what = file.path().string() + ": " + place + ", its morph targets";
    if (Status fits = file.budget().work(4 * offsets->size(), what); !fits) return fits;
    if (offsets->size() != 3 * to.size()) {
      return report::badInput(file.path().string() + ": " + place + ": a morph target's " + name +
                              " has not as many elements as POSITION; export the file again");
    }
    for (std::size_t i = 0; i < to.size(); ++i) {
      to[i] += weight * Vec3(offsets->data() + 3 * i);
    }
    return Status::ok();
  };
  for (std::size_t t = 0; t < std::min(arraySize(targets), weights.size()); ++t) {
    const auto weight = float(weights[t]);
    if (weight == 0.0f) continue;
    if (Status s = add((*targets)[t], "POSITION", weight, mesh.positions); !s) return s;
    if (Status s = add((*targets)[t], "NORMAL", weight, mesh.normals); !s) return s;
  }
  return Status::ok();
}

Result<std::optional<GltfSkin>> GltfSkin::of(const GltfFile& file, std::int64_t index,
                                             std::span<const GltfNode* const> nodes,
                                             Diagnosis& diagnosis) {
  const json* skin = element(file.json(), "skins", index);
  const json* joints = find(skin, "joints");
  const auto ignored = [&](const std::string& why) {
    diagnosis.lose(
        Severity::Warning, "skin-ignored", 1,
        "skins are not whole and were ignored: their meshes stand as they were modelled; "
        "export the file again, or apply its pose in a modelling program",
        "skin " + std::to_string(index) + " " + why);
    return std::optional<GltfSkin>();
  };
  if (arraySize(joints) == 0) return ignored("has no joints");
  GltfSkin result;
  result.worldFromBind_.reserve(joints->size());
  for (const json& joint : *joints) {
    const std::int64_t node = asInteger(&joint).value_or(-1);
    if (node < 0 || std::size_t(node) >= nodes.size() || nodes[std::size_t(node)] == nullptr) {
      return ignored("has a joint that is not in the scene");
    }
    result.worldFromBind_.push_back(nodes[std::size_t(node)]->worldFromNode);
  }
  if (const auto accessor = integer(skin, "inverseBindMatrices")) {
    const Result<std::vector<float>> inverse = file.accessorFloats(*accessor, 16);
    if (!inverse) return inverse.error();
    const std::string what = file.path().string() + ": skin " + std::to_string(index);
    if (Status fits = file.budget().work(4 * inverse->size(), what); !fits) return fits.error();
    if (inverse->size() < 16 * result.worldFromBind_.size()) {
      return ignored("has fewer inverse bind matrices than joints");
    }
    for (std::size_t i = 0; i < result.worldFromBind_.size(); ++i) {
      result.worldFromBind_[i] *=
          Eigen::Map<const Eigen::Matrix4f>(inverse->data() + 16 * i).cast<double>();
    }
  }
  diagnosis.lose(Severity::Note, "skin-posed", 1,
                 "skins were posed as their joints stand in the file, and are not in the asset: it "
                 "has that pose alone; to bake another, pose the scene and export it again");
  return std::optional(std::move(result));
}

bool GltfSkin::pose(std::span<const float> joints, std::span<const float> weights,
                    scene::Mesh& mesh) const {
  const std::size_t count = mesh.positions.size(), each = count > 0 ? joints.size() / count : 0;
  for (const float joint : joints) {
    if (!(joint >= 0.0f && joint < float(worldFromBind_.size()))) return false;
  }
  std::vector<bool> mirrored(count);
  for (std::size_t v = 0; v < count; ++v) {
    Matrix4d blended = Matrix4d::Zero();
    double sum = 0.0;
    for (std::size_t i = v * each; i < (v + 1) * each; ++i) {
      if (!(weights[i] > 0.0f)) continue;
      blended += double(weights[i]) * worldFromBind_[std::size_t(joints[i])];
      sum += double(weights[i]);
    }
    if (!(sum > 0.0)) continue;  // held by nothing, it stays
    blended /= sum;
    const Mat3d linear = blended.topLeftCorner<3, 3>();
    const Vec3d moved = linear * mesh.positions[v].cast<double>() + blended.col(3).head<3>();
    mesh.positions[v] = moved.cast<float>();
    mirrored[v] = linear.determinant() < 0.0;
    if (mesh.normals.empty()) continue;
    Mat3d cofactor;  // as scene::transformed has it
    cofactor.col(0) = linear.col(1).cross(linear.col(2));
    cofactor.col(1) = linear.col(2).cross(linear.col(0));
    cofactor.col(2) = linear.col(0).cross(linear.col(1));
    const Vec3d turned = cofactor * mesh.normals[v].cast<double>();
    mesh.normals[v] = ((mirrored[v] ? -1.0 : 1.0) * turned).stableNormalized().cast<float>();
  }
  for (scene::Triangle& t : mesh.triangles) {
    if (mirrored[t[0]]) std::swap(t[1], t[2]);
  }
  return true;
}

}  // namespace lambent::scene_io
