// Successive orders of scattering in a spherical atmosphere.
//
// A *cell* is a pair of the Sun's zenith angle and an altitude. For each, and for one order after
// another:
//   arrive   radiance from directions of a quadrature, by a ray through what the cells hold of the
//            order before (march_kernel.cpp), and the ground's where the ray ends there
//   weigh    its second moments, which are all that Rayleigh's phase function asks for, and its
//            integral with the aerosols' phase function for each direction of a grid
// until an order adds next to nothing. What the air holds is kept as a scale for each cell, whose
// logarithm is interpolated, and what of it goes where.
//
// This work is based on:
// - preetham2003modeling: "Skylight Models", the sum I¹ + I² + … and its recurrence.
// - bruneton2008precomputed: §4, the orders' tables over altitude, Sun and direction. We keep the
//   light that arrives weighed by each phase function apart, and densities out of the tables; split
//   directions at the horizon; and have as many wavelengths as one asks for.
#include "lambent/sky/scattering.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "lambent/math/isa.h"
#include "lambent/math/quadrature.h"
#include "lambent/math/types.h"
#include "lambent/sky/interpolation.h"
#include "lambent/work/runner.h"

namespace lambent::sky {

constexpr double kSunRadius = 0.004652;  // rad: how softly the planet's shadow ends in the tables
constexpr double kLastZenith = 122 * kPi / 180;
constexpr float kNothing = 1e-34f;

MarchKernels kernels() {
#if defined(__x86_64__)
  switch (math::bestIsa()) {
    case math::Isa::Avx512: return avx512::marchKernels();
    case math::Isa::Avx2: return avx2::marchKernels();
    case math::Isa::Baseline: break;
  }
#endif
  return baseline::marchKernels();
}

/// The nodes of the tables.
struct Grid {
  double height = 0;
  double density = 1;
  int suns = 0, altitudes = 0, zeniths = 0, azimuths = 0;

  static double sunCoordinate(double zenith, double density) {
    // 5° by day and 1° in twilight, with a smooth change about 78°.
    const double degrees = zenith * 180 / kPi;
    return density * (degrees / 5 + 0.8 * 6 * std::log1p(std::exp((degrees - 78) / 6)));
  }
  double sunOf(int i) const {
    double low = 0, high = 180;
    for (int step = 0; step < 60; ++step) {
      const double mid = 0.5 * (low + high);
      (coordinate(mid * kPi / 180) < i ? low : high) = mid;
    }
    return 0.5 * (low + high) * kPi / 180;
  }
  double coordinate(double zenith) const {
    return sunCoordinate(zenith, density) - sunCoordinate(0, density);
  }
  double altitudeOf(int i) const {
    return height * std::pow(double(i) / (altitudes - 1), 2.5);
  }
  double altitudeCoordinate(double altitude) const {
    return std::pow(std::clamp(altitude / height, 0.0, 1.0), 0.4) * (altitudes - 1);
  }
  int cells() const { return suns * altitudes; }
  int cell(int sun, int altitude) const { return sun * altitudes + altitude; }
  // Directions have a border of one on each side, so that four neighbours lie side by side.
  int azimuthStride() const { return azimuths + 2; }
  int directions() const { return (zeniths + 2) * azimuthStride(); }
};

/// What every cell holds, for kLanes wavelengths.
struct Held {
  std::vector<float> logScale, moments, aerosol;
  explicit Held(const Grid& grid)
      : logScale(std::size_t(grid.cells()) * kLanes, std::log(kNothing)),
        moments(std::size_t(grid.cells()) * 4 * kLanes),
        aerosol(std::size_t(grid.cells()) * std::size_t(grid.directions()) * kLanes) {}
};

/// kLanes wavelengths of a medium, and the light in it.
struct Block {
  float extinction[3][kLanes] = {}, scattering[2][kLanes] = {};
  float albedo[kLanes] = {};
  Held held;
  std::vector<float> ground;  ///< diffuse irradiance of the ground, [sun][lane]
  explicit Block(const Grid& grid)
      : held(grid), ground(std::size_t(grid.suns) * kLanes, kNothing) {}
};

MarchTables tablesOf(const Block& block, const Held& held, const Grid& grid) {
  return {{block.extinction[0], block.extinction[1], block.extinction[2]},
          {block.scattering[0], block.scattering[1]},
          held.logScale.data(),
          held.moments.data(),
          held.aerosol.data(),
          grid.directions(),
          grid.azimuthStride()};
}

/// Directions from which light arrives at an altitude, and how it is weighed.
struct Arrivals {
  struct Direction {
    double zenith, azimuth, weight;  ///< weight: sr, of both halves of the circle
    int path;                        ///< of its zenith angle
  };
  std::vector<Direction> directions;
  std::vector<AirPath> paths;
  std::vector<float> phase;  ///< [direction of the grid, without border][arrival]: with its weight
  int upward = 0;            ///< the first so many directions come from above
};

/// How much of a disc is above a straight edge: `above` is its centre's height in radii.
double discAbove(double above) {
  const double x = std::clamp(above, -1.0, 1.0);
  return 1 - (std::acos(x) - x * std::sqrt(1 - x * x)) / kPi;
}

/// ω's cosine with the zenith, the Sun's, and the azimuth between them, at one place.
struct LocalFrame {
  double cosine, sunCosine, towardsSun;
};

Resolution Resolution::exact(int refine) {
  const double finer = std::pow(1.5, refine);
  const auto times = [finer](double n) { return int(std::lround(n * finer)); };
  Resolution r;
  r.sunDensity = 1.5 * finer;
  r.altitudes = times(24);
  r.upward = times(20);
  r.downward = times(12);
  r.around = times(16);
  r.zeniths = times(36);
  r.azimuths = times(19);
  r.levels = times(10);
  r.nodes = 4;
  r.depth = 1 / finer;
  r.cubic = true;
  r.tolerance = 1e-4 / finer;
  r.orders = 60;
  return r;
}

struct Scattering::Impl {
  Medium medium;
  Resolution resolution;
  Grid grid;
  SunLengths sunLengths;
  PathSplit split;
  std::vector<Block> blocks;
  int ordersDone = 1;

