// This work is based on:
// - sander2003multi: §3.1, charts grown from seeds by a shortest path whose cost is distance times
//   the turn of the normal away from the chart's, and moved seeds, as Lloyd's method does.
// - cohen2004variational: the mean normal as a chart's proxy, seeds at the best fit.
// Where we deviate: the number of charts is not asked for. Regions are bisected until their normals
// agree well enough, then all grow together, and neighbours whose union still agrees are joined.
// What "well enough" leaves wrong is settled by laying charts out and cutting those that stretch.
#include "lambent/atlas/charts.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <map>
#include <queue>
#include <set>
#include <tuple>

#include <Eigen/Geometry>

#include "lambent/atlas/smooth_borders.h"
#include "lambent/work/parallel_for.h"

namespace lambent::atlas {
namespace {

/// Length of the mean normal below which a region is bisected: 1 for a plane, (1 + cos θ)/2 for the
/// cap of a sphere around an angle θ (73° here).
constexpr double kCoherent = 0.65;
/// … and down to which neighbours are joined.
constexpr double kJoinable = 0.66;
/// … and down to which charts below kSmall of the mean area are joined with a neighbour.
constexpr double kJoinableIfSmall = 0.45;
constexpr double kSmall = 0.15;
/// Rough surfaces never agree: regions below this share of the surface are left to the layout.
constexpr double kSmallestBisected = 1.0 / 400.0;
/// Distance counts for this much even where the normal is the chart's: charts of flat surfaces
/// become round.
constexpr double kRoundness = 0.15;
/// Cosine of the angle from which a crease is sharp: regions end there before they are bisected.
constexpr double kSharp = 0.6;
/// What crossing a crease costs, per 1 − cos of its angle.
constexpr double kCreaseCost = 6.0;

struct Seed {
  std::uint32_t triangle;
  Vec3d normal;  ///< unit, the mean of its chart
};

struct Scratch {
  std::vector<double> cost;
  std::vector<std::uint32_t> owner;
  explicit Scratch(std::size_t triangles) : cost(triangles), owner(triangles) {}
};

Vec3d normalSum(const WeldedSurface& surface, const Chart& chart) {
  Vec3d sum = Vec3d::Zero();
  for (const std::uint32_t t : chart) sum += surface.areas[t] * surface.normals[t];
  return sum;
}

double areaOf(const WeldedSurface& surface, const Chart& chart) {
  double sum = 0.0;
  for (const std::uint32_t t : chart) sum += surface.areas[t];
  return sum;
}

double edgeLength(const WeldedSurface& surface, std::uint32_t triangle, int side) {
  const auto& v = surface.triangles[triangle];
  return (surface.positions[v[side]] - surface.positions[v[(side + 1) % 3]]).norm();
}

/// The triangle nearest to the middle of the chart. On a curved chart the mean of positions hangs
/// in the air, over the triangle that is meant.
Seed seedOf(const WeldedSurface& surface, const Chart& chart) {
  Vec3d middle = Vec3d::Zero();
  for (const std::uint32_t t : chart) middle += surface.areas[t] * surface.centroids[t];
  middle /= areaOf(surface, chart);
  const Vec3d sum = normalSum(surface, chart);
  Seed seed{chart.front(), sum.norm() > 0.0 ? Vec3d(sum.normalized()) : Vec3d(Vec3d::Zero())};
  double best = std::numeric_limits<double>::infinity();
  for (const std::uint32_t t : chart) {
    const double distance =
        (surface.centroids[t] - middle).squaredNorm() * (2.0 - surface.normals[t].dot(seed.normal));
    if (distance < best) best = distance, seed.triangle = t;
  }
  return seed;
}

/// Grows charts from the seeds over `region`, whose triangles are those with chartOf = `id`.
/// Returns the triangle that was reached last.
std::uint32_t grow(const WeldedSurface& surface, const Chart& region,
                   const std::vector<std::uint32_t>& chartOf, std::uint32_t id,
                   const std::vector<Seed>& seeds, Scratch& scratch) {
  using Entry = std::tuple<double, std::uint32_t, std::uint32_t>;  // cost, triangle, seed
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  for (const std::uint32_t t : region) {
    scratch.cost[t] = std::numeric_limits<double>::infinity();
    scratch.owner[t] = kNoTriangle;
  }
  for (std::uint32_t s = 0; s < seeds.size(); ++s) {
    scratch.cost[seeds[s].triangle] = 0.0;
    queue.emplace(0.0, seeds[s].triangle, s);
  }
  std::uint32_t last = seeds.front().triangle;
  while (!queue.empty()) {
    const auto [cost, t, s] = queue.top();
    queue.pop();
    if (scratch.owner[t] != kNoTriangle) continue;
    scratch.owner[t] = s;
    last = t;
    for (const std::uint32_t n : surface.neighbours[t]) {
      if (n == kNoTriangle || chartOf[n] != id || scratch.owner[n] != kNoTriangle) continue;
      const double turn = 1.0 - seeds[s].normal.dot(surface.normals[n]);
      const double crease = 1.0 - surface.normals[t].dot(surface.normals[n]);
      const double reached = cost + (surface.centroids[n] - surface.centroids[t]).norm() *
                                        (kRoundness + turn) * (1.0 + kCreaseCost * crease);
      if (reached < scratch.cost[n]) {
        scratch.cost[n] = reached;
        queue.emplace(reached, n, s);
      }
    }
  }
  return last;
}

std::vector<Chart> gather(const Chart& region, std::size_t seeds, const Scratch& scratch) {
  std::vector<Chart> charts(seeds);
  for (const std::uint32_t t : region) charts[scratch.owner[t]].push_back(t);
  return charts;
}

/// Two pieces, grown from two ends.
std::vector<Chart> bisect(const WeldedSurface& surface, const Chart& region,
                          const std::vector<std::uint32_t>& chartOf, Scratch& scratch,
                          int iterations) {
  const std::uint32_t id = chartOf[region.front()];
  assert(region.size() >= 2);
  Seed middle = seedOf(surface, region);
  std::vector<Seed> seeds(1, middle);
  seeds[0].triangle = grow(surface, region, chartOf, id, seeds, scratch);
  seeds[0].normal = surface.normals[seeds[0].triangle];
  const std::uint32_t other = grow(surface, region, chartOf, id, seeds, scratch);
  seeds.push_back({other, surface.normals[other]});
  std::vector<Chart> pieces;
  for (int i = 0; i < iterations; ++i) {
    grow(surface, region, chartOf, id, seeds, scratch);
    pieces = gather(region, 2, scratch);
    for (int k = 0; k < 2; ++k) seeds[k] = seedOf(surface, pieces[k]);
  }
  return pieces;
}

void label(const std::vector<Chart>& charts, std::vector<std::uint32_t>& chartOf) {
  work::parallelFor(charts.size(), [&](std::size_t c) {
    for (const std::uint32_t t : charts[c]) chartOf[t] = static_cast<std::uint32_t>(c);
  });
}

/// Bisects regions until their normals agree.
std::vector<Chart> bisectAll(const WeldedSurface& surface, std::vector<Chart> work,
                             std::vector<std::uint32_t>& chartOf, Scratch& scratch) {
  std::vector<Chart> done;
  while (!work.empty()) {
    label(work, chartOf);
    std::vector<std::vector<Chart>> pieces(work.size());
    work::parallelFor(work.size(), [&](std::size_t c) {
      const double area = areaOf(surface, work[c]);
      if (work[c].size() >= 2 && area > kSmallestBisected * surface.area &&
          normalSum(surface, work[c]).norm() < kCoherent * area)
        pieces[c] = bisect(surface, work[c], chartOf, scratch, 3);
    });
    std::vector<Chart> next;
    for (std::size_t c = 0; c < work.size(); ++c) {
      if (pieces[c].empty()) done.push_back(std::move(work[c]));
      for (Chart& piece : pieces[c]) next.push_back(std::move(piece));
    }
    work.swap(next);
  }
  return done;
}

/// Pieces of the surface between sharp creases. Small ones, of rough surfaces and bevels, do not
/// count: creases around them are passed.
std::vector<Chart> piecesBetweenCreases(const WeldedSurface& surface) {
  const std::size_t count = surface.triangles.size();
  std::vector<std::uint32_t> pieceOf(count, kNoTriangle);
  std::vector<std::uint32_t> stack;
  const auto flood = [&](const auto& passable) {
    std::vector<Chart> pieces;
    std::fill(pieceOf.begin(), pieceOf.end(), kNoTriangle);
    for (std::uint32_t first = 0; first < count; ++first) {
      if (pieceOf[first] != kNoTriangle || !surface.hasArea(first)) continue;
      const auto id = static_cast<std::uint32_t>(pieces.size());
      Chart& piece = pieces.emplace_back();
      pieceOf[first] = id;
      stack.push_back(first);
      while (!stack.empty()) {
        const std::uint32_t t = stack.back();
        stack.pop_back();
        piece.push_back(t);
        for (const std::uint32_t n : surface.neighbours[t])
          if (n != kNoTriangle && pieceOf[n] == kNoTriangle && passable(t, n))
            pieceOf[n] = id, stack.push_back(n);
      }
      std::sort(piece.begin(), piece.end());
    }
    return pieces;
  };
  const auto smooth = [&](std::uint32_t a, std::uint32_t b) {
    return surface.normals[a].dot(surface.normals[b]) > kSharp;
  };
  const std::vector<Chart> pieces = flood(smooth);
  std::vector<bool> small(count);
  for (const Chart& piece : pieces)
    if (areaOf(surface, piece) < kSmallestBisected * surface.area)
      for (const std::uint32_t t : piece) small[t] = true;
  return flood(
      [&](std::uint32_t a, std::uint32_t b) { return smooth(a, b) || small[a] || small[b]; });
}

/// Joins neighbours, the pair with the longest common border for its size first, as long as the
/// normals of the union agree.
std::vector<Chart> join(const WeldedSurface& surface, std::vector<std::uint32_t>& chartOf,
                        std::size_t count) {
  struct Node {
    Vec3d normal = Vec3d::Zero();
    double area = 0.0, border = 0.0;
    std::map<std::uint32_t, double> shared;  ///< common border, metres
    std::uint32_t into = kNoTriangle;
  };
  std::vector<Node> nodes(count);
  double total = 0.0;
  for (std::uint32_t t = 0; t < surface.triangles.size(); ++t) {
    if (!surface.hasArea(t)) continue;
    Node& node = nodes[chartOf[t]];
    node.normal += surface.areas[t] * surface.normals[t];
    node.area += surface.areas[t];
    total += surface.areas[t];
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t n = surface.neighbours[t][k];
      if (n != kNoTriangle && chartOf[n] == chartOf[t]) continue;
      const double length = edgeLength(surface, t, k);
      node.border += length;
      if (n != kNoTriangle) node.shared[chartOf[n]] += length;
    }
  }
  const double smallArea = kSmall * total / static_cast<double>(count);
  /// How much of the smaller one's border goes away, if the two may be joined.
  const auto gain = [&](std::uint32_t a, std::uint32_t b) {
    const Node &x = nodes[a], &y = nodes[b];
    const double area = x.area + y.area;
    const bool small = std::min(x.area, y.area) < smallArea;
    if ((x.normal + y.normal).norm() < (small ? kJoinableIfSmall : kJoinable) * area) return 0.0;
    const double shared = x.shared.at(b);
    // A union with a long border for its area would leave gaps in the map.
    const double border = x.border + y.border - 2.0 * shared;
    if (!small && border * border > 45.0 * area) return 0.0;
    const double share = shared / std::min(x.border, y.border);
    return small ? 1.0 + share : (share > 0.2 ? share : 0.0);
  };
  using Entry = std::tuple<double, std::uint32_t, std::uint32_t>;
  std::priority_queue<Entry> queue;
  const auto offer = [&](std::uint32_t a, std::uint32_t b) {
    const double g = gain(std::min(a, b), std::max(a, b));
    if (g > 0.0) queue.emplace(g, std::min(a, b), std::max(a, b));
  };
  for (std::uint32_t a = 0; a < count; ++a)
    for (const auto& [b, length] : nodes[a].shared)
      if (a < b) offer(a, b);
  while (!queue.empty()) {
    const auto [g, a, b] = queue.top();
    queue.pop();
    if (nodes[a].into != kNoTriangle || nodes[b].into != kNoTriangle) continue;
    if (gain(a, b) != g) continue;  // one of them has grown: that offer stands elsewhere
    const double shared = nodes[a].shared.at(b);
    nodes[b].into = a;
    nodes[a].normal += nodes[b].normal;
    nodes[a].area += nodes[b].area;
    nodes[a].border += nodes[b].border - 2.0 * shared;
    nodes[a].shared.erase(b);
    for (const auto& [c, length] : nodes[b].shared) {
      nodes[c].shared.erase(b);
      if (c == a) continue;
      nodes[a].shared[c] += length;
      nodes[c].shared[a] += length;
    }
    for (const auto& [c, length] : nodes[a].shared) offer(a, c);
  }
  std::vector<std::uint32_t> number(count, kNoTriangle);
  std::vector<Chart> charts;
  for (std::uint32_t t = 0; t < surface.triangles.size(); ++t) {
    if (!surface.hasArea(t)) continue;
    std::uint32_t c = chartOf[t];
    while (nodes[c].into != kNoTriangle) c = nodes[c].into;
    if (number[c] == kNoTriangle) {
      number[c] = static_cast<std::uint32_t>(charts.size());
      charts.emplace_back();
    }
    charts[number[c]].push_back(t);
  }
  return charts;
}

}  // namespace

