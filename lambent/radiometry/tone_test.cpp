#include "lambent/radiometry/tone.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace lambent::radiometry {
namespace {

float filmicOf(float x) {
  return filmic(Rgb(x, x, x))[1];
}

TEST(Tone, LuminanceWeightsSumToOne) {
  EXPECT_FLOAT_EQ(luminance(Rgb(1, 1, 1)), 1.0f);
  EXPECT_FLOAT_EQ(luminance(Rgb(0, 1, 0)), 0.7152f);
}

TEST(Tone, FilmicRisesFromBlackWithSlopeOneAndStaysBelowOne) {
  EXPECT_EQ(filmicOf(0.0f), 0.0f);
  EXPECT_NEAR(filmicOf(1e-3f) / 1e-3f, 1.0f, 1e-5f);
  EXPECT_NEAR(filmicOf(0.18f), 0.18f, 0.01f);
  EXPECT_NEAR(filmicOf(1.0f), 0.6f, 1e-6f);
  EXPECT_LT(filmicOf(16.0f), 0.98f);
  EXPECT_GT(filmicOf(16.0f), 0.95f);
  float before = 0.0f;
  for (float x = 1e-4f; x < 100.0f; x *= 1.01f) {
    const float y = filmicOf(x);
    EXPECT_GT(y, before) << x;
    EXPECT_LE(y, x);
    EXPECT_LT(y, 1.0f);
    before = y;
  }
}

TEST(Tone, FilmicTakesAnyFloat) {
  const float infinity = std::numeric_limits<float>::infinity();
  EXPECT_EQ(filmicOf(-1.0f), 0.0f);
  EXPECT_EQ(filmicOf(std::nanf("")), 0.0f);
  EXPECT_NEAR(filmicOf(infinity), 1.0f, 1e-4f);
  EXPECT_NEAR(filmicOf(std::numeric_limits<float>::max()), 1.0f, 1e-4f);
}

TEST(Tone, SrgbKnownValuesAndRoundTrip) {
  EXPECT_NEAR(srgbEncode(0.5f), 0.735357f, 1e-5f);
  EXPECT_NEAR(srgbDecode(0.5f), 0.214041f, 1e-5f);
  EXPECT_FLOAT_EQ(srgbEncode(1.0f), 1.0f);
  EXPECT_NEAR(srgbEncode(0.0031308f), srgbEncode(0.00313081f), 1e-6f);
  for (int i = 0; i <= 255; ++i) {
    const float code = static_cast<float>(i) / 255.0f;
    EXPECT_NEAR(srgbEncode(srgbDecode(code)), code, 1e-6f);
  }
}

struct Picture {
  std::vector<Rgb> pixels;
};

TEST(Tone, ToneMapExposesThenCurves) {
  const Picture scene{{Rgb(0.25f, 2.0f, -1.0f)}};
  const Picture linear = toneMap(scene, 1.0f, ToneCurve::Linear);
  EXPECT_FLOAT_EQ(linear.pixels[0][0], 0.5f);
  EXPECT_FLOAT_EQ(linear.pixels[0][1], 1.0f);
  EXPECT_FLOAT_EQ(linear.pixels[0][2], 0.0f);
  const Picture curved = toneMap(scene, -1.0f, ToneCurve::Filmic);
  EXPECT_FLOAT_EQ(curved.pixels[0][1], filmicOf(1.0f));
}

}  // namespace
}  // namespace lambent::radiometry