  /// Fills what depends on the Sun of a path's node.
  void prepare(const AirPath& path, const AirPath::Node& node, const RayInAir& ray, bool soft,
               MarchNode& out) const {
    const double r0 = medium.shell.radius + path.altitude, r = medium.shell.radius + node.altitude;
    const double sun0 = std::cos(ray.sunZenith);
    const LocalFrame frame{
        std::clamp((r0 * ray.cosine + node.distance) / r, -1.0, 1.0),
        std::clamp((r0 * sun0 + node.distance * ray.towardsSun) / r, -1.0, 1.0), ray.towardsSun};
    const double sunZenith = std::acos(frame.sunCosine), zenith = std::acos(frame.cosine);
    out.weight = float(node.weight);
    std::copy_n(node.density, kParts, out.density);
    std::copy_n(node.length, kParts, out.length);
    const double above = sunLengths.horizonAngle(node.altitude) - sunZenith;
    out.sunVisible = float(soft ? discAbove(above / kSunRadius) : (above >= 0 ? 1 : 0));
    if (out.sunVisible > 0)
      sunLengths.at(node.altitude, sunZenith, out.sunLength);
    else
      std::fill_n(out.sunLength, kParts, 0.0f);

    const double sines = std::sqrt(std::max(0.0, (1 - frame.cosine * frame.cosine) *
                                                     (1 - frame.sunCosine * frame.sunCosine)));
    // Where either stands in the zenith azimuths mean nothing.
    const double cosAzimuth =
        sines > 1e-9
            ? std::clamp((frame.towardsSun - frame.cosine * frame.sunCosine) / sines, -1.0, 1.0)
            : 1;
    const double azimuth = std::acos(cosAzimuth);

    const double sunAt = grid.coordinate(sunZenith),
                 altitudeAt = grid.altitudeCoordinate(node.altitude);
    const Taps suns =
        resolution.cubic ? cubicTaps(sunAt, grid.suns) : linearTaps(sunAt, grid.suns);
    const Taps rows = resolution.cubic ? cubicTaps(altitudeAt, grid.altitudes)
                                       : linearTaps(altitudeAt, grid.altitudes);
    out.cellCount = 0;
    for (int i = 0; i < suns.count; ++i)
      for (int j = 0; j < rows.count; ++j) {
        const double w = suns.weight[i] * rows.weight[j];
        if (w == 0) continue;
        out.cell[out.cellCount] = grid.cell(suns.first + i, rows.first + j);
        out.cellWeight[out.cellCount++] = float(w);
      }
    // With the border in: node k of an axis is entry k + 1.
    const auto directed = [](double at, int count, float(&weight)[4]) {
      const Taps taps = cubicTaps(at + 1, count + 2);
      for (int k = 0; k < 4; ++k) weight[k] = float(taps.weight[k]);
      return taps.first;
    };
    const int z = directed(zenith / kPi * (grid.zeniths - 1), grid.zeniths, out.zenithWeight);
    const int a = directed(azimuth / kPi * (grid.azimuths - 1), grid.azimuths, out.azimuthWeight);
    out.direction = z * grid.azimuthStride() + a;
    const double sine = std::sqrt(std::max(0.0, 1 - frame.cosine * frame.cosine));
    const double x = sine * cosAzimuth, y = frame.cosine;
    const double z2 = std::max(0.0, sine * sine - x * x);
    out.moment[0] = float(1 + x * x);
    out.moment[1] = float(1 + y * y);
    out.moment[2] = float(1 + z2);
    out.moment[3] = float(2 * x * y);
  }

