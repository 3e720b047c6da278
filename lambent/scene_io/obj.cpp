#include "lambent/scene_io/obj.h"

#include <map>
#include <string>
#include <unordered_map>

#include "lambent/scene_io/diagnosis.h"
#include "lambent/scene_io/far_origin.h"
#include "lambent/scene_io/linked_files.h"
#include "lambent/scene_io/mesh_bytes.h"
#include "lambent/scene_io/mtl.h"
#include "lambent/scene_io/obj_text.h"
#include "lambent/scene_io/polygon.h"
#include "lambent/scene_io/text_file.h"
#include "lambent/scene_io/two_sides.h"
#include "lambent/scene_io/vertex_colors.h"

namespace lambent::scene_io {
namespace {

struct CornerHash {
  std::size_t operator()(const ObjCorner& c) const {
    std::uint64_t h = std::uint64_t(std::uint32_t(c.normal)) << 32 | std::uint32_t(c.smoothing);
    h = h * 0x9e3779b97f4a7c15ull ^
        (std::uint64_t(std::uint32_t(c.uv)) << 32 | std::uint32_t(c.position));
    h *= 0x9e3779b97f4a7c15ull;
    return std::size_t(h ^ h >> 29);
  }
};

class ObjReader {
 public:
  ObjReader(const std::filesystem::path& path, const LoadOptions& options)
      : path_(path),
        name_(path.string()),
        files_(path, options),
        finder_(files_),
        materials_(scene_, files_, finder_, diagnosis_) {}

  Result<LoadedScene> read();

 private:
  Status readLibraries(const std::string& names);
  Status addMesh(const ObjPart& part);
  /// A mesh with one vertex for each distinct corner. `groups` number the positions and what is
  /// smooth there: made normals are smooth across seams of the texture.
  Result<scene::Mesh> build(const ObjPart& part, const UvTransform& uv,
                            std::vector<std::uint32_t>& groups);
  Error noElement(const ObjPart& part, std::size_t face, const ObjCorner& corner) const;
  bool exists(const ObjCorner& corner) const;
  int materialOf(const ObjPart& part);
  DoubleBox usedBox() const;

