// The steps: cut the surface into charts (charts.h), lay each out (flatten.h), cut those that will
// not lie flat, over themselves, or stretch too far; and pack (pack.h).
#include "lambent/atlas/charted_surface.h"

#include <algorithm>
#include <cassert>
#include <optional>
#include <utility>

#include "lambent/work/parallel_for.h"

namespace lambent::atlas {
namespace {

/// A vertex of `cutAt` (by vertex of the surface) that lies inside of the chart.
std::optional<std::uint32_t> toBeCut(const ChartPatch& patch, const std::vector<bool>& cutAt) {
  if (cutAt.empty()) return std::nullopt;
  std::vector<bool> atBorder(patch.positions.size(), false);
  for (const auto& loop : patch.loops)
    for (const std::uint32_t v : loop) atBorder[v] = true;
  for (std::uint32_t v = 0; v < patch.chartVertices(); ++v)
    if (!atBorder[v] && cutAt[patch.weldedVertex[v]]) return patch.weldedVertex[v];
  return std::nullopt;
}

/// Lays charts out, and cuts those that cannot be, until all lie flat. That ends: a piece has fewer
/// triangles than its chart, and a single triangle always lies flat.
Result<std::vector<LaidOutChart>> layOut(const WeldedSurface& surface, std::vector<Chart> work,
                                         float maximumStretch, const std::vector<bool>& cutAt,
                                         const Progress& progress) {
  std::vector<LaidOutChart> done;
  std::vector<std::uint32_t> chartOf(surface.triangles.size(), kNoTriangle);
  std::vector<std::uint32_t> numberOf(surface.triangles.size());
  std::size_t triangles = 0, total = 0;
  for (const Chart& chart : work) total += chart.size();
  while (!work.empty()) {
    if (progress && !progress({"charts", triangles, total, "triangles"}))
      return report::cancelled();
    work::parallelFor(work.size(), [&](std::size_t c) {
      for (const std::uint32_t t : work[c]) chartOf[t] = static_cast<std::uint32_t>(c);
    });
    std::vector<std::optional<LaidOutChart>> results(work.size());
    std::vector<std::vector<Chart>> pieces(work.size());
    work::parallelFor(work.size(), [&](std::size_t c) {
      const Chart& chart = work[c];
      ChartPatch patch = chartPatch(surface, chart, chartOf, numberOf);
      if (const auto vertex = chart.size() > 1 ? toBeCut(patch, cutAt) : std::nullopt) {
        pieces[c] = cutThrough(surface, chart, chartOf, *vertex);
        return;
      }
      if (patch.disc)
        if (std::optional<std::vector<Vec2d>> layout = flatten(patch)) {
          const double stretch = stretchOf(patch, *layout).stretch();
          if (chart.size() == 1 || !(maximumStretch > 1.0f) || stretch <= maximumStretch) {
            results[c] = LaidOutChart{{}, std::move(patch), std::move(*layout), 0.0};
            return;
          }
        }
      pieces[c] = cutInTwo(surface, chart, chartOf);
    });
    std::vector<Chart> next;
    for (std::size_t c = 0; c < work.size(); ++c) {
      if (!results[c]) {
        for (Chart& piece : pieces[c]) next.push_back(std::move(piece));
        continue;
      }
      for (const std::uint32_t t : work[c]) chartOf[t] = kNoTriangle;
      triangles += work[c].size();
      done.push_back(std::move(*results[c]));
      done.back().triangles = std::move(work[c]);
    }
    work.swap(next);
  }
  return done;
}

/// `density`: by how much it is to be larger than in metres.
PackShape shapeOf(const LaidOutChart& chart, double density) {
  PackShape shape;
  for (const auto& loop : chart.patch.loops) {
    std::vector<Vec2d>& outline = shape.outlines.emplace_back();
    for (const std::uint32_t v : loop) outline.push_back(density * chart.layout[v]);
  }
  double largest = -1.0;
  for (std::size_t i = 0; i < chart.patch.chartTriangles; ++i) {
    const auto& t = chart.patch.triangles[i];
    const Vec2d e = chart.layout[t[1]] - chart.layout[t[0]],
                f = chart.layout[t[2]] - chart.layout[t[0]];
    const double doubled = e.x() * f.y() - e.y() * f.x();
    shape.area += 0.5 * density * density * doubled;
    if (doubled > largest) {
      largest = doubled;
      shape.anchor = density * (chart.layout[t[0]] + chart.layout[t[1]] + chart.layout[t[2]]) / 3.0;
    }
  }
  return shape;
}

/// The mesh with a vertex for every pair of a vertex and a place in the square.
class AtlasMesh {
 public:
  AtlasMesh(const scene::Mesh& mesh, Atlas& atlas) : atlas_(atlas) {
    atlas.mesh = mesh;
    atlas.mesh.uvs.assign(mesh.positions.size(), Vec2::Zero());
    atlas.mesh.texelUvs.clear();
    atlas.chartOfTriangle.assign(mesh.triangles.size(), kNoTriangle);
    atlas.sourceVertex.resize(mesh.positions.size());
    for (std::uint32_t v = 0; v < atlas.sourceVertex.size(); ++v) atlas.sourceVertex[v] = v;
    placed_.resize(mesh.positions.size());
  }