  void prepare(const AirPath& path, const RayInAir& ray, bool soft,
               std::vector<MarchNode>& out) const {
    out.resize(path.nodes.size());
    for (std::size_t n = 0; n < path.nodes.size(); ++n)
      prepare(path, path.nodes[n], ray, soft, out[n]);
  }

  /// The Sun's zenith angle at the end of a path.
  double sunZenithAtEnd(const AirPath& path, const RayInAir& ray) const {
    const double r0 = medium.shell.radius + path.altitude;
    return std::acos(std::clamp((r0 * std::cos(ray.sunZenith) + path.end * ray.towardsSun) /
                                    medium.shell.radius,
                                -1.0, 1.0));
  }

  /// The Sun's irradiance on the ground; 1 above the air.
  void directOnGround(const Block& block, double sunZenith, float (&out)[kLanes]) const {
    float lengths[kParts];
    const double above = (kPi / 2 - sunZenith) / kSunRadius;
    const double visible = discAbove(above);
    if (!(visible > 0)) {
      std::fill_n(out, kLanes, 0.0f);
      return;
    }
    sunLengths.at(0, sunZenith, lengths);
    // The mean cosine of what is visible of the disc is above 0.
    const double cosine = std::max(std::cos(sunZenith), 0.3 * kSunRadius);
    float depths[kLanes];
    for (int l = 0; l < kLanes; ++l) {
      depths[l] = 0;
      for (int part = 0; part < kParts; ++part)
        depths[l] -= block.extinction[part][l] * lengths[part];
    }
    kernels().exp(depths, out);
    for (float& value : out) value *= float(cosine * visible);
  }

  void groundIrradiance(const std::vector<float>& table, double sunZenith,
                        float (&out)[kLanes]) const {
    const double at = grid.coordinate(sunZenith);
    const Taps taps = resolution.cubic ? cubicTaps(at, grid.suns) : linearTaps(at, grid.suns);
    for (int l = 0; l < kLanes; ++l) {
      double sum = 0;
      for (int k = 0; k < taps.count; ++k)
        sum += taps.weight[k] *
               std::log(double(table[std::size_t(taps.first + k) * kLanes + l]));
      out[l] = float(std::exp(sum));
    }
  }

