#include "lambent/scene_io/obj.h"

#include <charconv>
#include <map>
#include <set>
#include <string>
#include <unordered_map>

#include "lambent/radiometry/srgb.h"
#include "lambent/scene_io/diagnosis.h"
#include "lambent/scene_io/far_origin.h"
#include "lambent/scene_io/linked_files.h"
#include "lambent/scene_io/mesh_bytes.h"
#include "lambent/scene_io/mtl.h"
#include "lambent/scene_io/polygon.h"
#include "lambent/scene_io/text_cursor.h"

namespace lambent::scene_io {
namespace {

/// What one corner of a face refers to, from 0; −1: nothing.
struct Corner {
  std::int32_t position = -1, uv = -1, normal = -1;
  bool operator==(const Corner&) const = default;
};

struct CornerHash {
  std::size_t operator()(const Corner& c) const {
    std::uint64_t h = std::uint32_t(c.position);
    h = h * 0x9e3779b97f4a7c15ull ^ std::uint32_t(c.uv);
    h = h * 0x9e3779b97f4a7c15ull ^ std::uint32_t(c.normal);
    return std::size_t(h ^ h >> 29);
  }
};

/// The faces of one object with one material.
struct Part {
  std::string object, material;
  std::vector<Corner> corners;
  std::vector<std::uint32_t> sizes;  ///< corners of each face
  std::size_t firstLine = 0;
};

class ObjReader {
 public:
  ObjReader(const std::filesystem::path& path, const LoadOptions& options)
      : path_(path), name_(path.string()), files_(path, options) {}

  Result<LoadedScene> read();

 private:
  Error bad(std::size_t line, const std::string& message) const {
    return report::badInput(name_ + ", line " + std::to_string(line) + ": " + message);
  }
  Status readLines(std::string_view text);
  Status readVertex(TextCursor& cursor);
  Status readFace(TextCursor& cursor);
  std::optional<Error> readIndex(const char*& p, const char* end, std::size_t count,
                                 const char* kind, std::size_t line, std::int32_t& index) const;
  Status readLibrary(const std::string& name);
  Status readLibraries(std::string_view names);
  Part& part();
  Result<scene::Mesh> build(const Part& part, std::vector<std::uint32_t>& groups) const;
  int materialOf(const Part& part);
  DoubleBox usedBox() const;