  /// `place`: a number of its own for every vertex of every chart.
  void setCorner(std::uint32_t triangle, int corner, std::uint64_t place, const Vec2& uv) {
    std::uint32_t& vertex = atlas_.mesh.triangles[triangle][corner];
    const std::uint32_t source = vertex;
    std::vector<std::pair<std::uint64_t, std::uint32_t>>& known = placed_[source];
    for (const auto& [at, number] : known)
      if (at == place) {
        vertex = number;
        return;
      }
    scene::Mesh& mesh = atlas_.mesh;
    if (!known.empty()) {
      vertex = static_cast<std::uint32_t>(mesh.positions.size());
      atlas_.sourceVertex.push_back(source);
      mesh.positions.push_back(Vec3(mesh.positions[source]));
      if (!mesh.normals.empty()) mesh.normals.push_back(Vec3(mesh.normals[source]));
      if (!mesh.colors.empty()) mesh.colors.push_back(Rgb(mesh.colors[source]));
      if (!mesh.alphas.empty()) mesh.alphas.push_back(float(mesh.alphas[source]));
      scene::copyVertex(mesh.others, source);
      mesh.uvs.emplace_back();
    }
    mesh.uvs[vertex] = uv;
    known.emplace_back(place, vertex);
  }

 private:
  Atlas& atlas_;
  std::vector<std::vector<std::pair<std::uint64_t, std::uint32_t>>> placed_;
};

}  // namespace

Result<ChartedSurface> chartedSurface(const scene::Mesh& mesh, WeldedSurface surface,
                                      float maximumStretch, const Progress& progress,
                                      std::span<const std::uint32_t> cutAt) {
  ChartedSurface charted;
  charted.surface = std::move(surface);
  if (!(charted.surface.area > 0.0))
    return report::badInput((mesh.name.empty() ? "the mesh" : "mesh \"" + mesh.name + "\"") +
                            " has no triangle of any area, and so no surface to lay out");
  std::vector<bool> cut(cutAt.empty() ? 0 : charted.surface.positions.size(), false);
  for (const std::uint32_t corner : cutAt)
    cut[charted.surface.triangles[corner / 3][corner % 3]] = true;
  Result<std::vector<LaidOutChart>> charts =
      layOut(charted.surface, cutIntoCharts(charted.surface), maximumStretch, cut, progress);
  if (!charts) return charts.error();
  charted.charts = std::move(*charts);
  charted.chartOfTriangle.assign(mesh.triangles.size(), kNoTriangle);
  for (std::uint32_t c = 0; c < charted.charts.size(); ++c) {
    charted.charts[c].area = shapeOf(charted.charts[c], 1.0).area;
    for (const std::uint32_t t : charted.charts[c].triangles) charted.chartOfTriangle[t] = c;
  }
  return charted;
}

Result<Atlas> packedAtlas(const scene::Mesh& mesh, const ChartedSurface& charted,
                          std::span<const double> densities, const PackOptions& options,
                          const Progress& progress) {
  assert(densities.empty() || densities.size() == charted.charts.size());
  const auto densityOf = [&](std::size_t c) { return densities.empty() ? 1.0 : densities[c]; };
  std::vector<PackShape> shapes(charted.charts.size());
  work::parallelFor(shapes.size(),
                    [&](std::size_t c) { shapes[c] = shapeOf(charted.charts[c], densityOf(c)); });
  if (progress && !progress({"packing", 0, shapes.size(), "charts"})) return report::cancelled();
  Result<Packing> packing = pack(shapes, options);
  if (!packing) return packing.error();
  if (progress && !progress({"packing", shapes.size(), shapes.size(), "charts"}))
    return report::cancelled();

  Atlas atlas;
  atlas.charts = static_cast<std::uint32_t>(charted.charts.size());
  AtlasMesh out(mesh, atlas);
  StretchSum whole;
  for (std::uint32_t c = 0; c < atlas.charts; ++c) {
    const LaidOutChart& chart = charted.charts[c];
    const Placement& placement = packing->placements[c];
    std::vector<Vec2d> placed(chart.layout.size());
    for (std::size_t v = 0; v < placed.size(); ++v)
      placed[v] =
          (placement.linear * (densityOf(c) * chart.layout[v]) + placement.offset) / options.size;
    const StretchSum sum = stretchOf(chart.patch, placed);
    whole.squared += sum.squared, whole.area += sum.area, whole.flat += sum.flat;
    atlas.worstStretch = std::max(atlas.worstStretch, sum.stretch());
    for (std::size_t i = 0; i < chart.triangles.size(); ++i)
      for (int k = 0; k < 3; ++k) {
        atlas.chartOfTriangle[chart.triangles[i]] = c;
        const std::uint32_t v = chart.patch.triangles[i][k];
        out.setCorner(chart.triangles[i], k, std::uint64_t(c) << 32 | v,
                      placed[v].cast<float>().cwiseMax(0.0f).cwiseMin(1.0f));
      }
  }
  atlas.stretch = whole.stretch();
  atlas.usedArea = whole.flat;

  // Triangles without area lie on a point of a chart that they touch: nothing of them can be seen.
  std::vector<std::uint32_t> cornerAt(charted.surface.positions.size(), kNoTriangle);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    if (charted.surface.hasArea(t))
      for (int k = 0; k < 3; ++k) cornerAt[charted.surface.triangles[t][k]] = 3 * t + k;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    if (charted.surface.hasArea(t)) continue;
    std::uint32_t corner = 3 * charted.charts[0].triangles[0];
    for (const std::uint32_t v : charted.surface.triangles[t])
      if (cornerAt[v] != kNoTriangle) corner = cornerAt[v];
    atlas.chartOfTriangle[t] = atlas.chartOfTriangle[corner / 3];
    const Vec2 uv = atlas.mesh.uvs[atlas.mesh.triangles[corner / 3][corner % 3]];
    for (int k = 0; k < 3; ++k) out.setCorner(t, k, std::uint64_t(0xffffffffu) << 32 | corner, uv);
  }
  return atlas;
}

}  // namespace lambent::atlas
