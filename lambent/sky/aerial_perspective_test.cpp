#include "lambent/sky/aerial_perspective.h"

#include <cmath>
#include <cstdlib>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "lambent/radiometry/spectra.h"
#include "lambent/sky/aerial_table.h"
#include "lambent/sky/sun_frame.h"
#include "lambent/sky/test_angles.h"

namespace lambent::sky {
namespace {

using test::kDegree;

Atmosphere clearAir() {
  return *preset("clear");
}

std::vector<double> wavelengthsEvery(double step) {
  std::vector<double> nm;
  for (int i = 0; 380 + i * step <= 740; ++i) nm.push_back(380 + i * step);
  return nm;
}

/// Light that is resolved coarsely: what is compared here is made of the same.
const Scattering& coarselySolved() {
  static const Scattering solved = [] {
    Resolution r;
    r.sunDensity = 0.5;
    r.altitudes = 8;
    r.upward = 8;
    r.downward = 5;
    r.around = 6;
    r.zeniths = 13;
    r.azimuths = 7;
    r.tolerance = 1e-2;
    r.cubic = true;
    r.levels = 16;
    r.nodes = 5;
    return *Scattering::solve(mediumOf(clearAir(), wavelengthsEvery(24)), r);
  }();
  return solved;
}

ExactAir exactAir(const ViewerInAir& viewer) {
  return ExactAir(coarselySolved(), clearAir(), viewer);
}

Vec3d towards(double elevation, double azimuth) {
  return {std::cos(elevation) * std::cos(azimuth), std::sin(elevation),
          std::cos(elevation) * std::sin(azimuth)};
}

double luminanceOf(const Eigen::Array3d& rgb) {
  return 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
}

RayInAir rayOf(const ViewerInAir& viewer, const Vec3d& direction) {
  return {viewer.altitude, direction.y(), kPi / 2 - viewer.sunElevation,
          direction.dot(sunDirection(viewer.sunElevation))};
}

TEST(AirStretches, AreThePathsUpToThem) {
  const Scattering& scattering = coarselySolved();
  const std::vector<double> ends = {10, 500, 3e3, 2e4, 8e4, 5e5};
  AirStretches stretches;
  for (const double sun : {40.0, 1.0, -5.0})
    for (const double elevation : {90.0, 30.0, 2.0, 0.0, -0.5}) {
      const ViewerInAir viewer{1500, sun * kDegree};
      const RayInAir ray = rayOf(viewer, towards(elevation * kDegree, 0.7));
      scattering.upTo(ray, ends, 6, stretches);
      const std::size_t count = scattering.medium().wavelengths.size();
      for (std::size_t k = 0; k < ends.size(); ++k) {
        const AirLight light = scattering.along(ray, ends[k]);
        for (std::size_t i = 0; i < count; i += 5) {
          const std::size_t at = k * count + i;
          const auto near = [&](double value, double expected) {
            EXPECT_NEAR(value, expected, 6e-3 * expected + 1e-12)
                << sun << ' ' << elevation << ' ' << ends[k] << ' ' << i;
          };
          near(stretches.air[at], light.air[i]);
          near(stretches.aerosol[at], light.aerosol[i]);
          near(stretches.multiple[at], light.multiple[i]);
          near(std::exp(-stretches.depth[at]), light.transmittance[i]);
        }
      }
    }
}

TEST(AirStretches, GoOnBelowTheGround) {
  // 100 m above it, looking down: after 1 km the path has been as long in air like the ground's.
  const Scattering& scattering = coarselySolved();
  const std::vector<double> ends = {100, 1000};
  AirStretches stretches;
  scattering.upTo(rayOf({100, 1}, towards(-kPi / 2, 0)), ends, 3, stretches);
  const Medium& medium = scattering.medium();
  const std::size_t count = medium.wavelengths.size();
  for (std::size_t i = 0; i < count; ++i) {
    const double depth = stretches.depth[count + i] - stretches.depth[i];
    EXPECT_NEAR(depth, 900 * (medium.extinction[kAir][i] + medium.extinction[kAerosol][i]),
                1e-6 * depth);
    EXPECT_GT(stretches.air[count + i], 5 * stretches.air[i]);
  }
}

TEST(AirColors, OfGreySurfacesOnTheGroundAreExact) {
  const Scattering& scattering = coarselySolved();
  const std::vector<double>& nm = scattering.medium().wavelengths;
  for (const double sun : {50.0, 3.0, -6.0}) {
    const AirColors colors(scattering, clearAir(), sun * kDegree);
    const GroundLight ground = scattering.onGround(kPi / 2 - sun * kDegree);
    std::vector<double> thickness(nm.size()), before(nm.size()), after(nm.size());
    for (std::size_t i = 0; i < nm.size(); ++i) {
      thickness[i] = 0.3 * std::pow(550 / nm[i], 4);
      before[i] = 0.5 / kPi * (ground.diffuse[i] + ground.direct[i]);
      after[i] = before[i] * std::exp(-thickness[i]);
    }
    const Eigen::Array3d f = 1 - colors.lost(thickness);
    const Eigen::Array3d expected = colors.radiance(after) / colors.radiance(before);
    // In twilight red is next to nothing in the light, and is held within what wavelengths do.
    EXPECT_LT((f - expected).abs().maxCoeff(), sun > 0 ? 1e-9 : 1e-2) << sun;
    EXPECT_GT(f[0], f[1]);
    EXPECT_GT(f[1], f[2]);
    // Through very much air, each channel keeps within what wavelengths do.
    for (double& t : thickness) t *= 60;
    const Eigen::Array3d all = colors.lost(thickness);
    EXPECT_TRUE((all <= 1).all() && (all > 0.98).all()) << all.transpose();
  }
}

TEST(AirColors, SixteenWavelengthsAreEnough) {
  Resolution once;
  once.orders = 1;
  once.sunFrom = once.sunTo = 0.9;
  const auto solved = [&](double step) {
    return *Scattering::solve(mediumOf(clearAir(), wavelengthsEvery(step)), once);
  };
  const ViewerInAir viewer{500, 40 * kDegree};
  const ExactAir few(solved(24), clearAir(), viewer), many(solved(5), clearAir(), viewer);
  for (const double elevation : {60.0, 5.0, 0.0})
    for (const double distance : {300.0, 2e4, 3e5}) {
      const Vec3d direction = towards(elevation * kDegree, 1);
      const AirBetween a = many.at(direction, distance), b = few.at(direction, distance);
      EXPECT_LT((b.extinction - a.extinction).abs().maxCoeff(), 1e-3);
      EXPECT_LT((b.inScattered() / a.inScattered() - 1).abs().maxCoeff(), 2e-3);
    }
  // And many are as radiometry has the colours of spectra that are linear between wavelengths: here
  // the Sun's is, and the air's is a cubic.
  const Scattering fine = solved(5);
  const AirColors colors(fine, clearAir(), viewer.sunElevation);
  std::vector<double> relative = fine.radiance(rayOf(viewer, towards(0.5, 1))), spectrum = relative;
  for (std::size_t i = 0; i < spectrum.size(); ++i) spectrum[i] *= fine.medium().solarIrradiance[i];
  const Eigen::Array3d expected =
      radiometry::linearRgbOf(radiometry::xyzvOf(fine.medium().wavelengths, spectrum));
  EXPECT_LT((colors.radiance(relative) / expected - 1).abs().maxCoeff(), 3e-4);
}

TEST(ExactAir, ShortPathsAreLinear) {
  for (const double sun : {60.0, 5.0, -4.0}) {
    const ExactAir air = exactAir({300, sun * kDegree});
    const Vec3d direction = towards(0.2, 1.2);
    const AirBetween at1 = air.at(direction, 1), at10 = air.at(direction, 10);
    EXPECT_GT(at1.extinction.minCoeff(), 1 - 1e-3);
    EXPECT_LT(at1.extinction.maxCoeff(), 1);
    EXPECT_LT((at10.inScattered() / at1.inScattered() - 10).abs().maxCoeff(), 0.02);
    EXPECT_LT(((1 - at10.extinction) / (1 - at1.extinction) - 10).abs().maxCoeff(), 0.05);
    EXPECT_TRUE((air.at(direction, 0).seen({1, 2, 3}) == Eigen::Array3d(1, 2, 3)).all());
  }
}

TEST(ExactAir, OfAllTheAirIsTheSky) {
  const Scattering& scattering = coarselySolved();
  for (const double altitude : {0.0, 4000.0})
    for (const double sun : {35.0, -3.0}) {
      const ViewerInAir viewer{altitude, sun * kDegree};
      const AirColors colors(scattering, clearAir(), viewer.sunElevation);
      const ExactAir air = exactAir(viewer);
      for (const double elevation : {90.0, 20.0, 1.0, -3.0, -60.0}) {
        const Vec3d direction = towards(elevation * kDegree, 0.5);
        const RayInAir ray = rayOf(viewer, direction);
        const Eigen::Array3d sky = colors.radiance(scattering.radiance(ray));
        // Below the horizon the ground is seen through the air before it.
        const Eigen::Array3d ground = colors.radiance(scattering.along(ray).ground);
        const double end =
            scattering.medium().shell.toGround(altitude, direction.y()).value_or(kEndless);
        const Eigen::Array3d in = air.at(direction, end).inScattered();
        EXPECT_LT((in + ground - sky).abs().maxCoeff(), 2e-3 * sky.abs().maxCoeff())
            << altitude << ' ' << sun << ' ' << elevation;
        EXPECT_EQ(elevation<0, ground.maxCoeff()> 0);
      }
    }
}

TEST(ExactAir, GrowsWithDistance) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int trial = 0; trial < 30; ++trial) {
    const ViewerInAir viewer{1e4 * uniform(random), (100 * uniform(random) - 10) * kDegree};
    const ExactAir air = exactAir(viewer);
    const double elevation = 0.3 * (uniform(random) - 0.3);
    const Vec3d direction = towards(elevation, kPi * uniform(random));
    AirBetween before = air.at(direction, 1);
    for (double distance = 2; distance < 2e6; distance *= 2) {
      const AirBetween now = air.at(direction, distance);
      EXPECT_GE(luminanceOf(now.inScattered()), luminanceOf(before.inScattered()) * (1 - 1e-3));
      // Every wavelength loses; a channel of Rec. 709 that has all but gone may gain a little by the
      // wavelengths that count negative in it (1.5e-3 seen, after 500 km of grazing air).
      EXPECT_LE((now.extinction - before.extinction).maxCoeff(),
                before.extinction.minCoeff() > 0.01 ? 1e-6 : 3e-3)
          << trial << ' ' << distance;
      before = now;
    }
  }
}

