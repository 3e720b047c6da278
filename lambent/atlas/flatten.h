// A chart laid out in the plane, as near to its own shape and size as its curvature lets it.
#pragma once

#include <optional>
#include <vector>

#include "lambent/atlas/chart_patch.h"

namespace lambent::atlas {

/// Where the chart's vertices lie (patch.chartVertices() of them), in metres: its area in the plane
/// is its area on the surface. Every triangle keeps its winding, and the chart does not lie over
/// itself. Nothing if no such layout was found: the chart should be cut. `patch` is a disc. A chart
/// of a single triangle keeps its shape exactly, and always succeeds.
std::optional<std::vector<Vec2d>> flatten(const ChartPatch& patch);

/// L² stretch of a triangle (sander2001texture §3, eq. for L²(T)): root mean square, over
/// directions, of how much longer the surface is than its picture. Infinite for a picture without
/// area or turned over.
double triangleStretch(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec2d& pa,
                       const Vec2d& pb, const Vec2d& pc);

/// Sums towards the L² stretch of a set of triangles.
struct StretchSum {
  double squared = 0.0;  ///< Σ area · stretch²
  double area = 0.0;     ///< m² on the surface
  double flat = 0.0;     ///< area in the plane
  /// L² stretch, free of scale: 1 where the picture keeps all lengths in proportion.
  double stretch() const;
};
StretchSum stretchOf(const ChartPatch& patch, const std::vector<Vec2d>& layout);

/// Whether the outline of a layout crosses itself.
bool outlineCrossesItself(const std::vector<std::vector<std::uint32_t>>& loops,
                          const std::vector<Vec2d>& layout);

}  // namespace lambent::atlas
