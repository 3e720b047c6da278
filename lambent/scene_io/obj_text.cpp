#include "lambent/scene_io/obj_text.h"

#include <charconv>
#include <map>
#include <optional>
#include <utility>

#include "lambent/scene_io/obj_unread.h"
#include "lambent/scene_io/text_cursor.h"
#include "lambent/scene_io/text_file.h"

namespace lambent::scene_io {
namespace {

class ObjTextReader {
 public:
  ObjTextReader(std::string_view text, const std::string& file, Diagnosis& diagnosis)
      : cursor_(text, TextCursor::Joining::Backslash), name_(file), diagnosis_(diagnosis) {}

  Result<ObjText> read();

 private:
  Error bad(const std::string& message) const {
    return report::badInput(name_ + ", line " + std::to_string(cursor_.line()) + ": " + message);
  }
  /// bad() for a statement that lacks numbers.
  Error noNumber(const std::string& message) {
    return bad(message + decimalCommaIn(cursor_.word()));
  }
  Status readStatement(std::string_view key);
  Status readVertex();
  Status readFace();
  Status readCorner(std::string_view word, ObjCorner& corner) const;
  std::optional<Error> readIndex(const char*& p, const char* end, std::size_t count,
                                 const char* kind, std::int32_t& index) const;
  void readSmoothing();
  ObjPart& part();