TEST(ExactAir, GoesOnInValleys) {
  // Someone on the ground looks into a valley: the air is everywhere as at the viewer.
  const ViewerInAir viewer{0, 30 * kDegree};
  const ExactAir exact = exactAir(viewer);
  const AirTable table(coarselySolved(), clearAir(), viewer);
  const ConstantAir constant = constantAir(coarselySolved(), clearAir(), viewer);
  for (const double elevation : {-0.02, -0.3, -1.2})
    for (const double distance : {100.0, 1500.0, 6000.0}) {
      const Vec3d down = towards(elevation, 2);
      const AirBetween a = exact.at(down, distance), b = table.at(down, distance);
      EXPECT_LT((a.extinction - constant.at(down, distance).extinction).abs().maxCoeff(), 0.01);
      EXPECT_LT((a.extinction - b.extinction).abs().maxCoeff(), 0.01);
      EXPECT_LT((b.inScattered() / a.inScattered() - 1).abs().maxCoeff(), 0.015);
    }
}

/// How far a table is from the integral: of in-scattered light relative to its largest channel.
struct TableError {
  double rms = 0, worst = 0, worstExtinction = 0;
};
TableError errorOfTable(const ViewerInAir& viewer) {
  const ExactAir exact = exactAir(viewer);
  const AirTable table(coarselySolved(), clearAir(), viewer);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(0, 1);
  TableError error;
  constexpr int kMany = 600;
  for (int k = 0; k < kMany; ++k) {
    // Half of them near the horizon.
    const double elevation = (k % 2 ? 0.5 : 0.08) * kPi * (2 * uniform(random) - 1);
    const Vec3d direction = towards(elevation, 2 * kPi * uniform(random));
    double distance = 10 * std::pow(1e5, uniform(random));
    if (const auto ground =
            coarselySolved().medium().shell.toGround(viewer.altitude, direction.y()))
      distance = std::min(distance, *ground);
    const AirBetween a = exact.at(direction, distance), b = table.at(direction, distance);
    const double off =
        (b.inScattered() - a.inScattered()).abs().maxCoeff() / a.inScattered().abs().maxCoeff();
    error.rms += off * off / kMany;
    error.worst = std::max(error.worst, off);
    error.worstExtinction =
        std::max(error.worstExtinction, (b.extinction - a.extinction).abs().maxCoeff());
  }
  error.rms = std::sqrt(error.rms);
  if (std::getenv("LAMBENT_TEST_VERBOSE"))
    std::printf("%.0f m, Sun %.0f: rms %.2f%%, worst %.2f%%, extinction %.4f\n", viewer.altitude,
                viewer.sunElevation / kDegree, 100 * error.rms, 100 * error.worst,
                error.worstExtinction);
  return error;
}

