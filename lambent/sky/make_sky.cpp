#include "lambent/sky/make_sky.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <fmt/format.h>

#include "lambent/math/types.h"
#include "lambent/sky/analytic_sky.h"
#include "lambent/sky/dome_quadrature.h"
#include "lambent/sky/exact_dome.h"
#include "lambent/sky/spectral_weights.h"
#include "lambent/sky/sun_above.h"
#include "lambent/sky/table_cache.h"

namespace lambent::sky {
namespace {

using report::badUsage;

constexpr double kInDegrees = 180 / kPi;

Status checkOptions(const SkyOptions& o) {
  const auto within = [](double value, double least, double most) {
    return value >= least && value <= most;  // false for nan
  };
  if (!within(o.sunElevation * kInDegrees, -18.0001, 90.0001))
    return badUsage(
        fmt::format("the Sun stands at {:.2f}°: a sky by day and in twilight needs it "
                    "within -18 to 90 degrees of the horizon",
                    o.sunElevation * kInDegrees));
  if (!within(o.altitude, 0, o.atmosphere.height))
    return badUsage(
        fmt::format("altitude {:g} m is not within 0 (the ground) and {:g} m (the top "
                    "of the air)",
                    o.altitude, o.atmosphere.height));
  if (!within(o.sunDistance, 0.1, 10))
    return badUsage(
        fmt::format("the Sun's distance {:g} is not within 0.1 to 10 AU", o.sunDistance));
  if (o.cieType < 1 || o.cieType > 15)
    return badUsage(fmt::format("CIE sky {} is not one of 1 to 15", o.cieType));
  if (o.refine < 0 || o.refine > 3)
    return badUsage(fmt::format("refine {} is not within 0 to 3", o.refine));
  for (const std::optional<double>& given :
       {o.directNormalIrradiance, o.diffuseHorizontalIrradiance})
    if (given && !within(*given, 0, 2000))
      return badUsage(fmt::format("irradiance {:g} is not within 0 to 2000 W/m2", *given));
  for (std::size_t i = 0; i < o.wavelengths.size(); ++i)
    if (!within(o.wavelengths[i], 340, 740))
      return badUsage(
          fmt::format("wavelength {:g} nm is not within 340 to 740 nm", o.wavelengths[i]));
  return Status::ok();
}

double nearnessOf(const SkyOptions& options) {
  return 1 / (options.sunDistance * options.sunDistance);
}

/// Sun and ground from irradiances: of the ground by dome and Sun, and of a surface that faces a Sun
/// with all of its disc above the horizon.
struct Lights {
  std::vector<double> groundDiffuse, groundDirect, sun;
};

template <class LightsAt>
void addSunAndGround(const SkyOptions& options, const LightsAt& lightsAt, Sky& sky) {
  sky.wavelengths = spectrumWavelengths(options);
  sky.altitude = options.altitude;
  sky.sun.elevation = options.sunElevation;
  sky.sun.angularRadius = kSunRadius / options.sunDistance;
  sky.sun.visible = discAbove((options.sunElevation - sky.horizon) / sky.sun.angularRadius);
  const auto ground = [&](const Lights& light, const std::vector<double>& nm) {
    std::vector<double> leaving(nm.size());
    for (std::size_t i = 0; i < nm.size(); ++i)
      leaving[i] = options.atmosphere.groundAlbedo.at(nm[i]) / kPi *
                   (light.groundDiffuse[i] + light.groundDirect[i]);
    return leaving;
  };
  const Lights asked = lightsAt(sky.wavelengths);
  sky.groundRadiance = ground(asked, sky.wavelengths);
  for (const double value : asked.sun)
    sky.sun.spectralIrradiance.push_back(sky.sun.visible * value);
  std::vector<double> fine;
  for (double nm = 340; nm <= 740; nm += 5) fine.push_back(nm);
  const Lights seen = lightsAt(fine);
  sky.ground = radiometry::xyzvOf(fine, ground(seen, fine));
  sky.sun.irradiance = sky.sun.visible * radiometry::xyzvOf(fine, seen.sun);
}

/// Wavelengths of an exact sky: what is asked for, and enough beside it for its colour.
std::vector<double> exactWavelengths(const SkyOptions& options) {
  std::vector<double> nm = spectrumWavelengths({});
  nm.insert(nm.end(), options.wavelengths.begin(), options.wavelengths.end());
  std::sort(nm.begin(), nm.end());
  nm.erase(std::unique(nm.begin(), nm.end()), nm.end());
  return nm;
}

Result<Sky> exactSky(const SkyOptions& options, const Progress& progress) {
  Resolution resolution = Resolution::exact(options.refine);
  const double zenith = kPi / 2 - options.sunElevation;
  resolution.lookUpAt(zenith);
  Result<Scattering> solved = Scattering::solve(
      mediumOf(options.atmosphere, exactWavelengths(options)), resolution, progress);
  if (!solved) return solved.error();
  Sky sky;
  sky.horizon = kPi / 2 - solved->horizonZenith(options.altitude);
  const GroundLight ground = solved->onGround(zenith);
  const std::vector<double> sun = solved->sunTransmittance(options.altitude, zenith);
  const std::vector<double>& nodes = solved->medium().wavelengths;
  addSunAndGround(
      options,
      [&](const std::vector<double>& nm) {
        const auto at = [&](const std::vector<double>& values, double wavelength) {
          std::vector<float> logs;
          for (const double value : values) logs.push_back(float(std::log(std::max(value, 1e-30))));
          return nearnessOf(options) * solarIrradianceOf(options.atmosphere, wavelength) *
                 std::exp(double(SpectralTaps(nodes, wavelength)(logs.data())));
        };
        Lights lights;
        for (const double wavelength : nm) {
          lights.groundDiffuse.push_back(at(ground.diffuse, wavelength));
          lights.groundDirect.push_back(at(ground.direct, wavelength));
          lights.sun.push_back(at(sun, wavelength));
        }
        return lights;
      },
      sky);
  sky.dome = exactDome(std::move(*solved), options.atmosphere, options.altitude,
                       options.sunElevation, nearnessOf(options));
  return sky;
}

Sky fastSky(const SkyOptions& options, const SkyTable& table) {
  Sky sky;
  sky.horizon = table.horizon();
  addSunAndGround(
      options,
      [&](const std::vector<double>& nm) {
        SkyTable::Light light = table.light(options.sunElevation, nearnessOf(options), nm);
        return Lights{std::move(light.groundDiffuse), std::move(light.groundDirect),
                      std::move(light.sun)};
      },
      sky);
  sky.dome = table.dome(options.sunElevation, nearnessOf(options));
  return sky;
}

}  // namespace

std::vector<double> spectrumWavelengths(const SkyOptions& options) {
  if (!options.wavelengths.empty()) return options.wavelengths;
  std::vector<double> nm;
  for (double at = 340; at <= 740; at += 10) nm.push_back(at);
  return nm;
}

Result<SkyTable> SkyMaker::tableOf(const SkyOptions& options, Findings& findings,
                                   const Progress& progress) {
  if (kept_ && kept_->atmosphere == options.atmosphere &&
      kept_->table.altitude() == options.altitude)
    return kept_->table;
  std::optional<SkyTable> table = readTable(options.cache, options.atmosphere, options.altitude);
  if (!table) {
    Result<SkyTable> made = SkyTable::make(options.atmosphere, options.altitude, progress);
    if (!made) return made.error();
    if (const Status kept = keepTable(options.cache, options.atmosphere, *made); !kept)
      findings.push_back({Severity::Note, "sky-table-not-kept",
                          fmt::format("the table of this atmosphere could not be kept for the next "
                                      "time: {}",
                                      kept.error().message),
                          1});
    table = std::move(*made);
  }
  kept_ = Kept{options.atmosphere, *table};
  return std::move(*table);
}

Result<WithFindings<Sky>> SkyMaker::make(const SkyOptions& options, const Progress& progress) {
  if (Status ok = checkOptions(options); !ok) return ok.error();
  WithFindings<Sky> made;
  if (options.model == Model::Fast) {
    const Result<SkyTable> table = tableOf(options, made.findings, progress);
    if (!table) return table.error();
    made.value = fastSky(options, *table);
  } else if (options.model == Model::Exact) {
    Result<Sky> sky = exactSky(options, progress);
    if (!sky) return sky.error();
    made.value = std::move(*sky);
  } else {
    made.value = analyticSky(options);
  }
  return made;
}

Result<WithFindings<Sky>> makeSky(const SkyOptions& options, const Progress& progress) {
  return SkyMaker().make(options, progress);
}

std::filesystem::path cacheFolder() {
  if (const char* cache = std::getenv("XDG_CACHE_HOME"); cache && *cache == '/')
    return std::filesystem::path(cache) / "lambent";
  if (const char* home = std::getenv("HOME"); home && *home == '/')
    return std::filesystem::path(home) / ".cache" / "lambent";
  return {};
}

Horizontal onHorizontal(const Sky& sky) {
  Horizontal sum{radiometry::Xyzv::Zero(), radiometry::Xyzv::Zero(), {}, {}};
  const double share = sky.sun.visible > 0 ? horizontalShareOfDisc(sky.sun.elevation) : 0;
  const double perVisible = sky.sun.visible > 0 ? share / sky.sun.visible : 0;
  sum.direct = perVisible * sky.sun.irradiance;
  for (const double value : sky.sun.spectralIrradiance)
    sum.directSpectrum.push_back(perVisible * value);
  sum.diffuseSpectrum.assign(sky.wavelengths.size(), 0.0);
  const DomeQuadrature quadrature = domeQuadrature(64, 64);
  std::vector<double> radiance(sky.wavelengths.size());
  for (std::size_t i = 0; i < quadrature.directions.size(); ++i) {
    const Vec3d& direction = quadrature.directions[i];
    const double weight = quadrature.solidAngles[i] * direction.y();
    sum.diffuse += weight * sky.dome->color(direction);
    sky.dome->spectrum(direction, sky.wavelengths, radiance);
    for (std::size_t k = 0; k < radiance.size(); ++k)
      sum.diffuseSpectrum[k] += weight * radiance[k];
  }
  return sum;
}

}  // namespace lambent::sky
