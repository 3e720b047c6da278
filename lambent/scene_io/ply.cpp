#include "lambent/scene_io/ply.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <string>

#include "lambent/radiometry/srgb.h"
#include "lambent/scene_io/diagnosis.h"
#include "lambent/scene_io/far_origin.h"
#include "lambent/scene_io/linked_files.h"
#include "lambent/scene_io/mtl.h"
#include "lambent/scene_io/ply_header.h"
#include "lambent/scene_io/polygon.h"
#include "lambent/scene_io/text_cursor.h"
#include "lambent/scene_io/text_number.h"

namespace lambent::scene_io {
namespace {

/// Numbers from the body, one after another. Every read is checked against the end; after the
/// first failure all reads yield 0 and ok() is false.
class Body {
 public:
  Body(std::string_view bytes, PlyFormat format)
      : at_(bytes.data()),
        end_(at_ + bytes.size()),
        ascii_(format == PlyFormat::Ascii),
        swap_((format == PlyFormat::BinaryBig) != (std::endian::native == std::endian::big)) {}

  bool ok() const { return ok_; }
  bool ascii() const { return ascii_; }
  std::size_t left() const { return std::size_t(end_ - at_); }

  double number(PlyType type) { return ascii_ ? text() : binary(type); }

  /// Skips `size` bytes of a binary body.
  void skip(std::size_t size) {
    if (size > left()) {
      ok_ = false;
      at_ = end_;
    } else {
      at_ += size;
    }
  }

 private:
  double text() {
    while (at_ != end_ && static_cast<unsigned char>(*at_) <= ' ') ++at_;
    const std::optional<ParsedNumber> number = parseNumber(at_, end_);
    if (!number) {
      ok_ = false;
      at_ = end_;
      return 0.0;
    }
    at_ = number->end;
    return number->value;
  }

  template <class T>
  double raw() {
    if (left() < sizeof(T)) {
      ok_ = false;
      at_ = end_;
      return 0.0;
    }
    std::array<char, sizeof(T)> bytes;
    std::memcpy(bytes.data(), at_, sizeof(T));
    at_ += sizeof(T);
    if (swap_) std::reverse(bytes.begin(), bytes.end());
    return double(std::bit_cast<T>(bytes));
  }

  double binary(PlyType type) {
    switch (type) {
      case PlyType::Int8:
        return raw<std::int8_t>();
      case PlyType::Uint8:
        return raw<std::uint8_t>();
      case PlyType::Int16:
        return raw<std::int16_t>();
      case PlyType::Uint16:
        return raw<std::uint16_t>();
      case PlyType::Int32:
        return raw<std::int32_t>();
      case PlyType::Uint32:
        return raw<std::uint32_t>();
      case PlyType::Float32:
        return raw<float>();
      case PlyType::Float64:
        break;
    }
    return raw<double>();
  }

  const char *at_, *end_;
  bool ascii_, swap_, ok_ = true;
};

/// What a property of a vertex is for.
enum class Role { None, X, Y, Z, NX, NY, NZ, U, V, Red, Green, Blue };

Role roleOf(std::string_view name) {
  constexpr std::pair<std::string_view, Role> kRoles[] = {{"x", Role::X},
                                                          {"y", Role::Y},
                                                          {"z", Role::Z},
                                                          {"nx", Role::NX},
                                                          {"ny", Role::NY},
                                                          {"nz", Role::NZ},
                                                          {"s", Role::U},
                                                          {"t", Role::V},
                                                          {"u", Role::U},
                                                          {"v", Role::V},
                                                          {"texture_u", Role::U},
                                                          {"texture_v", Role::V},
                                                          {"s0", Role::U},
                                                          {"t0", Role::V},
                                                          {"red", Role::Red},
                                                          {"green", Role::Green},
                                                          {"blue", Role::Blue},
                                                          {"r", Role::Red},
                                                          {"g", Role::Green},
                                                          {"b", Role::Blue},
                                                          {"diffuse_red", Role::Red},
                                                          {"diffuse_green", Role::Green},
                                                          {"diffuse_blue", Role::Blue}};
  for (const auto& [known, role] : kRoles) {
    if (name == known) return role;
  }
  return Role::None;
}

class PlyReader {
 public:
  PlyReader(const std::filesystem::path& path, const PlyHeader& header, Body body,
            LinkedFiles& files)
      : path_(path), name_(path.string()), header_(header), body_(body), files_(files) {}

