// One material of an .mtl file as the file says it.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lambent/math/types.h"
#include "lambent/report/result.h"
#include "lambent/scene_io/mtl_map.h"

namespace lambent::scene_io {

struct MtlEntry {
  std::string name;
  std::optional<Rgb> diffuse, specular, emission;  ///< as they are, finite
  std::optional<double> exponent, metallic, roughness, opacity, transparency;
  int illumination = 2;
  MtlMap diffuseMap, opacityMap;
  /// The names of maps that are not read, by keyword: "map_Ks", "bump".
  std::vector<std::pair<std::string, std::string>> otherMaps;
  /// Keywords that have no meaning here but change a look: "Pc", "aniso", or that nobody knows.
  std::vector<std::string> layers, unknown;
};

/// The materials of a file in its sequence.
std::vector<MtlEntry> readMtlEntries(std::string_view text);

}  // namespace lambent::scene_io
