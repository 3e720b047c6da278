// The header of a PLY file: what elements follow, and how they are stored.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "lambent/report/result.h"

namespace lambent::scene_io {

enum class PlyFormat { Ascii, BinaryLittle, BinaryBig };
enum class PlyType { Int8, Uint8, Int16, Uint16, Int32, Uint32, Float32, Float64 };

std::size_t sizeOf(PlyType type);
bool isFloat(PlyType type);

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::Float32;  ///< of the value, or of a list's items
  bool isList = false;
  PlyType countType = PlyType::Uint8;
};

struct PlyElement {
  std::string name;
  std::size_t count = 0;
  std::vector<PlyProperty> properties;

  /// Bytes that one of them takes in the file at the very least.
  std::size_t leastSize(bool ascii) const;
  /// Bytes that one of them takes in memory: a float for each property of a vertex and its
  /// position in double besides, a triangle for a face and what belongs to its corners, nothing for what is skipped.
  std::size_t sizeInMemory() const;
  bool isVertices() const { return name == "vertex"; }
  bool isStrips() const { return name == "tristrips"; }
  bool isFaces() const { return name == "face" || isStrips(); }
};

struct PlyHeader {
  PlyFormat format = PlyFormat::Ascii;
  std::vector<PlyElement> elements;
  std::vector<std::string> textureFiles;  ///< of "comment TextureFile NAME", in sequence
  std::size_t skippedLines = 0;           ///< that PLY does not know
  std::string firstSkipped;               ///< "line 3"
  std::size_t size = 0;                   ///< bytes up to the body
};

Result<PlyHeader> readPlyHeader(std::string_view text, const std::string& file);

}  // namespace lambent::scene_io