TEST(AirTable, IsTheIntegral) {
  for (const double altitude : {2.0, 3000.0})
    for (const double sun : {60.0, 30.0, 10.0, 2.0}) {
      const TableError error = errorOfTable({altitude, sun * kDegree});
      EXPECT_LT(error.rms, 0.01) << altitude << ' ' << sun;
      EXPECT_LT(error.worst, 0.045) << altitude << ' ' << sun;
      EXPECT_LT(error.worstExtinction, 0.01) << altitude << ' ' << sun;
    }
}

TEST(AirTable, InTwilightAndHighUp) {
  EXPECT_LT(errorOfTable({2, -4 * kDegree}).rms, 0.01);
  EXPECT_LT(errorOfTable({2, -12 * kDegree}).rms, 0.02);
  EXPECT_LT(errorOfTable({12e3, 30 * kDegree}).rms, 0.01);
  // The planet's shadow crosses rays that are tabulated as if nothing did.
  EXPECT_LT(errorOfTable({12e3, -4 * kDegree}).rms, 0.03);
}

TEST(AirTable, ConvergesWithItsNodes) {
  const ViewerInAir viewer{800, 4 * kDegree};
  const ExactAir exact = exactAir(viewer);
  double before = 1;
  for (const int times : {1, 2, 4}) {
    const AirTable table(coarselySolved(), clearAir(), viewer,
                         {24 * times, 6 * times + 1, 10 * times, 3});
    double worst = 0;
    for (double elevation = -1; elevation < 1.5; elevation += 0.11)
      for (double azimuth = 0.1; azimuth < 3; azimuth += 0.37) {
        const Vec3d direction = towards(elevation, azimuth);
        const double distance = elevation < 0 ? 800 : 1500;  // not as far as the ground
        const Eigen::Array3d a = exact.at(direction, distance).inScattered();
        worst = std::max(worst, (table.at(direction, distance).inScattered() - a).abs().maxCoeff() /
                                    a.maxCoeff());
      }
    EXPECT_LT(worst, before / 2);
    before = worst;
  }
  EXPECT_LT(before, 4e-3);
}

