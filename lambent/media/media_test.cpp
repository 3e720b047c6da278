#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "lambent/math/quadrature.h"
#include "lambent/math/types.h"
#include "lambent/media/density_profile.h"
#include "lambent/media/optical_length.h"
#include "lambent/media/phase_function.h"

namespace lambent::media {
namespace {

constexpr double kDegree = kPi / 180;

std::vector<PhaseFunction> everyPhase() {
  return {Isotropic{},
          RayleighPhase{},
          HenyeyGreenstein{0.75},
          HenyeyGreenstein{-0.4},
          CornetteShanks{0.7},
          DoubleHenyeyGreenstein{0.2, 0.8, -0.4},
          Schlick{0.7},
          Schlick{-0.3},
          Schlick{0}};
}

TEST(PhaseFunctions, IntegrateToOneAndHaveTheirMeanCosine) {
  const math::Quadrature rule = math::gaussLegendre(200);
  for (const PhaseFunction& phase : everyPhase()) {
    double sum = 0, cosine = 0;
    for (std::size_t k = 0; k < rule.nodes.size(); ++k) {
      const double value = evaluate(phase, rule.nodes[k]);
      EXPECT_GE(value, 0);
      sum += 2 * kPi * rule.weights[k] * value;
      cosine += 2 * kPi * rule.weights[k] * value * rule.nodes[k];
    }
    EXPECT_NEAR(sum, 1, 1e-12) << phase.index();
    EXPECT_NEAR(cosine, meanCosine(phase), 1e-12) << phase.index();
  }
}

TEST(PhaseFunctions, PositiveParametersScatterForward) {
  EXPECT_GT(evaluate(Schlick{0.5}, 1), evaluate(Schlick{0.5}, -1));
  EXPECT_GT(evaluate(HenyeyGreenstein{0.5}, 1), evaluate(HenyeyGreenstein{0.5}, -1));
  EXPECT_NEAR(meanCosine(Schlick{1.55 * 0.5 - 0.55 * 0.125}), 0.532, 5e-4);
}

TEST(OpticalLength, ChapmanFunctions) {
  // Exact spherical values, without refraction.
  struct Row {
    double x, degrees, value;
  };
  for (const Row& row :
       {Row{795, 0, 1.0}, Row{795, 30, 1.154218806}, Row{795, 60, 1.992564114},
        Row{795, 75, 3.799511553}, Row{795, 80, 5.550195491}, Row{795, 85, 10.13831325},
        Row{795, 88, 18.65839126}, Row{795, 90, 35.3547874}, Row{5300, 0, 1.0},
        Row{5300, 60, 1.998870479}, Row{5300, 80, 5.72445943}, Row{5300, 85, 11.20971932},
        Row{5300, 88, 25.46000475}, Row{5300, 90, 91.24910192}})
    EXPECT_NEAR(chapman(row.x, row.degrees * kDegree) / row.value, 1, 1e-8)
        << row.x << ' ' << row.degrees;
}

TEST(OpticalLength, ToTheTopOfTheAir) {
  struct Row {
    double scale, altitude, degrees, length;  ///< km
  };
  const Shell shell{6.36e6, 6e4};
  for (const Row& row :
       {Row{8, 0, 0, 7.995575325}, Row{8, 0, 60, 15.93193014}, Row{8, 0, 80, 44.38187115},
        Row{8, 0, 85, 81.08022309}, Row{8, 0, 88, 149.2373402}, Row{8, 0, 90, 282.8076635},
        Row{1.2, 0, 0, 1.2}, Row{1.2, 0, 60, 2.398644574}, Row{1.2, 0, 80, 6.869351316},
        Row{1.2, 0, 85, 13.45166318}, Row{1.2, 0, 88, 30.5520057}, Row{1.2, 0, 90, 109.4989223},
        Row{8, 10, 0, 2.2876137}, Row{8, 10, 80, 12.70163355}, Row{8, 10, 90, 81.06494032},
        Row{8, 10, 92, 220.5552551}, Row{1.2, 2, 90, 20.68492608}, Row{1.2, 2, 91, 83.30051323}})
    EXPECT_NEAR(opticalLengthToTop(shell, DensityProfile::exponential(row.scale * 1e3),
                                   row.altitude * 1e3, std::cos(row.degrees * kDegree)) /
                    (row.length * 1e3),
                1, 1e-8)
        << row.scale << ' ' << row.altitude << ' ' << row.degrees;
}

TEST(OpticalLength, OfASegmentThroughFogOverAPlane) {
  const Shell flat{1e10, 1e5};
  const auto thickness = [&](double sigma, double scale, double y0, double dy, double length) {
    return sigma * opticalLength(flat, DensityProfile::exponential(scale), y0, dy / length, length);
  };
  EXPECT_NEAR(thickness(0.02, 50, 0, 100, 200), 1.729329434, 1e-6);
  EXPECT_NEAR(thickness(0.005, 1000, 200, -50, 3000), 12.593167, 1e-5);
}

TEST(DensityProfiles, TheStandardAtmosphereMeetsItselfAtItsLayers) {
  const DensityProfile air = DensityProfile::usStandard1976();
  EXPECT_NEAR(air.at(0), 1, 1e-9);
  // coesa1976us, table 1: kg/m³ at geometric altitudes.
  EXPECT_NEAR(1.225 * air.at(5000), 0.73643, 1e-4);
  EXPECT_NEAR(1.225 * air.at(20000), 0.088910, 2e-5);
  EXPECT_NEAR(1.225 * air.at(50000), 1.0269e-3, 2e-6);
  for (const double altitude : air.breaks())
    EXPECT_NEAR(air.at(altitude - 0.01) / air.at(altitude + 0.01), 1, 2e-4) << altitude;
  // Hydrostatic balance: ∫ ρ g dz is the pressure at the ground, as of 8434.5 m of homogeneous air.
  const math::Quadrature rule = math::gaussLegendre(400, 0, 84000);
  double weight = 0;
  for (std::size_t k = 0; k < rule.nodes.size(); ++k)
    weight +=
        rule.weights[k] * air.at(rule.nodes[k]) * std::pow(6356766 / (6356766 + rule.nodes[k]), 2);
  EXPECT_NEAR(weight, 8434.5, 0.5);
}

TEST(DensityProfiles, TablesAreLinearAndMayStep) {
  const DensityProfile box = DensityProfile::tabulated({{0, 1}, {1000, 1}, {1000, 0.5}, {2000, 0}});
  EXPECT_EQ(box.at(-5), 1);
  EXPECT_EQ(box.at(999), 1);
  EXPECT_NEAR(box.at(1500), 0.25, 1e-12);
  EXPECT_EQ(box.at(9000), 0);
  EXPECT_NEAR(box.column(5000), 1000 + 250, 1e-9);
}

TEST(Shells, RaysAreWhereTheyShouldBe) {
  const Shell shell{6.36e6, 6e4};
  EXPECT_EQ(shell.horizonCosine(0), 0);
  EXPECT_NEAR(*shell.toGround(1000, -1), 1000, 1e-6);
  EXPECT_FALSE(shell.toGround(1000, 0));
  EXPECT_NEAR(*shell.exitAt(6e4, 0, 1), 6e4, 1e-6);
  EXPECT_NEAR(*shell.exitAt(6e4, 6e4, -1), 2 * (6.36e6 + 6e4), 1e-3);
  EXPECT_NEAR(shell.altitudeAlong(0.01, 0, 0), 0.01, 1e-9);
  EXPECT_NEAR(shell.altitudeAlong(0, 0, 1000), 1e6 / (2 * 6.36e6), 1e-5);
  EXPECT_NEAR(shell.lowestAltitude(1e4, -0.02), (6.37e6) * std::sqrt(1 - 0.0004) - 6.36e6, 1e-6);
}

}  // namespace
}  // namespace lambent::media
