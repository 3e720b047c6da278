// A checked glTF file → Scene: nodes flattened into world space, one mesh for each primitive in
// each place where it stands.
#include <algorithm>
#include <cmath>
#include <map>
#include <new>
#include <utility>

#include <fmt/format.h>
#include <Eigen/Geometry>
#include <Eigen/LU>

#include "lambent/scene/shapes.h"
#include "lambent/scene_io/diagnosis.h"
#include "lambent/scene_io/gltf_extensions.h"
#include "lambent/scene_io/gltf_extent.h"
#include "lambent/scene_io/gltf_json.h"
#include "lambent/scene_io/gltf_materials.h"
#include "lambent/scene_io/gltf_nodes.h"
#include "lambent/scene_io/gltf_origin.h"
#include "lambent/scene_io/gltf_primitive.h"
#include "lambent/scene_io/gltf_read.h"
#include "lambent/scene_io/gltf_source.h"
#include "lambent/scene_io/gltf_types.h"
#include "lambent/scene_io/mesh_bytes.h"
#include "lambent/scene_io/two_sides.h"
#include "lambent/scene_io/vertex_colors.h"

namespace lambent::scene_io {
namespace {

using nlohmann::json;
using scene::Mesh;
using Mat4d = Eigen::Matrix4d;

/// A small file may place one mesh a million times; this bounds what that may grow to.
constexpr std::size_t kMaxTriangles = std::size_t(1) << 28;

/// What looking for unused vertices, making normals and the like goes through for each vertex. A
/// small file may show a few vertices each of one large accessor many times over.
constexpr std::uint64_t kWorkPerVertex = 128;
/// And for each mesh, however small.
constexpr std::uint64_t kWorkPerMesh = 1024;

class Loader {
 public:
  Loader(const GltfFile& file, const GltfLoadOptions& options)
      : file_(file), document_(file.json()), options_(options), name_(file.path().string()) {}

  Result<LoadedGltf> load();

 private:
  Error bad(const std::string& message) const { return report::badInput(name_ + ": " + message); }
  Status checkExtensions();
  Status visitNodes();
  Status moveNear();
  Status placeMesh(const GltfNode& node, std::int64_t mesh);
  Status placePrimitive(const GltfNode& node, std::span<const Mat4d> instances,
                        const LoadedGltf::Origin& origin, const std::string& name, bool several);
  Result<Mesh> readPrimitive(const json& node, const json& mesh, const json& primitive,
                             const std::string& place, int material, bool& posed);
  TextureUse uvsOf(const GltfPrimitive& source, int material, const std::string& place);
  Result<const GltfSkin*> skinOf(const json& node);
  Status addMesh(Mesh mesh, LoadedGltf::Origin origin, const std::string& place);
  Status addBacks();
  void noteLosses();
  void placeCamera(const json& node, const GltfNode& placed);