TEST(ConstantAir, IsTheIntegralAlongTheGround) {
  const ViewerInAir viewer{1, 40 * kDegree};
  const ExactAir exact = exactAir(viewer);
  const ConstantAir constant = constantAir(coarselySolved(), clearAir(), viewer);
  for (const double azimuth : {0.0, 1.0, 3.0}) {
    const Vec3d along = towards(0, azimuth);
    for (const double distance : {1.0, 100.0, 1000.0, 5000.0}) {
      const AirBetween a = exact.at(along, distance), c = constant.at(along, distance);
      const double tolerance = distance < 2000 ? 4e-3 : 0.015;
      EXPECT_LT((c.extinction - a.extinction).abs().maxCoeff(), tolerance) << distance;
      EXPECT_LT((c.fromSun / a.fromSun - 1).abs().maxCoeff(), tolerance) << distance;
      EXPECT_TRUE((c.multiple == 0).all());
      // What the seed leaves out "without loss of quality": the light of the sky and the ground.
      EXPECT_GT(luminanceOf(a.multiple), 0.1 * luminanceOf(a.inScattered()));
    }
    // Far away it keeps what would be there without the planet's curvature.
    const AirBetween c = constant.at(along, 1e9);
    EXPECT_LT(c.extinction.maxCoeff(), 1e-12);
    EXPECT_TRUE((c.fromSun > 0).all());
  }
}

