// This work is based on rigollier2000clear for clear skies' irradiance:
//   direct  E₀ e^(−.8662 T m δ_R(m)),
//           1 / δ_R = 6.6296 + 1.7513 m − .1202 m² + .0065 m³ − .00013 m⁴,
//           or 10.4 + .718 m for m > 20 (kasten1996linke), m the air mass of kasten1989revised;
//   diffuse E₀ T_rd(T) F_d(h, T), both polynomials.
// Deviation: Preetham's turbidity, a ratio for visible light, stands for Linke's, a ratio for all
// of it.
#include "lambent/sky/analytic_sky.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "lambent/sky/air_mass.h"
#include "lambent/sky/analytic_dome.h"
#include "lambent/sky/asrc_cie.h"
#include "lambent/sky/dome_quadrature.h"
#include "lambent/sky/preetham.h"
#include "lambent/sky/standard_skies.h"
#include "lambent/sky/sun_above.h"
#include "lambent/sky/twilight.h"

namespace lambent::sky {
namespace {

double irradianceOfSun(const SkyOptions& options, double nm) {
  return solarIrradianceOf(options.atmosphere, nm) *
         preethamSunTransmittance({.turbidity = turbidityOf(options.atmosphere),
                                   .ozone = options.atmosphere.ozone / 1000},
                                  options.sunElevation, nm) /
         (options.sunDistance * options.sunDistance);
}

/// The dome of a model, whether its Sun shines, and the illuminance on a surface facing it where
/// the model knows that itself.
struct DomeAndSun {
  std::shared_ptr<const Dome> dome;
  bool shines = true;
  std::optional<double> directIlluminance;
};

DomeAndSun makeDomeAndSun(const SkyOptions& options) {
  const double turbidity = turbidityOf(options.atmosphere), sun = options.sunElevation;
  const auto plain = [](const auto& sky) {
    return daylightDome([sky](const Vec3d& direction) { return sky.luminance(direction); });
  };
  MeasuredIrradiance measured = clearSkyIrradiance(turbidity, sun, options.sunDistance);
  measured.directNormal = options.directNormalIrradiance.value_or(measured.directNormal);
  measured.diffuseHorizontal =
      options.diffuseHorizontalIrradiance.value_or(measured.diffuseHorizontal);
  PerezOptions perez;
  perez.sunDistance = options.sunDistance;
  switch (options.model) {
    case Model::CieOvercast:
      return {plain(cieOvercast(sun)), false, {}};
    case Model::CieClear:
      return {plain(cieClear(sun, turbidity)), true, {}};
    case Model::CieGeneral:
      return {plain(standardSky(options.cieType, sun)),
              options.cieType > 6 && options.cieType != 9,
              {}};
    case Model::Perez: {
      const PerezSky sky = perezSky(measured, sun, perez);
      return {plain(sky), true, sky.directNormalIlluminance};
    }
    case Model::AsrcCie: {
      const AsrcSky sky = asrcSky(measured, sun, perez);
      return {plain(sky), true, sky.directNormalIlluminance};
    }
    case Model::Preetham:
    case Model::Exact:
    case Model::Fast:
      break;
  }
  assert(options.model == Model::Preetham);
  return {preethamDome(preethamSky(turbidity, sun)), true, {}};
}

SunDisc makeSunDisc(const SkyOptions& options, const DomeAndSun& of,
                    const std::vector<double>& wavelengths) {
  SunDisc sun;
  sun.elevation = options.sunElevation;
  sun.angularRadius = kSunRadius / options.sunDistance;
  sun.visible = discAbove(options.sunElevation / sun.angularRadius);
  sun.spectralIrradiance.assign(wavelengths.size(), 0.0);
  if (!of.shines || sun.visible <= 0) return sun;

  // Colour by its own wavelengths, so that it does not depend on those that spectra are asked at.
  std::vector<double> fine, power;
  for (double nm = 360; nm <= 780; nm += 5) {
    fine.push_back(nm);
    power.push_back(irradianceOfSun(options, nm));
  }
  const radiometry::Xyzv whole = radiometry::xyzvOf(fine, power);
  double scale = sun.visible;
  if (of.directIlluminance) scale *= whole[1] > 0 ? *of.directIlluminance / whole[1] : 0;
  sun.irradiance = scale * whole;
  std::ranges::transform(wavelengths, sun.spectralIrradiance.begin(),
                         [&](double nm) { return scale * irradianceOfSun(options, nm); });
  return sun;
}

/// Radiance that leaves a ground which reflects evenly.
void addGround(const SkyOptions& options, Sky& sky) {
  const DomeQuadrature dome = domeQuadrature(16, 16);
  const double sunShare = std::max(std::sin(options.sunElevation), 0.0);
  std::vector<double> fine;
  for (double nm = 360; nm <= 780; nm += 10) fine.push_back(nm);
  const auto leaving = [&](const std::vector<double>& nm, const std::vector<double>& direct) {
    std::vector<double> sum(nm.size(), 0.0), radiance(nm.size());
    for (size_t i = 0; i < dome.directions.size(); ++i) {
      const double weight = dome.solidAngles[i] * dome.directions[i].y();
      sky.dome->spectrum(dome.directions[i], nm, radiance);
      for (size_t k = 0; k < nm.size(); ++k) sum[k] += weight * radiance[k];
    }
    for (size_t k = 0; k < nm.size(); ++k) {
      const double albedo = std::clamp(options.atmosphere.groundAlbedo.at(nm[k]), 0.0, 1.0);
      sum[k] = albedo / kPi * (sum[k] + sunShare * direct[k]);
    }
    return sum;
  };
  sky.groundRadiance = leaving(sky.wavelengths, sky.sun.spectralIrradiance);
  std::vector<double> direct(fine.size(), 0.0);
  if (sky.sun.irradiance[1] > 0) {
    std::ranges::transform(fine, direct.begin(),
                           [&](double nm) { return irradianceOfSun(options, nm); });
    const double scale = sky.sun.irradiance[1] / radiometry::xyzvOf(fine, direct)[1];
    for (double& value : direct) value *= scale;
  }
  sky.ground = radiometry::xyzvOf(fine, leaving(fine, direct));
}

}  // namespace

double turbidityOf(const Atmosphere& atmosphere) {
  if (atmosphere.turbidity) return *atmosphere.turbidity;
  const auto* angstrom = std::get_if<Atmosphere::Angstrom>(&atmosphere.aerosols);
  return angstrom ? std::max((angstrom->thicknessAt1um + .04586) / .04608, 1.0) : 2;
}

MeasuredIrradiance clearSkyIrradiance(double linkeTurbidity, double sunElevation,
                                      double sunDistance) {
  const double above = 1367 / (sunDistance * sunDistance);
  const double t = std::clamp(linkeTurbidity, 1.0, 12.0);
  const double height = modelledElevation(sunElevation), s = std::sin(height);
  const double m = kastenYoungAirMass(height);
  const double inverseThickness =
      m > 20 ? 10.4 + .718 * m : 6.6296 + m * (1.7513 + m * (-.1202 + m * (.0065 - m * .00013)));
  const double trd = -1.5843e-2 + 3.0543e-2 * t + 3.797e-4 * t * t;
  const double a0 = std::max(.26463 - .061581 * t + .0031408 * t * t, 2e-3 / trd);
  const double a1 = 2.0402 + .018945 * t - .011161 * t * t;
  const double a2 = -1.3025 + .039231 * t + .0085079 * t * t;
  const double twilight = twilightFactor(sunElevation);
  return {above * std::exp(-.8662 * t * m / inverseThickness) * twilight,
          above * trd * std::max(a0 + s * (a1 + s * a2), 0.0) * twilight};
}

Sky analyticSky(const SkyOptions& options) {
  const DomeAndSun of = makeDomeAndSun(options);
  Sky sky;
  sky.dome = of.dome;
  sky.wavelengths = spectrumWavelengths(options);
  sky.sun = makeSunDisc(options, of, sky.wavelengths);
  sky.altitude = std::max(options.altitude, 0.0);
  const double radius = options.atmosphere.planetRadius;
  sky.horizon = -std::acos(radius / (radius + sky.altitude));
  addGround(options, sky);
  return sky;
}

}  // namespace lambent::sky
