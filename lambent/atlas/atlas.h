// A surface laid out in the unit square: charts, each flattened with little stretch, packed.
#pragma once

#include <cstdint>
#include <vector>

#include "lambent/report/finding.h"
#include "lambent/report/progress.h"
#include "lambent/report/result.h"
#include "lambent/scene/scene.h"

namespace lambent::atlas {

struct AtlasOptions {
  int size = 2048;              ///< texels a side of the map that will lie over it
  int gutter = 2;               ///< texels at least between charts, ≥ 1
  bool ownUvs = true;           ///< take the mesh's own UVs if they are sound and do not overlap
  float maximumStretch = 1.5f;  ///< L² stretch of a chart above which it is cut in two (1: none)
  /// Corners, 3 · triangle + k, whose vertices no automatic chart may have inside: singularities of
  /// what is to lie over the atlas. Own UVs do not heed them.
  std::vector<std::uint32_t> cutAt = {};
};

struct Atlas {
  /// The input with UVs, and vertices doubled where charts meet. Triangles keep their sequence.
  scene::Mesh mesh;
  std::vector<std::uint32_t> sourceVertex;  ///< of the input, for each vertex
  /// A triangle without area has the chart of a neighbour whose corner it shares.
  std::vector<std::uint32_t> chartOfTriangle;
  std::uint32_t charts = 0;
  bool ownUvs = false;        ///< the mesh's own UVs were taken
  double stretch = 1.0;       ///< L² stretch over the whole surface (sander2001texture), 1 at best
  double worstStretch = 1.0;  ///< of the worst chart
  double usedArea = 0.0;      ///< share of the square that charts cover
};

/// Any mesh works: holes, several components, genus above 0, non-manifold edges (cut there). A
/// finding says why own UVs were not taken (own_uvs.h lists them). The first vertices of the
/// result are those of the input, in its sequence; doubles follow. In an automatic atlas every
/// triangle of area has the same winding in (u, v) as on the surface, texels are as dense
/// everywhere, but for stretch, and no texel of a size×size map is touched by two charts.
/// BadInput if no triangle has area; BadUsage for options out of range, or if a map of that size
/// has no room for so many charts. The same at any number of threads.
Result<WithFindings<Atlas>> makeAtlas(const scene::Mesh& mesh, const AtlasOptions& options,
                                      const Progress& progress);

inline constexpr std::uint32_t kNoChart = 0xffffffffu;

/// For every texel of a size×size map, row 0 at v = 0, the chart whose triangles touch its square
/// (were it by a corner), or kNoChart. Of several charts, which sound UVs do not have, the first.
std::vector<std::uint32_t> chartOfTexel(const Atlas& atlas, int size);

struct GutterCount {
  std::size_t sharedTexels = 0;  ///< touched by two charts or more
  std::size_t narrowTexels = 0;  ///< of a chart, within two texels of another's
};
GutterCount countGutters(const Atlas& atlas, int size);

}  // namespace lambent::atlas
