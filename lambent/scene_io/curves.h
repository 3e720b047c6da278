// Files → curves in space: polylines.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lambent/math/types.h"
#include "lambent/report/result.h"

namespace lambent::scene_io {

/// Two points or more, one after the other.
using Polyline = std::vector<Vec3d>;

enum class CurveFormat {
  Csv,  ///< lines of curve,x,y,z: what has one name in the first column, line after line, is one
        ///< curve. A first line that is no numbers is a heading; # begins a comment
  Obj,  ///< lines of v and l
};

/// BadInput names `file`, the line, and what is right: numbers that are missing or not finite, a
/// vertex that is not there, no curve at all. Curves of one point are left out.
Result<std::vector<Polyline>> parseCurves(std::string_view text, CurveFormat format,
                                          const std::string& file);

/// By extension: .csv or .obj.
Result<std::vector<Polyline>> readCurves(const std::filesystem::path& path);

}  // namespace lambent::scene_io
