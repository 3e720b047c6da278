#include "lambent/tone/tone_curve.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace lambent::tone {
namespace {

float filmicOf(float x) {
  return filmic(Rgb(x, x, x))[1];
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

TEST(Tone, ToneMapExposesThenCurves) {
  image::Image scene(1, 1);
  scene.at(0, 0) = Rgb(0.25f, 2.0f, -1.0f);
  const image::Image linear = toneMap(scene, 1.0f, Curve::Linear);
  EXPECT_FLOAT_EQ(linear.pixels[0][0], 0.5f);
  EXPECT_FLOAT_EQ(linear.pixels[0][1], 1.0f);
  EXPECT_FLOAT_EQ(linear.pixels[0][2], 0.0f);
  const image::Image curved = toneMap(scene, -1.0f, Curve::Filmic);
  EXPECT_FLOAT_EQ(curved.pixels[0][1], filmicOf(1.0f));
}

}  // namespace
}  // namespace lambent::tone
