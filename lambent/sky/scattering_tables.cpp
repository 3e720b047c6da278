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

/// Cosine of a zenith angle at a place along a path that has `cosine0` at its origin, and whose
/// direction makes an angle of cosine `between` with what it is the zenith angle of.
double cosineAlong(const media::Shell& shell, const AirPath& path, const AirPath::Node& node,
                   double cosine0, double between) {
  const double r0 = shell.radius + path.altitude, r = shell.radius + node.altitude;
  return std::clamp((r0 * cosine0 + node.distance * between) / r, -1.0, 1.0);
}

/// Of an axis of directions, from 0 to half a turn, with its border in: node k is entry k + 1.
int directionTaps(double angle, int count, float (&weight)[4]) {
  const Taps four = cubicTaps(angle / kPi * (count - 1) + 1, count + 2);
  for (int k = 0; k < 4; ++k) weight[k] = float(four.weight[k]);
  return four.first;
}

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

std::vector<Scattering::Impl::Place> Scattering::Impl::prepareAlong(
    const AirPath& path, double cosine, std::vector<MarchNode>& nodes) const {
  std::vector<Place> places(path.nodes.size());
  nodes.resize(path.nodes.size());
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    const AirPath::Node& node = path.nodes[n];
    MarchNode& out = nodes[n];
    Place& place = places[n];
    out.weight = float(node.weight);
    std::copy_n(node.density, kParts, out.density);
    std::copy_n(node.length, kParts, out.length);
    place.cosine = cosineAlong(medium.shell, path, node, cosine, 1);
    place.sine = std::sqrt(1 - place.cosine * place.cosine);
    place.rows = placeTaps(node.rise * (grid.altitudes - 1), grid.altitudes);
    place.direction = grid.azimuthStride() *
                      directionTaps(quickAcos(place.cosine), grid.zeniths, out.zenithWeight);
    out.moment[1] = float(1 + place.cosine * place.cosine);
  }
  return places;
}

void Scattering::Impl::prepareOnce(const AirPath& path, const RayInAir& ray, Shadow shadow,
                                   std::vector<MarchNode>& nodes) const {
  const double sunCosine = std::cos(ray.sunZenith);
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    const AirPath::Node& node = path.nodes[n];
    MarchNode& out = nodes[n];
    const double sunZenith =
        std::acos(cosineAlong(medium.shell, path, node, sunCosine, ray.towardsSun));
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
                                    std::span<const Place> places,
                                    std::vector<MarchNode>& nodes) const {
  const double sunCosine0 = std::cos(ray.sunZenith);
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    const Place& place = places[n];
    MarchNode& out = nodes[n];
    const double sunCosine =
        cosineAlong(medium.shell, path, path.nodes[n], sunCosine0, ray.towardsSun);
    const double sines = place.sine * std::sqrt(1 - sunCosine * sunCosine);
    // Where either stands in the zenith azimuths mean nothing.
    const double cosAzimuth =
        sines > 1e-9 ? std::clamp((ray.towardsSun - place.cosine * sunCosine) / sines, -1.0, 1.0)
                     : 1;
    const Taps suns = placeTaps(grid.sunCoordinate(quickAcos(sunCosine)), grid.suns);
    out.cellCount = 0;
    for (int i = 0; i < suns.count; ++i)
      for (int j = 0; j < place.rows.count; ++j) {
        const double w = suns.weight[i] * place.rows.weight[j];
        if (w == 0) continue;
        out.cell[out.cellCount] = grid.cell(suns.first + i, place.rows.first + j);
        out.cellWeight[out.cellCount++] = float(w);
      }
    out.direction =
        place.direction + directionTaps(quickAcos(cosAzimuth), grid.azimuths, out.azimuthWeight);
    const double x = place.sine * cosAzimuth, x2 = x * x;
    out.moment[0] = float(1 + x2);
    out.moment[2] = float(1 + (place.sine * place.sine - x2));
    out.moment[3] = float(2 * x * place.cosine);
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
