// RTTs against closed forms: what a patch must answer where light can be integrated by hand.
#include <gtest/gtest.h>

#include <cmath>

#include "lambent/math/directions.h"
#include "lambent/math/quadrature.h"
#include "lambent/meso/build_rtt.h"
#include "lambent/meso/effective_albedo.h"
#include "lambent/meso/height_field.h"
#include "lambent/meso/light_grid.h"
#include "lambent/meso/test_patches.h"
#include "lambent/scene/shapes.h"
#include "lambent/sh/basis.h"
#include "lambent/sh/zonal.h"

namespace lambent::meso {
namespace {

double underEvenLight(const transfer::SimulatedRtt& rtt, int x, int y, int viewX = 0,
                      int viewY = 0) {
  return rtt.values[rtt.index(0, x, y, viewX, viewY)] * std::sqrt(4.0 * kPi);
}

TEST(RttClosedForm, AFlatPatchIsTheCosineLobeForEveryPositionAndView) {
  // B_i(u, v) = ρ/π Â_l y_i(+z).
  RttOptions options = smallOptions(4, 3);
  options.bands = 6;
  const Patch patch = flatPatch(Rgb(0.2f, 0.5f, 0.8f));
  const transfer::SimulatedRtt rtt = build(patch, options);
  const sh::ZonalMoments cosine = sh::clampedCosine(6);
  std::vector<double> y(36);
  sh::evaluate(6, Vec3d(0, 0, 1), y);
  for (int i = 0; i < 36; ++i)
    for (int p = 0; p < 16; ++p)
      for (int v = 0; v < 9; ++v)
        for (int c = 0; c < 3; ++c)
          EXPECT_NEAR(rtt.values[rtt.index(i, p % 4, p / 4, v % 3, v / 3) + c],
                      patch.scene.materials[0].diffuse[c] / kPi * cosine[sh::bandOf(i)] * y[i],
                      1e-6)
              << i;
  EXPECT_NEAR((effectiveAlbedo(rtt) - patch.scene.materials[0].diffuse).abs().maxCoeff(), 0, 1e-6);
}

TEST(RttClosedForm, ImagesOfAFlatPatchErrByTheQuadratureAlone) {
  // Eq. (5) of I_k = ρ/π cos θ_k. Over azimuth, 16 equal steps integrate every |m| < 16 exactly, so
  // only m = 0 is left. Over the height z the rule is the midpoint rule in z on the rings' bounds:
  // |error| ≤ 2π Σ h³/24 max|(z P_l)''| · √((2l+1)/4π), exact for l = 0, whose integrand is linear.
  RttOptions options = smallOptions(3, 2);
  options.method = RttMethod::Images;
  const transfer::SimulatedRtt rtt = build(flatPatch(Rgb::Constant(0.6f)), options);
  const sh::ZonalMoments cosine = sh::clampedCosine(5);
  // The largest |(z P_l(z))''| on [0, 1], at z = 1: P'' + 2P' there is (l−1)l(l+1)(l+2)/8 + l(l+1).
  for (int i = 0; i < 25; ++i) {
    const int l = sh::bandOf(i);
    std::vector<double> y(25);
    sh::evaluate(5, Vec3d(0, 0, 1), y);
    double bound = 1e-6;
    if (i == sh::index(l, 0) && l > 0) {
      const double curvature = (l - 1.0) * l * (l + 1.0) * (l + 2.0) / 8.0 + l * (l + 1.0);
      double cubes = 0.0;
      for (int k = 0; k < 8; ++k)
        cubes += std::pow(std::cos(kPi * k / 16) - std::cos(kPi * (k + 1) / 16), 3);
      bound +=
          0.6 / kPi * 2.0 * kPi * cubes / 24.0 * curvature * std::sqrt((2 * l + 1) / (4 * kPi));
    }
    for (int p = 0; p < 9; ++p)
      EXPECT_NEAR(rtt.values[rtt.index(i, p % 3, p / 3, 1, 0)], 0.6 / kPi * cosine[l] * y[i], bound)
          << i;
  }
}

TEST(RttClosedForm, AFlatGlossyPatchReflectsTheMirroredLobe) {
  // From straight above, the lobe G about +z lies wholly above the horizon: B_i = k ĝ_l y_i(+z).
  Patch patch = flatPatch(Rgb::Zero());
  patch.scene.materials[0].glossy = Rgb::Constant(0.5f);
  patch.scene.materials[0].lobeExponent = 20.0f;
  RttOptions options = smallOptions(2, 1);
  options.lobeDirections = 256;
  const transfer::SimulatedRtt rtt = build(patch, options);
  const sh::ZonalMoments lobe = sh::phongLobe(5, 20.0);
  std::vector<double> y(25);
  sh::evaluate(5, Vec3d(0, 0, 1), y);
  for (int i = 0; i < 25; ++i)
    EXPECT_NEAR(rtt.values[rtt.index(i, 0, 0, 0, 0)], 0.5 * lobe[sh::bandOf(i)] * y[i], 1e-6) << i;
  // Obliquely, light that comes from R = reflect(v) counts: the moment along x is against the view.
  options.views = 8;
  const transfer::SimulatedRtt oblique = build(patch, options);
  const Vec3 view = viewDirection(8, 6, 3);
  ASSERT_GT(view.x(), 0.4f);
  EXPECT_LT(oblique.values[oblique.index(sh::index(1, 1), 0, 0, 6, 3)], -0.05);
}

TEST(RttClosedForm, TheBottomOfASlotSeesTheSkyBetweenItsWalls) {
  // Endless black walls of height h, w apart, on a floor of albedo ρ: at distance x from one wall
  // the sky's form factor is ½ (sin a + sin b), tan a = x/h, tan b = (w − x)/h. Light of one bounce
  // is none, for the walls are black.
  const float width = 0.06f, height = 0.03f;
  const Patch patch = slotPatch(width, height, 0.0f, 0.7f);
  RttOptions options = smallOptions(16, 1);
  options.height = 2;
  options.directions = 4096;
  const transfer::SimulatedRtt rtt = build(patch, options);
  int seen = 0;
  for (int x = 0; x < 16; ++x) {
    // Means over the position's two sub-samples.
    double expected = 0.0;
    bool whole = true;
    for (const double part : {0.25, 0.75}) {
      const double at = (x + part) / 16 * 0.1 - 0.02;  // the slot lies from 0.02 to 0.08
      whole = whole && at > 0.0 && at < width;
      const auto sine = [&](double d) { return d / std::hypot(d, height); };
      expected += 0.5 * 0.7 * 0.5 * (sine(at) + sine(width - at));
    }
    if (!whole) continue;
    ++seen;
    EXPECT_NEAR(underEvenLight(rtt, x, 0), expected, 0.004) << x;
  }
  EXPECT_GE(seen, 8);
}

TEST(RttClosedForm, AWhiteGrooveApproachesTheFurnaceFromBelow) {
  // A V groove with walls of albedo 1: under even light all that enters leaves, and radiance goes
  // to 1 as bounces are added. Without any, the walls' mean is their share of sky, opening over
  // walls by reciprocity: sin(α/2) for an angle α between them.
  const Patch patch = groovePatch(0.05f, Rgb::Ones());  // half a period deep: α = 90 degrees
  RttOptions options = smallOptions(12, 1);
  options.height = 2;
  options.directions = 1024;
  double before = 0.0;
  for (const int bounces : {0, 1, 2, 4, 12}) {
    options.bounces = bounces;
    const transfer::SimulatedRtt rtt = build(patch, options);
    double mean = 0.0;
    for (int x = 0; x < 12; ++x) {
      EXPECT_LT(underEvenLight(rtt, x, 0), 1.003);
      mean += underEvenLight(rtt, x, 0) / 12;
    }
    EXPECT_GT(mean, before);
    before = mean;
    if (bounces == 0) {
      EXPECT_NEAR(mean, std::sin(kPi / 4), 0.003);
    }
  }
  EXPECT_NEAR(before, 1.0, 0.004);
}

TEST(RttClosedForm, AWhiteHeightFieldReflectsAllOfEvenLight) {
  const Patch patch = bumpyPatch(Rgb::Ones());
  RttOptions options = smallOptions(6, 4);
  options.bounces = 20;
  const transfer::SimulatedRtt rtt = build(patch, options);
  for (int p = 0; p < 36; ++p)
    for (int v = 0; v < 16; ++v) {
      const double radiance = underEvenLight(rtt, p % 6, p / 6, v % 4, v / 4);
      EXPECT_LT(radiance, 1.004);
      EXPECT_GT(radiance, 0.98);
    }
  EXPECT_NEAR(effectiveAlbedo(rtt)[0], 1.0, 0.006);
}

TEST(ViewGrid, EveryCellCoversTheSameSolidAngleAndComesBack) {
  // Area of a cell by summing the map's Jacobian over a fine grid of its square.
  for (int cell = 0; cell < 64; ++cell) {
    const int n = 24;
    double area = 0.0;
    for (int k = 0; k < n * n; ++k) {
      const Vec2 corner((cell % 8 + float(k % n) / n) / 8, (cell / 8 + float(k / n) / n) / 8);
      const float h = 1.0f / (8 * n);
      const Vec3 a = math::hemisphereFromSquare(corner);
      const Vec3 b = math::hemisphereFromSquare(corner + Vec2(h, 0));
      const Vec3 c = math::hemisphereFromSquare(corner + Vec2(0, h));
      const Vec3 d = math::hemisphereFromSquare(corner + Vec2(h, h));
      area += 0.5 * double((d - a).cross(c - b).norm());
    }
    EXPECT_NEAR(area, 2 * kPi / 64, 2 * kPi / 64 * 2e-3) << cell;
    const Vec2 middle((cell % 8 + 0.5f) / 8, (cell / 8 + 0.5f) / 8);
    const Vec2 back = math::squareFromHemisphere(viewDirection(8, cell % 8, cell / 8));
    EXPECT_NEAR((back - middle).norm(), 0.0f, 1e-5f);
  }
}

TEST(LightGrid, SolidAnglesSumToTheHemisphereAndCosinesToPi) {
  for (const auto& [polar, azimuth] : {std::pair{8, 16}, std::pair{1, 1}, std::pair{5, 7}}) {
    const auto lights = lightGrid(polar, azimuth);
    EXPECT_EQ(lights.size(), std::size_t(polar) * azimuth);
    double area = 0.0, cosine = 0.0;
    for (const DirectionalLight& light : lights) {
      EXPECT_GT(light.direction.z(), 0.0f);
      EXPECT_NEAR(light.direction.norm(), 1.0f, 1e-6f);
      area += light.solidAngle;
      cosine += light.solidAngle * light.direction.z();
    }
    EXPECT_NEAR(area, 2 * kPi, 1e-12);
    EXPECT_NEAR(cosine, kPi, 1e-6);
  }
}

}  // namespace
}  // namespace lambent::meso