  Result<LoadedScene> read();

 private:
  Error bad(const std::string& message) const { return report::badInput(name_ + ": " + message); }
  Error truncated(const PlyElement& element, std::size_t index) const {
    return bad("the file is truncated or damaged in element " + element.name + " " +
               std::to_string(index) + " of " + std::to_string(element.count) +
               "; copy or export it again");
  }
  Status readVertices(const PlyElement& element);
  Status readFaces(const PlyElement& element);
  Status skip(const PlyElement& element);
  /// The length of a list whose items still have to follow in the body.
  Result<std::size_t> listLength(const PlyElement& element, const PlyProperty& property,
                                 std::size_t index);
  /// Makes the mesh's positions, far from the origin or not; returns what was subtracted.
  Vec3d placePositions();
  /// Makes triangles of the corners in list_.
  Status addFace(const PlyElement& element, std::size_t index);

  std::filesystem::path path_;
  std::string name_;
  const PlyHeader& header_;
  Body body_;
  LinkedFiles& files_;
  scene::Mesh mesh_;
  std::vector<double> list_;
  std::vector<Vec3d> positions_;  ///< as the file says them
  std::vector<Vec3d> polygon_;
  std::vector<scene::Triangle> cut_;
  Diagnosis diagnosis_;
};

Result<std::size_t> PlyReader::listLength(const PlyElement& element, const PlyProperty& property,
                                          std::size_t index) {
  const double length = body_.number(property.countType);
  const std::size_t itemSize = body_.ascii() ? 2 : sizeOf(property.type);
  // An ascii item takes a digit and a blank, the last one perhaps no blank.
  if (!body_.ok() || !(length >= 0.0) || length * double(itemSize) > double(body_.left()) + 1.0) {
    return truncated(element, index);
  }
  return std::size_t(length);
}

Status PlyReader::readVertices(const PlyElement& element) {
  std::vector<Role> roles;
  bool has[12] = {};
  bool integerColor = false;
  float colorScale = 1.0f;
  for (const PlyProperty& property : element.properties) {
    const Role role = property.isList ? Role::None : roleOf(property.name);
    roles.push_back(has[int(role)] ? Role::None : role);
    if (role == Role::Red && !isFloat(property.type)) {
      integerColor = true;
      colorScale = sizeOf(property.type) == 1 ? 1.0f / 255.0f : 1.0f / 65535.0f;
    }
    has[int(role)] = role != Role::None;
  }
  if (!has[int(Role::X)] || !has[int(Role::Y)] || !has[int(Role::Z)]) {
    return bad("its vertices have no x, y and z");
  }
  const bool normals = has[int(Role::NX)] && has[int(Role::NY)] && has[int(Role::NZ)];
  const bool uvs = has[int(Role::U)] && has[int(Role::V)];
  const bool colors = has[int(Role::Red)] && has[int(Role::Green)] && has[int(Role::Blue)];
  positions_.reserve(element.count);
  if (normals) mesh_.normals.reserve(element.count);
  if (uvs) mesh_.uvs.reserve(element.count);
  if (colors) mesh_.colors.reserve(element.count);

  for (std::size_t i = 0; i < element.count; ++i) {
    double values[12] = {};
    for (std::size_t p = 0; p < roles.size(); ++p) {
      const PlyProperty& property = element.properties[p];
      if (property.isList) {
        const Result<std::size_t> length = listLength(element, property, i);
        if (!length) return length.error();
        for (std::size_t k = 0; k < *length; ++k) body_.number(property.type);
      } else {
        values[int(roles[p])] = body_.number(property.type);
      }
    }
    if (!body_.ok()) return truncated(element, i);
    positions_.emplace_back(values[int(Role::X)], values[int(Role::Y)], values[int(Role::Z)]);
    const auto value = [&](Role role) { return float(values[int(role)]); };
    if (normals) mesh_.normals.emplace_back(value(Role::NX), value(Role::NY), value(Role::NZ));
    // As in OBJ, v counts from the bottom of the image.
    if (uvs) mesh_.uvs.emplace_back(value(Role::U), 1.0f - value(Role::V));
    if (colors) {
      const Rgb color(value(Role::Red), value(Role::Green), value(Role::Blue));
      const auto linear = [&](float c) { return radiometry::srgbDecode(c * colorScale); };
      mesh_.colors.push_back(
          integerColor ? Rgb(linear(color.x()), linear(color.y()), linear(color.z())) : color);
    }
  }
  return Status::ok();
}

Status PlyReader::addFace(const PlyElement& element, std::size_t index) {
  const bool strip = element.name == "tristrips";
  const auto face = [&] { return element.name + " " + std::to_string(index); };
  const std::size_t vertices = positions_.size();
  for (double item : list_) {
    if (strip && item == -1.0) continue;
    if (!(item >= 0.0) || item >= double(vertices)) {
      return bad(face() + " refers to vertex " +
                 std::to_string(std::int64_t(std::clamp(item, -9e18, 9e18))) + " of " +
                 std::to_string(vertices) + "; export the file again");
    }
  }
  const auto corner = [&](std::size_t i) { return std::uint32_t(list_[i]); };
  if (strip) {
    std::size_t start = 0;
    for (std::size_t i = 0; i <= list_.size(); ++i) {
      if (i < list_.size() && list_[i] != -1.0) continue;
      for (std::size_t k = start; k + 2 < i; ++k) {
        const std::size_t odd = (k - start) % 2;
        mesh_.triangles.push_back({corner(k), corner(k + 1 + odd), corner(k + 2 - odd)});
      }
      start = i + 1;
    }
    return Status::ok();
  }
  if (list_.size() == 3) {
    mesh_.triangles.push_back({corner(0), corner(1), corner(2)});
    return Status::ok();
  }
  if (list_.size() < 3) {
    diagnosis_.add(Severity::Warning, "small-faces", 1,
                   "faces have fewer than three corners and were left out", face());
    return Status::ok();
  }
  polygon_.clear(), cut_.clear();
  for (std::size_t i = 0; i < list_.size(); ++i) polygon_.push_back(positions_[corner(i)]);
  cutPolygon(polygon_, cut_);
  for (const auto& [a, b, c] : cut_) {
    mesh_.triangles.push_back({corner(a), corner(b), corner(c)});
  }
  return Status::ok();
}

Status PlyReader::readFaces(const PlyElement& element) {
  const bool strip = element.name == "tristrips";
  if (!strip) mesh_.triangles.reserve(std::min(element.count, body_.left()));
  for (std::size_t i = 0; i < element.count; ++i) {
    list_.clear();
    bool found = false;
    for (const PlyProperty& property : element.properties) {
      if (!property.isList) {
        body_.number(property.type);
        continue;
      }
      const Result<std::size_t> length = listLength(element, property, i);
      if (!length) return length.error();
      const bool wanted = property.name == "vertex_indices" || property.name == "vertex_index";
      found = found || wanted;
      for (std::size_t k = 0; k < *length; ++k) {
        const double item = body_.number(property.type);
        if (wanted) list_.push_back(item);
      }
    }
    if (!body_.ok()) return truncated(element, i);
    if (!found) return bad("its faces have no list vertex_indices");
    if (Status status = addFace(element, i); !status) {
      return status;
    }
  }
  return Status::ok();
}

Status PlyReader::skip(const PlyElement& element) {
  const bool plain = std::none_of(element.properties.begin(), element.properties.end(),
                                  [](const PlyProperty& p) { return p.isList; });
  if (element.properties.empty()) return Status::ok();
  if (plain && !body_.ascii()) {
    std::size_t size = 0;
    for (const PlyProperty& property : element.properties) size += sizeOf(property.type);
    body_.skip(size * element.count);  // the header's check bounds the product
    return body_.ok() ? Status::ok() : Status(truncated(element, 0));
  }
  for (std::size_t i = 0; i < element.count; ++i) {
    for (const PlyProperty& property : element.properties) {
      std::size_t items = 1;
      if (property.isList) {
        const Result<std::size_t> length = listLength(element, property, i);
        if (!length) return length.error();
        items = *length;
      }
      for (std::size_t k = 0; k < items; ++k) body_.number(property.type);
    }
    if (!body_.ok()) return truncated(element, i);
  }
  return Status::ok();
}

Vec3d PlyReader::placePositions() {
  std::vector<bool> used(positions_.size());
  for (const scene::Triangle& triangle : mesh_.triangles) {
    for (std::uint32_t vertex : triangle) used[vertex] = true;
  }
  DoubleBox box;
  for (std::size_t i = 0; i < used.size(); ++i) {
    if (used[i]) box.extend(positions_[i]);
  }
  const Vec3d origin = farOrigin(box);
  noteFarOrigin(origin, diagnosis_);
  mesh_.positions.reserve(positions_.size());
  for (const Vec3d& p : positions_) mesh_.positions.push_back((p - origin).cast<float>());
  return origin;
}

Result<LoadedScene> PlyReader::read() {
  bool hasVertices = false;
  for (const PlyElement& element : header_.elements) {
    // Each property of each element takes a byte at least, so a count beyond what is left is a lie,
    // and is found out before memory is asked for.
    const std::size_t least = std::max<std::size_t>(element.leastSize(body_.ascii()), 1);
    if (!element.properties.empty() && element.count > (body_.left() + 1) / least) {
      return bad("its header promises " + std::to_string(element.count) + " of element " +
                 element.name + ", but only " + std::to_string(body_.left()) +
                 " bytes follow: the file is truncated or damaged");
    }
    const std::string what = name_ + ": element " + element.name;
    Status status = files_.budget().hold(element.count * element.sizeInMemory(), what);
    if (!status) return status.error();
    if (element.isVertices()) {
      if (hasVertices) return bad("its header has two elements vertex");
      if (element.count > 0xfffffffeu) return bad("it has more vertices than 32 bits can number");
      hasVertices = true;
      status = readVertices(element);
    } else if (element.isFaces()) {
      if (!hasVertices) return bad("its faces come before its vertices, which is not read");
      status = readFaces(element);
    } else {
      status = skip(element);
    }
    if (!status) return status.error();
  }
  if (mesh_.triangles.empty()) {
    return bad(positions_.empty() ? "holds no triangles"
                                  : "holds " + std::to_string(positions_.size()) +
                                        " points and no triangles; reconstruct a surface first");
  }
  const Vec3d origin = placePositions();
  mesh_.name = path_.stem().string();
  FinishOptions finish;
  finish.front = Front::Normals;
  finish.crease = files_.options().crease;
  const bool colored = !mesh_.colors.empty();
  if (Status status = finishMesh(mesh_, finish, name_, "the mesh", diagnosis_); !status) {
    return status.error();
  }
  if (mesh_.triangles.empty()) return bad("all its triangles are without area");

  LoadedScene loaded;
  loaded.scene.origin = origin;
  scene::Material material;
  FileFinder finder(files_);
  const std::filesystem::path folder = path_.parent_path();
  const FileFinder::Found picture = finder.find(folder, header_.textureFile, folder);
  if (!header_.textureFile.empty()) files_.note(picture.path);
  if (!header_.textureFile.empty() && !mesh_.uvs.empty()) {
    const Result<int> texture = readTextureFile(picture, loaded.scene, files_, diagnosis_);
    if (!texture) return texture.error();
    material.baseColorTexture = *texture;
  }
  if (colored || material.baseColorTexture >= 0) material.diffuse = Rgb::Ones();
  loaded.scene.materials.push_back(std::move(material));
  loaded.scene.meshes.push_back(std::move(mesh_));
  loaded.findings = diagnosis_.findings();
  loaded.linkedFiles = files_.noted();
  return loaded;
}

}  // namespace

Result<LoadedScene> loadPly(const std::filesystem::path& path, const LoadOptions& options) {
  LinkedFiles files(path, options);
  const Result<std::vector<std::byte>> bytes = files.readScene();
  if (!bytes) return bytes.error();
  const std::string_view text = asText(*bytes);
  const Result<PlyHeader> header = readPlyHeader(text, path.string());
  if (!header) return header.error();
  return PlyReader(path, *header, Body(text.substr(header->size), header->format), files).read();
}

}  // namespace lambent::scene_io
