// A checked glTF file → Scene: nodes flattened into world space, one mesh for each primitive in
// each place where it stands.
#include <algorithm>
#include <cmath>
#include <map>
#include <new>

#include <fmt/format.h>
#include <Eigen/Geometry>
#include <Eigen/LU>

#include "lambent/scene/shapes.h"
#include "lambent/scene_io/diagnosis.h"
#include "lambent/scene_io/gltf_extensions.h"
#include "lambent/scene_io/gltf_json.h"
#include "lambent/scene_io/gltf_materials.h"
#include "lambent/scene_io/gltf_origin.h"
#include "lambent/scene_io/gltf_read.h"
#include "lambent/scene_io/mesh_bytes.h"

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

std::optional<Mat4d> localTransform(const json& node) {
  Mat4d m = Mat4d::Identity();
  if (const json* matrix = find(node, "matrix"); matrix != nullptr) {
    const auto values = numbers(&node, "matrix", 16);
    if (!values) return {};
    for (int i = 0; i < 16; ++i) m(i % 4, i / 4) = (*values)[i];
    if (m.row(3) != Eigen::RowVector4d(0, 0, 0, 1)) return {};
    return m;
  }
  const auto vector = [&](const char* key, std::vector<double> otherwise) {
    return find(node, key) == nullptr ? std::optional(otherwise)
                                      : numbers(&node, key, otherwise.size());
  };
  const auto t = vector("translation", {0, 0, 0}), r = vector("rotation", {0, 0, 0, 1}),
             s = vector("scale", {1, 1, 1});
  if (!t || !r || !s) return {};
  Eigen::Quaterniond q((*r)[3], (*r)[0], (*r)[1], (*r)[2]);
  if (!(q.norm() > 1e-12)) return {};
  q.normalize();
  m.topLeftCorner<3, 3>() = q.toRotationMatrix() * Vec3d((*s)[0], (*s)[1], (*s)[2]).asDiagonal();
  m.topRightCorner<3, 1>() = Vec3d((*t)[0], (*t)[1], (*t)[2]);
  return m;
}

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

class Loader {
 public:
  Loader(const GltfFile& file, const GltfLoadOptions& options)
      : file_(file), document_(file.json()), options_(options), name_(file.path().string()) {}

  Result<LoadedGltf> load();

 private:
  Error bad(const std::string& message) const { return report::badInput(name_ + ": " + message); }
  Status checkExtensions();
  Status visitNodes();
  std::vector<std::int64_t> roots() const;
  Status placeMesh(std::int64_t node, std::int64_t mesh, const Mat4d& world);
  Result<Mesh> readPrimitive(const json& primitive, const std::string& place, int material);
  Result<std::vector<std::uint32_t>> readIndices(std::int64_t accessor, std::size_t vertices,
                                                 const std::string& place);
  void placeCamera(const json& node, const Mat4d& world);

  const GltfFile& file_;
  const json& document_;
  GltfLoadOptions options_;
  std::string name_;
  LoadedGltf result_;
  Diagnosis diagnosis_;
  std::optional<GltfMaterials> materials_;
  std::size_t triangles_ = 0;
};

Status Loader::checkExtensions() {
  const json* required = find(document_, "extensionsRequired");
  for (std::size_t i = 0; i < arraySize(required); ++i) {
    const json& entry = (*required)[i];
    if (!entry.is_string()) continue;
    const std::string extension = entry.get<std::string>();
    if (!isKnownExtension(extension)) {
      return bad("needs the glTF extension " + extension.substr(0, 100) +
                 ", which Lambent does not read; " + remedyFor(extension));
    }
  }
  return Status::ok();
}

