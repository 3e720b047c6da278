// The presets: what their numbers come to.
#include "lambent/sky/atmosphere.h"

#include <cmath>

#include <gtest/gtest.h>

#include "lambent/media/phase_function.h"
#include "lambent/sky/medium.h"

namespace lambent::sky {
namespace {

/// Vertical optical thickness of the aerosols.
double aerosolThickness(const Atmosphere& a, double nm) {
  const double wavelengths[] = {nm};
  return mediumOf(a, wavelengths).extinction[kAerosol][0] * a.aerosolProfile.column(a.height);
}

TEST(Presets, AreThoseThatAreNamed) {
  for (const std::string_view name : presets()) {
    ASSERT_TRUE(preset(name)) << name;
    EXPECT_EQ(preset(name)->name, name);
    EXPECT_EQ(preset(name), preset(name));
    for (const std::string_view other : presets())
      EXPECT_EQ(preset(name) == preset(other), name == other) << name << ' ' << other;
  }
  EXPECT_FALSE(preset(""));
  EXPECT_FALSE(preset("Clear"));
}

// The atmosphere of published tables of sky radiance, number by number.
TEST(Presets, TheReferenceIsThatOfThePublishedRadiances) {
  const Atmosphere a = *preset("reference");
  const double nm[] = {450, 550, 650, 720};
  const double rayleigh[] = {0.0264382, 0.0116218, 0.00589338, 0.00389511};  // 1/km
  const double ground[] = {0.031, 0.089, 0.042, 0.234};
  const double sun[] = {2.01449, 1.84687, 1.54572, 1.33778};
  const Medium medium = mediumOf(a, nm);
  EXPECT_EQ(medium.shell.radius, 6360e3);
  EXPECT_EQ(medium.shell.radius + medium.shell.height, 6420e3);
  EXPECT_EQ(a.air, media::DensityProfile::exponential(8000));
  EXPECT_EQ(a.aerosolProfile, media::DensityProfile::exponential(1200));
  EXPECT_EQ(a.aerosolPhase, media::PhaseFunction(media::CornetteShanks{0.7}));
  for (int i = 0; i < 4; ++i) {
    EXPECT_NEAR(1000 * medium.scattering[kAir][i] / rayleigh[i], 1, 2e-6) << nm[i];
    EXPECT_EQ(medium.extinction[kAir][i], medium.scattering[kAir][i]);
    EXPECT_NEAR(aerosolThickness(a, nm[i]), 0.04 * std::pow(nm[i] / 1000, -0.8), 1e-12);
    EXPECT_NEAR(medium.scattering[kAerosol][i] / medium.extinction[kAerosol][i], 0.8, 1e-12);
    EXPECT_EQ(medium.extinction[kOzone][i], 0);
    EXPECT_EQ(medium.albedo[i], ground[i]);
    EXPECT_NEAR(medium.solarIrradiance[i], sun[i], 1e-5) << nm[i];
  }
}

TEST(Presets, TurbidityGivesTheThicknessOfItsPaper) {
  // preetham1999practical, appendix 1: β = .04608 T − .04586, α = 1.3.
  EXPECT_NEAR(aerosolThickness(*preset("clear"), 1000), 0.06934, 1e-9);
  EXPECT_NEAR(aerosolThickness(*preset("hazy"), 1000), 0.23062, 1e-9);
  EXPECT_NEAR(aerosolThickness(*preset("clear"), 550), 0.06934 * std::pow(0.55, -1.3), 1e-9);
  EXPECT_EQ(aerosolThickness(*preset("pure"), 550), 0);
  EXPECT_EQ(preset("clear")->turbidity, 2.5);
}

TEST(Aerosols, JungesLawAgreesWithAngstroms) {
  // preetham1999practical gives both for turbidity: c = (.6544 T − .6510)·10⁻¹⁶ with v = 4, spread
  // over the 1.25 km of its aerosols.
  for (const double turbidity : {2.0, 3.0, 6.0}) {
    Atmosphere a = withTurbidity(Atmosphere{}, turbidity);
    a.aerosolProfile = media::DensityProfile::exponential(1250);
    const double angstrom = aerosolThickness(a, 550);
    a.aerosols = Atmosphere::Junge{(0.6544 * turbidity - 0.6510) * 1e-16, 4};
    EXPECT_NEAR(aerosolThickness(a, 550) / angstrom, 1, 0.06) << turbidity;
    EXPECT_NEAR(aerosolThickness(a, 400) / aerosolThickness(a, 770),
                std::pow(770.0 / 400, 2) * 0.656 / 0.69, 1e-9);
  }
}

TEST(Presets, OzoneHasTheColumnThatIsSaid) {
  const Atmosphere a = *preset("clear");
  const double nm[] = {600};
  // 300 DU at 600 nm: about .038 (the Chappuis band's peak, 5·10⁻²⁵ m² a molecule).
  const double thickness = mediumOf(a, nm).extinction[kOzone][0] * a.ozoneProfile.column(a.height);
  EXPECT_NEAR(thickness, 300 * 2.6867e20 * 5e-25, 0.003);
}

}  // namespace
}  // namespace lambent::sky
