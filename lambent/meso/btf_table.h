// The list of a measured BTF's pictures: a CSV file beside them.
#pragma once

#include <filesystem>
#include <vector>

#include "lambent/math/types.h"
#include "lambent/report/result.h"

namespace lambent::meso {

struct BtfSample {
  std::filesystem::path file;
  Vec3 view, light;  ///< unit, towards the eye and the light, in the patch's frame, z > 0
  int line = 0;      ///< of the table, from 1
};

/// Reads a table such as
///
///     file,view_theta,view_phi,light_theta,light_phi
///     v00_l00.png,0,0,15,90
///
/// Angles in degrees: theta from the patch's normal (0 ≤ theta < 90), phi from its +x towards its
/// +y. Columns may stand in any sequence, and further ones are not read. Files are relative to the
/// table's folder; names with commas cannot be given. Empty lines and lines that begin with # are
/// skipped. BadInput names the line and the column.
Result<std::vector<BtfSample>> readBtfTable(const std::filesystem::path& path);

/// The table of a BTF given by its folder: the only .csv in it. A file is its own table.
Result<std::filesystem::path> findBtfTable(const std::filesystem::path& path);

}  // namespace lambent::meso
