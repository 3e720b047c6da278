// This work is based on:
// - sander2001texture: §3, L² stretch, the measure that layouts are judged by.
// - tutte1963draw: a disc whose border lies on a convex polygon, with positive weights inside, is
//   laid out without a triangle turned over: the start that always exists.
// - liu2008local: as-rigid-as-possible steps, which come near in a few steps.
// - smith2015bijective: descent that never turns a triangle over.
// - liu2017quasi: L-BFGS with a factored Laplacian for its first guess of the curvature.
// Where we deviate from the bi-scale paper, which lays charts out in polygons on a circle
// (sloan2003biscale §4.3): borders are free, so that charts keep their shape and stretch less.
#include "lambent/atlas/flatten.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <unordered_map>

#include <Eigen/Geometry>
#include <Eigen/SparseCholesky>

#include "lambent/atlas/layout_energy.h"

namespace lambent::atlas {
namespace {

constexpr int kRigidSteps = 12;
constexpr int kDescentSteps = 60;
constexpr int kMemory = 5;
constexpr double kConverged = 2e-5;  ///< relative decrease of the energy, over five steps

using Solver = Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>;

/// The chart seen along its mean normal.
Layout projected(const ChartPatch& patch) {
  Vec3d normal = Vec3d::Zero();
  for (std::size_t i = 0; i < patch.chartTriangles; ++i) {
    const auto& t = patch.triangles[i];
    normal += (patch.positions[t[1]] - patch.positions[t[0]])
                  .cross(patch.positions[t[2]] - patch.positions[t[0]]);
  }
  if (!(normal.norm() > 0.0)) normal = Vec3d::UnitZ();
  normal.normalize();
  const Vec3d x = normal.unitOrthogonal(), y = normal.cross(x);
  Layout layout(patch.positions.size(), 2);
  for (std::size_t v = 0; v < patch.positions.size(); ++v)
    layout.row(v) << (patch.positions[v] - patch.positions[0]).dot(x),
        (patch.positions[v] - patch.positions[0]).dot(y);
  return layout;
}

/// The border on a circle in proportion to its length, the rest harmonic between, of the chart's
/// area. Weights are cotangents where those are positive.
std::optional<Layout> onCircle(const ChartPatch& patch, const LayoutEnergy& energy,
                               const Eigen::SparseMatrix<double>& laplacian) {
  const std::vector<std::uint32_t>& border = patch.loops.front();
  const Eigen::Index count = laplacian.rows();
  Layout layout = Layout::Zero(count, 2);
  std::vector<Eigen::Index> inner(count, 0);
  double length = 0.0;
  const auto edge = [&](std::size_t i) {
    return (patch.positions[border[(i + 1) % border.size()]] - patch.positions[border[i]]).norm();
  };
  for (std::size_t i = 0; i < border.size(); ++i) length += edge(i);
  const double radius = std::sqrt(energy.area() / kPi);
  double along = 0.0;
  for (std::size_t i = 0; i < border.size(); ++i) {
    const double angle = 2.0 * kPi * along / length;
    layout.row(border[i]) << radius * std::cos(angle), radius * std::sin(angle);
    inner[border[i]] = -1;
    along += edge(i);
  }
  Eigen::Index unknowns = 0;
  for (Eigen::Index v = 0; v < count; ++v)
    if (inner[v] == 0) inner[v] = unknowns++;
  if (unknowns == 0) return layout;
  std::vector<Eigen::Triplet<double>> entries;
  Layout right = Layout::Zero(unknowns, 2);
  for (Eigen::Index column = 0; column < count; ++column) {
    if (inner[column] < 0) continue;
    double sum = 0.0;
    const double least = 1e-3;  // of a weight, which is ½ (cot α + cot β)
    for (Eigen::SparseMatrix<double>::InnerIterator it(laplacian, column); it; ++it) {
      if (it.row() == column) continue;
      const double weight = std::clamp(-it.value(), least, 1.0 / least);
      sum += weight;
      if (inner[it.row()] < 0)
        right.row(inner[column]) += weight * layout.row(it.row());
      else
        entries.emplace_back(inner[it.row()], inner[column], -weight);
    }
    entries.emplace_back(inner[column], inner[column], sum);
  }
  Eigen::SparseMatrix<double> matrix(unknowns, unknowns);
  matrix.setFromTriplets(entries.begin(), entries.end());
  Solver solver(matrix);
  if (solver.info() != Eigen::Success) return std::nullopt;
  const Layout solved = solver.solve(right);
  for (Eigen::Index v = 0; v < count; ++v)
    if (inner[v] >= 0) layout.row(v) = solved.row(inner[v]);
  return layout;
}

/// Alternates between turning each triangle's own shape to lie as it does, and laying all out as
/// near to those as they fit. Fast, but triangles may turn over.
Layout rigidSteps(const LayoutEnergy& energy, const Solver& solver, Layout layout, int steps) {
  for (int i = 0; i < steps; ++i) {
    // Solving for the change keeps the place of the pinned vertex.
    layout = solver.solve(energy.rigidTarget(layout));
  }
  return layout;
}

/// Descends from a layout without flips to one near the minimum, through layouts without flips.
Layout descend(const LayoutEnergy& energy, const Solver& solver, Layout layout, int steps) {
  std::vector<Layout> moves, changes;  // of the last steps: s and y of L-BFGS
  std::vector<double> curvatures;
  Layout gradient;
  double value = energy.evaluate(layout, &gradient);
  std::vector<double> values{value};
  for (int step = 0; step < steps && std::isfinite(value); ++step) {
    Layout direction = -gradient;
    std::vector<double> alphas(moves.size());
    for (std::size_t i = moves.size(); i-- > 0;) {
      alphas[i] = moves[i].cwiseProduct(direction).sum() / curvatures[i];
      direction -= alphas[i] * changes[i];
    }
    // At an isometry the energy's curvature is up to four times that of the Dirichlet energy.
    direction = 0.25 * Layout(solver.solve(direction));
    for (std::size_t i = 0; i < moves.size(); ++i) {
      const double beta = changes[i].cwiseProduct(direction).sum() / curvatures[i];
      direction += (alphas[i] - beta) * moves[i];
    }
    double slope = gradient.cwiseProduct(direction).sum();
    if (!(slope < 0.0)) {
      if (moves.empty()) break;
      moves.clear(), changes.clear(), curvatures.clear();
      continue;
    }
    double length = std::min(1.0, 0.8 * energy.largestStep(layout, direction));
    Layout tried, triedGradient;
    double reached = std::numeric_limits<double>::infinity();
    for (int halving = 0; halving < 30; ++halving, length *= 0.5) {
      tried = layout + length * direction;
      reached = energy.evaluate(tried);
      if (reached <= value + 1e-4 * length * slope) break;
      reached = std::numeric_limits<double>::infinity();
    }
    if (!std::isfinite(reached)) break;
    energy.evaluate(tried, &triedGradient);
    Layout move = tried - layout, change = triedGradient - gradient;
    const double curvature = move.cwiseProduct(change).sum();
    if (curvature > 1e-12 * move.norm() * change.norm()) {
      moves.push_back(std::move(move));
      changes.push_back(std::move(change));
      curvatures.push_back(curvature);
      if (moves.size() > std::size_t(kMemory)) {
        moves.erase(moves.begin());
        changes.erase(changes.begin());
        curvatures.erase(curvatures.begin());
      }
    }
    layout.swap(tried);
    gradient.swap(triedGradient);
    value = reached;
    values.push_back(value);
    if (values.size() > 5 && values[values.size() - 6] - value < kConverged * value) break;
  }
  return layout;
}

std::vector<Vec2d> atTheSurfacesArea(const ChartPatch& patch, const Layout& layout) {
  std::vector<Vec2d> result(patch.chartVertices());
  for (std::size_t v = 0; v < result.size(); ++v) result[v] = layout.row(v);
  const StretchSum sum = stretchOf(patch, result);
  const double scale = std::sqrt(sum.area / sum.flat);
  for (Vec2d& p : result) p *= scale;
  return result;
}

bool anyFlipped(const ChartPatch& patch, const std::vector<Vec2d>& layout) {
  for (std::size_t i = 0; i < patch.chartTriangles; ++i) {
    const auto& t = patch.triangles[i];
    const Vec2d a = layout[t[1]] - layout[t[0]], b = layout[t[2]] - layout[t[0]];
    if (!(a.x() * b.y() - a.y() * b.x() > 0.0)) return true;
  }
  return false;
}

}  // namespace

double triangleStretch(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec2d& pa,
                       const Vec2d& pb, const Vec2d& pc) {
  const Vec2d e = pb - pa, f = pc - pa;
  const double doubled = e.x() * f.y() - e.y() * f.x();
  if (!(doubled > 0.0)) return std::numeric_limits<double>::infinity();
  // Partial derivatives of the surface by the plane's coordinates.
  const Vec3d u = ((b - a) * f.y() - (c - a) * e.y()) / doubled;
  const Vec3d v = ((c - a) * e.x() - (b - a) * f.x()) / doubled;
  return std::sqrt(0.5 * (u.squaredNorm() + v.squaredNorm()));
}

double StretchSum::stretch() const {
  return area > 0.0 ? std::sqrt(squared / area * flat / area) : 1.0;
}

StretchSum stretchOf(const ChartPatch& patch, const std::vector<Vec2d>& layout) {
  StretchSum sum;
  for (std::size_t i = 0; i < patch.chartTriangles; ++i) {
    const auto& t = patch.triangles[i];
    const Vec3d &a = patch.positions[t[0]], &b = patch.positions[t[1]], &c = patch.positions[t[2]];
    const double area = 0.5 * (b - a).cross(c - a).norm();
    const Vec2d e = layout[t[1]] - layout[t[0]], f = layout[t[2]] - layout[t[0]];
    const double stretch = triangleStretch(a, b, c, layout[t[0]], layout[t[1]], layout[t[2]]);
    sum.squared += area * stretch * stretch;
    sum.area += area;
    sum.flat += 0.5 * (e.x() * f.y() - e.y() * f.x());
  }
  return sum;
}

bool outlineCrossesItself(const std::vector<std::vector<std::uint32_t>>& loops,
                          const std::vector<Vec2d>& layout) {
  struct Segment {
    std::uint32_t from, to;
  };
  std::vector<Segment> segments;
  double length = 0.0;
  Vec2d lower = Vec2d::Constant(std::numeric_limits<double>::infinity()), upper = -lower;
  for (const auto& loop : loops)
    for (std::size_t i = 0; i < loop.size(); ++i) {
      segments.push_back({loop[i], loop[(i + 1) % loop.size()]});
      length += (layout[segments.back().to] - layout[segments.back().from]).norm();
      lower = lower.cwiseMin(layout[loop[i]]);
      upper = upper.cwiseMax(layout[loop[i]]);
    }
  if (segments.size() < 4 || !(length > 0.0)) return false;
  const double cell =
      std::max(length / static_cast<double>(segments.size()), (upper - lower).maxCoeff() / 4096.0);
  const auto side = [](const Vec2d& a, const Vec2d& b, const Vec2d& c) {
    return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
  };
  const auto cross = [&](const Segment& s, const Segment& t) {
    if (s.from == t.from || s.from == t.to || s.to == t.from || s.to == t.to) return false;
    const Vec2d &a = layout[s.from], &b = layout[s.to], &c = layout[t.from], &d = layout[t.to];
    return (side(a, b, c) > 0.0) != (side(a, b, d) > 0.0) &&
           (side(c, d, a) > 0.0) != (side(c, d, b) > 0.0);
  };
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> cells;
  for (std::uint32_t s = 0; s < segments.size(); ++s) {
    const Vec2d &a = layout[segments[s].from], &b = layout[segments[s].to];
    const auto cellOf = [&](double x, double from) {
      return static_cast<std::uint64_t>((x - from) / cell);
    };
    const std::uint64_t x0 = cellOf(std::min(a.x(), b.x()), lower.x()),
                        x1 = cellOf(std::max(a.x(), b.x()), lower.x()),
                        y0 = cellOf(std::min(a.y(), b.y()), lower.y()),
                        y1 = cellOf(std::max(a.y(), b.y()), lower.y());
    for (std::uint64_t y = y0; y <= y1; ++y)
      for (std::uint64_t x = x0; x <= x1; ++x) {
        std::vector<std::uint32_t>& here = cells[y << 32 | x];
        for (const std::uint32_t other : here)
          if (cross(segments[s], segments[other])) return true;
        here.push_back(s);
      }
  }
  return false;
}

std::optional<std::vector<Vec2d>> flatten(const ChartPatch& patch) {
  if (patch.chartTriangles == 1) {
    const Vec3d &a = patch.positions[0], &b = patch.positions[1], &c = patch.positions[2];
    const Vec3d x = (b - a).normalized();
    const double foot = (c - a).dot(x);
    return std::vector<Vec2d>{Vec2d::Zero(), Vec2d((b - a).norm(), 0.0),
                              Vec2d(foot, ((c - a) - foot * x).norm())};
  }
  const LayoutEnergy energy(patch);
  Eigen::SparseMatrix<double> laplacian = energy.laplacian();
  Eigen::SparseMatrix<double> pinned = laplacian;
  pinned.coeffRef(0, 0) += std::max(laplacian.coeff(0, 0), 1.0);  // else any shift is a solution
  const Solver solver(pinned);
  if (solver.info() != Eigen::Success) return std::nullopt;

  const Layout seen = projected(patch);
  Layout layout = rigidSteps(energy, solver, seen, kRigidSteps);
  int steps = kDescentSteps;
  if (!energy.flipFree(layout)) {
    const std::optional<Layout> start = onCircle(patch, energy, laplacian);
    if (!start || !energy.flipFree(*start)) {
      if (!energy.flipFree(seen)) return std::nullopt;
      layout = seen;
    } else {
      layout = rigidSteps(energy, solver, *start, 2 * kRigidSteps);
      if (!energy.flipFree(layout)) layout = *start, steps *= 3;
    }
  }
  layout = descend(energy, solver, std::move(layout), steps);
  if (!layout.allFinite()) return std::nullopt;
  std::vector<Vec2d> result = atTheSurfacesArea(patch, layout);
  if (anyFlipped(patch, result) || outlineCrossesItself(patch.loops, result)) return std::nullopt;
  return result;
}

}  // namespace lambent::atlas
