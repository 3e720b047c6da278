// Successive orders of scattering in a spherical atmosphere.
//
// For each cell, a pair of the Sun's zenith angle and an altitude, and for one order after another:
//   arrive   radiance from directions of a quadrature, by a ray through what the cells hold of the
//            order before (march_kernel.cpp), and the ground's where the ray ends there
//   weigh    its second moments, which are all that Rayleigh's phase function asks for, and its
//            integral with the aerosols' phase function for each direction of a grid
// until an order adds next to nothing. What a cell holds is kept as a scale, whose logarithm is
// interpolated between cells, and what of it goes where.
//
// This work is based on:
// - preetham2003modeling: "Skylight Models", the sum I¹ + I² + … and its recurrence.
// - bruneton2008precomputed: §4, the orders' tables over altitude, Sun and direction. We keep the
//   light that arrives weighed by each phase function apart, and densities out of the tables; split
//   directions at the horizon; and have as many wavelengths as one asks for.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "lambent/math/quadrature.h"
#include "lambent/math/types.h"
#include "lambent/sky/scattering_tables.h"
#include "lambent/work/runner.h"

namespace lambent::sky {
namespace {

/// Directions from which light arrives at an altitude, and how it is weighed.
struct Arrivals {
  struct Direction {
    double zenith, azimuth;  ///< azimuth from the Sun's, within half a turn
    double weight;           ///< sr, of both halves
    int path;                ///< of its zenith angle
  };
  std::vector<Direction> directions;
  struct Path {
    AirPath path;
    std::vector<Scattering::Impl::Place> places;
    std::vector<MarchNode> nodes;  ///< as Impl::prepareAlong leaves them
  };
  std::vector<Path> paths;
  // With the weights of the directions in:
  std::vector<float> moments;  ///< [xx, yy, zz, xy][arrival]
  std::vector<float> phase;    ///< [direction of the grid, without border][arrival]
  int fromAbove = 0;           ///< the first so many come from above the horizon
};

Arrivals arrivalsAt(double altitude, const Scattering::Impl& s) {
  Arrivals made;
  const double horizon = s.sunLengths.horizonAngle(altitude);
  const auto add = [&](int count, double end) {
    // Nodes crowd at the horizon, where light changes most.
    const math::Quadrature rule = math::gaussLegendre(count, 0, 1);
    for (int i = 0; i < count; ++i) {
      const double t = rule.nodes[i], zenith = horizon + (end - horizon) * t * t;
      const double weight = rule.weights[i] * 2 * t * std::abs(end - horizon) * std::sin(zenith);
      const int path = int(made.paths.size());
      Arrivals::Path& along = made.paths.emplace_back();
      along.path = airPath(s.medium, s.split, altitude, std::cos(zenith), kEndless);
      along.places = s.prepareAlong(along.path, along.path.cosine, along.nodes);
      for (int j = 0; j < s.resolution.around; ++j)
        made.directions.push_back({zenith, kPi * (j + 0.5) / s.resolution.around,
                                   weight * 2 * kPi / s.resolution.around, path});
    }
  };
  add(s.resolution.upward, 0);
  made.fromAbove = int(made.directions.size());
  add(s.resolution.downward, kPi);

  const std::size_t count = made.directions.size();
  made.moments.resize(4 * count);
  for (std::size_t i = 0; i < count; ++i) {
    const Arrivals::Direction& in = made.directions[i];
    const double x = std::sin(in.zenith) * std::cos(in.azimuth), y = std::cos(in.zenith),
                 z = std::sin(in.zenith) * std::sin(in.azimuth);
    const double products[4] = {x * x, y * y, z * z, x * y};
    for (std::size_t m = 0; m < 4; ++m)
      made.moments[m * count + i] = float(in.weight * products[m]);
  }
  made.phase.reserve(std::size_t(s.grid.zeniths) * s.grid.azimuths * count);
  std::vector<double> row(count);
  for (int z = 0; z < s.grid.zeniths; ++z)
    for (int a = 0; a < s.grid.azimuths; ++a) {
      const double zenith = kPi * z / (s.grid.zeniths - 1),
                   azimuth = kPi * a / (s.grid.azimuths - 1);
      double sum = 0;
      for (std::size_t i = 0; i < count; ++i) {
        const Arrivals::Direction& in = made.directions[i];
        const double cosines = std::cos(zenith) * std::cos(in.zenith),
                     sines = std::sin(zenith) * std::sin(in.zenith);
        double both = 0;
        for (const double turn : {azimuth - in.azimuth, azimuth + in.azimuth})
          both += media::evaluate(s.medium.aerosolPhase, cosines + sines * std::cos(turn));
        sum += row[i] = in.weight * 0.5 * both;
      }
      // Even light stays even: the quadrature's integral of the phase function is made 1.
      for (const double value : row) made.phase.push_back(float(value / sum));
    }
  return made;
}

/// Light that arrived, [arrival][lane], as a cell holds it.
void weigh(const Arrivals& arrivals, const std::vector<float>& radiance, const Grid& grid,
           const MarchKernels& kernel, int cell, Held& held) {
  const int count = int(arrivals.directions.size());
  float moments[4 * kLanes];
  kernel.weigh(arrivals.moments.data(), 4, count, radiance.data(), moments);
  const int zs = grid.zeniths, as = grid.azimuths;
  std::vector<float> phased(std::size_t(zs) * as * kLanes);
  kernel.weigh(arrivals.phase.data(), zs * as, count, radiance.data(), phased.data());

  float inverse[kLanes];
  for (int l = 0; l < kLanes; ++l) {
    const float all =
        std::max(moments[l] + moments[kLanes + l] + moments[2 * kLanes + l], kNothing);
    held.logScale[std::size_t(cell) * kLanes + l] = std::log(all);
    inverse[l] = 1 / all;
  }
  for (int i = 0; i < 4 * kLanes; ++i)
    held.moments[std::size_t(cell) * 4 * kLanes + i] = moments[i] * inverse[i % kLanes];
  float* directed = &held.aerosol[std::size_t(cell) * grid.directions() * kLanes];
  const auto entry = [&](int z, int a) {
    return directed + (std::size_t(z + 1) * grid.azimuthStride() + (a + 1)) * kLanes;
  };
  const float* from = phased.data();
  for (int z = 0; z < zs; ++z)
    for (int a = 0; a < as; ++a, from += kLanes)
      for (int l = 0; l < kLanes; ++l) entry(z, a)[l] = from[l] * inverse[l];
  // The border: past the zenith one comes down on the other side, past the Sun's azimuth on the
  // mirrored half.
  for (int a = 0; a < as; ++a) {
    std::copy_n(entry(1, as - 1 - a), kLanes, entry(-1, a));
    std::copy_n(entry(zs - 2, as - 1 - a), kLanes, entry(zs, a));
  }
  for (int z = -1; z <= zs; ++z) {
    std::copy_n(entry(z, 1), kLanes, entry(z, -1));
    std::copy_n(entry(z, as - 2), kLanes, entry(z, as));
  }
}

/// What one order left for kLanes wavelengths: in the air, and on the ground ([sun][lane],
/// logarithms).
struct Order {
  Held air;
  std::vector<float> logGround;
};

/// One cell of the order that follows `before`, the first if `once`; for all wavelengths, which
/// share their rays.
class Step {
 public:
  Step(const Scattering::Impl& s, const std::vector<Arrivals>& arrivals,
       const std::vector<Order>& before, bool once)
      : s_(s), arrivals_(arrivals), before_(before), once_(once), kernel_(marchKernels()) {}

