#include "lambent/scene_io/ply.h"

#include <algorithm>
#include <numeric>
#include <span>
#include <string>
#include <unordered_map>

#include "lambent/scene_io/diagnosis.h"
#include "lambent/scene_io/far_origin.h"
#include "lambent/scene_io/file_finder.h"
#include "lambent/scene_io/linked_files.h"
#include "lambent/scene_io/mesh_bytes.h"
#include "lambent/scene_io/mtl.h"
#include "lambent/scene_io/ply_data.h"
#include "lambent/scene_io/text_file.h"
#include "lambent/scene_io/two_sides.h"
#include "lambent/scene_io/vertex_colors.h"

namespace lambent::scene_io {
namespace {

/// A vertex as a corner of a triangle has it.
struct PlyCorner {
  std::uint32_t vertex = 0;
  Vec2 uv = Vec2::Zero();
  Rgb color = Rgb::Zero();
  bool operator==(const PlyCorner& other) const {
    return vertex == other.vertex && uv == other.uv && (color == other.color).all();
  }
};

struct PlyCornerHash {
  std::size_t operator()(const PlyCorner& c) const {
    std::size_t h = c.vertex;
    for (const float value : {c.uv.x(), c.uv.y(), c.color.x(), c.color.y(), c.color.z()}) {
      h = h * 0x9e3779b97f4a7c15ull ^ std::hash<float>()(value);
    }
    return h ^ h >> 29;
  }
};

class PlyReader {
 public:
  PlyReader(const std::filesystem::path& path, const PlyHeader& header, LinkedFiles& files)
      : path_(path), name_(path.string()), header_(header), files_(files) {}

  Result<LoadedScene> read(PlyBody body);

 private:
  Error bad(const std::string& message) const { return report::badInput(name_ + ": " + message); }
  /// What was subtracted from the positions.
  Vec3d originOf() const;
  std::vector<Rgb> linearColors(const PlyColors& colors);
  /// The vertices as they are, or for each texture those of its triangles, one for each distinct
  /// corner. `groups` are the vertices' numbers.
  scene::Mesh wholeMesh();
  scene::Mesh meshOf(std::span<const std::uint32_t> triangles, std::vector<std::uint32_t>& groups);
  Status addMeshes();
  Status addMesh(scene::Mesh mesh, const std::vector<std::uint32_t>& groups, int texture);
  Result<int> materialWith(int texture, bool hasUvs, bool hasColors);
  void tellHeader();