  TextCursor cursor_;
  std::string name_;
  Diagnosis& diagnosis_;
  ObjText text_;
  UnreadStatements unread_;
  std::string object_, material_;
  std::map<std::pair<std::string, std::string>, std::size_t> partIndex_;
  ObjPart* current_ = nullptr;
  bool flat_ = false;            ///< every face smooths with itself alone
  std::int32_t smoothing_ = -1;  ///< as ObjCorner's, if not flat_
  std::size_t faces_ = 0;
};

ObjPart& ObjTextReader::part() {
  if (current_ == nullptr) {
    const auto [entry, isNew] = partIndex_.try_emplace({object_, material_}, text_.parts.size());
    if (isNew) text_.parts.push_back({object_, material_, {}, {}, 0});
    current_ = &text_.parts[entry->second];
  }
  return *current_;
}

Status ObjTextReader::readVertex() {
  double values[7];
  int count = 0;
  while (count < 7) {
    const auto value = cursor_.number();
    if (!value) break;
    values[count++] = *value;
  }
  const std::string_view rest = count < 7 ? cursor_.rest() : std::string_view();
  if (count < 3 || (!rest.empty() && rest[0] != '#')) {
    return noNumber("a vertex needs three numbers; the file is damaged");
  }
  text_.positions.emplace_back(values[0], values[1], values[2]);
  std::vector<Rgb>& colors = text_.colors;
  if (count >= 6) {
    colors.resize(text_.positions.size() - 1, Rgb::Constant(-1.0f));
    const double* c = values + (count == 7 ? 4 : 3);
    colors.push_back(Rgb(float(c[0]), float(c[1]), float(c[2])));
  } else if (!colors.empty()) {
    colors.push_back(Rgb::Constant(-1.0f));
  }
  return Status::ok();
}

/// Parses one index of a corner: from 1 upwards, or from −1 downwards counted from the last element
/// read so far.
std::optional<Error> ObjTextReader::readIndex(const char*& p, const char* end, std::size_t count,
                                              const char* kind, std::int32_t& index) const {
  std::int64_t value = 0;
  const auto [stop, error] = std::from_chars(p, end, value);
  if (error != std::errc()) {
    return bad("a face has a corner that is no index; the file is damaged");
  }
  p = stop;
  const std::int64_t place = value < 0 ? std::int64_t(count) + value : value - 1;
  if (place < 0 || place > 0x7ffffffe || value == 0) {
    return bad("face " + std::to_string(faces_) + " refers to " + kind + " " +
               std::to_string(value) + ", which does not exist; export the file again");
  }
  index = std::int32_t(place);
  return {};
}

Status ObjTextReader::readCorner(std::string_view word, ObjCorner& corner) const {
  const char *p = word.data(), *end = p + word.size();
  auto error = readIndex(p, end, text_.positions.size(), "vertex", corner.position);
  if (!error && p != end && *p == '/') {
    ++p;
    if (p != end && *p != '/') error = readIndex(p, end, text_.uvs.size(), "vt", corner.uv);
    if (!error && p != end && *p == '/') {
      ++p;
      if (p != end) error = readIndex(p, end, text_.normals.size(), "vn", corner.normal);
    }
  }
  if (error) return *error;
  if (p != end) return bad("a face has a corner that is no index; the file is damaged");
  return Status::ok();
}

Status ObjTextReader::readFace() {
  ObjPart& target = part();
  std::uint32_t count = 0;
  for (std::string_view word = cursor_.word(); !word.empty() && word[0] != '#';
       word = cursor_.word()) {
    // "3#comment" is an index and a comment.
    const std::size_t comment = word.find('#');
    ObjCorner corner;
    if (Status read = readCorner(word.substr(0, comment), corner); !read) return read;
    if (corner.normal < 0) corner.smoothing = flat_ ? -2 - std::int32_t(faces_) : smoothing_;
    target.corners.push_back(corner);
    ++count;
    if (comment != std::string_view::npos) break;
  }
  if (count < 3) {
    diagnosis_.add(Severity::Warning, "small-faces", 1,
                   "faces have fewer than three corners and were left out",
                   "line " + std::to_string(cursor_.line()));
    target.corners.resize(target.corners.size() - count);
  } else {
    if (target.sizes.empty()) target.firstLine = cursor_.line();
    target.sizes.push_back(count);
  }
  ++faces_;
  return Status::ok();
}

void ObjTextReader::readSmoothing() {
  const auto group = cursor_.number();  // or "off"
  flat_ = !group || !(*group >= 1.0);
  smoothing_ = !flat_ && *group < 2e9 ? std::int32_t(*group) : -1;
}

Status ObjTextReader::readStatement(std::string_view key) {
  if (key == "v") return readVertex();
  if (key == "vn") {
    const auto x = cursor_.number(), y = cursor_.number(), z = cursor_.number();
    if (!x || !y || !z) return noNumber("a normal needs three numbers");
    text_.normals.emplace_back(float(*x), float(*y), float(*z));
  } else if (key == "vt") {
    const auto u = cursor_.number(), v = cursor_.number();
    if (!u) return noNumber("a texture coordinate needs a number");
    // OBJ counts v from the bottom of the image, glTF from its top.
    text_.uvs.emplace_back(float(*u), 1.0f - float(v.value_or(0.0)));
  } else if (key == "f" || key == "fo") {
    return readFace();
  } else if (key == "o") {
    object_ = cursor_.rest();
    current_ = nullptr;
  } else if (key == "usemtl") {
    material_ = cursor_.rest();
    current_ = nullptr;
  } else if (key == "mtllib") {
    text_.libraries.emplace_back(cursor_.rest());
  } else if (key == "s") {
    readSmoothing();
  } else {
    unread_.add(key, cursor_.line());
  }
  return Status::ok();
}

Result<ObjText> ObjTextReader::read() {
  while (cursor_.nextLine()) {
    const std::string_view key = cursor_.word();
    // A lone control character is the end of a file of CP/M's descendants.
    if (key.empty() || key[0] == '#' || static_cast<unsigned char>(key[0]) < ' ') continue;
    if (Status status = readStatement(key); !status) return status.error();
  }
  unread_.tell(diagnosis_);
  return std::move(text_);
}

}  // namespace

Result<ObjText> readObjText(std::string_view text, const std::string& file, Diagnosis& diagnosis) {
  return ObjTextReader(text, file, diagnosis).read();
}

std::vector<std::string> libraryNames(std::string_view text) {
  std::vector<std::string> names;
  std::string name;
  bool quoted = false;
  const auto finish = [&] {
    if (!name.empty()) names.push_back(std::exchange(name, {}));
  };
  const bool endings =
      text.find(".mtl") != std::string_view::npos || text.find(".MTL") != std::string_view::npos;
  for (const char c : text) {
    const bool blank = c == ' ' || c == '\t';
    if (c == '"') {
      quoted = !quoted;
      finish();
    } else if (blank && !quoted && name.empty()) {
      continue;
    } else if (blank && !quoted && (!endings || name.ends_with(".mtl") || name.ends_with(".MTL"))) {
      finish();
    } else if (c == '#' && name.empty()) {
      break;
    } else {
      name.push_back(c);
    }
  }
  finish();
  return names;
}

}  // namespace lambent::scene_io