  void operator()(int cell, std::vector<Order>& next) const {
    const int sun = cell / s_.grid.altitudes, row = cell % s_.grid.altitudes;
    const Arrivals& here = arrivals_[std::size_t(row)];
    const double sunZenith = s_.grid.sunZenith(sun), altitude = s_.grid.altitude(row);
    // [block][arrival][lane]
    const std::size_t size = here.directions.size() * kLanes;
    std::vector<std::vector<float>> radiance(s_.blocks.size(), std::vector<float>(size));
    std::vector<MarchNode> nodes;  // of the path of the last direction
    for (std::size_t i = 0; i < here.directions.size(); ++i) {
      const Arrivals::Direction& in = here.directions[i];
      const auto& [path, places, fresh] = here.paths[std::size_t(in.path)];
      if (i == 0 || in.path != here.directions[i - 1].path) nodes = fresh;
      const double towardsSun = std::cos(in.zenith) * std::cos(sunZenith) +
                                std::sin(in.zenith) * std::sin(sunZenith) * std::cos(in.azimuth);
      const RayInAir ray{altitude, path.cosine, sunZenith, towardsSun};
      if (once_)
        s_.prepareOnce(path, ray, Scattering::Impl::Shadow::Soft, nodes);
      else
        s_.prepareAgain(path, ray, places, nodes);
      for (std::size_t b = 0; b < s_.blocks.size(); ++b)
        arrive(b, path, ray, nodes, &radiance[b][i * kLanes]);
    }
    for (std::size_t b = 0; b < s_.blocks.size(); ++b) {
      weigh(here, radiance[b], s_.grid, kernel_, cell, next[b].air);
      if (row > 0) continue;
      float down[kLanes] = {};
      for (int i = 0; i < here.fromAbove; ++i) {
        const Arrivals::Direction& in = here.directions[std::size_t(i)];
        for (int l = 0; l < kLanes; ++l)
          down[l] +=
              float(in.weight * std::cos(in.zenith)) * radiance[b][std::size_t(i) * kLanes + l];
      }
      for (int l = 0; l < kLanes; ++l)
        next[b].logGround[std::size_t(sun) * kLanes + l] = std::log(std::max(down[l], kNothing));
    }
  }

