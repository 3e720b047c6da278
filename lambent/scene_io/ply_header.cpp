#include "lambent/scene_io/ply_header.h"

#include <algorithm>
#include <charconv>
#include <optional>
#include <utility>

#include "lambent/scene/scene.h"
#include "lambent/scene_io/text_cursor.h"

namespace lambent::scene_io {
namespace {

/// More than any scanner writes; keeps a hostile header from being the work.
constexpr std::size_t kMostProperties = 4096;

std::optional<PlyType> typeOf(std::string_view name) {
  constexpr std::pair<std::string_view, PlyType> kTypes[] = {
      {"char", PlyType::Int8},      {"int8", PlyType::Int8},       {"uchar", PlyType::Uint8},
      {"uint8", PlyType::Uint8},    {"short", PlyType::Int16},     {"int16", PlyType::Int16},
      {"ushort", PlyType::Uint16},  {"uint16", PlyType::Uint16},   {"int", PlyType::Int32},
      {"int32", PlyType::Int32},    {"uint", PlyType::Uint32},     {"uint32", PlyType::Uint32},
      {"float", PlyType::Float32},  {"float32", PlyType::Float32}, {"double", PlyType::Float64},
      {"float64", PlyType::Float64}};
  for (const auto& [known, type] : kTypes) {
    if (name == known) return type;
  }
  return {};
}

}  // namespace

std::size_t sizeOf(PlyType type) {
  constexpr std::size_t kSizes[] = {1, 1, 2, 2, 4, 4, 4, 8};
  return kSizes[int(type)];
}

bool isFloat(PlyType type) {
  return type == PlyType::Float32 || type == PlyType::Float64;
}

std::size_t PlyElement::leastSize(bool ascii) const {
  std::size_t size = 0;
  for (const PlyProperty& property : properties) {
    size += ascii ? 2 : sizeOf(property.isList ? property.countType : property.type);
  }
  return size;
}

std::size_t PlyElement::sizeInMemory() const {
  if (isVertices()) return sizeof(float) * properties.size() + 3 * sizeof(double);
  const std::size_t corners = properties.size() > 1 ? 3 * sizeof(Vec2) + sizeof(Rgb) : 0;
  return isFaces() ? sizeof(scene::Triangle) + corners : 0;
}

Result<PlyHeader> readPlyHeader(std::string_view text, const std::string& file) {
  PlyHeader header;
  TextCursor cursor(text);
  const auto bad = [&](const std::string& message) {
    return report::badInput(file + ", line " + std::to_string(cursor.line()) + ": " + message);
  };
  if (!cursor.nextLine() || cursor.word() != "ply") {
    return report::badInput(file + ": is not a PLY file: it does not begin with \"ply\"");
  }
  const std::size_t firstEnd = text.find_first_of("\r\n");
  const std::string_view afterFirst = text.substr(std::min(firstEnd, text.size()));
  const bool returnAlone = afterFirst.size() > 1 && afterFirst[0] == '\r' && afterFirst[1] != '\n';
  bool hasFormat = false;
  std::size_t properties = 0;
  while (cursor.nextLine()) {
    const std::string_view key = cursor.word();
    if (key == "end_header") {
      if (!hasFormat) return bad("the header has no format");
      header.size = cursor.offset(text.data());
      // Where lines end with a return alone, a line feed is the first byte of the body.
      if (returnAlone && text[header.size - 1] == '\n') --header.size;
      return header;
    }
    if (key == "format") {
      const std::string_view format = cursor.word();
      if (format == "ascii") {
        header.format = PlyFormat::Ascii;
      } else if (format == "binary_little_endian") {
        header.format = PlyFormat::BinaryLittle;
      } else if (format == "binary_big_endian") {
        header.format = PlyFormat::BinaryBig;
      } else {
        return bad("the format is unknown; it is ascii, binary_little_endian or binary_big_endian");
      }
      hasFormat = true;
    } else if (key == "element") {
      PlyElement element;
      element.name = cursor.word();
      const std::string_view count = cursor.word();
      const auto [stop, error] =
          std::from_chars(count.data(), count.data() + count.size(), element.count);
      if (error != std::errc() || stop != count.data() + count.size() || element.name.empty()) {
        return bad("an element needs a name and a count that is not negative");
      }
      header.elements.push_back(std::move(element));
    } else if (key == "property") {
      if (header.elements.empty()) return bad("a property comes before any element");
      PlyProperty property;
      std::string_view type = cursor.word();
      if (type == "list") {
        property.isList = true;
        const auto countType = typeOf(cursor.word());
        if (!countType) return bad("a list has an unknown type of count");
        property.countType = *countType;
        type = cursor.word();
      }
      const auto known = typeOf(type);
      if (!known) return bad("a property has an unknown type");
      property.type = *known;
      property.name = cursor.word();
      if (++properties > kMostProperties) return bad("the header has too many properties");
      header.elements.back().properties.push_back(std::move(property));
    } else if (key == "comment") {
      if (cursor.word() == "TextureFile") header.textureFiles.emplace_back(cursor.rest());
    } else if (key != "obj_info" && !key.empty()) {
      if (header.skippedLines++ == 0) header.firstSkipped = "line " + std::to_string(cursor.line());
    }
  }
  return bad("the header has no end: the file is truncated");
}

}  // namespace lambent::scene_io