  Arrivals arrivalsAt(double altitude) const;
  void weigh(const Arrivals& arrivals, const std::vector<float>& radiance, int cell,
             Held& out) const;
  Status iterate(const Progress& progress);
};

Arrivals Scattering::Impl::arrivalsAt(double altitude) const {
  Arrivals made;
  const double horizon = sunLengths.horizonAngle(altitude);
  const auto add = [&](int count, double from, double to) {
    // Nodes crowd at the horizon, where light changes most.
    const math::Quadrature rule = math::gaussLegendre(count, 0, 1);
    for (int i = 0; i < count; ++i) {
      const double t = rule.nodes[i];
      const double zenith = from + (to - from) * t * t;
      const double weight = rule.weights[i] * 2 * t * std::abs(to - from) * std::sin(zenith);
      const int path = int(made.paths.size());
      made.paths.push_back(airPath(medium, split, altitude, std::cos(zenith), 1e12));
      for (int j = 0; j < resolution.around; ++j)
        made.directions.push_back({zenith, kPi * (j + 0.5) / resolution.around,
                                   weight * 2 * kPi / resolution.around, path});
    }
  };
  add(resolution.upward, horizon, 0);
  made.upward = int(made.directions.size());
  add(resolution.downward, horizon, kPi);
  // Light that travels along −ω arrives from ω and goes on along −ω′.
  made.phase.resize(std::size_t(grid.zeniths) * grid.azimuths * made.directions.size());
  std::size_t at = 0;
  for (int z = 0; z < grid.zeniths; ++z)
    for (int a = 0; a < grid.azimuths; ++a) {
      const double zenith = kPi * z / (grid.zeniths - 1), azimuth = kPi * a / (grid.azimuths - 1);
      for (const Arrivals::Direction& in : made.directions) {
        const double cc = std::cos(zenith) * std::cos(in.zenith),
                     ss = std::sin(zenith) * std::sin(in.zenith);
        const double both =
            media::evaluate(medium.aerosolPhase, cc + ss * std::cos(azimuth - in.azimuth)) +
            media::evaluate(medium.aerosolPhase, cc + ss * std::cos(azimuth + in.azimuth));
        made.phase[at++] = float(in.weight * 0.5 * both);
      }
    }
  // What leaves for all directions is what arrived: the phase function's integral over the
  // grid of arrivals is made 1 for each direction of leaving.
  const std::size_t count = made.directions.size();
  for (std::size_t row = 0; row < made.phase.size() / count; ++row) {
    double sum = 0;
    for (std::size_t i = 0; i < count; ++i) sum += double(made.phase[row * count + i]);
    for (std::size_t i = 0; i < count; ++i) made.phase[row * count + i] /= float(sum);
  }
  return made;
}

/// radiance: [arrival][lane].
void Scattering::Impl::weigh(const Arrivals& arrivals, const std::vector<float>& radiance,
                             int cell, Held& out) const {
  const std::size_t count = arrivals.directions.size();
  float moments[4][kLanes] = {};
  for (std::size_t i = 0; i < count; ++i) {
    const Arrivals::Direction& in = arrivals.directions[i];
    const double sine = std::sin(in.zenith);
    const double x = sine * std::cos(in.azimuth), y = std::cos(in.zenith),
                 z = sine * std::sin(in.azimuth);
    const float w[4] = {float(in.weight * x * x), float(in.weight * y * y),
                        float(in.weight * z * z), float(in.weight * x * y)};
    for (int m = 0; m < 4; ++m)
      for (int l = 0; l < kLanes; ++l) moments[m][l] += w[m] * radiance[i * kLanes + l];
  }
  float inverse[kLanes];
  for (int l = 0; l < kLanes; ++l) {
    const float all = std::max(moments[0][l] + moments[1][l] + moments[2][l], kNothing);
    out.logScale[std::size_t(cell) * kLanes + l] = std::log(all);
    inverse[l] = 1 / all;
  }
  for (int m = 0; m < 4; ++m)
    for (int l = 0; l < kLanes; ++l)
      out.moments[(std::size_t(cell) * 4 + m) * kLanes + l] = moments[m][l] * inverse[l];
  float* directed = &out.aerosol[std::size_t(cell) * grid.directions() * kLanes];
  const auto entry = [&](int z, int a) {
    return directed + (std::size_t(z + 1) * grid.azimuthStride() + (a + 1)) * kLanes;
  };
  const float* phase = arrivals.phase.data();
  for (int z = 0; z < grid.zeniths; ++z)
    for (int a = 0; a < grid.azimuths; ++a, phase += count) {
      float sum[kLanes] = {};
      for (std::size_t i = 0; i < count; ++i)
        for (int l = 0; l < kLanes; ++l) sum[l] += phase[i] * radiance[i * kLanes + l];
      for (int l = 0; l < kLanes; ++l) entry(z, a)[l] = sum[l] * inverse[l];
    }
  // The border: past the zenith one comes down on the other side, past the Sun's azimuth on the
  // mirrored half.
  const auto copy = [&](int z, int a, int fromZ, int fromA) {
    std::copy_n(entry(fromZ, fromA), kLanes, entry(z, a));
  };
  const int zs = grid.zeniths, as = grid.azimuths;
  for (int a = 0; a < as; ++a) {
    copy(-1, a, 1, as - 1 - a);
    copy(zs, a, zs - 2, as - 1 - a);
  }
  for (int z = -1; z <= zs; ++z) {
    copy(z, -1, z, 1);
    copy(z, as, z, as - 2);
  }
}

Status Scattering::Impl::iterate(const Progress& progress) {
  std::vector<Arrivals> arrivals;
  for (int j = 0; j < grid.altitudes; ++j) arrivals.push_back(arrivalsAt(grid.altitudeOf(j)));
  const MarchKernels kernel = kernels();
  work::Runner runner(progress);
  const work::Chunks chunks(std::size_t(grid.cells()), 1);
  for (Block& block : blocks) {
    Held before(grid), next(grid);
    std::vector<float> groundBefore(block.ground.size()), groundNext(block.ground.size());
    for (int k = 0; k < grid.suns; ++k) {
      float direct[kLanes];
      directOnGround(block, grid.sunOf(k), direct);
      for (int l = 0; l < kLanes; ++l)
        groundBefore[std::size_t(k) * kLanes + l] = std::max(direct[l], kNothing);
    }
    std::vector<float> total(std::size_t(grid.cells()) * kLanes), last(total.size());
    bool done = false;
    for (int order = 1; order <= resolution.orders && !done; ++order) {
      const MarchTables tables = tablesOf(block, before, grid);
      const Status ran = runner.run(
          {.name = "light in the air", .unit = "cells"}, chunks, [&](const work::Chunk& chunk) {
            const int cell = int(chunk.index);
            const int sun = cell / grid.altitudes, row = cell % grid.altitudes;
            const Arrivals& here = arrivals[row];
            const double sunZenith = grid.sunOf(sun), altitude = grid.altitudeOf(row);
            std::vector<float> radiance(here.directions.size() * kLanes);
            std::vector<MarchNode> nodes;
            double down[kLanes] = {};
            for (std::size_t i = 0; i < here.directions.size(); ++i) {
              const Arrivals::Direction& in = here.directions[i];
              const AirPath& path = here.paths[in.path];
              const RayInAir ray{altitude, path.cosine, sunZenith,
                                 std::cos(in.zenith) * std::cos(sunZenith) +
                                     std::sin(in.zenith) * std::sin(sunZenith) *
                                         std::cos(in.azimuth)};
              float* out = &radiance[i * kLanes];
              if (!path.nodes.empty()) {
                prepare(path, ray, true, nodes);
                MarchSums sums;
                kernel.march(tables, nodes.data(), int(nodes.size()), order == 1, order > 1, sums);
                const float air =
                    float(media::evaluate(media::RayleighPhase{}, ray.towardsSun));
                const float aerosol =
                    float(media::evaluate(medium.aerosolPhase, ray.towardsSun));
                for (int l = 0; l < kLanes; ++l)
                  out[l] = order == 1 ? air * sums.air[l] + aerosol * sums.aerosol[l]
                                      : sums.multiple[l];
              }
              if (path.hitsGround) {
                float light[kLanes], depth[kLanes], through[kLanes];
                groundIrradiance(groundBefore, sunZenithAtEnd(path, ray), light);
                for (int l = 0; l < kLanes; ++l) {
                  depth[l] = 0;
                  for (int part = 0; part < kParts; ++part)
                    depth[l] -= block.extinction[part][l] * path.length[part];
                }
                kernel.exp(depth, through);
                for (int l = 0; l < kLanes; ++l)
                  out[l] += through[l] * light[l] * block.albedo[l] * float(1 / kPi);
              }
              if (row == 0 && int(i) < here.upward)
                for (int l = 0; l < kLanes; ++l)
                  down[l] += in.weight * std::cos(in.zenith) * double(out[l]);
            }
            weigh(here, radiance, cell, next);
            if (row == 0)
              for (int l = 0; l < kLanes; ++l)
                groundNext[std::size_t(sun) * kLanes + l] = std::max(float(down[l]), kNothing);
          });
      if (!ran) return ran;
      // Sums of all orders so far, and what the last one added.
      double most = 0;
      for (int cell = 0; cell < grid.cells(); ++cell)
        for (int l = 0; l < kLanes; ++l) {
          const std::size_t at = std::size_t(cell) * kLanes + l;
          last[at] = std::exp(next.logScale[at]);
          total[at] += last[at];
          if (total[at] > 1e-25f) most = std::max(most, double(last[at] / total[at]));
        }
      done = most < resolution.tolerance;
      ordersDone = std::max(ordersDone, order);
      for (int cell = 0; cell < grid.cells(); ++cell)
        for (int l = 0; l < kLanes; ++l) {
          const std::size_t at = std::size_t(cell) * kLanes + l;
          const float share = last[at];
          for (int m = 0; m < 4; ++m)
            block.held.moments[(std::size_t(cell) * 4 + m) * kLanes + l] +=
                share * next.moments[(std::size_t(cell) * 4 + m) * kLanes + l];
          for (int d = 0; d < grid.directions(); ++d)
            block.held.aerosol[(std::size_t(cell) * grid.directions() + d) * kLanes + l] +=
                share * next.aerosol[(std::size_t(cell) * grid.directions() + d) * kLanes + l];
        }
      for (std::size_t i = 0; i < block.ground.size(); ++i) block.ground[i] += groundNext[i];
      std::swap(before, next);
      std::swap(groundBefore, groundNext);
    }
    for (int cell = 0; cell < grid.cells(); ++cell)
      for (int l = 0; l < kLanes; ++l) {
        const std::size_t at = std::size_t(cell) * kLanes + l;
        const float scale = std::max(total[at], kNothing);
        block.held.logScale[at] = std::log(scale);
        for (int m = 0; m < 4; ++m)
          block.held.moments[(std::size_t(cell) * 4 + m) * kLanes + l] /= scale;
        for (int d = 0; d < grid.directions(); ++d)
          block.held.aerosol[(std::size_t(cell) * grid.directions() + d) * kLanes + l] /= scale;
      }
  }
  return Status::ok();
}

Result<Scattering> Scattering::solve(Medium medium, const Resolution& resolution,
                                     const Progress& progress) {
  auto impl = std::make_shared<Impl>();
  impl->medium = std::move(medium);
  const Medium& m = impl->medium;
  impl->resolution = resolution;
  impl->sunLengths = SunLengths(m);
  impl->grid = {m.shell.height, resolution.sunDensity, 0, resolution.altitudes,
                resolution.zeniths, resolution.azimuths};
  impl->grid.suns = int(std::ceil(impl->grid.coordinate(kLastZenith))) + 1;
  impl->split.nodes = resolution.nodes;
  impl->split.depth = resolution.depth;
  for (int k = 1; k < resolution.levels; ++k)
    impl->split.levels.push_back(m.shell.height *
                                 std::pow(double(k) / resolution.levels, 2.2));
  for (const media::DensityProfile& profile : m.profiles)
    if (const auto* table = std::get_if<media::DensityProfile::Tabulated>(&profile.law()))
      for (const auto& point : table->points)
        if (point.altitude > 0 && point.altitude < m.shell.height)
          impl->split.levels.push_back(point.altitude);
  const std::size_t count = m.wavelengths.size();
  for (std::size_t first = 0; first < count; first += kLanes) {
    Block block(impl->grid);
    for (int l = 0; l < kLanes; ++l) {
      const std::size_t at = std::min(first + std::size_t(l), count - 1);
      for (int part = 0; part < 3; ++part)
        block.extinction[part][l] = float(m.extinction[part][at]);
      for (int part = 0; part < 2; ++part)
        block.scattering[part][l] = float(m.scattering[part][at]);
      block.albedo[l] = float(m.albedo[at]);
    }
    impl->blocks.push_back(std::move(block));
  }
  if (Status ran = impl->iterate(progress); !ran) return ran.error();
  return Scattering(std::move(impl));
}

const Medium& Scattering::medium() const {
  return impl_->medium;
}
int Scattering::orders() const {
  return impl_->ordersDone;
}

AirLight Scattering::along(const RayInAir& ray, double end) const {
  const Medium& m = impl_->medium;
  // Where the ray enters and leaves the planet's shadow, a cylinder.
  std::vector<double> breaks;
  const double r = m.shell.radius + ray.altitude, sun = std::cos(ray.sunZenith);
  const double nu = ray.towardsSun, a = 1 - nu * nu;
  const double b = r * ray.cosine - r * sun * nu;
  const double c = ray.altitude * (2 * m.shell.radius + ray.altitude) - r * r * sun * sun;
  if (const double d = b * b - a * c; a > 1e-12 && d > 0)
    for (const double s : {(-b - std::sqrt(d)) / a, (-b + std::sqrt(d)) / a})
      if (r * sun + s * nu < 0) breaks.push_back(s);
  const AirPath path = airPath(m, impl_->split, ray.altitude, ray.cosine, end, breaks);
  std::vector<MarchNode> nodes;
  impl_->prepare(path, ray, false, nodes);
  const MarchKernels kernel = kernels();
  const std::size_t count = m.wavelengths.size();
  AirLight light;
  for (std::size_t first = 0; first < count; first += kLanes) {
    const Block& block = impl_->blocks[first / kLanes];
    MarchSums sums{};
    if (!nodes.empty())
      kernel.march(tablesOf(block, block.held, impl_->grid), nodes.data(), int(nodes.size()), true,
                   true, sums);
    float depth[kLanes], through[kLanes], ground[kLanes] = {}, direct[kLanes] = {};
    for (int l = 0; l < kLanes; ++l) {
      depth[l] = 0;
      for (int part = 0; part < kParts; ++part)
        depth[l] -= block.extinction[part][l] * path.length[part];
    }
    kernel.exp(depth, through);
    if (path.hitsGround) {
      const double sunZenith = impl_->sunZenithAtEnd(path, ray);
      impl_->groundIrradiance(block.ground, sunZenith, ground);
      impl_->directOnGround(block, sunZenith, direct);
    }
    const std::size_t here = std::min(std::size_t(kLanes), count - first);
    for (std::size_t l = 0; l < here; ++l) {
      light.air.push_back(double(sums.air[l]));
      light.aerosol.push_back(double(sums.aerosol[l]));
      light.multiple.push_back(double(sums.multiple[l]));
      light.ground.push_back(double(through[l]) * (double(ground[l]) + double(direct[l])) *
                             double(block.albedo[l]) / kPi);
      light.transmittance.push_back(double(through[l]));
    }
  }
  return light;
}

std::vector<double> Scattering::radiance(const RayInAir& ray) const {
  const AirLight light = along(ray);
  const double air = media::evaluate(media::RayleighPhase{}, ray.towardsSun);
  const double aerosol = media::evaluate(medium().aerosolPhase, ray.towardsSun);
  std::vector<double> sum(light.air.size());
  for (std::size_t i = 0; i < sum.size(); ++i)
    sum[i] = air * light.air[i] + aerosol * light.aerosol[i] + light.multiple[i] + light.ground[i];
  return sum;
}

std::vector<double> Scattering::diffuseIrradiance(double sunZenith) const {
  std::vector<double> out;
  for (const Block& block : impl_->blocks) {
    float lanes[kLanes];
    impl_->groundIrradiance(block.ground, sunZenith, lanes);
    out.insert(out.end(), lanes, lanes + kLanes);
  }
  out.resize(medium().wavelengths.size());
  return out;
}

std::vector<double> Scattering::sunTransmittance(double altitude, double sunZenith) const {
  const Medium& m = medium();
  std::vector<double> out(m.wavelengths.size());
  if (sunZenith > impl_->sunLengths.horizonAngle(altitude)) return out;
  float lengths[kParts];
  impl_->sunLengths.at(altitude, sunZenith, lengths);
  for (std::size_t i = 0; i < out.size(); ++i) {
    double depth = 0;
    for (int part = 0; part < kParts; ++part)
      depth += m.extinction[part][i] * double(lengths[part]);
    out[i] = std::exp(-depth);
  }
  return out;
}

}  // namespace lambent::sky