 private:
  void arrive(std::size_t b, const AirPath& path, const RayInAir& ray,
              const std::vector<MarchNode>& nodes, float* radiance) const {
    const Block& block = s_.blocks[b];
    if (!nodes.empty()) {
      MarchSums sums;
      kernel_.march(block.tables(before_[b].air, s_.grid), nodes.data(), int(nodes.size()), once_,
                    !once_, sums);
      const float air = float(media::evaluate(media::RayleighPhase{}, ray.towardsSun));
      const float aerosol = float(media::evaluate(s_.medium.aerosolPhase, ray.towardsSun));
      for (int l = 0; l < kLanes; ++l)
        radiance[l] = once_ ? air * sums.air[l] + aerosol * sums.aerosol[l] : sums.multiple[l];
    }
    if (!path.hitsGround) return;
    float light[kLanes], through[kLanes];
    s_.fromLogs(before_[b].logGround, s_.sunZenithAtEnd(path, ray), light);
    block.transmit(path.length, through);
    for (int l = 0; l < kLanes; ++l)
      radiance[l] += through[l] * light[l] * block.albedo[l] * float(1 / kPi);
  }

  const Scattering::Impl& s_;
  const std::vector<Arrivals>& arrivals_;
  const std::vector<Order>& before_;
  bool once_;
  MarchKernels kernel_;
};

/// The sum of orders: normalised as a cell holds it once all are in.
class Sum {
 public:
  Sum(const Grid& grid, Block& block)
      : grid_(grid),
        block_(block),
        scale_(std::size_t(grid.cells()) * kLanes),
        ground_(block.logGround.size()) {}

  /// How much of a cell's sum the order is, at most.
  double add(const Order& order) {
    double most = 0;
    for (std::size_t cell = 0; cell < std::size_t(grid_.cells()); ++cell) {
      float share[kLanes];
      for (std::size_t l = 0; l < kLanes; ++l) {
        share[l] = std::exp(order.air.logScale[cell * kLanes + l]);
        float& scale = scale_[cell * kLanes + l];
        scale += share[l];
        if (scale > 1e-25f) most = std::max(most, double(share[l] / scale));
      }
      addCell(order, cell, share);
    }
    for (std::size_t i = 0; i < ground_.size(); ++i) ground_[i] += std::exp(order.logGround[i]);
    return most;
  }