TEST(ConstantAir, HasNoSunAtNight) {
  const ConstantAir night = constantAir(coarselySolved(), clearAir(), {1, -2 * kDegree});
  EXPECT_TRUE((night.at(Vec3d::UnitX(), 5000).fromSun == 0).all());
}

TEST(AerialPerspective, FiniteWhateverIsAsked) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(0, 1);
  const media::Shell& shell = coarselySolved().medium().shell;
  for (int trial = 0; trial < 14; ++trial) {
    ViewerInAir viewer{shell.height * std::pow(uniform(random), 3),
                       (-18 + 108 * uniform(random)) * kDegree};
    if (trial == 0) viewer = {0, kPi / 2};
    if (trial == 1) viewer = {shell.height, 0};
    if (trial == 2) viewer = {0, -18 * kDegree};
    ASSERT_TRUE(checkViewer(viewer, shell));
    const AerialPerspective forms[] = {exactAir(viewer),
                                       AirTable(coarselySolved(), clearAir(), viewer, {12, 4, 6}),
                                       constantAir(coarselySolved(), clearAir(), viewer)};
    for (int k = 0; k < 60; ++k) {
      Vec3d direction = towards(kPi * (uniform(random) - 0.5), 7 * uniform(random));
      if (k == 0) direction = Vec3d::UnitY();
      if (k == 1) direction = -Vec3d::UnitY();
      if (k == 2) direction = Vec3d::UnitX();
      if (k == 3) direction = sunDirection(viewer.sunElevation);
      double distance = std::pow(10, 12 * uniform(random) - 3);
      if (k % 9 == 4) distance = 0;
      if (k % 9 == 5) distance = std::numeric_limits<double>::infinity();
      for (const AerialPerspective& air : forms) {
        const AirBetween between = airBetween(air, direction, distance);
        ASSERT_TRUE((between.extinction >= 0).all() && (between.extinction <= 1).all())
            << air.index() << ' ' << viewer.altitude << ' ' << distance << ' ' << k << ' '
            << direction.transpose() << ' ' << between.extinction.transpose();
        ASSERT_TRUE(between.inScattered().isFinite().all()) << air.index();
        ASSERT_GE(luminanceOf(between.inScattered()), 0) << air.index();
      }
    }
  }
}

TEST(AerialPerspective, ViewersStandInTheAir) {
  const media::Shell shell{6.36e6, 6e4};
  EXPECT_TRUE(checkViewer({0, 0}, shell));
  EXPECT_FALSE(checkViewer({-1, 0}, shell));
  EXPECT_FALSE(checkViewer({6.1e4, 0}, shell));
  EXPECT_FALSE(checkViewer({std::nan(""), 0}, shell));
  EXPECT_FALSE(checkViewer({0, 2}, shell));
  EXPECT_FALSE(checkViewer({0, 0, 0}, shell));
}

}  // namespace
}  // namespace lambent::sky