  std::filesystem::path path_;
  std::string name_;
  LinkedFiles files_;
  FileFinder finder_;
  ObjText text_;
  float white_ = 1.0f;                   ///< of vertex colours
  std::map<std::string, int> defaults_;  ///< names of materials that no library has
  scene::Scene scene_;
  Diagnosis diagnosis_;
  MtlReader materials_;
};

Status ObjReader::readLibraries(const std::string& names) {
  const std::filesystem::path folder = path_.parent_path();
  const auto read = [&](std::string_view name) {
    FileFinder::Found found = finder_.find(folder, name, folder);
    if (!found.exists) {  // an OBJ is renamed with its library, and does not get to know it
      FileFinder::Found own = finder_.find(folder, path_.stem().string() + ".mtl", folder);
      own.elsewhere = true;
      if (own.exists) found = std::move(own);
    }
    if (found.exists && found.elsewhere) {
      diagnosis_.add(Severity::Note, "file-found-beside", 1,
                     "files were not where their names say; those of the same name beside the "
                     "scene were read",
                     found.path.string());
    }
    return materials_.read(found.path, folder);
  };
  // A name may have blanks, and a line may have several names.
  const std::vector<std::string> several = libraryNames(names);
  if (several.size() < 2 || finder_.find(folder, names, folder).exists) {
    return read(several.size() == 1 ? several[0] : names);
  }
  for (const std::string& name : several) {
    if (Status status = read(name); !status) return status;
  }
  return Status::ok();
}

bool ObjReader::exists(const ObjCorner& corner) const {
  const auto check = [](std::int32_t index, std::size_t count) {
    return index < 0 || std::size_t(index) < count;
  };
  return check(corner.position, text_.positions.size()) && check(corner.uv, text_.uvs.size()) &&
         check(corner.normal, text_.normals.size());
}

Error ObjReader::noElement(const ObjPart& part, std::size_t face, const ObjCorner& corner) const {
  const auto beyond = [](std::int32_t index, std::size_t count) {
    return index >= 0 && std::size_t(index) >= count;
  };
  const char* kind = "vn";
  std::int32_t index = corner.normal;
  std::size_t count = text_.normals.size();
  if (beyond(corner.position, text_.positions.size())) {
    kind = "vertex", index = corner.position, count = text_.positions.size();
  } else if (beyond(corner.uv, text_.uvs.size())) {
    kind = "vt", index = corner.uv, count = text_.uvs.size();
  }
  return report::badInput(name_ + ": face " + std::to_string(face) + " of " +
                          (part.object.empty() ? "the file" : "object \"" + part.object + "\"") +
                          " (from line " + std::to_string(part.firstLine) + ") refers to " + kind +
                          " " + std::to_string(index + 1) + " of " + std::to_string(count) +
                          "; export the file again");
}

Result<scene::Mesh> ObjReader::build(const ObjPart& part, const UvTransform& uv,
                                     std::vector<std::uint32_t>& groups) {
  scene::Mesh mesh;
  mesh.name = part.object;
  std::unordered_map<ObjCorner, std::uint32_t, CornerHash> known;
  known.reserve(part.corners.size() / 4);  // of a closed surface of triangles it is a sixth
  std::map<std::pair<std::int32_t, std::int32_t>, std::uint32_t> smoothed;
  std::vector<Vec3d> polygon;
  std::vector<std::uint32_t> ids;
  std::vector<scene::Triangle> cut;
  bool anyUv = false, anyNormal = false;
  auto next = std::uint32_t(text_.positions.size());  // groups that are no position's
  const auto groupOf = [&](const ObjCorner& corner) {
    if (corner.smoothing == -1) return std::uint32_t(corner.position);
    if (corner.smoothing < -1) return next++;  // a face's own
    const auto [entry, isNew] = smoothed.try_emplace({corner.position, corner.smoothing}, next);
    next += isNew;
    return entry->second;
  };
  const auto addVertex = [&](const ObjCorner& corner) {
    const auto position = std::size_t(corner.position);
    mesh.positions.push_back((text_.positions[position] - scene_.origin).cast<float>());
    // Zero stands for "none here"; finishMesh makes a normal there.
    mesh.normals.push_back(corner.normal < 0 ? Vec3(Vec3::Zero()) : text_.normals[corner.normal]);
    mesh.uvs.push_back(corner.uv < 0 ? Vec2(Vec2::Zero()) : uv.apply(text_.uvs[corner.uv]));
    if (!text_.colors.empty()) {
      const Rgb& color = text_.colors[position];
      mesh.colors.push_back((color < 0.0f).all() ? Rgb(Rgb::Ones()) : linearColor(color, white_));
    }
    groups.push_back(groupOf(corner));
    anyUv = anyUv || corner.uv >= 0;
    anyNormal = anyNormal || corner.normal >= 0;
  };
  std::size_t first = 0, crossing = 0;
  for (std::size_t face = 0; face < part.sizes.size(); ++face) {
    polygon.clear(), ids.clear(), cut.clear();
    for (std::size_t i = first; i < first + part.sizes[face]; ++i) {
      const ObjCorner& corner = part.corners[i];
      if (!exists(corner)) return noElement(part, face, corner);
      const auto [entry, isNew] = known.try_emplace(corner, std::uint32_t(mesh.positions.size()));
      if (isNew) addVertex(corner);
      ids.push_back(entry->second);
    }
    first += part.sizes[face];
    if (ids.size() == 3) {
      mesh.triangles.push_back({ids[0], ids[1], ids[2]});
      continue;
    }
    for (std::size_t i = first - ids.size(); i < first; ++i) {
      polygon.push_back(text_.positions[std::size_t(part.corners[i].position)]);
    }
    crossing += !cutPolygon(polygon, cut);
    for (const auto& [a, b, c] : cut) mesh.triangles.push_back({ids[a], ids[b], ids[c]});
  }
  noteCrossing(crossing, diagnosis_);
  if (!anyUv) mesh.uvs.clear();
  if (!anyNormal) mesh.normals.clear();
  return mesh;
}

/// Of the positions that faces use. Indices that do not exist are build()'s to refuse.
DoubleBox ObjReader::usedBox() const {
  std::vector<bool> used(text_.positions.size());
  for (const ObjPart& part : text_.parts) {
    for (const ObjCorner& corner : part.corners) {
      if (std::size_t(corner.position) < used.size()) used[std::size_t(corner.position)] = true;
    }
  }
  DoubleBox box;
  for (std::size_t i = 0; i < used.size(); ++i) {
    if (used[i]) box.extend(text_.positions[i]);
  }
  return box;
}

int ObjReader::materialOf(const ObjPart& part) {
  if (const int known = materials_.find(part.material); known >= 0) return known;
  const auto [entry, isNew] = defaults_.try_emplace(part.material, int(scene_.materials.size()));
  if (isNew) {
    const bool colored = !text_.colors.empty();
    scene::Material material;
    material.name = part.material;
    if (colored) material.diffuse = Rgb::Ones();
    scene_.materials.push_back(std::move(material));
    diagnosis_.add(Severity::Note, "no-material", 1,
                   colored ? "default material was used: white diffuse under vertex colours"
                           : "default material was used: diffuse grey of 80%",
                   part.material);
  }
  return entry->second;
}

Status ObjReader::addMesh(const ObjPart& part) {
  std::vector<std::uint32_t> groups;
  const int material = materialOf(part);
  Result<scene::Mesh> mesh = build(part, materials_.uvOf(material), groups);
  if (!mesh) return mesh.error();
  mesh->material = material;
  if (mesh->name.empty()) mesh->name = part.material;
  const std::string place = mesh->name.empty() ? "the mesh" : "mesh \"" + mesh->name + "\"";
  FinishOptions finish;
  finish.front = Front::Normals;
  finish.groups = groups;
  finish.crease = files_.options().crease;
  if (Status status = finishMesh(*mesh, finish, name_, place, diagnosis_); !status) return status;
  if (mesh->triangles.empty()) return Status::ok();
  if (Status fits = files_.budget().hold(bytesOf(*mesh), name_ + ": " + place); !fits) return fits;
  scene_.meshes.push_back(std::move(*mesh));
  return Status::ok();
}

Result<LoadedScene> ObjReader::read() {
  const Result<std::vector<std::byte>> bytes = files_.readScene();
  if (!bytes) return bytes.error();
  const Result<std::string_view> text = textOf(*bytes, name_);
  if (!text) return text.error();
  Result<ObjText> read = readObjText(*text, name_, diagnosis_);
  if (!read) return read.error();
  text_ = std::move(*read);
  for (const std::string& names : text_.libraries) {
    if (Status status = readLibraries(names); !status) return status.error();
  }
  materials_.dropParts();
  scene_.origin = farOrigin(usedBox());
  noteFarOrigin(scene_.origin, diagnosis_);
  white_ = whiteOf(text_.colors);
  noteWhite(white_, diagnosis_);
  for (const ObjPart& part : text_.parts) {
    if (part.sizes.empty()) continue;
    if (Status status = addMesh(part); !status) return status.error();
  }
  if (scene_.meshes.empty()) {
    return report::badInput(name_ + ": holds no triangles" +
                            (text_.positions.empty()
                                 ? "; it may not be an OBJ file"
                                 : ", only vertices; export it with its faces"));
  }
  const auto given = giveBacks(scene_, files_.options().sides, name_, files_.budget(), diagnosis_);
  if (!given) return given.error();
  return LoadedScene{std::move(scene_), diagnosis_.findings(), files_.noted()};
}

}  // namespace

Result<LoadedScene> loadObj(const std::filesystem::path& path, const LoadOptions& options) {
  return ObjReader(path, options).read();
}

}  // namespace lambent::scene_io