  /// Adds to the sum what orders after `order` would, the last that was added: as if each were less
  /// than the one before by the factor that the last was.
  void addTail(const Order& order, const Order& before) {
    const auto tail = [](float last, float previous) {
      const float ratio = std::min(std::exp(last - previous), 0.95f);
      return std::exp(last) * ratio / (1 - ratio);
    };
    for (std::size_t cell = 0; cell < std::size_t(grid_.cells()); ++cell) {
      float share[kLanes];
      for (std::size_t l = 0; l < kLanes; ++l) {
        const std::size_t at = cell * kLanes + l;
        share[l] = tail(order.air.logScale[at], before.air.logScale[at]);
        scale_[at] += share[l];
      }
      addCell(order, cell, share);
    }
    for (std::size_t i = 0; i < ground_.size(); ++i)
      ground_[i] += tail(order.logGround[i], before.logGround[i]);
  }

  void finish() {
    const std::size_t directions = std::size_t(grid_.directions());
    for (std::size_t cell = 0; cell < std::size_t(grid_.cells()); ++cell)
      for (std::size_t l = 0; l < kLanes; ++l) {
        const float scale = std::max(scale_[cell * kLanes + l], kNothing);
        block_.held.logScale[cell * kLanes + l] = std::log(scale);
        for (std::size_t m = cell * 4; m < (cell + 1) * 4; ++m)
          block_.held.moments[m * kLanes + l] /= scale;
        for (std::size_t d = cell * directions; d < (cell + 1) * directions; ++d)
          block_.held.aerosol[d * kLanes + l] /= scale;
      }
    for (std::size_t i = 0; i < ground_.size(); ++i)
      block_.logGround[i] = std::log(std::max(ground_[i], kNothing));
  }

 private:
  void addCell(const Order& order, std::size_t cell, const float (&share)[kLanes]) {
    const std::size_t directions = std::size_t(grid_.directions());
    addTo(block_.held.moments, order.air.moments, cell * 4, 4, share);
    addTo(block_.held.aerosol, order.air.aerosol, cell * directions, directions, share);
  }
  static void addTo(std::vector<float>& sum, const std::vector<float>& order, std::size_t first,
                    std::size_t count, const float (&share)[kLanes]) {
    for (std::size_t i = first; i < first + count; ++i)
      for (std::size_t l = 0; l < kLanes; ++l)
        sum[i * kLanes + l] += share[l] * order[i * kLanes + l];
  }

  const Grid& grid_;
  Block& block_;
  std::vector<float> scale_, ground_;
};

}  // namespace

Status Scattering::Impl::addOrders(const Progress& progress) {
  std::vector<Arrivals> arrivals;
  for (int row = 0; row < grid.altitudes; ++row)
    arrivals.push_back(arrivalsAt(grid.altitude(row), *this));
  std::vector<Order> before, next;
  std::vector<Sum> sums;
  for (Block& block : blocks) {
    before.push_back({Held(grid), block.logGround});
    next.push_back(before.back());
    sums.emplace_back(grid, block);
    for (int sun = 0; sun < grid.suns; ++sun) {
      float light[kLanes];
      direct(block, grid.sunZenith(sun), light);
      for (int l = 0; l < kLanes; ++l)
        before.back().logGround[std::size_t(sun) * kLanes + l] =
            std::log(std::max(light[l], kNothing));
    }
  }
  const work::Runner runner(progress);
  const work::Chunks cells(std::size_t(grid.cells()), 1);
  for (orders = 1;; ++orders) {
    const Step step(*this, arrivals, before, orders == 1);
    const Status ran =
        runner.run({.name = fmt::format("light scattered {} times", orders), .unit = "cells"},
                   cells, [&](const work::Chunk& chunk) { step(int(chunk.index), next); });
    if (!ran) return ran;
    double most = 0;
    for (std::size_t b = 0; b < blocks.size(); ++b) most = std::max(most, sums[b].add(next[b]));
    if (most < resolution.tolerance || orders >= resolution.orders) break;
    std::swap(before, next);
  }
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    sums[b].addTail(next[b], before[b]);
    sums[b].finish();
  }
  return Status::ok();
}

}  // namespace lambent::sky
