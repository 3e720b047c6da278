// This work is based on:
// - liu2004computational: what a pattern repeats is told by the peaks of its autocorrelation; the
//   translations generate a lattice, and few turns are possible beside them.
// Where we differ: what is compared is not a picture but the response to light, whose directions
// turn with the patch; so relief counts, and a patch lit from one side is no less symmetric.
#include "lambent/synthesis/patch_symmetry.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <vector>

#include <Eigen/Dense>

#include "lambent/work/parallel_for.h"

namespace lambent::synthesis {
namespace {

constexpr int kMostPlaces = 64;      ///< a side of the grid that is compared
constexpr int kFinest = 16;          ///< cells along a side at most
constexpr double kTranslated = 0.8;  ///< correlation from which a translation counts
constexpr double kTurned = 0.9;      ///< … and a turn

/// Responses seen from above, less their mean: [y][x][band, channel].
struct Plan {
  int width = 0, height = 0, bands = 0;
  Eigen::MatrixXf values;  ///< dimensions × places

  Eigen::Index place(int x, int y) const {
    return Eigen::Index((y % height + height) % height) * width + (x % width + width) % width;
  }
};

Plan planOf(const transfer::SimulatedRtt& rtt) {
  const int step = (std::max(rtt.width, rtt.height) + kMostPlaces - 1) / kMostPlaces;
  Plan plan;
  plan.width = std::max(1, rtt.width / step), plan.height = std::max(1, rtt.height / step);
  plan.bands = std::min(rtt.bands, 3);
  const int coefficients = plan.bands * plan.bands;
  plan.values.setZero(3 * coefficients, Eigen::Index(plan.width) * plan.height);
  const int low = (rtt.views - 1) / 2, high = rtt.views / 2;  // the views about the middle
  for (int c = 0, l = 0; c < coefficients; ++c) {
    if (c == (l + 1) * (l + 1)) ++l;
    const float weight = 1.0f / float(std::max(l, 1));
    for (int y = 0; y < plan.height * step; ++y)
      for (int x = 0; x < plan.width * step; ++x)
        for (int vy = low; vy <= high; ++vy)
          for (int vx = low; vx <= high; ++vx)
            for (int k = 0; k < 3; ++k)
              plan.values(3 * c + k, plan.place(x / step, y / step)) +=
                  weight * rtt.values[rtt.index(c, x, y, vx, vy) + std::size_t(k)];
  }
  plan.values.colwise() -= Eigen::VectorXf(plan.values.rowwise().mean());
  return plan;
}

/// The patch turned counter-clockwise by `quarters` quarter turns, its light with it.
Plan turned(const Plan& plan, int quarters) {
  Plan out = plan;
  for (int y = 0; y < plan.height; ++y)
    for (int x = 0; x < plan.width; ++x) {
      int u = x, v = y;
      if (quarters == 1) u = plan.width - 1 - y, v = x;
      if (quarters == 2) u = plan.width - 1 - x, v = plan.height - 1 - y;
      const auto from = plan.values.col(plan.place(x, y));
      auto to = out.values.col(out.place(u, v));
      for (int l = 0; l < plan.bands; ++l)
        for (int m = 0; m <= l; ++m) {
          // A function turned by α: its pair (cos mφ, sin mφ) turns by mα.
          const int turn = (m * quarters) % 4;
          const float cosine = turn == 0 ? 1.0f : turn == 2 ? -1.0f : 0.0f;
          const float sine = turn == 1 ? 1.0f : turn == 3 ? -1.0f : 0.0f;
          const int plus = 3 * (l * l + l + m), minus = 3 * (l * l + l - m);
          for (int k = 0; k < 3; ++k) {
            const float c = from[plus + k], s = from[minus + k];
            to[plus + k] = m == 0 ? c : cosine * c - sine * s;
            if (m > 0) to[minus + k] = sine * c + cosine * s;
          }
        }
    }
  return out;
}

/// Correlation of a(q) with b(q + t) for every t, [t.y][t.x].
Eigen::VectorXd correlations(const Plan& a, const Plan& b) {
  Eigen::VectorXd found = Eigen::VectorXd::Zero(a.values.cols());
  const double own = std::sqrt(double(a.values.squaredNorm()) * double(b.values.squaredNorm()));
  if (!(own > 0.0)) return Eigen::VectorXd::Ones(a.values.cols());  // of one colour
  work::parallelFor(std::size_t(a.height), [&](std::size_t ty) {
    for (int tx = 0; tx < a.width; ++tx) {
      double sum = 0.0;
      for (int y = 0; y < a.height; ++y) {
        const Eigen::Index row = a.place(0, y), other = b.place(0, y + int(ty));
        // Two runs of a row: up to where it wraps, and on from there.
        sum += double(a.values.middleCols(row, a.width - tx)
                          .cwiseProduct(b.values.middleCols(other + tx, a.width - tx))
                          .sum());
        if (tx > 0)
          sum += double(a.values.middleCols(row + a.width - tx, tx)
                            .cwiseProduct(b.values.middleCols(other, tx))
                            .sum());
      }
      found[Eigen::Index(ty) * a.width + tx] = sum / own;
    }
  });
  return found;
}

struct Peak {
  Vec2d at;  ///< fractions of the period
  double height;
};

/// Local maxima, between places, the highest first.
std::vector<Peak> peaksOf(const Plan& plan, const Eigen::VectorXd& c) {
  std::vector<Peak> peaks;
  for (int y = 0; y < plan.height; ++y)
    for (int x = 0; x < plan.width; ++x) {
      const double here = c[plan.place(x, y)];
      bool highest = true;
      for (int dy = -1; dy <= 1 && highest; ++dy)
        for (int dx = -1; dx <= 1 && highest; ++dx) {
          const Eigen::Index other = plan.place(x + dx, y + dy);
          if (other == plan.place(x, y)) continue;
          highest = c[other] < here || (c[other] == here && other > plan.place(x, y));
        }
      if (!highest) continue;
      // The parabola through three values along each axis.
      const auto between = [&](double before, double after, double& offset) {
        const double bend = before - 2.0 * here + after;
        offset = bend < -1e-12 ? std::clamp(0.5 * (before - after) / bend, -0.5, 0.5) : 0.0;
        return bend < -1e-12 ? -0.25 * (before - after) * offset : 0.0;
      };
      double dx = 0.0, dy = 0.0;
      const double more = between(c[plan.place(x - 1, y)], c[plan.place(x + 1, y)], dx) +
                          between(c[plan.place(x, y - 1)], c[plan.place(x, y + 1)], dy);
      peaks.push_back({Vec2d((x + dx) / plan.width, (y + dy) / plan.height), here + more});
    }
  std::stable_sort(peaks.begin(), peaks.end(),
                   [](const Peak& a, const Peak& b) { return a.height > b.height; });
  return peaks;
}

/// n·t is a whole period for the least n up to kFinest; t is set to be exactly so.
std::optional<int> orderOf(Vec2d& t, const Plan& plan) {
  for (int n = 1; n <= kFinest; ++n) {
    const Vec2d whole(std::round(n * t.x()), std::round(n * t.y()));
    const Vec2d off = n * t - whole;
    if (std::abs(off.x()) * plan.width > 0.4 * n || std::abs(off.y()) * plan.height > 0.4 * n)
      continue;
    t = whole / n;
    return n;
  }
  return std::nullopt;
}

using Pair = Eigen::Matrix<long, 2, 1>;

/// A shortest basis of the lattice that `vectors` generate, as lengths are in `metric`.
std::array<Pair, 2> basisOf(std::vector<Pair> vectors, const Vec2d& metric) {
  // Euclid's algorithm on x leaves one vector with an x; what is left lies on the y axis.
  Pair first = Pair::Zero();
  long y = 0;
  for (Pair v : vectors) {
    while (v.x() != 0) {
      const long times = first.x() / v.x();
      const Pair rest = first - times * v;
      first = v, v = rest;
    }
    y = std::gcd(y, v.y());
  }
  std::array<Pair, 2> basis = {first, Pair(0, y)};
  const auto dot = [&](const Pair& a, const Pair& b) {
    return a.cast<double>().cwiseProduct(metric).dot(b.cast<double>().cwiseProduct(metric));
  };
  for (;;) {  // Lagrange and Gauss
    if (dot(basis[0], basis[0]) > dot(basis[1], basis[1])) std::swap(basis[0], basis[1]);
    const long times = std::lround(dot(basis[0], basis[1]) / dot(basis[0], basis[0]));
    if (times == 0) return basis;
    basis[1] -= times * basis[0];
  }
}

/// Whether a quarter turn takes every vector of the lattice to another.
bool turnsWithin(const std::array<Vec2, 2>& lattice) {
  Eigen::Matrix2d basis;
  basis << lattice[0].cast<double>(), lattice[1].cast<double>();
  const Eigen::Matrix2d inverse = basis.inverse();
  for (const Vec2& vector : lattice) {
    const Vec2d times = inverse * Vec2d(-double(vector.y()), double(vector.x()));
    if ((times - Vec2d(std::round(times.x()), std::round(times.y()))).norm() > 1e-3) return false;
  }
  return true;
}

}  // namespace

int PatchSymmetry::cells() const {
  const float area = std::abs(lattice[0].x() * lattice[1].y() - lattice[0].y() * lattice[1].x());
  return std::max(1, int(std::lround(1.0f / area)));
}

PatchSymmetry symmetryOf(const transfer::SimulatedRtt& rtt) {
  const Plan plan = planOf(rtt);
  PatchSymmetry symmetry;
  std::vector<Peak> peaks = peaksOf(plan, correlations(plan, plan));
  std::vector<std::pair<Vec2d, int>> generators;
  long denominator = 1;
  for (Peak& peak : peaks) {
    const Vec2d near = peak.at - Vec2d(std::round(peak.at.x()), std::round(peak.at.y()));
    if (near.cwiseAbs().maxCoeff() >= 0.25 - 0.5 / kMostPlaces)
      symmetry.moved = std::max(symmetry.moved, peak.height);
    if (peak.height < kTranslated) continue;
    const std::optional<int> order = orderOf(peak.at, plan);
    if (!order || std::lcm(denominator, long(*order)) > 48) continue;
    denominator = std::lcm(denominator, long(*order));
    generators.push_back({peak.at, *order});
  }
  std::vector<Pair> vectors = {Pair(denominator, 0), Pair(0, denominator)};
  for (const auto& [t, order] : generators)
    vectors.push_back(Pair(std::lround(t.x() * denominator), std::lround(t.y() * denominator)));
  const auto basis = basisOf(std::move(vectors), rtt.size.cast<double>());
  for (std::size_t k = 0; k < 2; ++k)
    symmetry.lattice[k] = (basis[k].cast<double>() / denominator).cast<float>();

  const auto turn = [&](int quarters) {
    const std::vector<Peak> found = peaksOf(plan, correlations(turned(plan, quarters), plan));
    return found.empty() ? Peak{Vec2d::Zero(), 1.0} : found.front();
  };
  const Peak half = turn(2);
  symmetry.halfTurned = half.height;
  if (half.height >= kTurned) {
    symmetry.turns = 2;
    symmetry.centre = (0.5 * half.at).cast<float>();
  }
  const bool square =
      plan.width == plan.height && std::abs(rtt.size.x() - rtt.size.y()) < 1e-3f * rtt.size.x();
  if (square) {
    const Peak quarter = turn(1);
    symmetry.quarterTurned = quarter.height;
    if (quarter.height >= kTurned && turnsWithin(symmetry.lattice)) {
      symmetry.turns = 4;
      const Vec2d t = quarter.at;
      symmetry.centre = (0.5 * Vec2d(t.x() - t.y(), t.x() + t.y())).cast<float>();
    }
  }
  return symmetry;
}

}  // namespace lambent::synthesis