  std::filesystem::path path_;
  std::string name_;
  LinkedFiles files_;
  std::set<std::filesystem::path> libraries_;  ///< read already
  std::vector<Vec3d> positions_;
  std::vector<Vec3> normals_;
  std::vector<Vec2> uvs_;
  std::vector<Rgb> colors_;  ///< as many as positions, or empty
  std::string object_, material_;
  std::map<std::pair<std::string, std::string>, std::size_t> partIndex_;
  std::vector<Part> parts_;
  Part* current_ = nullptr;
  std::map<std::string, int, std::less<>> materials_;
  std::size_t faces_ = 0;
  scene::Scene scene_;
  Diagnosis diagnosis_;
};

Part& ObjReader::part() {
  if (current_ == nullptr) {
    const auto [entry, isNew] = partIndex_.try_emplace({object_, material_}, parts_.size());
    if (isNew) parts_.push_back({object_, material_, {}, {}, 0});
    current_ = &parts_[entry->second];
  }
  return *current_;
}

Status ObjReader::readVertex(TextCursor& cursor) {
  double values[7];
  int count = 0;
  while (count < 7) {
    const auto value = cursor.number();
    if (!value) break;
    values[count++] = *value;
  }
  if (count < 3 || (count < 7 && !cursor.rest().empty())) {
    return bad(cursor.line(), "a vertex needs three numbers; the file is damaged");
  }
  positions_.emplace_back(values[0], values[1], values[2]);
  if (count >= 6) {
    colors_.resize(positions_.size() - 1, Rgb::Ones());
    const double* c = values + (count == 7 ? 4 : 3);
    colors_.push_back(Rgb(radiometry::srgbDecode(float(c[0])), radiometry::srgbDecode(float(c[1])),
                          radiometry::srgbDecode(float(c[2]))));
  } else if (!colors_.empty()) {
    colors_.push_back(Rgb::Ones());
  }
  return Status::ok();
}

/// Parses one index of a corner: from 1 upwards, or from −1 downwards counted from the last element
/// read so far.
std::optional<Error> ObjReader::readIndex(const char*& p, const char* end, std::size_t count,
                                          const char* kind, std::size_t line,
                                          std::int32_t& index) const {
  std::int64_t value = 0;
  const auto [stop, error] = std::from_chars(p, end, value);
  if (error != std::errc()) {
    return bad(line, "a face has a corner that is no index; the file is damaged");
  }
  p = stop;
  const std::int64_t place = value < 0 ? std::int64_t(count) + value : value - 1;
  if (place < 0 || place > 0x7ffffffe || value == 0) {
    return bad(line, "face " + std::to_string(faces_) + " refers to " + kind + " " +
                         std::to_string(value) + ", which does not exist; export the file again");
  }
  index = std::int32_t(place);
  return {};
}

Status ObjReader::readFace(TextCursor& cursor) {
  Part& target = part();
  const std::size_t line = cursor.line();
  std::uint32_t count = 0;
  for (std::string_view word = cursor.word(); !word.empty() && word[0] != '#';
       word = cursor.word()) {
    const char *p = word.data(), *end = p + word.size();
    Corner corner;
    auto error = readIndex(p, end, positions_.size(), "vertex", line, corner.position);
    if (!error && p != end && *p == '/') {
      ++p;
      if (p != end && *p != '/') error = readIndex(p, end, uvs_.size(), "vt", line, corner.uv);
      if (!error && p != end && *p == '/') {
        ++p;
        if (p != end) error = readIndex(p, end, normals_.size(), "vn", line, corner.normal);
      }
    }
    if (error) return *error;
    if (p != end) return bad(line, "a face has a corner that is no index; the file is damaged");
    target.corners.push_back(corner);
    ++count;
  }
  if (count < 3) {
    diagnosis_.add(Severity::Warning, "small-faces", 1,
                   "faces have fewer than three corners and were left out",
                   "line " + std::to_string(line));
    target.corners.resize(target.corners.size() - count);
  } else {
    if (target.sizes.empty()) target.firstLine = line;
    target.sizes.push_back(count);
  }
  ++faces_;
  return Status::ok();
}

Status ObjReader::readLibrary(const std::string& name) {
  return readMtl(path_.parent_path() / name, scene_, materials_, libraries_, files_, diagnosis_);
}

Status ObjReader::readLibraries(std::string_view names) {
  std::error_code error;
  // A name may have blanks, and a line may have several names.
  if (std::filesystem::exists(path_.parent_path() / std::string(names), error)) {
    return readLibrary(std::string(names));
  }
  TextCursor words(names);
  words.nextLine();
  for (std::string_view word = words.word(); !word.empty(); word = words.word()) {
    if (Status status = readLibrary(std::string(word)); !status) return status;
  }
  return Status::ok();
}

Status ObjReader::readLines(std::string_view text) {
  TextCursor cursor(text, TextCursor::Joining::Backslash);
  Status status = Status::ok();
  while (status && cursor.nextLine()) {
    const std::string_view key = cursor.word();
    if (key.empty() || key[0] == '#') continue;
    if (key == "v") {
      status = readVertex(cursor);
    } else if (key == "vn") {
      const auto x = cursor.number(), y = cursor.number(), z = cursor.number();
      if (!x || !y || !z) return bad(cursor.line(), "a normal needs three numbers");
      normals_.emplace_back(float(*x), float(*y), float(*z));
    } else if (key == "vt") {
      const auto u = cursor.number(), v = cursor.number();
      if (!u) return bad(cursor.line(), "a texture coordinate needs a number");
      // OBJ counts v from the bottom of the image, glTF from its top.
      uvs_.emplace_back(float(*u), 1.0f - float(v.value_or(0.0)));
    } else if (key == "f" || key == "fo") {
      status = readFace(cursor);
    } else if (key == "o") {
      object_ = cursor.rest();
      current_ = nullptr;
    } else if (key == "usemtl") {
      material_ = cursor.rest();
      current_ = nullptr;
    } else if (key == "mtllib") {
      status = readLibraries(cursor.rest());
    } else if (key == "l" || key == "p" || key == "curv" || key == "surf") {
      diagnosis_.add(Severity::Note, "no-triangles", 1,
                     "points, lines and free-form elements were left out",
                     "line " + std::to_string(cursor.line()));
    }
  }
  return status;
}

/// A mesh with one vertex for each distinct corner. `groups` are the positions' numbers: made
/// normals are smooth across seams of the texture.
Result<scene::Mesh> ObjReader::build(const Part& part, std::vector<std::uint32_t>& groups) const {
  scene::Mesh mesh;
  mesh.name = part.object;
  std::unordered_map<Corner, std::uint32_t, CornerHash> known;
  std::vector<Vec3d> polygon;
  std::vector<std::uint32_t> ids;
  std::vector<scene::Triangle> cut;
  bool anyUv = false, anyNormal = false;
  std::size_t first = 0;
  for (std::size_t face = 0; face < part.sizes.size(); ++face) {
    polygon.clear(), ids.clear(), cut.clear();
    for (std::size_t i = first; i < first + part.sizes[face]; ++i) {
      const Corner& corner = part.corners[i];
      const auto check = [&](std::int32_t index, std::size_t count) {
        return index < 0 || std::size_t(index) < count;
      };
      if (!check(corner.position, positions_.size()) || !check(corner.uv, uvs_.size()) ||
          !check(corner.normal, normals_.size())) {
        const bool vertex = !check(corner.position, positions_.size());
        const bool uv = !vertex && !check(corner.uv, uvs_.size());
        return report::badInput(
            name_ + ": face " + std::to_string(face) + " of " +
            (part.object.empty() ? "the file" : "object \"" + part.object + "\"") + " (from line " +
            std::to_string(part.firstLine) + ") refers to " +
            (vertex ? "vertex "
             : uv   ? "vt "
                    : "vn ") +
            std::to_string((vertex ? corner.position
                            : uv   ? corner.uv
                                   : corner.normal) +
                           1) +
            " of " +
            std::to_string(vertex ? positions_.size()
                           : uv   ? uvs_.size()
                                  : normals_.size()) +
            "; export the file again");
      }
      const auto [entry, isNew] = known.try_emplace(corner, std::uint32_t(mesh.positions.size()));
      if (isNew) {
        mesh.positions.push_back((positions_[corner.position] - scene_.origin).cast<float>());
        // Zero stands for "none here"; finishMesh makes a normal there.
        mesh.normals.push_back(corner.normal < 0 ? Vec3(Vec3::Zero()) : normals_[corner.normal]);
        mesh.uvs.push_back(corner.uv < 0 ? Vec2(Vec2::Zero()) : uvs_[corner.uv]);
        if (!colors_.empty()) mesh.colors.push_back(colors_[corner.position]);
        groups.push_back(std::uint32_t(corner.position));
        anyUv = anyUv || corner.uv >= 0;
        anyNormal = anyNormal || corner.normal >= 0;
      }
      ids.push_back(entry->second);
      polygon.push_back(positions_[corner.position]);
    }
    first += part.sizes[face];
    cutPolygon(polygon, cut);
    for (const auto& [a, b, c] : cut) mesh.triangles.push_back({ids[a], ids[b], ids[c]});
  }
  if (!anyUv) mesh.uvs.clear();
  if (!anyNormal) mesh.normals.clear();
  return mesh;
}

/// Of the positions that faces use. Indices that do not exist are build()'s to refuse.
DoubleBox ObjReader::usedBox() const {
  std::vector<bool> used(positions_.size());
  for (const Part& part : parts_) {
    for (const Corner& corner : part.corners) {
      if (std::size_t(corner.position) < used.size()) used[std::size_t(corner.position)] = true;
    }
  }
  DoubleBox box;
  for (std::size_t i = 0; i < used.size(); ++i) {
    if (used[i]) box.extend(positions_[i]);
  }
  return box;
}

int ObjReader::materialOf(const Part& part) {
  const auto [entry, isNew] = materials_.try_emplace(part.material, int(scene_.materials.size()));
  if (isNew) {
    scene::Material material;
    material.name = part.material;
    if (!colors_.empty()) material.diffuse = Rgb::Ones();
    scene_.materials.push_back(std::move(material));
    diagnosis_.add(Severity::Note, "no-material", 1,
                   colors_.empty()
                       ? "default material was used: diffuse grey of 80%"
                       : "default material was used: white diffuse under vertex colours",
                   part.material);
  }
  return entry->second;
}

Result<LoadedScene> ObjReader::read() {
  const Result<std::vector<std::byte>> bytes = files_.readScene();
  if (!bytes) return bytes.error();
  if (Status status = readLines(asText(*bytes)); !status) return status.error();
  scene_.origin = farOrigin(usedBox());
  noteFarOrigin(scene_.origin, diagnosis_);

  for (const Part& part : parts_) {
    if (part.sizes.empty()) continue;
    std::vector<std::uint32_t> groups;
    Result<scene::Mesh> mesh = build(part, groups);
    if (!mesh) return mesh.error();
    mesh->material = materialOf(part);
    if (mesh->name.empty()) mesh->name = part.material;
    const std::string place = mesh->name.empty() ? "the mesh" : "mesh \"" + mesh->name + "\"";
    FinishOptions finish;
    finish.front = Front::Normals;
    finish.groups = groups;
    finish.crease = files_.options().crease;
    if (Status status = finishMesh(*mesh, finish, name_, place, diagnosis_); !status) {
      return status.error();
    }
    if (mesh->triangles.empty()) continue;
    if (Status fits = files_.budget().hold(bytesOf(*mesh), name_ + ": " + place); !fits) {
      return fits.error();
    }
    scene_.meshes.push_back(std::move(*mesh));
  }
  if (scene_.meshes.empty()) {
    return report::badInput(name_ + ": holds no triangles" +
                            (positions_.empty() ? "; it may not be an OBJ file"
                                                : ", only vertices; export it with its faces"));
  }
  return LoadedScene{std::move(scene_), diagnosis_.findings(), files_.noted()};
}

}  // namespace

Result<LoadedScene> loadObj(const std::filesystem::path& path, const LoadOptions& options) {
  return ObjReader(path, options).read();
}

}  // namespace lambent::scene_io
