#include "lambent/sky/scattering.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "lambent/math/quadrature.h"
#include "lambent/math/random.h"
#include "lambent/math/types.h"
#include "lambent/media/optical_length.h"
#include "lambent/sky/test_angles.h"

namespace lambent::sky {
namespace {

using test::kDegree;

/// Spherical Monte Carlo of the preset "reference", W m⁻² sr⁻¹ nm⁻¹ at 450, 550, 650 and 720 nm with
/// standard errors in percent: unpolarised, no refraction, all orders.
struct PublishedRow {
  double sun, view, azimuth;  ///< zenith angles, and the azimuth from the Sun's, degrees
  double radiance[4], error[4];
};
constexpr PublishedRow kMonteCarlo[] = {
    {60, 0, 0, {0.035825, 0.017673, 0.0085881, 0.0062806}, {.14, .15, .16, .21}},
    {60, 30, 0, {0.073335, 0.047008, 0.029601, 0.022941}, {.08, .08, .08, .10}},
    {60, 30, 180, {0.033419, 0.015335, 0.0067103, 0.0048445}, {.16, .18, .22, .25}},
    {60, 60, 0, {0.33826, 0.29751, 0.22687, 0.1853}, {.03, .03, .03, .03}},
    {60, 60, 90, {0.056374, 0.02797, 0.012917, 0.0096486}, {.12, .14, .15, .19}},
    {60, 60, 180, {0.061081, 0.029453, 0.012966, 0.0092729}, {.11, .13, .15, .18}},
    {60, 80, 0, {0.34851, 0.31074, 0.23173, 0.1908}, {.04, .04, .04, .04}},
    {60, 80, 90, {0.093749, 0.056588, 0.028038, 0.023084}, {.09, .10, .11, .12}},
    {60, 80, 180, {0.12145, 0.073292, 0.035872, 0.027313}, {.08, .08, .09, .11}},
    {94, 0, 0, {0.000282, 0.0002508, 0.00018128, 0.00013308}, {1.1, .88, .88, .83}},
    {94, 30, 0, {0.00042042, 0.00037789, 0.00027556, 0.00020054}, {.86, .74, .73, .70}},
    {94, 30, 180, {0.000332, 0.00030674, 0.00023197, 0.00017531}, {1.0, .78, .73, .74}},
    {94, 60, 0, {0.0010159, 0.0009977, 0.00074374, 0.00055536}, {.54, .46, .46, .47}},
    {94, 60, 90, {0.00047466, 0.00044973, 0.00034181, 0.00025589}, {.91, .73, .67, .70}},
    {94, 60, 180, {0.00042561, 0.00046655, 0.00037539, 0.00029539}, {.99, .73, .61, .64}},
    {94, 80, 0, {0.0020823, 0.0029166, 0.0024903, 0.001949}, {.39, .27, .26, .28}},
    {94, 80, 90, {0.00057846, 0.00075058, 0.00065378, 0.00052858}, {.93, .64, .55, .57}},
    {94, 80, 180, {0.000273, 0.000255, 0.000203, 0.000168}, {1.8, 1.6, 1.5, 1.4}}};

RayInAir rayTo(double altitude, double view, double azimuth, double sun) {
  return {altitude, std::cos(view), sun,
          std::cos(view) * std::cos(sun) + std::sin(view) * std::sin(sun) * std::cos(azimuth)};
}

Scattering solved(const Atmosphere& atmosphere, std::vector<double> wavelengths,
                  const Resolution& resolution = Resolution::fast()) {
  const auto scattering = Scattering::solve(mediumOf(atmosphere, wavelengths), resolution);
  EXPECT_TRUE(scattering);
  return *scattering;
}

TEST(Scattering, IsThatOfMonteCarloWithinItsErrors) {
  const Scattering sky = solved(*preset("reference"), {450, 550, 650, 720});
  double squares[2] = {};
  for (const PublishedRow& row : kMonteCarlo) {
    const std::vector<double> ours =
        sky.radiance(rayTo(0, row.view * kDegree, row.azimuth * kDegree, row.sun * kDegree));
    for (int i = 0; i < 4; ++i) {
      const double off = 100 * (ours[std::size_t(i)] *
                                    sky.medium().solarIrradiance[std::size_t(i)] / row.radiance[i] -
                                1);
      EXPECT_LT(std::abs(off), 3 * row.error[i] + 0.3)
          << row.sun << ' ' << row.view << ' ' << row.azimuth << ' ' << i;
      squares[row.sun > 90] += off * off / 36;
    }
  }
  EXPECT_LT(std::sqrt(squares[0]), 0.3);  // percent
  EXPECT_LT(std::sqrt(squares[1]), 1);    // the errors of the table itself
}

TEST(Scattering, OnceIsAQuadrature) {
  const Scattering sky = solved(*preset("reference"), {450, 720});
  const RayInAir zenith = rayTo(0, 0, 0, 60 * kDegree);
  const AirLight light = sky.along(zenith);
  const double air = media::evaluate(media::RayleighPhase{}, 0.5),
               aerosol = media::evaluate(sky.medium().aerosolPhase, 0.5);
  const double published[] = {0.024516, 0.004913};
  for (std::size_t i = 0; i < 2; ++i)
    EXPECT_NEAR((air * light.air[i] + aerosol * light.aerosol[i]) * sky.medium().solarIrradiance[i],
                published[i], 1e-6);
}

TEST(Scattering, LengthsToTheSunAreThoseOfTheIntegral) {
  const Medium medium = mediumOf(*preset("clear"), std::vector<double>{550});
  const SunLengths lengths(medium);
  math::Random random(1, 0);
  for (int i = 0; i < 300; ++i) {
    const double altitude = medium.shell.height * std::pow(random.uniform(), 2);
    const double zenith =
        lengths.horizonAngle(altitude) * (1 - std::pow(double(random.uniform()), 3)) * 0.99999;
    float ours[kParts];
    lengths.at(altitude, zenith, ours);
    for (const int part : {kAir, kAerosol}) {
      const double length = media::opticalLengthToTop(
          medium.shell, medium.profiles[std::size_t(part)], altitude, std::cos(zenith));
      EXPECT_NEAR(ours[part], length, 2e-4 * length + 5) << altitude << ' ' << zenith;
    }
  }
}

/// Rayleigh (τ .2) over aerosols that scatter by Henyey and Greenstein's function (τ .4), one km
/// each, on a planet that is flat to all purposes.
Atmosphere twoLayers(double albedoOfAerosols, double groundAlbedo) {
  Atmosphere a;
  a.planetRadius = 1e10;
  a.height = 2000;
  // Of Penndorf's coefficient at 550 nm, so that the air's optical thickness is .2.
  const double air = 0.2 / (mediumOf(a, std::vector<double>{550}).extinction[kAir][0] * 1000);
  a.air = media::DensityProfile::tabulated({{0, 0}, {1000, 0}, {1000, air}, {2000, air}});
  a.aerosolProfile = media::DensityProfile::tabulated({{0, 1}, {1000, 1}, {1000, 0}, {2000, 0}});
  a.aerosols = Atmosphere::Angstrom{0.4, 0};
  a.aerosolPhase = media::HenyeyGreenstein{0.7};
  a.singleScatteringAlbedo = albedoOfAerosols;
  a.ozone = 0;
  a.groundAlbedo = Spectral::constant(groundAlbedo);
  return a;
}

Resolution forLayers() {
  Resolution r;
  r.sunDensity = 2;
  r.altitudes = 13;
  r.upward = r.downward = 10;
  r.around = 9;
  r.zeniths = 25;
  r.azimuths = 13;
  r.cubic = true;
  r.tolerance = 1e-2;
  r.depth = 0.3;
  r.sunFrom = 12 * kDegree;
  r.sunTo = 68 * kDegree;
  return r;
}

/// What leaves the top upwards, over what came in on a horizontal surface.
double reflected(const Scattering& sky, double sun) {
  const math::Quadrature cosines = math::gaussLegendre(16, 0, 1),
                         turns = math::gaussLegendre(12, 0, kPi);
  double sum = 0;
  for (std::size_t i = 0; i < cosines.nodes.size(); ++i)
    for (std::size_t j = 0; j < turns.nodes.size(); ++j)
      sum += 2 * cosines.weights[i] * turns.weights[j] * cosines.nodes[i] *
             sky.radiance(rayTo(sky.medium().shell.height, kPi - std::acos(cosines.nodes[i]),
                                turns.nodes[j], sun))[0];
  return sum / std::cos(sun);
}

TEST(Scattering, OnAFlatPlanetIsThatOfTwoSlabs) {
  const double sun = std::acos(0.8);
  const Scattering sky = solved(twoLayers(0.9, 0.2), {550}, forLayers());
  EXPECT_NEAR(reflected(sky, sun) / 0.2721554, 1, 0.005);
  const GroundLight ground = sky.onGround(sun);
  EXPECT_NEAR((ground.diffuse[0] + ground.direct[0]) / 0.8 / 0.8244288, 1, 0.005);
  EXPECT_NEAR(ground.direct[0] / 0.8, std::exp(-0.6 / 0.8), 1e-4);
  // Reciprocity: what a direction sends on of another's light.
  for (const double azimuth : {0.0, 1.0, kPi}) {
    const double a = 0.3, b = 1.1, height = sky.medium().shell.height;
    const double there = sky.radiance(rayTo(height, kPi - a, azimuth, b))[0] / std::cos(b),
                 back = sky.radiance(rayTo(height, kPi - b, azimuth, a))[0] / std::cos(a);
    EXPECT_NEAR(there / back, 1, 0.01) << azimuth;
  }
}

TEST(Scattering, LosesNoLightWhereNothingAbsorbs) {
  const double sun = std::acos(0.8);
  const Scattering sky = solved(twoLayers(1, 0.3), {550}, forLayers());
  const GroundLight ground = sky.onGround(sun);
  EXPECT_NEAR(reflected(sky, sun) + 0.7 * (ground.diffuse[0] + ground.direct[0]) / 0.8, 1, 0.005);
}

TEST(Scattering, InEvenLightWithoutAbsorptionIsEven) {
  // The white furnace: Suns everywhere, a white planet in white air.
  Atmosphere white = *preset("pure");
  white.groundAlbedo = Spectral::constant(1);
  Resolution resolution = Resolution::fast();
  resolution.tolerance = 2e-3;
  const Scattering sky = solved(white, {450, 650}, resolution);
  const math::Quadrature turns = math::gaussLegendre(8, 0, kPi);
  for (const double view : {0.0, 60 * kDegree, 88 * kDegree, 100 * kDegree}) {
    const double altitude = 2000;
    const std::vector<double> through = sky.along(rayTo(altitude, view, 0, 0.5)).transmittance;
    std::vector<double> sum(2);
    double from = 0;
    for (const double to : {60 * kDegree, 85 * kDegree, 95 * kDegree, 121 * kDegree}) {
      const math::Quadrature suns = math::gaussLegendre(8, from, to);
      for (std::size_t i = 0; i < suns.nodes.size(); ++i)
        for (std::size_t j = 0; j < turns.nodes.size(); ++j) {
          const std::vector<double> radiance =
              sky.radiance(rayTo(altitude, view, turns.nodes[j], suns.nodes[i]));
          for (std::size_t l = 0; l < 2; ++l)
            sum[l] +=
                2 * suns.weights[i] * turns.weights[j] * std::sin(suns.nodes[i]) * radiance[l];
        }
      from = to;
    }
    const bool space = view < sky.horizonZenith(altitude);
    for (std::size_t l = 0; l < 2; ++l)
      EXPECT_NEAR(sum[l] + (space ? through[l] : 0), 1, 0.01) << view / kDegree << ' ' << l;
  }
}

TEST(Scattering, IsFiniteAndNeverNegative) {
  math::Random random(7, 0);
  const auto between = [&](double low, double high) {
    return low + (high - low) * double(random.uniform());
  };
  Resolution coarse;
  coarse.sunDensity = 0.5;
  coarse.altitudes = 6;
  coarse.upward = 5;
  coarse.downward = 4;
  coarse.around = 5;
  coarse.zeniths = 9;
  coarse.azimuths = 5;
  for (int round = 0; round < 8; ++round) {
    Atmosphere a = *preset(round % 2 ? "standard" : "clear");
    a.planetRadius = between(5e5, 1e7);
    a.height = between(1e4, 1.5e5);
    a.aerosols = Atmosphere::Angstrom{between(0, 2), between(-0.5, 2.5)};
    a.singleScatteringAlbedo = between(0, 1);
    a.aerosolPhase = media::HenyeyGreenstein{between(-0.9, 0.95)};
    a.ozone = between(0, 1000);
    a.groundAlbedo = Spectral::constant(between(0, 1));
    const Scattering sky = solved(a, {340, 550, 740}, coarse);
    for (int i = 0; i < 200; ++i) {
      const AirLight light = sky.along(rayTo(between(0, 1) * a.height, between(0, kPi),
                                             between(0, kPi), between(0, 108 * kDegree)),
                                       std::exp(between(0, 16)));
      for (const std::vector<double>* part :
           {&light.air, &light.aerosol, &light.multiple, &light.ground, &light.transmittance})
        for (const double value : *part) {
          ASSERT_TRUE(std::isfinite(value));
          ASSERT_GE(value, 0);
        }
      for (const double value : light.transmittance) ASSERT_LE(value, 1 + 1e-6);
    }
  }
}

TEST(Scattering, LightAddsUpAlongARay) {
  // A ray cut in two: the far half is seen through the near one.
  const Scattering sky = solved(*preset("clear"), {450, 550, 650});
  const RayInAir ray = rayTo(0, 80 * kDegree, 1, 40 * kDegree);
  const AirLight whole = sky.along(ray), near = sky.along(ray, 20000);
  const media::Shell& shell = sky.medium().shell;
  const double altitude = shell.altitudeAlong(0, ray.cosine, 20000);
  const double r = shell.radius + altitude;
  const RayInAir rest{
      altitude, (shell.radius * ray.cosine + 20000) / r,
      std::acos((shell.radius * std::cos(ray.sunZenith) + 20000 * ray.towardsSun) / r),
      ray.towardsSun};
  const AirLight far = sky.along(rest);
  for (std::size_t l = 0; l < 3; ++l) {
    EXPECT_NEAR((near.air[l] + near.transmittance[l] * far.air[l]) / whole.air[l], 1, 2e-3);
    EXPECT_NEAR((near.multiple[l] + near.transmittance[l] * far.multiple[l]) / whole.multiple[l], 1,
                5e-3);
    EXPECT_NEAR(near.transmittance[l] * far.transmittance[l] / whole.transmittance[l], 1, 1e-3);
  }
}

}  // namespace
}  // namespace lambent::sky
