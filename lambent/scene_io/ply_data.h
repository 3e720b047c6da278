// The elements of a PLY file as values: what ply.cpp makes a scene of.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "lambent/file/budget.h"
#include "lambent/report/result.h"
#include "lambent/scene/scene.h"
#include "lambent/scene_io/diagnosis.h"
#include "lambent/scene_io/ply_body.h"
#include "lambent/scene_io/ply_header.h"

namespace lambent::scene_io {

/// Colours as the file counts them.
struct PlyColors {
  std::vector<Rgb> values;  ///< one for each vertex or triangle, or none
  PlyType type = PlyType::Uint8;
};

struct PlyData {
  std::vector<Vec3d> positions;
  std::vector<Vec3> normals;  ///< one per position, or empty
  std::vector<Vec2> uvs;      ///< likewise; v from the top, as meshes have it
  PlyColors colors;
  std::vector<scene::Triangle> triangles;
  /// What belongs to a corner of a triangle and not to its vertex; one per triangle, or empty.
  std::vector<std::array<Vec2, 3>> cornerUvs;
  PlyColors faceColors;
  std::vector<int> textures;  ///< which of the header's files; one per triangle, or empty
};

/// Errors are BadInput and name `file` and the element. Memory is held in `budget`.
Result<PlyData> readPlyData(const PlyHeader& header, PlyBody body, const std::string& file,
                            file::Budget& budget, Diagnosis& diagnosis);

}  // namespace lambent::scene_io