  const GltfFile& file_;
  const json& document_;
  GltfLoadOptions options_;
  std::string name_;
  LoadedGltf result_;
  Diagnosis diagnosis_;
  std::vector<GltfNode> nodes_;
  std::vector<const GltfNode*> nodeAt_;     ///< by number
  Mat4d nearFromFile_ = Mat4d::Identity();  ///< a translation
  std::map<std::int64_t, std::optional<GltfSkin>> skins_;
  std::optional<GltfMaterials> materials_;
  std::size_t triangles_ = 0;
};

Status Loader::checkExtensions() {
  const json* required = find(document_, "extensionsRequired");
  for (std::size_t i = 0; i < arraySize(required); ++i) {
    const json& entry = (*required)[i];
    if (!entry.is_string()) continue;
    const std::string extension = entry.get<std::string>();
    if (!mayBeRequired(extension)) {
      return bad("needs the glTF extension " + extension.substr(0, 100) +
                 ", which Lambent does not read; " + remedyFor(extension));
    }
  }
  return Status::ok();
}

Status Loader::visitNodes() {
  Result<std::vector<GltfNode>> nodes = nodesOf(file_, diagnosis_);
  if (!nodes) return nodes.error();
  nodes_ = std::move(*nodes);
  nodeAt_ = nodesByIndex(file_, nodes_);
  if (Status status = moveNear(); !status) return status;
  for (const GltfNode& node : nodes_) {
    const json& object = *element(document_, "nodes", node.index);
    // Who reads a baked asset shows all of it: its transfer knows of what is hidden.
    const bool shown = !node.hidden || options_.keepAllVertices;
    if (const auto mesh = integer(object, "mesh"); mesh && shown) {
      if (Status status = placeMesh(node, *mesh); !status) return status;
    }
    if (find(object, "camera") != nullptr) placeCamera(object, node);
  }
  return Status::ok();
}

/// A scene far from the origin is moved to it, in double.
Status Loader::moveNear() {
  Vec3d& origin = result_.loaded.scene.origin;
  origin = originOf(document_);
  if (options_.keepAllVertices) return Status::ok();  // it stands where its transfer does
  const Result<Vec3d> far = farOriginOf(file_, nodes_);
  if (!far) return far.error();
  noteFarOrigin(*far, diagnosis_);
  origin += *far;
  nearFromFile_.col(3).head<3>() = -*far;
  for (GltfNode& node : nodes_) node.worldFromNode.col(3).head<3>() -= *far;
  return Status::ok();
}

/// Null: none, or one that is not whole.
Result<const GltfSkin*> Loader::skinOf(const json& node) {
  if (find(node, "skin") == nullptr) return nullptr;
  const std::int64_t index = integer(node, "skin").value_or(-1);
  auto known = skins_.find(index);
  if (known == skins_.end()) {
    Result<std::optional<GltfSkin>> skin = GltfSkin::of(file_, index, nodeAt_, diagnosis_);
    if (!skin) return skin.error();
    known = skins_.emplace(index, std::move(*skin)).first;
  }
  return known->second ? &*known->second : nullptr;
}

TextureUse Loader::uvsOf(const GltfPrimitive& source, int material, const std::string& place) {
  TextureUse use = materials_->textureUse(material);
  if (!options_.layout || !source.has("TEXCOORD_1")) return use;
  if (result_.loaded.scene.materials[std::size_t(material)].baseColorTexture < 0) {
    use = {};
    use.texCoord = 1;
  } else if (use.texCoord != 1) {
    diagnosis_.lose(Severity::Note, "layout-ignored", 1,
                    "meshes have a second set of texture coordinates, for light maps, which has no "
                    "place beside that of their texture: texels lie where the texture does; bake "
                    "vertices, or remove the texture",
                    place);
  }
  return use;
}

/// `posed`: whether a skin has moved it into world space.
Result<Mesh> Loader::readPrimitive(const json& node, const json& meshJson, const json& primitive,
                                   const std::string& place, int material, bool& posed) {
  const Result<GltfPrimitive> source = GltfPrimitive::open(file_, primitive, place);
  if (!source) return source.error();
  const TextureUse use = uvsOf(*source, material, place);
  Result<Mesh> mesh = source->mesh(use);
  if (!mesh) return mesh;
  mesh->material = material;
  if (mesh->positions.empty()) return mesh;
  const bool wanted = materials_->usesBesides(material, use.texCoord);
  if (Status status = source->readOthers(use, wanted, *mesh, diagnosis_); !status)
    return status.error();
  const auto isWhole = [](float alpha) { return alpha >= 1.0f; };
  if (result_.loaded.scene.materials[std::size_t(material)].alphaMode == scene::AlphaMode::Opaque ||
      std::all_of(mesh->alphas.begin(), mesh->alphas.end(), isWhole))
    mesh->alphas.clear();
  // Bytes that nothing says are normalized, and floats of a program that counts to 255.
  if (const float white = whiteOf(mesh->colors); white > 1.0f) {
    noteWhite(white, diagnosis_);
    for (Rgb& color : mesh->colors) color = linearColor(color, white);
    for (float& alpha : mesh->alphas) alpha /= white;
  }
  if (Status status =
          morph(file_, primitive, morphWeights(node, meshJson), place, *mesh, diagnosis_);
      !status) {
    return status.error();
  }
  if (find(primitive, "targets") != nullptr && !morphWeights(node, meshJson).empty())
    dropTangents(*mesh, place, diagnosis_);
  const Result<const GltfSkin*> skin = skinOf(node);
  if (!skin) return skin.error();
  if (*skin == nullptr) return mesh;
  const Result<bool> done = source->pose(**skin, *mesh);
  if (!done) return done.error();
  posed = *done;
  if (posed) dropTangents(*mesh, place, diagnosis_);
  return mesh;
}

Status Loader::placeMesh(const GltfNode& node, std::int64_t meshIndex) {
  const json* meshJson = element(document_, "meshes", meshIndex);
  if (meshJson == nullptr) {
    return bad("node " + std::to_string(node.index) + " shows mesh " + std::to_string(meshIndex) +
               ", which does not exist");
  }
  const json& nodeJson = *element(document_, "nodes", node.index);
  Result<std::vector<Mat4d>> instances = instancesOf(file_, nodeJson, node.index, diagnosis_);
  if (!instances) return instances.error();
  for (Mat4d& each : *instances) each = node.worldFromNode * each;
  std::string name = text(&nodeJson, "name");
  if (name.empty()) name = text(meshJson, "name");
  const std::size_t count = arraySize(find(*meshJson, "primitives"));
  for (std::size_t i = 0; i < count; ++i) {
    const LoadedGltf::Origin origin{int(node.index), int(meshIndex), int(i), true};
    if (Status status = placePrimitive(node, *instances, origin, name, count > 1); !status) {
      return status;
    }
  }
  return Status::ok();
}

Status Loader::placePrimitive(const GltfNode& node, std::span<const Mat4d> instances,
                              const LoadedGltf::Origin& origin, const std::string& name,
                              bool several) {
  const json& nodeJson = *element(document_, "nodes", node.index);
  const json& meshJson = *element(document_, "meshes", origin.mesh);
  const json& primitive = *element(meshJson, "primitives", origin.primitive);
  std::string place = "mesh ";
  place += name.empty() ? std::to_string(origin.mesh) : fmt::format("\"{:.200}\"", name);
  if (several) place += ", primitive " + std::to_string(origin.primitive);
  const std::int64_t mode = integer(primitive, "mode").value_or(4);
  if (mode < 4 || mode > 6) {
    diagnosis_.lose(Severity::Note, "no-triangles", 1,
                    "primitives of points or lines were left out", place);
    return Status::ok();
  }
  const Result<int> material = materials_->indexOf(primitive, place);
  if (!material) return material.error();
  bool posed = false;
  Result<Mesh> read = readPrimitive(nodeJson, meshJson, primitive, place, *material, posed);
  if (!read) return read.error();
  read->name = name;
  read->source.node = int(&node - nodes_.data());
  read->source.mesh = origin.mesh;
  read->source.primitive = origin.primitive;
  if (several) read->name += fmt::format("/{}", origin.primitive);
  // A skinned mesh does not follow its node (§3.7.3.3): its joints hold it, or as modelled it
  // stands in world space.
  const Mat4d identity = Mat4d::Identity();
  if (find(nodeJson, "skin") != nullptr) instances = {posed ? &identity : &nearFromFile_, 1};
  for (std::size_t i = 0; i < instances.size(); ++i) {
    const std::string what = name_ + ": node " + std::to_string(node.index) + ", " + place;
    const std::uint64_t work =
        std::uint64_t(read->positions.size()) * kWorkPerVertex + kWorkPerMesh;
    if (Status fits = file_.budget().work(work, what); !fits) return fits;
    Mesh mesh = i + 1 < instances.size() ? *read : std::move(*read);
    if (!instances[i].isIdentity(0.0)) {
      mesh = scene::transformed(std::move(mesh), instances[i]);
    }
    if (Status status = addMesh(std::move(mesh), origin, place); !status) return status;
  }
  return Status::ok();
}

Status Loader::addMesh(Mesh mesh, LoadedGltf::Origin origin, const std::string& place) {
  FinishOptions finish;
  finish.keepAllVertices = options_.keepAllVertices;
  finish.crease = options_.crease;
  if (Status status = finishMesh(mesh, finish, name_, place, diagnosis_, &origin.verticesKept);
      !status) {
    return status;
  }
  if (mesh.triangles.empty()) return Status::ok();
  triangles_ += mesh.triangles.size();
  if (triangles_ > kMaxTriangles) {
    return bad("its nodes place more than " + std::to_string(kMaxTriangles) +
               " triangles in all; Lambent makes every instance a mesh of its own");
  }
  const std::string what = name_ + ": node " + std::to_string(origin.node) + ", " + place;
  if (Status fits = file_.budget().hold(bytesOf(mesh), what); !fits) return fits;
  result_.loaded.scene.meshes.push_back(std::move(mesh));
  result_.origins.push_back(origin);
  return Status::ok();
}

/// A baked asset has the backs that it was baked with.
Status Loader::addBacks() {
  if (options_.keepAllVertices) return Status::ok();
  const Result<std::vector<bool>> given =
      giveBacks(result_.loaded.scene, options_.sides, name_, file_.budget(), diagnosis_);
  if (!given) return given.error();
  for (std::size_t m = 0; m < given->size(); ++m)
    if ((*given)[m]) result_.origins[m].verticesKept = false;
  return Status::ok();
}

/// What a bake leaves out of the file, apart from what was met on the way.
void Loader::noteLosses() {
  noteExtensions(document_, diagnosis_);
  noteWrongTypes(document_, diagnosis_);
  // The mark that asset/write.cpp leaves.
  const json* mark = find(find(find(document_, "asset"), "extras"), "lambent");
  if (find(mark, "baked") != nullptr &&
      find(find(document_, "extensions"), "LAMBENT_radiance_transfer") == nullptr)
    diagnosis_.lose(
        Severity::Warning, "transfer-stripped", 1,
        "this was baked, and an optimiser has stripped its transfer: it is a plain scene "
        "now; bake it again after the optimiser, or give that three-lambent/gltf-transform, "
        "which keeps transfer");
  if (const std::size_t count = arraySize(find(document_, "animations")); count > 0) {
    diagnosis_.lose(
        Severity::Note, "animations-ignored", count,
        "animations are not played: everything stands as its nodes say; to bake another "
        "moment, pose the scene there and export it again");
  }
}

void Loader::placeCamera(const json& node, const GltfNode& placed) {
  const Mat4d& world = placed.worldFromNode;
  const json* object = element(document_, "cameras", integer(node, "camera").value_or(-1));
  if (object == nullptr) return;
  const auto ignored = [&](const std::string& name) {
    diagnosis_.lose(Severity::Warning, "camera-ignored", 1,
                    "cameras have no valid transform or no valid angle and were left out: no view "
                    "can be taken from them; set them right where the file was made",
                    name);
  };
  scene::Camera camera;
  camera.source = int(&placed - nodes_.data());
  camera.name = text(&node, "name");
  if (camera.name.empty()) camera.name = text(object, "name");
  if (text(object, "type") == "orthographic") {
    camera.orthographicHalfHeight =
        float(std::abs(number(find(object, "orthographic"), "ymag", 1.0)));
    if (!(*camera.orthographicHalfHeight > 0.0f)) return ignored(camera.name);
  } else {
    camera.verticalFov = float(number(find(object, "perspective"), "yfov", 0.7));
    if (!(camera.verticalFov > 1e-4f && camera.verticalFov < 3.14f)) return ignored(camera.name);
  }
  // Scale in the nodes above moves a camera and does not stretch its picture.
  const Vec3d back = world.col(2).head<3>().normalized();
  const Vec3d right = Vec3d(world.col(1).head<3>()).cross(back).normalized();
  Mat4d rigid = world;
  rigid.topLeftCorner<3, 3>() << right, back.cross(right), back;
  if (!rigid.allFinite() || std::abs(rigid.determinant() - 1.0) > 1e-6) {
    return ignored(camera.name);
  }
  // A rigid transform stays as it is, to the bit.
  camera.worldFromCamera =
      ((rigid - world).cwiseAbs().maxCoeff() < 1e-6 ? world : rigid).cast<float>();
  result_.loaded.scene.cameras.push_back(std::move(camera));
}

Result<LoadedGltf> Loader::load() {
  if (Status status = checkExtensions(); !status) return status.error();
  materials_.emplace(file_, result_.loaded.scene, diagnosis_);
  if (Status status = materials_->read(); !status) return status.error();
  if (Status status = visitNodes(); !status) return status.error();
  if (result_.loaded.scene.meshes.empty()) {
    noteWrongTypes(document_, diagnosis_);
    const Findings wrong = diagnosis_.findings();
    const auto types = std::find_if(wrong.begin(), wrong.end(),
                                    [](const Finding& f) { return f.code == "wrong-types"; });
    return bad("holds no triangles; Lambent needs a surface to bake" +
               (types == wrong.end() ? std::string() : ". " + types->message));
  }
  const auto materials = std::span(std::as_const(result_.loaded.scene.materials))
                             .first(arraySize(find(document_, "materials")));
  auto kept = sourceOf(file_, nodes_, materials, materials_->images(), diagnosis_);
  if (!kept) return kept.error();
  result_.loaded.scene.source = std::move(*kept);
  if (Status status = addBacks(); !status) return status.error();
  noteLosses();
  result_.loaded.findings = diagnosis_.findings();
  file_.linkedFiles().noteGltf(document_);
  result_.loaded.linkedFiles = file_.linkedFiles().noted();
  return std::move(result_);
}

}  // namespace

Result<LoadedGltf> loadGltf(const GltfFile& file, const GltfLoadOptions& options) {
  return Loader(file, options).load();
}

}  // namespace lambent::scene_io
