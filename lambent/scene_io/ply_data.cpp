#include "lambent/scene_io/ply_data.h"

#include <algorithm>
#include <limits>

#include "lambent/scene_io/ply_roles.h"
#include "lambent/scene_io/polygon.h"
#include "lambent/scene_io/text_file.h"

namespace lambent::scene_io {
namespace {

/// What the triangles have besides their vertices.
struct FaceLooks {
  bool cornerUvs = false, colors = false, textures = false;
  bool operator==(const FaceLooks&) const = default;
};

class PlyDataReader {
 public:
  PlyDataReader(const PlyHeader& header, PlyBody body, const std::string& file,
                file::Budget& budget, Diagnosis& diagnosis)
      : header_(header), body_(body), name_(file), budget_(budget), diagnosis_(diagnosis) {}

  Result<PlyData> read();

 private:
  Error bad(const std::string& message) const { return report::badInput(name_ + ": " + message); }
  Error truncated(const PlyElement& element, std::size_t index) const;
  Status readElement(const PlyElement& element);
  Status readVertices(const PlyElement& element);
  Status readFaces(const PlyElement& element);
  Status skip(const PlyElement& element);
  /// The length of a list whose items still have to follow in the body.
  Result<std::size_t> listLength(const PlyElement& element, const PlyProperty& property,
                                 std::size_t index);
  /// Reads what belongs to a face: its corners into corners_, and so on.
  Status readFace(const PlyElement& element, const PlyRoles& roles, std::size_t index);
  Status checkCorners(const PlyElement& element, std::size_t index) const;
  void addStrips();
  void addFace(const PlyElement& element, std::size_t index);
  /// A triangle of corners of the face that was read.
  void addTriangle(std::size_t a, std::size_t b, std::size_t c);
  void tellUnread(const PlyElement& element, const PlyRoles& roles);
  void seeAlpha(double alpha, PlyType type) {
    alphaType_ = type;
    if (alpha < lowestAlpha_) lowestAlpha_ = alpha;
    if (alpha > highestAlpha_) highestAlpha_ = alpha;
  }
  bool isTransparent() const;

