// Looking up what successive_orders.cpp solved: light along any ray.
#include "lambent/sky/scattering.h"

#include <algorithm>
#include <cmath>

#include "lambent/math/types.h"
#include "lambent/sky/scattering_tables.h"

namespace lambent::sky {
namespace {

/// Farther from the day than this the tables hold nothing that is looked up.
constexpr double kLastZenith = 122 * kPi / 180;

}  // namespace

std::vector<double> shadowEdges(const media::Shell& shell, const RayInAir& ray) {
  const double r = shell.radius + ray.altitude, sun = std::cos(ray.sunZenith);
  const double a = 1 - ray.towardsSun * ray.towardsSun;
  const double b = r * ray.cosine - r * sun * ray.towardsSun;
  const double c = ray.altitude * (2 * shell.radius + ray.altitude) - r * r * sun * sun;
  const double d = b * b - a * c;
  std::vector<double> edges;
  if (a > 1e-12 && d > 0)
    for (const double s : {(-b - std::sqrt(d)) / a, (-b + std::sqrt(d)) / a})
      if (r * sun + s * ray.towardsSun < 0) edges.push_back(s);
  return edges;
}

Resolution Resolution::exact(int refine) {
  const double finer = std::pow(1.5, refine);
  const auto times = [finer](double n) { return int(std::lround(n * finer)); };
  Resolution r;
  r.sunDensity = finer;
  r.altitudes = times(18);
  r.upward = times(14);
  r.downward = times(9);
  r.around = times(12);
  r.zeniths = times(27);
  r.azimuths = times(14);
  r.levels = times(9);
  r.nodes = 4;
  r.depth = 1 / finer;
  r.cubic = true;
  r.tolerance = 4e-3 / (finer * finer);
  r.orders = 60;
  return r;
}

void Resolution::lookUpAt(double sunZenith) {
  sunFrom = sunZenith - 25 * kPi / 180;
  sunTo = sunZenith + 14 * kPi / 180;
}

std::shared_ptr<Scattering::Impl> Scattering::Impl::empty(Medium medium,
                                                          const Resolution& resolution) {
  auto impl = std::make_shared<Impl>();
  impl->medium = std::move(medium);
  impl->resolution = resolution;
  const Medium& m = impl->medium;
  impl->sunLengths = SunLengths(m);

  Grid& grid = impl->grid;
  grid = {m.shell.height,     resolution.sunDensity, 0, 0, resolution.altitudes,
          resolution.zeniths, resolution.azimuths};
  grid.first = grid.sunCoordinate(std::max(0.0, resolution.sunFrom));
  grid.suns =
      std::max(4, int(std::ceil(grid.sunCoordinate(std::min(resolution.sunTo, kLastZenith)))) + 1);

  impl->split.nodes = resolution.nodes;
  impl->split.depth = resolution.depth;
  for (int k = 1; k < resolution.levels; ++k)
    impl->split.levels.push_back(m.shell.height * std::pow(double(k) / resolution.levels, 2.2));
  for (const media::DensityProfile& profile : m.profiles)
    for (const double kink : profile.kinks())
      if (kink < m.shell.height) impl->split.levels.push_back(kink);

  const std::size_t count = m.wavelengths.size();
  for (std::size_t first = 0; first < count; first += kLanes) {
    Block block(grid);
    for (int l = 0; l < kLanes; ++l) {
      const std::size_t at = std::min(first + std::size_t(l), count - 1);
      for (int part = 0; part < kParts; ++part)
        block.extinction[part][l] = float(m.extinction[part][at]);
      for (const int part : {kAir, kAerosol})
        block.scattering[part][l] = float(m.scattering[part][at]);
      block.albedo[l] = float(m.albedo[at]);
    }
    impl->blocks.push_back(std::move(block));
  }
  return impl;
}

Result<Scattering> Scattering::solve(Medium medium, const Resolution& resolution,
                                     const Progress& progress) {
  std::shared_ptr<Impl> impl = Impl::empty(std::move(medium), resolution);
  if (Status added = impl->addOrders(progress); !added) return added.error();
  return Scattering(std::move(impl));
}

const Resolution& Scattering::resolution() const {
  return impl_->resolution;
}

const Medium& Scattering::medium() const {
  return impl_->medium;
}

int Scattering::orders() const {
  return impl_->orders;
}

double Scattering::horizonZenith(double altitude) const {
  return impl_->sunLengths.horizonAngle(altitude);
}

AirLight Scattering::along(const RayInAir& ray, double end) const {
  const Medium& m = impl_->medium;
  const AirPath path =
      airPath(m, impl_->split, ray.altitude, ray.cosine, end, shadowEdges(m.shell, ray));
  std::vector<MarchNode> nodes;
  const std::vector<Impl::Place> places = impl_->prepareAlong(path, ray.cosine, nodes);
  impl_->prepareOnce(path, ray, Impl::Shadow::Sharp, nodes);
  impl_->prepareAgain(path, ray, places, nodes);
  const double sunAtEnd = path.hitsGround ? impl_->sunZenithAtEnd(path, ray) : 0;
  const MarchKernels kernel = marchKernels();
  const std::size_t count = m.wavelengths.size();
  AirLight light;
  for (std::size_t first = 0; first < count; first += kLanes) {
    const Block& block = impl_->blocks[first / kLanes];
    MarchSums sums{};
    if (!nodes.empty())
      kernel.march(block.tables(block.held, impl_->grid), nodes.data(), int(nodes.size()), true,
                   true, sums);
    float through[kLanes], diffuse[kLanes] = {}, direct[kLanes] = {};
    block.transmit(path.length, through);
    if (path.hitsGround) {
      impl_->fromLogs(block.logGround, sunAtEnd, diffuse);
      impl_->direct(block, sunAtEnd, direct);
    }
    for (std::size_t l = 0; l < std::min(std::size_t(kLanes), count - first); ++l) {
      light.air.push_back(double(sums.air[l]));
      light.aerosol.push_back(double(sums.aerosol[l]));
      light.multiple.push_back(double(sums.multiple[l]));
      light.ground.push_back(double(through[l] * (diffuse[l] + direct[l]) * block.albedo[l]) / kPi);
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

GroundLight Scattering::onGround(double sunZenith) const {
  GroundLight light;
  for (const Block& block : impl_->blocks) {
    float diffuse[kLanes], direct[kLanes];
    impl_->fromLogs(block.logGround, sunZenith, diffuse);
    impl_->direct(block, sunZenith, direct);
    light.diffuse.insert(light.diffuse.end(), diffuse, diffuse + kLanes);
    light.direct.insert(light.direct.end(), direct, direct + kLanes);
  }
  light.diffuse.resize(medium().wavelengths.size());
  light.direct.resize(medium().wavelengths.size());
  return light;
}

std::vector<double> Scattering::sunTransmittance(double altitude, double sunZenith) const {
  const Medium& m = medium();
  float lengths[kParts];
  impl_->sunLengths.at(altitude, sunZenith, lengths);
  std::vector<double> out(m.wavelengths.size());
  for (std::size_t i = 0; i < out.size(); ++i) {
    double depth = 0;
    for (int part = 0; part < kParts; ++part)
      depth += m.extinction[part][i] * double(lengths[part]);
    out[i] = std::exp(-depth);
  }
  return out;
}

}  // namespace lambent::sky
