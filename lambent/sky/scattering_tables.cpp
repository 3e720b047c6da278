// Nodes of the tables, and nodes of rays through them.
#include "lambent/sky/scattering_tables.h"

#include <algorithm>
#include <cmath>

#include "lambent/math/isa.h"
#include "lambent/math/types.h"
#include "lambent/sky/interpolation.h"
#include "lambent/sky/sun_above.h"

namespace lambent::sky {
namespace {

constexpr double kPerDegree = kPi / 180;

/// abramowitz1964handbook, 4.4.46: 2e-8 rad off at most. A quarter of std::acos's time.
double quickAcos(double cosine) {
  const double x = std::abs(cosine);
  const double p =
      1.5707963050 +
      x * (-0.2145988016 +
           x * (0.0889789874 +
                x * (-0.0501743046 +
                     x * (0.0308918810 +
                          x * (-0.0170881256 + x * (0.0066700901 - x * 0.0012624911))))));
  const double angle = std::sqrt(1 - x) * p;
  return cosine < 0 ? kPi - angle : angle;
}

/// A ray's direction and the Sun at a place along it.
struct LocalFrame {
  double cosine, sunCosine;  ///< of their zenith angles
  LocalFrame(const media::Shell& shell, const AirPath& path, const AirPath::Node& node,
             const RayInAir& ray, double sunCosine0) {
    const double r0 = shell.radius + path.altitude, r = shell.radius + node.altitude;
    cosine = std::clamp((r0 * ray.cosine + node.distance) / r, -1.0, 1.0);
    sunCosine = std::clamp((r0 * sunCosine0 + node.distance * ray.towardsSun) / r, -1.0, 1.0);
  }
};

}  // namespace

MarchKernels marchKernels() {
#if defined(__x86_64__)
  switch (math::bestIsa()) {
    case math::Isa::Avx512:
      return avx512::marchKernels();
    case math::Isa::Avx2:
      return avx2::marchKernels();
    case math::Isa::Baseline:
      break;
  }
#endif
  return baseline::marchKernels();
}

double Grid::sunCoordinate(double zenith) const {
  const double degrees = zenith / kPerDegree, past = degrees - 78;
  const double more = (twilight - 0.2) / 2;
  return density * (degrees / 5 + more * (past + std::sqrt(past * past + 64))) - first;
}

double Grid::sunZenith(int node) const {
  double low = 0, high = kPi;
  for (int step = 0; step < 60; ++step) {
    const double middle = 0.5 * (low + high);
    (sunCoordinate(middle) < node ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

double Grid::altitude(int node) const {
  return altitudeOfRise(double(node) / (altitudes - 1), height);
}

Held::Held(const Grid& grid)
    : logScale(std::size_t(grid.cells()) * kLanes, std::log(kNothing)),
      moments(std::size_t(grid.cells()) * 4 * kLanes),
      aerosol(std::size_t(grid.cells()) * std::size_t(grid.directions()) * kLanes) {}

Block::Block(const Grid& grid)
    : held(grid), logGround(std::size_t(grid.suns) * kLanes, std::log(kNothing)) {}

MarchTables Block::tables(const Held& with, const Grid& grid) const {
  return {{extinction[0], extinction[1], extinction[2]},
          {scattering[0], scattering[1]},
          with.logScale.data(),
          with.moments.data(),
          with.aerosol.data(),
          grid.directions(),
          grid.azimuthStride()};
}

void Block::transmit(const float (&lengths)[kParts], float (&out)[kLanes]) const {
  float depths[kLanes] = {};
  for (int part = 0; part < kParts; ++part)
    for (int l = 0; l < kLanes; ++l) depths[l] -= extinction[part][l] * lengths[part];
  marchKernels().exp(depths, out);
}

void Scattering::Impl::prepareOnce(const AirPath& path, const RayInAir& ray, Shadow shadow,
                                   std::vector<MarchNode>& nodes) const {
  const double sunCosine = std::cos(ray.sunZenith);
  nodes.resize(path.nodes.size());
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    const AirPath::Node& node = path.nodes[n];
    MarchNode& out = nodes[n];
    out.weight = float(node.weight);
    std::copy_n(node.density, kParts, out.density);
    std::copy_n(node.length, kParts, out.length);
    const double sunZenith =
        std::acos(LocalFrame(medium.shell, path, node, ray, sunCosine).sunCosine);
    const double above = node.horizon - sunZenith;
    out.sunVisible =
        shadow == Shadow::Soft ? float(discAbove(above / kSunRadius)) : (above >= 0 ? 1.0f : 0.0f);
    if (out.sunVisible > 0)
      sunLengths.at(node.altitude, sunZenith, out.sunLength);
    else
      std::fill_n(out.sunLength, kParts, 0.0f);
  }
}

void Scattering::Impl::prepareAgain(const AirPath& path, const RayInAir& ray,
                                    std::vector<MarchNode>& nodes) const {
  const double sunCosine = std::cos(ray.sunZenith);
  const auto taps = [this](double at, int count) {
    return resolution.cubic ? cubicTaps(at, count) : linearTaps(at, count);
  };
  // With the border in: node k of an axis is entry k + 1.
  const auto directed = [](double at, int count, float(&weight)[4]) {
    const Taps four = cubicTaps(at + 1, count + 2);
    for (int k = 0; k < 4; ++k) weight[k] = float(four.weight[k]);
    return four.first;
  };
  nodes.resize(path.nodes.size());
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    const AirPath::Node& node = path.nodes[n];
    MarchNode& out = nodes[n];
    out.weight = float(node.weight);
    std::copy_n(node.density, kParts, out.density);
    std::copy_n(node.length, kParts, out.length);

    const LocalFrame frame(medium.shell, path, node, ray, sunCosine);
    const double sine2 = 1 - frame.cosine * frame.cosine;
    const double sines = std::sqrt(sine2 * (1 - frame.sunCosine * frame.sunCosine));
    // Where either stands in the zenith azimuths mean nothing.
    const double cosAzimuth =
        sines > 1e-9
            ? std::clamp((ray.towardsSun - frame.cosine * frame.sunCosine) / sines, -1.0, 1.0)
            : 1;
    const Taps suns = taps(grid.sunCoordinate(quickAcos(frame.sunCosine)), grid.suns);
    const Taps rows = taps(node.rise * (grid.altitudes - 1), grid.altitudes);
    out.cellCount = 0;
    for (int i = 0; i < suns.count; ++i)
      for (int j = 0; j < rows.count; ++j) {
        const double w = suns.weight[i] * rows.weight[j];
        if (w == 0) continue;
        out.cell[out.cellCount] = grid.cell(suns.first + i, rows.first + j);
        out.cellWeight[out.cellCount++] = float(w);
      }
    const int zenith = directed(quickAcos(frame.cosine) / kPi * (grid.zeniths - 1), grid.zeniths,
                                out.zenithWeight);
    const int azimuth = directed(quickAcos(cosAzimuth) / kPi * (grid.azimuths - 1), grid.azimuths,
                                 out.azimuthWeight);
    out.direction = zenith * grid.azimuthStride() + azimuth;
    const double x2 = sine2 * cosAzimuth * cosAzimuth;
    out.moment[0] = float(1 + x2);
    out.moment[1] = float(1 + frame.cosine * frame.cosine);
    out.moment[2] = float(1 + (sine2 - x2));
    out.moment[3] = float(2 * std::sqrt(sine2) * cosAzimuth * frame.cosine);
  }
}

double Scattering::Impl::sunZenithAtEnd(const AirPath& path, const RayInAir& ray) const {
  const double r0 = medium.shell.radius + path.altitude;
  return std::acos(std::clamp(
      (r0 * std::cos(ray.sunZenith) + path.end * ray.towardsSun) / medium.shell.radius, -1.0, 1.0));
}

void Scattering::Impl::direct(const Block& block, double sunZenith, float (&out)[kLanes]) const {
  const double share = horizontalShareOfDisc(kPi / 2 - sunZenith);
  if (!(share > 0)) {
    std::fill_n(out, kLanes, 0.0f);
    return;
  }
  float lengths[kParts];
  sunLengths.at(0, sunZenith, lengths);
  block.transmit(lengths, out);
  for (float& value : out) value *= float(share);
}

void Scattering::Impl::fromLogs(const std::vector<float>& logs, double sunZenith,
                                float (&out)[kLanes]) const {
  const double at = grid.sunCoordinate(sunZenith);
  const Taps taps = resolution.cubic ? cubicTaps(at, grid.suns) : linearTaps(at, grid.suns);
  float sum[kLanes] = {};
  for (int k = 0; k < taps.count; ++k)
    for (int l = 0; l < kLanes; ++l)
      sum[l] += float(taps.weight[k]) * logs[std::size_t(taps.first + k) * kLanes + l];
  marchKernels().exp(sum, out);
}

}  // namespace lambent::sky