std::vector<Chart> cutIntoCharts(const WeldedSurface& surface) {
  Scratch scratch(surface.triangles.size());
  std::vector<std::uint32_t> chartOf(surface.triangles.size(), kNoTriangle);
  std::vector<Chart> charts = bisectAll(surface, piecesBetweenCreases(surface), chartOf, scratch);
  // All grow together, from the seeds that bisection found.
  Chart everything;
  for (std::uint32_t t = 0; t < surface.triangles.size(); ++t)
    if (surface.hasArea(t)) everything.push_back(t);
  if (everything.empty()) return {};
  std::vector<std::uint32_t> one(surface.triangles.size(), kNoTriangle);
  for (const std::uint32_t t : everything) one[t] = 0;
  for (int i = 0; i < 4; ++i) {
    std::vector<Seed> seeds(charts.size());
    work::parallelFor(charts.size(), [&](std::size_t c) { seeds[c] = seedOf(surface, charts[c]); });
    grow(surface, everything, one, 0, seeds, scratch);
    charts = gather(everything, seeds.size(), scratch);
  }
  charts = smoothBorders(surface, charts);
  label(charts, chartOf);
  return join(surface, chartOf, charts.size());
}

std::vector<Chart> cutInTwo(const WeldedSurface& surface, const Chart& chart,
                            const std::vector<std::uint32_t>& chartOf) {
  // Growth over a few triangles of a large surface must not cost the whole of it.
  thread_local Scratch scratch(0);
  if (scratch.cost.size() < surface.triangles.size()) scratch = Scratch(surface.triangles.size());
  return bisect(surface, chart, chartOf, scratch, 3);
}

