// The text of an OBJ file as values: what build() in obj.cpp makes meshes of.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "lambent/math/types.h"
#include "lambent/report/result.h"
#include "lambent/scene_io/diagnosis.h"

namespace lambent::scene_io {

/// What one corner of a face refers to, from 0; −1: nothing.
struct ObjCorner {
  std::int32_t position = -1, uv = -1, normal = -1;
  /// Where no normal is given: corners at a position share a made one if this is the same. −1 where
  /// the file has said nothing of smoothing yet, the number of a group, or below −1 a face's own.
  std::int32_t smoothing = -1;
  bool operator==(const ObjCorner&) const = default;
};

/// The faces of one object with one material.
struct ObjPart {
  std::string object, material;
  std::vector<ObjCorner> corners;
  std::vector<std::uint32_t> sizes;  ///< corners of each face
  std::size_t firstLine = 0;
};

struct ObjText {
  std::vector<Vec3d> positions;
  std::vector<Vec3> normals;
  std::vector<Vec2> uvs;  ///< v from the top, as meshes have it
  /// As they are counted in the file; below 0 where a vertex has none. As many as positions, or
  /// empty.
  std::vector<Rgb> colors;
  std::vector<ObjPart> parts;
  std::vector<std::string> libraries;  ///< what follows mtllib, in sequence
};

/// Errors are BadInput and name `file` and the line. Indices may still be beyond what is there.
Result<ObjText> readObjText(std::string_view text, const std::string& file, Diagnosis& diagnosis);

/// The names in what follows mtllib, if it is not one name: in quotes, ending in .mtl, or words.
std::vector<std::string> libraryNames(std::string_view text);

}  // namespace lambent::scene_io