  const PlyHeader& header_;
  PlyBody body_;
  std::string name_;
  file::Budget& budget_;
  Diagnosis& diagnosis_;
  PlyData data_;
  bool hasVertices_ = false;
  // Of the face that is read.
  std::vector<double> corners_, uvs_;
  double scalars_[kPlyRoles] = {};
  std::vector<Vec3d> polygon_;
  std::vector<scene::Triangle> cut_;
  FaceLooks looks_;
  PlyType alphaType_ = PlyType::Uint8;
  double lowestAlpha_ = std::numeric_limits<double>::infinity(), highestAlpha_ = 0.0;
  std::size_t oddUvs_ = 0;
};

Error PlyDataReader::truncated(const PlyElement& element, std::size_t index) const {
  const std::string place = "element " + element.name + " " + std::to_string(index) + " of " +
                            std::to_string(element.count);
  if (const std::string comma = decimalCommaIn(body_.failedAt()); !comma.empty()) {
    return bad(place + " has \"" + std::string(body_.failedAt().substr(0, 40)) + "\"" + comma);
  }
  return bad("the file is truncated or damaged in " + place + "; copy or export it again");
}

Result<std::size_t> PlyDataReader::listLength(const PlyElement& element,
                                              const PlyProperty& property, std::size_t index) {
  const double length = body_.number(property.countType);
  const std::size_t itemSize = body_.ascii() ? 2 : sizeOf(property.type);
  // An ascii item takes a digit and a blank, the last one perhaps no blank.
  if (!body_.ok() || !(length >= 0.0) || length * double(itemSize) > double(body_.left()) + 1.0) {
    return truncated(element, index);
  }
  return std::size_t(length);
}

void PlyDataReader::tellUnread(const PlyElement& element, const PlyRoles& roles) {
  if (roles.unread.empty()) return;
  diagnosis_.add(Severity::Note, "properties-ignored", roles.unreadCount,
                 "properties are of no kind that is read and were left out",
                 element.name + ": " + roles.unread);
}

/// Whether anything lets light through: alpha is counted as colours are.
bool PlyDataReader::isTransparent() const {
  double white = 255.0;
  if (isFloat(alphaType_) && highestAlpha_ <= 2.0) white = 1.0;
  if (sizeOf(alphaType_) > 1 && highestAlpha_ > 255.0) white = 65535.0;
  return lowestAlpha_ < 0.998 * white;
}

Status PlyDataReader::readVertices(const PlyElement& element) {
  const PlyRoles roles(element);
  tellUnread(element, roles);
  if (!roles.has(PlyRole::X) || !roles.has(PlyRole::Y) || !roles.has(PlyRole::Z)) {
    return bad("its vertices have no x, y and z");
  }
  const bool normals = roles.has(PlyRole::NX) && roles.has(PlyRole::NY) && roles.has(PlyRole::NZ);
  const bool uvs = roles.has(PlyRole::U) && roles.has(PlyRole::V);
  const bool colors = roles.hasColors();
  data_.positions.reserve(element.count);
  if (normals) data_.normals.reserve(element.count);
  if (uvs) data_.uvs.reserve(element.count);
  if (colors) data_.colors.values.reserve(element.count);
  data_.colors.type = roles.redType;

  double values[kPlyRoles] = {};
  const auto value = [&](PlyRole role) { return float(values[int(role)]); };
  for (std::size_t i = 0; i < element.count; ++i) {
    for (std::size_t p = 0; p < roles.roles.size(); ++p) {
      const PlyProperty& property = element.properties[p];
      if (property.isList) {
        const Result<std::size_t> length = listLength(element, property, i);
        if (!length) return length.error();
        for (std::size_t k = 0; k < *length; ++k) body_.number(property.type);
      } else {
        const double number = values[int(roles.roles[p])] = body_.number(property.type);
        if (roles.roles[p] == PlyRole::Alpha) seeAlpha(number, property.type);
      }
    }
    if (!body_.ok()) return truncated(element, i);
    data_.positions.emplace_back(values[int(PlyRole::X)], values[int(PlyRole::Y)],
                                 values[int(PlyRole::Z)]);
    if (normals) {
      data_.normals.emplace_back(value(PlyRole::NX), value(PlyRole::NY), value(PlyRole::NZ));
    }
    // As in OBJ, v counts from the bottom of the image.
    if (uvs) data_.uvs.emplace_back(value(PlyRole::U), 1.0f - value(PlyRole::V));
    if (colors) {
      data_.colors.values.emplace_back(value(PlyRole::Red), value(PlyRole::Green),
                                       value(PlyRole::Blue));
    }
  }
  return Status::ok();
}

void PlyDataReader::addTriangle(std::size_t a, std::size_t b, std::size_t c) {
  data_.triangles.push_back(
      {std::uint32_t(corners_[a]), std::uint32_t(corners_[b]), std::uint32_t(corners_[c])});
  if (looks_.cornerUvs) {
    const auto uv = [&](std::size_t i) {
      const bool there = uvs_.size() == 2 * corners_.size();
      return there ? Vec2(float(uvs_[2 * i]), 1.0f - float(uvs_[2 * i + 1])) : Vec2(0.0f, 1.0f);
    };
    data_.cornerUvs.push_back({uv(a), uv(b), uv(c)});
  }
  if (looks_.colors) {
    data_.faceColors.values.emplace_back(float(scalars_[int(PlyRole::Red)]),
                                         float(scalars_[int(PlyRole::Green)]),
                                         float(scalars_[int(PlyRole::Blue)]));
  }
  if (looks_.textures) {
    const double number = scalars_[int(PlyRole::Texture)];
    const bool there = number >= 0.0 && number < double(header_.textureFiles.size());
    data_.textures.push_back(there ? int(number) : 0);
  }
}

void PlyDataReader::addStrips() {
  std::size_t start = 0;
  for (std::size_t i = 0; i <= corners_.size(); ++i) {
    if (i < corners_.size() && corners_[i] != -1.0) continue;
    for (std::size_t k = start; k + 2 < i; ++k) {
      const std::size_t odd = (k - start) % 2;
      addTriangle(k, k + 1 + odd, k + 2 - odd);
    }
    start = i + 1;
  }
}

void PlyDataReader::addFace(const PlyElement& element, std::size_t index) {
  const std::size_t count = corners_.size();
  if (count == 3) return addTriangle(0, 1, 2);
  if (count < 3) {
    diagnosis_.add(Severity::Warning, "small-faces", 1,
                   "faces have fewer than three corners and were left out",
                   element.name + " " + std::to_string(index));
    return;
  }
  polygon_.clear(), cut_.clear();
  for (const double corner : corners_) polygon_.push_back(data_.positions[std::size_t(corner)]);
  if (!cutPolygon(polygon_, cut_)) noteCrossing(1, diagnosis_);
  for (const auto& [a, b, c] : cut_) addTriangle(a, b, c);
}

Status PlyDataReader::checkCorners(const PlyElement& element, std::size_t index) const {
  const std::size_t vertices = data_.positions.size();
  for (const double item : corners_) {
    if (element.isStrips() && item == -1.0) continue;
    if (!(item >= 0.0) || item >= double(vertices)) {
      return bad(element.name + " " + std::to_string(index) + " refers to vertex " +
                 std::to_string(std::int64_t(std::clamp(item, -9e18, 9e18))) + " of " +
                 std::to_string(vertices) + "; export the file again");
    }
  }
  return Status::ok();
}

Status PlyDataReader::readFace(const PlyElement& element, const PlyRoles& roles,
                               std::size_t index) {
  corners_.clear(), uvs_.clear();
  for (std::size_t p = 0; p < roles.roles.size(); ++p) {
    const PlyProperty& property = element.properties[p];
    const PlyRole role = roles.roles[p];
    if (!property.isList) {
      const double number = scalars_[int(role)] = body_.number(property.type);
      if (role == PlyRole::Alpha) seeAlpha(number, property.type);
      continue;
    }
    const Result<std::size_t> length = listLength(element, property, index);
    if (!length) return length.error();
    for (std::size_t k = 0; k < *length; ++k) {
      const double item = body_.number(property.type);
      if (role == PlyRole::Corners) corners_.push_back(item);
      if (role == PlyRole::CornerUvs) uvs_.push_back(item);
    }
  }
  oddUvs_ += roles.has(PlyRole::CornerUvs) && uvs_.size() != 2 * corners_.size();
  return body_.ok() ? Status::ok() : Status(truncated(element, index));
}

Status PlyDataReader::readFaces(const PlyElement& element) {
  const PlyRoles roles(element);
  tellUnread(element, roles);
  if (!roles.has(PlyRole::Corners) && element.count > 0) {
    return bad("its faces have no list vertex_indices");
  }
  const FaceLooks looks{roles.has(PlyRole::CornerUvs), roles.hasColors(),
                        roles.has(PlyRole::Texture) && header_.textureFiles.size() > 1};
  // Either all triangles have a thing or none.
  if (!data_.triangles.empty() && looks != looks_) return skip(element);
  looks_ = looks;
  data_.faceColors.type = roles.redType;
  if (!element.isStrips()) data_.triangles.reserve(std::min(element.count, body_.left()));
  for (std::size_t i = 0; i < element.count; ++i) {
    if (Status read = readFace(element, roles, i); !read) return read;
    if (Status sound = checkCorners(element, i); !sound) return sound;
    if (element.isStrips()) {
      addStrips();
    } else {
      addFace(element, i);
    }
  }
  return Status::ok();
}

Status PlyDataReader::skip(const PlyElement& element) {
  // Where a scanner stood is no part of what it saw.
  if (element.count > 0 && element.name != "camera") {
    diagnosis_.lose(Severity::Note, "element-ignored", element.count,
                    "elements are of a kind that is not read and were left out", element.name);
  }
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

Status PlyDataReader::readElement(const PlyElement& element) {
  // Each property of each element takes a byte at least, so a count beyond what is left is a lie,
  // and is found out before memory is asked for.
  const std::size_t least = std::max<std::size_t>(element.leastSize(body_.ascii()), 1);
  if (!element.properties.empty() && element.count > (body_.left() + 1) / least) {
    return bad("its header promises " + std::to_string(element.count) + " of element " +
               element.name + ", but only " + std::to_string(body_.left()) +
               " bytes follow: the file is truncated or damaged");
  }
  const std::string what = name_ + ": element " + element.name;
  if (Status fits = budget_.hold(element.count * element.sizeInMemory(), what); !fits) return fits;
  if (element.isVertices()) {
    if (hasVertices_) return bad("its header has two elements vertex");
    if (element.count > 0xfffffffeu) return bad("it has more vertices than 32 bits can number");
    hasVertices_ = true;
    return readVertices(element);
  }
  if (!element.isFaces()) return skip(element);
  if (!hasVertices_) return bad("its faces come before its vertices, which is not read");
  return readFaces(element);
}

Result<PlyData> PlyDataReader::read() {
  for (const PlyElement& element : header_.elements) {
    if (Status status = readElement(element); !status) return status.error();
  }
  if (isTransparent()) {
    diagnosis_.lose(Severity::Warning, "alpha-ignored", 0,
                    "vertices or faces are (partly) transparent and are taken as opaque");
  }
  if (oddUvs_ > 0) {
    diagnosis_.lose(Severity::Warning, "corner-uvs-ignored", oddUvs_,
                    "faces have not two texture coordinates for each corner; theirs are 0, 0");
  }
  return std::move(data_);
}

}  // namespace

Result<PlyData> readPlyData(const PlyHeader& header, PlyBody body, const std::string& file,
                            file::Budget& budget, Diagnosis& diagnosis) {
  return PlyDataReader(header, body, file, budget, diagnosis).read();
}

}  // namespace lambent::scene_io