std::vector<Chart> cutThrough(const WeldedSurface& surface, const Chart& chart,
                              const std::vector<std::uint32_t>& chartOf, std::uint32_t vertex) {
  constexpr int kDirections = 12;
  const std::uint32_t id = chartOf[chart.front()];
  const Vec3d at = surface.positions[vertex];
  Vec3d normal = Vec3d::Zero();
  for (const std::uint32_t t : chart)
    for (const std::uint32_t v : surface.triangles[t])
      if (v == vertex) normal += surface.areas[t] * surface.normals[t];
  const Vec3d x = normal.unitOrthogonal(), y = normal.normalized().cross(x);
  const auto across = [&](int k) -> Vec3d {
    const double angle = kPi * k / kDirections;
    return std::cos(angle) * x + std::sin(angle) * y;
  };
  const auto left = [&](const Vec3d& direction, std::uint32_t t) {
    return (surface.centroids[t] - at).dot(direction) >= 0.0;
  };
  double shortest = std::numeric_limits<double>::infinity();
  Vec3d chosen = x;
  for (int k = 0; k < kDirections; ++k) {
    const Vec3d direction = across(k);
    double length = 0.0;
    for (const std::uint32_t t : chart)
      for (int side = 0; side < 3; ++side) {
        const std::uint32_t n = surface.neighbours[t][side];
        if (n != kNoTriangle && n > t && chartOf[n] == id &&
            left(direction, t) != left(direction, n))
          length += edgeLength(surface, t, side);
      }
    if (length < shortest) shortest = length, chosen = direction;
  }
  const auto touches = [&](std::uint32_t t) {
    const auto& corners = surface.triangles[t];
    return std::find(corners.begin(), corners.end(), vertex) != corners.end();
  };
  // What hangs together with the vertex on one side of the cut, and what is left, which may well
  // reach over the cut elsewhere.
  std::vector<Chart> pieces;
  std::set<std::uint32_t> rest(chart.begin(), chart.end());
  const auto flood = [&](std::uint32_t first, bool leftAlone) {
    Chart& piece = pieces.emplace_back(1, first);
    rest.erase(first);
    for (std::size_t i = 0; i < piece.size(); ++i)
      for (const std::uint32_t n : surface.neighbours[piece[i]])
        if (n != kNoTriangle && rest.contains(n) && (!leftAlone || left(chosen, n)))
          rest.erase(n), piece.push_back(n);
    std::sort(piece.begin(), piece.end());
  };
  for (const std::uint32_t t : chart)
    if (touches(t) && left(chosen, t)) {
      flood(t, true);
      break;
    }
  while (!rest.empty()) flood(*rest.begin(), false);
  const auto with = std::count_if(pieces.begin(), pieces.end(), [&](const Chart& piece) {
    return std::any_of(piece.begin(), piece.end(), touches);
  });
  return with > 1 ? pieces : cutInTwo(surface, chart, chartOf);
}

}  // namespace lambent::atlas
