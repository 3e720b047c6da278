// This work is based on:
// - preetham2003modeling: "Aerial Perspective Model". Its equations are for one kind of particles; the
//   sum over kinds is ours. Its L_in takes the Sun's light alone: AirBetween::multiple is what it
//   leaves out, and is 0 in its form.
#include "lambent/sky/aerial_perspective.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "lambent/sky/aerial_table.h"
#include "lambent/sky/sun_frame.h"

namespace lambent::sky {
namespace {

/// (1 − e^(−x)) / x
Eigen::Array3d meanTransmittance(const Eigen::Array3d& x) {
  return x.unaryExpr([](double t) { return t > 1e-9 ? -std::expm1(-t) / t : 1 - 0.5 * t; });
}

}  // namespace

Status checkViewer(const ViewerInAir& viewer, const media::Shell& shell) {
  if (!(viewer.altitude >= 0 && viewer.altitude <= shell.height))
    return report::badUsage(fmt::format(
        "a viewer at an altitude of {} m is not in the air, which reaches from 0 to {} m",
        viewer.altitude, shell.height));
  if (!(std::abs(viewer.sunElevation) <= kPi / 2 + 1e-9) || !(viewer.sunDistance > 0))
    return report::badUsage("the Sun's elevation is between -90° and 90°, its distance above 0");
  return Status::ok();
}

ExactAir::ExactAir(Scattering scattering, const Atmosphere& atmosphere, const ViewerInAir& viewer)
    : scattering_(std::move(scattering)),
      viewer_(viewer),
      sun_(sunDirection(viewer.sunElevation)),
      colors_(scattering_, atmosphere, viewer.sunElevation, viewer.sunDistance) {}

AirBetween ExactAir::at(const Vec3d& direction, double distance) const {
  if (!(distance > 0)) return {};
  const double towardsSun = std::clamp(direction.dot(sun_), -1.0, 1.0);
  const RayInAir ray{viewer_.altitude, std::clamp(direction.y(), -1.0, 1.0),
                     kPi / 2 - viewer_.sunElevation, towardsSun};
  AirStretches light;
  const double ends[] = {std::min(distance, kEndless)};
  scattering_.upTo(ray, ends, 5, light);
  const double air = media::evaluate(media::RayleighPhase{}, towardsSun);
  const double aerosol = media::evaluate(scattering_.medium().aerosolPhase, towardsSun);
  for (std::size_t i = 0; i < light.air.size(); ++i)
    light.air[i] = air * light.air[i] + aerosol * light.aerosol[i];
  return {1 - colors_.lost(light.depth), colors_.radiance(light.air),
          colors_.radiance(light.multiple)};
}

AirBetween ConstantAir::at(const Vec3d& direction, double distance) const {
  if (!(distance > 0)) return {};
  distance = std::min(distance, kEndless);
  const double towardsSun = std::clamp(direction.dot(sun), -1.0, 1.0);
  const Eigen::Array3d depth = extinction * distance;
  const Eigen::Array3d scattered = air * media::evaluate(media::RayleighPhase{}, towardsSun) +
                                   aerosol * media::evaluate(aerosolPhase, towardsSun);
  return {(-depth).exp(), scattered * distance * meanTransmittance(depth), Eigen::Array3d::Zero()};
}

ConstantAir constantAir(const Scattering& scattering, const Atmosphere& atmosphere,
                        const ViewerInAir& viewer) {
  const Medium& medium = scattering.medium();
  const AirColors colors(scattering, atmosphere, viewer.sunElevation, viewer.sunDistance);
  const double sunZenith = kPi / 2 - viewer.sunElevation;
  const bool day = sunZenith <= scattering.horizonZenith(viewer.altitude);
  std::vector<double> sun = scattering.sunTransmittance(viewer.altitude, sunZenith);
  const std::size_t count = sun.size();
  std::vector<double> extinction(count), air(count), aerosol(count);
  for (std::size_t i = 0; i < count; ++i) {
    for (int part = 0; part < kParts; ++part)
      extinction[i] += medium.extinction[part][i] * medium.profiles[part].at(viewer.altitude);
    if (!day) continue;
    const auto scattered = [&](Part part) {
      return sun[i] * medium.scattering[part][i] * medium.profiles[part].at(viewer.altitude);
    };
    air[i] = scattered(kAir);
    aerosol[i] = scattered(kAerosol);
  }
  // What is lost per metre: of a path so short that it is linear.
  constexpr double kShort = 1e-3;  // m
  std::vector<double> depth(count);
  for (std::size_t i = 0; i < count; ++i) depth[i] = extinction[i] * kShort;
  return {colors.lost(depth) / kShort, colors.radiance(air), colors.radiance(aerosol),
          medium.aerosolPhase, sunDirection(viewer.sunElevation)};
}

AirBetween airBetween(const AerialPerspective& air, const Vec3d& direction, double distance) {
  return std::visit([&](const auto& form) { return form.at(direction, distance); }, air);
}

}  // namespace lambent::sky