std::vector<std::int64_t> Loader::roots() const {
  std::vector<std::int64_t> roots;
  if (arraySize(find(document_, "scenes")) > 0) {
    const json* scene = element(document_, "scenes", integer(document_, "scene").value_or(0));
    const json* nodes = find(scene, "nodes");
    for (std::size_t i = 0; i < arraySize(nodes); ++i) {
      roots.push_back(asInteger(&(*nodes)[i]).value_or(-1));
    }
    return roots;
  }
  const std::size_t count = arraySize(find(document_, "nodes"));
  std::vector<bool> isChild(count);
  for (std::size_t i = 0; i < count; ++i) {
    const json* children = find((*find(document_, "nodes"))[i], "children");
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

Status Loader::visitNodes() {
  struct Pending {
    std::int64_t node;
    Mat4d world;
  };
  std::vector<Pending> pending;
  std::vector<bool> visited(arraySize(find(document_, "nodes")));
  const auto push = [&](std::int64_t node, const Mat4d& world) -> Status {
    const std::string name = "node " + std::to_string(node);
    if (node < 0 || std::size_t(node) >= visited.size()) {
      return bad(name + " is referred to and does not exist");
    }
    // glTF nodes form trees: a node met twice has two parents or is its own ancestor.
    if (visited[std::size_t(node)]) {
      return bad(name + " is reached twice: nodes form a cycle or share a child; export it again");
    }
    visited[std::size_t(node)] = true;
    pending.push_back({node, world});
    return Status::ok();
  };
  std::vector<std::int64_t> first = roots();
  for (auto it = first.rbegin(); it != first.rend(); ++it) {
    if (Status status = push(*it, Mat4d::Identity()); !status) return status;
  }
  std::size_t skinned = 0;
  while (!pending.empty()) {
    const Pending current = pending.back();
    pending.pop_back();
    const json* node = element(document_, "nodes", current.node);
    const auto local = localTransform(*node);
    if (!local) {
      return bad("node " + std::to_string(current.node) +
                 " has a transform that is not valid; apply transforms and export it again");
    }
    const Mat4d world = current.world * *local;
    if (const auto mesh = integer(node, "mesh")) {
      // A skinned mesh does not follow its node (§3.7.3.3): as modelled, it stands in world space.
      const bool skin = find(*node, "skin") != nullptr;
      skinned += skin;
      const Mat4d place = skin ? Mat4d(Mat4d::Identity()) : world;
      if (Status status = placeMesh(current.node, *mesh, place); !status) return status;
    }
    if (find(*node, "camera") != nullptr) placeCamera(*node, world);
    const json* children = find(*node, "children");
    for (std::size_t i = arraySize(children); i-- > 0;) {
      if (Status status = push(asInteger(&(*children)[i]).value_or(-1), world); !status) {
        return status;
      }
    }
  }
  if (skinned > 0) {
    diagnosis_.add(Severity::Warning, "skin-ignored", skinned,
                   "meshes have a skin, which is ignored: they stand as they were modelled");
  }
  return Status::ok();
}

Result<std::vector<std::uint32_t>> Loader::readIndices(std::int64_t accessor, std::size_t vertices,
                                                       const std::string& place) {
  const Result<AccessorView> view = file_.accessorView(accessor);
  if (!view) return view.error();
  if (view->componentCount != 1 || view->component == Component::Float) {
    return bad(place + ": accessor " + std::to_string(accessor) + " cannot hold indices");
  }
  std::vector<std::uint32_t> indices(view->count);
  const std::size_t size = view->elementSize();
  for (std::size_t i = 0; i < indices.size(); ++i) {
    const std::byte* p = view->bytes.data() + i * view->stride;
    std::uint32_t value = 0;
    for (std::size_t b = size; b-- > 0;) value = value << 8 | std::uint32_t(p[b]);
    if (value >= vertices) {
      return bad(place + ": index " + std::to_string(i) + " (triangle " + std::to_string(i / 3) +
                 ") refers to vertex " + std::to_string(value) + " of " + std::to_string(vertices) +
                 "; export the file again");
    }
    indices[i] = value;
  }
  return indices;
}

Result<Mesh> Loader::readPrimitive(const json& primitive, const std::string& place, int material) {
  const json* attributes = find(primitive, "attributes");
  if (find(find(primitive, "extensions"), "KHR_draco_mesh_compression") != nullptr &&
      !integer(attributes, "POSITION")) {
    return bad(place +
               " is compressed with KHR_draco_mesh_compression, which Lambent does not "
               "read; " +
               remedyFor("KHR_draco_mesh_compression"));
  }
  Mesh mesh;
  mesh.material = material;
  const auto positionAccessor = integer(attributes, "POSITION");
  if (!positionAccessor) return mesh;  // nothing to see, says the specification
  const auto floats = [&](std::int64_t accessor, int components) {
    return file_.accessorFloats(accessor, components);
  };
  const auto mismatch = [&](const std::string& attribute) {
    return bad(place + ": " + attribute + " has not as many elements as POSITION");
  };

  const Result<std::vector<float>> positions = floats(*positionAccessor, 3);
  if (!positions) return positions.error();
  const std::size_t count = positions->size() / 3;
  mesh.positions.resize(count);
  for (std::size_t i = 0; i < count; ++i) mesh.positions[i] = Vec3(positions->data() + 3 * i);

  if (const auto accessor = integer(attributes, "NORMAL")) {
    const Result<std::vector<float>> normals = floats(*accessor, 3);
    if (!normals) return normals.error();
    if (normals->size() != 3 * count) return mismatch("NORMAL");
    mesh.normals.resize(count);
    for (std::size_t i = 0; i < count; ++i) mesh.normals[i] = Vec3(normals->data() + 3 * i);
  }
  const TextureUse use = materials_->textureUse(material);
  const std::string uvName = "TEXCOORD_" + std::to_string(use.texCoord);
  if (const auto accessor = integer(attributes, uvName)) {
    const Result<std::vector<float>> uvs = floats(*accessor, 2);
    if (!uvs) return uvs.error();
    if (uvs->size() != 2 * count) return mismatch(uvName);
    mesh.uvs.resize(count);
    for (std::size_t i = 0; i < count; ++i) mesh.uvs[i] = use.apply(Vec2(uvs->data() + 2 * i));
  }
  if (const auto accessor = integer(attributes, "COLOR_0")) {
    const bool hasAlpha = text(element(document_, "accessors", *accessor), "type") == "VEC4";
    const int width = hasAlpha ? 4 : 3;
    const Result<std::vector<float>> colors = floats(*accessor, width);
    if (!colors) return colors.error();
    if (colors->size() != width * count) return mismatch("COLOR_0");
    mesh.colors.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
      mesh.colors[i] = Rgb(Eigen::Map<const Eigen::Array3f>(colors->data() + width * i));
    }
  }

  std::vector<std::uint32_t> indices;
  if (const auto accessor = integer(primitive, "indices")) {
    Result<std::vector<std::uint32_t>> read = readIndices(*accessor, count, place);
    if (!read) return read.error();
    indices = std::move(*read);
  } else {
    indices.resize(count);
    for (std::size_t i = 0; i < count; ++i) indices[i] = std::uint32_t(i);
  }
  mesh.triangles = triangulate(indices, int(integer(primitive, "mode").value_or(4)));
  if (arraySize(find(primitive, "targets")) > 0) {
    diagnosis_.add(Severity::Warning, "morph-ignored", 1,
                   "primitives have morph targets, which are ignored", place);
  }
  return mesh;
}

Status Loader::placeMesh(std::int64_t nodeIndex, std::int64_t meshIndex, const Mat4d& world) {
  const json* meshJson = element(document_, "meshes", meshIndex);
  if (meshJson == nullptr) {
    return bad("node " + std::to_string(nodeIndex) + " shows mesh " + std::to_string(meshIndex) +
               ", which does not exist");
  }
  const json* node = element(document_, "nodes", nodeIndex);
  std::string name = text(node, "name");
  if (name.empty()) name = text(meshJson, "name");
  const json* primitives = find(*meshJson, "primitives");
  const std::size_t count = arraySize(primitives);
  for (std::size_t i = 0; i < count; ++i) {
    const json& primitive = (*primitives)[i];
    std::string place = "mesh ";
    place += name.empty() ? std::to_string(meshIndex) : fmt::format("\"{:.200}\"", name);
    if (count > 1) place += ", primitive " + std::to_string(i);
    const std::int64_t mode = integer(primitive, "mode").value_or(4);
    if (mode < 4 || mode > 6) {
      diagnosis_.add(Severity::Note, "no-triangles", 1,
                     "primitives of points or lines were left out", place);
      continue;
    }
    const Result<int> material = materials_->indexOf(primitive, place);
    if (!material) return material.error();
    Result<Mesh> mesh = readPrimitive(primitive, place, *material);
    if (!mesh) return mesh.error();
    file::Budget& budget = file_.budget();
    const std::string what = name_ + ": node " + std::to_string(nodeIndex) + ", " + place;
    if (Status fits = budget.work(mesh->positions.size() * kWorkPerVertex, what); !fits) {
      return fits;
    }
    if (!world.isIdentity(0.0)) *mesh = scene::transformed(std::move(*mesh), world.cast<float>());
    mesh->name = name;
    if (count > 1) mesh->name += fmt::format("/{}", i);

    FinishOptions finish;
    finish.keepAllVertices = options_.keepAllVertices;
    LoadedGltf::Origin origin{int(nodeIndex), int(meshIndex), int(i), true};
    if (Status status = finishMesh(*mesh, finish, name_, place, diagnosis_, &origin.verticesKept);
        !status) {
      return status;
    }
    if (mesh->triangles.empty()) continue;
    triangles_ += mesh->triangles.size();
    if (triangles_ > kMaxTriangles) {
      return bad("its nodes place more than " + std::to_string(kMaxTriangles) +
                 " triangles in all; Lambent makes every instance a mesh of its own");
    }
    if (Status fits = budget.hold(bytesOf(*mesh), what); !fits) return fits;
    result_.loaded.scene.meshes.push_back(std::move(*mesh));
    result_.origins.push_back(origin);
  }
  return Status::ok();
}

void Loader::placeCamera(const json& node, const Mat4d& world) {
  const json* object = element(document_, "cameras", integer(node, "camera").value_or(-1));
  if (object == nullptr) return;
  scene::Camera camera;
  camera.name = text(&node, "name");
  if (camera.name.empty()) camera.name = text(object, "name");
  if (text(object, "type") == "orthographic") {
    camera.orthographicHalfHeight =
        float(std::abs(number(find(object, "orthographic"), "ymag", 1.0)));
    if (!(*camera.orthographicHalfHeight > 0.0f)) return;
  } else {
    camera.verticalFov = float(number(find(object, "perspective"), "yfov", 0.7));
    if (!(camera.verticalFov > 1e-4f && camera.verticalFov < 3.14f)) return;
  }
  // Scale in the nodes above moves a camera and does not stretch its picture.
  const Vec3d back = world.col(2).head<3>().normalized();
  const Vec3d right = Vec3d(world.col(1).head<3>()).cross(back).normalized();
  Mat4d rigid = world;
  rigid.topLeftCorner<3, 3>() << right, back.cross(right), back;
  if (!rigid.allFinite() || std::abs(rigid.determinant() - 1.0) > 1e-6) {
    diagnosis_.add(Severity::Warning, "camera-ignored", 1,
                   "cameras have no valid transform and were left out", camera.name);
    return;
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
    return bad("holds no triangles; Lambent needs a surface to bake");
  }
  result_.loaded.scene.origin = originOf(document_);
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
