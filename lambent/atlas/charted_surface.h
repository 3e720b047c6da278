// A surface cut into charts, each laid out in the plane: what an atlas is packed of, as often and
// as finely as one likes.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lambent/atlas/atlas.h"
#include "lambent/atlas/charts.h"
#include "lambent/atlas/flatten.h"
#include "lambent/atlas/pack.h"
#include "lambent/atlas/welded_surface.h"
#include "lambent/report/progress.h"
#include "lambent/report/result.h"

namespace lambent::atlas {

struct LaidOutChart {
  Chart triangles;  ///< of the mesh, in rising sequence
  ChartPatch patch;
  std::vector<Vec2d> layout;  ///< of the patch's vertices, metres
  double area = 0.0;          ///< m², in the plane as on the surface
};

struct ChartedSurface {
  WeldedSurface surface;
  std::vector<LaidOutChart> charts;
  /// A triangle without area has none (kNoTriangle).
  std::vector<std::uint32_t> chartOfTriangle;
};

/// `surface`: that of the mesh; where it does not hang together no chart does. `maximumStretch`
/// and `cutAt` as AtlasOptions. BadInput if no triangle has area; Cancelled.
Result<ChartedSurface> chartedSurface(const scene::Mesh& mesh, WeldedSurface surface,
                                      float maximumStretch, const Progress& progress,
                                      std::span<const std::uint32_t> cutAt = {});

/// The same with charts of different densities, [chart], > 0: texels are that much denser on a
/// chart, in proportion to others. None: all are as dense. `mesh` is that of the charts. BadUsage
/// if there is no room; Cancelled.
Result<Atlas> packedAtlas(const scene::Mesh& mesh, const ChartedSurface& charted,
                          std::span<const double> densities, const PackOptions& options,
                          const Progress& progress);

}  // namespace lambent::atlas