  std::filesystem::path path_;
  std::string name_;
  const PlyHeader& header_;
  LinkedFiles& files_;
  PlyData data_;
  std::vector<Rgb> colors_, faceColors_;  ///< linear
  LoadedScene loaded_;
  Diagnosis diagnosis_;
};

Vec3d PlyReader::originOf() const {
  std::vector<bool> used(data_.positions.size());
  for (const scene::Triangle& triangle : data_.triangles) {
    for (std::uint32_t vertex : triangle) used[vertex] = true;
  }
  DoubleBox box;
  for (std::size_t i = 0; i < used.size(); ++i) {
    if (used[i]) box.extend(data_.positions[i]);
  }
  return farOrigin(box);
}

/// Integers are sRGB; floats are linear, unless they are counted beyond 1.
std::vector<Rgb> PlyReader::linearColors(const PlyColors& colors) {
  std::vector<Rgb> linear = colors.values;
  if (linear.empty()) return linear;
  float white = 255.0f;
  if (isFloat(colors.type)) {
    white = whiteOf(linear);
    noteWhite(white, diagnosis_);
    if (white == 1.0f) return linear;
  } else if (sizeOf(colors.type) > 1) {
    white = whiteOfIntegers(linear);
  }
  for (Rgb& color : linear) {
    // Bytes that were declared as signed.
    if (colors.type == PlyType::Int8) color = (color < 0.0f).select(color + 256.0f, color);
    color = linearColor(color, white);
  }
  return linear;
}

scene::Mesh PlyReader::wholeMesh() {
  scene::Mesh mesh;
  mesh.positions.reserve(data_.positions.size());
  for (const Vec3d& p : data_.positions) {
    mesh.positions.push_back((p - loaded_.scene.origin).cast<float>());
  }
  mesh.normals = std::move(data_.normals);
  mesh.uvs = std::move(data_.uvs);
  mesh.colors = std::move(colors_);
  mesh.triangles = std::move(data_.triangles);
  return mesh;
}

scene::Mesh PlyReader::meshOf(std::span<const std::uint32_t> triangles,
                              std::vector<std::uint32_t>& groups) {
  scene::Mesh mesh;
  std::unordered_map<PlyCorner, std::uint32_t, PlyCornerHash> known;
  const auto vertexOf = [&](const PlyCorner& corner) {
    const auto [entry, isNew] = known.try_emplace(corner, std::uint32_t(groups.size()));
    if (!isNew) return entry->second;
    const std::uint32_t v = corner.vertex;
    groups.push_back(v);
    mesh.positions.push_back((data_.positions[v] - loaded_.scene.origin).cast<float>());
    if (!data_.normals.empty()) mesh.normals.push_back(data_.normals[v]);
    if (!data_.cornerUvs.empty() || !data_.uvs.empty()) mesh.uvs.push_back(corner.uv);
    if (!colors_.empty() || !faceColors_.empty()) mesh.colors.push_back(corner.color);
    return entry->second;
  };
  for (const std::uint32_t t : triangles) {
    scene::Triangle triangle;
    for (std::size_t i = 0; i < 3; ++i) {
      PlyCorner corner{data_.triangles[t][i]};
      if (!data_.cornerUvs.empty()) {
        corner.uv = data_.cornerUvs[t][i];
      } else if (!data_.uvs.empty()) {
        corner.uv = data_.uvs[corner.vertex];
      }
      if (!corner.uv.allFinite()) corner.uv = Vec2::Zero();  // not a number is not even itself
      if (!faceColors_.empty()) {
        corner.color = faceColors_[t];
      } else if (!colors_.empty()) {
        corner.color = colors_[corner.vertex];
      }
      if (!corner.color.isFinite().all()) corner.color = Rgb::Ones();
      triangle[i] = vertexOf(corner);
    }
    mesh.triangles.push_back(triangle);
  }
  return mesh;
}

Result<int> PlyReader::materialWith(int texture, bool hasUvs, bool hasColors) {
  scene::Scene& scene = loaded_.scene;
  scene::Material material;
  if (std::size_t(texture) < header_.textureFiles.size()) {
    const std::string& picture = header_.textureFiles[std::size_t(texture)];
    const std::filesystem::path folder = path_.parent_path();
    const FileFinder::Found found = FileFinder(files_).find(folder, picture, folder);
    files_.note(found.path);
    if (hasUvs) {
      const Result<int> read = readTextureFile(found, scene, files_, diagnosis_);
      if (!read) return read.error();
      material.baseColorTexture = *read;
    } else {
      diagnosis_.lose(Severity::Warning, "texture-without-uvs", 1,
                      "textures were left out: there are no texture coordinates to place them",
                      picture);
    }
  }
  if (hasColors || material.baseColorTexture >= 0) material.diffuse = Rgb::Ones();
  scene.materials.push_back(std::move(material));
  return int(scene.materials.size() - 1);
}

Status PlyReader::addMesh(scene::Mesh mesh, const std::vector<std::uint32_t>& groups, int texture) {
  mesh.name = path_.stem().string();
  if (!data_.textures.empty() && texture > 0) mesh.name += "/" + std::to_string(texture);
  const bool hasUvs = !mesh.uvs.empty(), hasColors = !mesh.colors.empty();
  FinishOptions finish;
  finish.front = Front::Normals;
  finish.crease = files_.options().crease;
  finish.groups = groups;
  if (Status status = finishMesh(mesh, finish, name_, "the mesh", diagnosis_); !status) {
    return status;
  }
  if (mesh.triangles.empty()) return Status::ok();
  const Result<int> material = materialWith(texture, hasUvs, hasColors);
  if (!material) return material.error();
  mesh.material = *material;
  loaded_.scene.meshes.push_back(std::move(mesh));
  return Status::ok();
}

void PlyReader::tellHeader() {
  if (header_.skippedLines > 0) {
    diagnosis_.add(Severity::Note, "header-lines-skipped", header_.skippedLines,
                   "lines of the header are nothing that PLY knows and were skipped",
                   header_.firstSkipped);
  }
  if (header_.textureFiles.size() > 1 && data_.textures.empty()) {
    diagnosis_.lose(Severity::Warning, "textures-ignored", header_.textureFiles.size() - 1,
                    "textures were left out: faces do not say (texnumber) which is theirs, and "
                    "have the first");
  }
}

Status PlyReader::addMeshes() {
  if (data_.cornerUvs.empty() && faceColors_.empty() && data_.textures.empty()) {
    return addMesh(wholeMesh(), {}, 0);
  }
  std::vector<std::uint32_t> order(data_.triangles.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto textureOf = [&](std::uint32_t t) {
    return data_.textures.empty() ? 0 : data_.textures[t];
  };
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return textureOf(a) < textureOf(b); });
  for (std::size_t first = 0, last = 0; first < order.size(); first = last) {
    const int texture = textureOf(order[first]);
    while (last < order.size() && textureOf(order[last]) == texture) ++last;
    std::vector<std::uint32_t> groups;
    scene::Mesh mesh = meshOf(std::span(order).subspan(first, last - first), groups);
    if (Status fits = files_.budget().hold(bytesOf(mesh), name_ + ": the mesh"); !fits) return fits;
    if (Status added = addMesh(std::move(mesh), groups, texture); !added) return added;
  }
  return Status::ok();
}

Result<LoadedScene> PlyReader::read(PlyBody body) {
  Result<PlyData> data = readPlyData(header_, body, name_, files_.budget(), diagnosis_);
  if (!data) return data.error();
  data_ = std::move(*data);
  if (data_.triangles.empty()) {
    return bad(data_.positions.empty()
                   ? "holds no triangles"
                   : "holds " + std::to_string(data_.positions.size()) +
                         " points and no triangles; reconstruct a surface first");
  }
  tellHeader();
  loaded_.scene.origin = originOf();
  noteFarOrigin(loaded_.scene.origin, diagnosis_);
  colors_ = linearColors(data_.colors);
  faceColors_ = linearColors(data_.faceColors);
  if (!colors_.empty() && !faceColors_.empty()) {
    diagnosis_.lose(Severity::Note, "face-colors-ignored", faceColors_.size(),
                    "triangles have a colour of their own besides those of their vertices, which "
                    "are taken");
    faceColors_.clear();
  }
  const Status added = addMeshes();
  if (!added) return added.error();
  if (loaded_.scene.meshes.empty()) return bad("all its triangles are without area");
  const auto given =
      giveBacks(loaded_.scene, files_.options().sides, name_, files_.budget(), diagnosis_);
  if (!given) return given.error();
  loaded_.findings = diagnosis_.findings();
  loaded_.linkedFiles = files_.noted();
  return std::move(loaded_);
}

}  // namespace

Result<LoadedScene> loadPly(const std::filesystem::path& path, const LoadOptions& options) {
  LinkedFiles files(path, options);
  const Result<std::vector<std::byte>> bytes = files.readScene();
  if (!bytes) return bytes.error();
  const Result<std::string_view> text = textOf(*bytes, path.string());
  if (!text) return text.error();
  const Result<PlyHeader> header = readPlyHeader(*text, path.string());
  if (!header) return header.error();
  return PlyReader(path, *header, files).read(PlyBody(text->substr(header->size), header->format));
}

}  // namespace lambent::scene_io
