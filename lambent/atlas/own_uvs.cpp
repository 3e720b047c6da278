#include "lambent/atlas/own_uvs.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "lambent/atlas/flatten.h"
#include "lambent/scene/diagnose.h"

namespace lambent::atlas {
namespace {

/// The place of a welded vertex in a triangle's picture.
const Vec2& uvAt(const scene::Mesh& mesh, const WeldedSurface& surface, std::uint32_t triangle,
                 std::uint32_t vertex) {
  const auto& v = surface.triangles[triangle];
  const int k = v[0] == vertex ? 0 : v[1] == vertex ? 1 : 2;
  return mesh.uvs[mesh.triangles[triangle][k]];
}

/// Triangles that hang together across edges on the surface and in the square as well.
std::uint32_t labelCharts(const scene::Mesh& mesh, const WeldedSurface& surface,
                          std::vector<std::uint32_t>& chartOf) {
  chartOf.assign(mesh.triangles.size(), kNoTriangle);
  std::uint32_t charts = 0;
  std::vector<std::uint32_t> stack;
  for (std::uint32_t first = 0; first < chartOf.size(); ++first) {
    if (chartOf[first] != kNoTriangle || !surface.hasArea(first)) continue;
    chartOf[first] = charts;
    stack.push_back(first);
    while (!stack.empty()) {
      const std::uint32_t t = stack.back();
      stack.pop_back();
      for (int k = 0; k < 3; ++k) {
        const std::uint32_t n = surface.neighbours[t][k];
        if (n == kNoTriangle || chartOf[n] != kNoTriangle) continue;
        const std::uint32_t a = surface.triangles[t][k], b = surface.triangles[t][(k + 1) % 3];
        if (uvAt(mesh, surface, t, a) != uvAt(mesh, surface, n, a) ||
            uvAt(mesh, surface, t, b) != uvAt(mesh, surface, n, b))
          continue;
        chartOf[n] = charts;
        stack.push_back(n);
      }
    }
    ++charts;
  }
  // Triangles without area go with a neighbour: nothing of them can be seen.
  std::vector<std::uint32_t> chartAt(surface.positions.size(), 0);
  for (std::uint32_t t = 0; t < chartOf.size(); ++t)
    if (surface.hasArea(t))
      for (const std::uint32_t v : surface.triangles[t]) chartAt[v] = chartOf[t];
  for (std::uint32_t t = 0; t < chartOf.size(); ++t)
    if (!surface.hasArea(t)) chartOf[t] = chartAt[surface.triangles[t][0]];
  return charts;
}

}  // namespace

WithFindings<std::optional<Atlas>> atlasOfOwnUvs(const scene::Mesh& mesh,
                                                 const WeldedSurface& surface,
                                                 const AtlasOptions& options) {
  WithFindings<std::optional<Atlas>> result;
  const auto refuse = [&](std::string code, std::string why, std::uint64_t count) {
    result.findings.push_back({Severity::Note, std::move(code),
                               why +
                                   "; it is laid out anew, which leaves no place for textures that "
                                   "were painted for the old layout",
                               count});
    return result;
  };
  const std::string name = mesh.name.empty() ? "the mesh" : "mesh \"" + mesh.name + "\"";
  if (mesh.uvs.empty() || mesh.uvs.size() != mesh.positions.size()) {
    result.findings.push_back({Severity::Note, "no-uvs",
                               name + " has no texture coordinates; it is laid out automatically",
                               0});
    return result;
  }
  if (const Status sound = scene::checkUvs(mesh, options.size, options.size); !sound)
    return refuse("uvs-unsound", sound.error().message, 0);

  Atlas atlas;
  atlas.ownUvs = true;
  atlas.charts = labelCharts(mesh, surface, atlas.chartOfTriangle);
  std::vector<StretchSum> sums(atlas.charts);
  std::uint64_t collapsed = 0;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    if (!surface.hasArea(t)) continue;
    std::array<Vec2d, 3> p;
    for (int k = 0; k < 3; ++k) p[k] = mesh.uvs[mesh.triangles[t][k]].cast<double>();
    const Vec2d e = p[1] - p[0], f = p[2] - p[0];
    const double doubled = e.x() * f.y() - e.y() * f.x();
    // Less than a ten-thousandth of a texel: rounding, not a picture.
    if (std::abs(doubled) * options.size * options.size < 1e-4) {
      if (surface.areas[t] > 1e-7 * surface.area) ++collapsed;
      continue;
    }
    if (doubled < 0.0)  // a mirrored chart stretches no more for it
      for (Vec2d& q : p) q.x() = -q.x();
    const auto& v = surface.triangles[t];
    const double stretch = triangleStretch(surface.positions[v[0]], surface.positions[v[1]],
                                           surface.positions[v[2]], p[0], p[1], p[2]);
    StretchSum& sum = sums[atlas.chartOfTriangle[t]];
    sum.squared += surface.areas[t] * stretch * stretch;
    sum.area += surface.areas[t];
    sum.flat += 0.5 * std::abs(doubled);
  }
  if (collapsed > 0)
    return refuse("uvs-collapsed",
                  name + ": " + std::to_string(collapsed) +
                      " triangles with area on the surface have none in its texture coordinates",
                  collapsed);
  atlas.mesh = mesh;
  atlas.sourceVertex.resize(mesh.positions.size());
  for (std::uint32_t v = 0; v < atlas.sourceVertex.size(); ++v) atlas.sourceVertex[v] = v;

  const GutterCount gutters = countGutters(atlas, options.size);
  if (gutters.sharedTexels > 0)
    return refuse("uvs-without-gutter",
                  name + ": charts of its texture coordinates touch in " +
                      std::to_string(gutters.sharedTexels) + " texels of the " +
                      std::to_string(options.size) + "×" + std::to_string(options.size) + " map",
                  gutters.sharedTexels);
  if (gutters.narrowTexels > 0)
    result.findings.push_back(
        {Severity::Note, "uvs-narrow-gutter",
         name + ": charts of its texture coordinates lie within two texels of each "
                "other, so that bilinear look-ups at their borders mix them; they "
                "are used as they are",
         gutters.narrowTexels});
  StretchSum whole;
  for (const StretchSum& sum : sums) {
    whole.squared += sum.squared, whole.area += sum.area, whole.flat += sum.flat;
    atlas.worstStretch = std::max(atlas.worstStretch, sum.stretch());
  }
  atlas.stretch = whole.stretch();
  atlas.usedArea = whole.flat;
  result.value = std::move(atlas);
  return result;
}

}  // namespace lambent::atlas
