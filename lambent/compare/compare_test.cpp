#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "lambent/compare/flip.h"
#include "lambent/compare/metrics.h"
#include "lambent/compare/strip.h"
#include "lambent/radiometry/tone.h"

namespace lambent::compare {
namespace {

image::Image flat(const Rgb& color, int width = 48, int height = 40) {
  image::Image image(width, height);
  for (Rgb& pixel : image.pixels) pixel = color;
  return image;
}

TEST(Metrics, MatchValuesWorkedOutByHand) {
  const std::array<Rgb, 2> truth = {Rgb(1, 1, 1), Rgb(3, 3, 3)};
  const std::array<Rgb, 2> judged = {Rgb(1.5f, 1, 1), Rgb(3, 3, 2)};
  const Metrics m = measure(truth, judged);
  EXPECT_EQ(m.count, 2u);
  EXPECT_FLOAT_EQ(m.bias[0], 0.25f);
  EXPECT_FLOAT_EQ(m.bias[1], 0.0f);
  EXPECT_FLOAT_EQ(m.bias[2], -0.5f);
  EXPECT_NEAR(m.relativeBias, -0.5 / 12.0, 1e-12);
  EXPECT_NEAR(m.rmse, std::sqrt(1.25 / 6.0), 1e-12);
  EXPECT_NEAR(m.relativeRmse, std::sqrt(1.25 / 30.0), 1e-12);
  EXPECT_NEAR(m.relativeMse, (0.25 / 1.04 + 1.0 / 9.04) / 6.0, 1e-12);
  EXPECT_DOUBLE_EQ(m.worst, 1.0);
}

TEST(Metrics, EqualPicturesHaveNoError) {
  const image::Image a = flat(Rgb(0.2f, 0.5f, 0.7f));
  const Metrics m = measure(a, a);
  EXPECT_EQ(m.rmse, 0.0);
  EXPECT_EQ(m.relativeBias, 0.0);
  EXPECT_EQ(m.relativeMse, 0.0);
  EXPECT_EQ(psnr(a, a), std::numeric_limits<double>::infinity());
}

TEST(Metrics, AgainstABlackTruthRelativeErrorsAreInfinite) {
  const Metrics m = measure(flat(Rgb::Zero()), flat(Rgb::Constant(1.0f)));
  EXPECT_DOUBLE_EQ(m.rmse, 1.0);
  EXPECT_TRUE(std::isinf(m.relativeRmse));
  EXPECT_TRUE(std::isinf(m.relativeBias));
}

TEST(Metrics, PixelsThatNeitherPictureCoversDoNotCount) {
  image::Image a = flat(Rgb::Constant(1.0f), 4, 1), b = flat(Rgb::Constant(2.0f), 4, 1);
  a.alpha = {1, 0, 0, 0};
  b.alpha = {1, 0.5f, 0, 0};
  EXPECT_EQ(measure(a, b).count, 2u);
  b.alpha.clear();  // opaque: all of it counts
  EXPECT_EQ(measure(a, b).count, 4u);
}

TEST(Metrics, PsnrIsOfEncodedValues) {
  const float a = 0.5f, b = 0.6f;
  const double d = double(radiometry::srgbEncode(b)) - double(radiometry::srgbEncode(a));
  EXPECT_NEAR(psnr(flat(Rgb::Constant(a)), flat(Rgb::Constant(b))), -20.0 * std::log10(d), 1e-4);
}

TEST(Flip, EqualPicturesHaveNoError) {
  image::Image a = flat(Rgb(0.2f, 0.5f, 0.7f));
  for (int x = 0; x < a.width; ++x) a.at(x, 7) = Rgb(1, 0, 0);
  const FlipMap map = flip(a, a);
  EXPECT_EQ(map.mean, 0.0);
  EXPECT_EQ(map.error.size(), a.pixels.size());
}

TEST(Flip, GreenAgainstBlueIsTheLargestDifference) {
  // The paper's normalisation (§4.1.4): their distance maps to 1.
  const FlipMap map = flip(flat(Rgb(0, 1, 0)), flat(Rgb(0, 0, 1)));
  EXPECT_NEAR(map.mean, 1.0, 1e-4);
}

TEST(Flip, BlackAgainstWhiteFollowsFromTheFormulas) {
  // HyAB is 100 (lightness alone); green to blue is 203.5 (Lab of the primaries, chroma · L/100).
  const double largest = std::pow(203.5, 0.7), knee = 0.4 * largest, power = std::pow(100.0, 0.7);
  const double expected = 0.95 + (power - knee) / (largest - knee) * 0.05;
  EXPECT_NEAR(flip(flat(Rgb::Zero()), flat(Rgb::Constant(1.0f))).mean, expected, 1e-3);
}

TEST(Flip, SmallDifferencesGrowWithTheirSizeAndStayLocal) {
  const image::Image a = flat(Rgb::Constant(0.3f), 96, 64);
  image::Image b = a, c = a;
  b.at(20, 30) = Rgb::Constant(0.4f);
  c.at(20, 30) = Rgb::Constant(0.9f);
  const FlipMap small = flip(a, b), large = flip(a, c);
  EXPECT_GT(small.mean, 0.0);
  EXPECT_GT(large.mean, small.mean);
  EXPECT_LT(large.error[30 * 96 + 80], 1e-3f);
  EXPECT_GT(large.error[30 * 96 + 20], 0.2f);
}

TEST(Flip, IsSymmetric) {
  image::Image a = flat(Rgb(0.1f, 0.4f, 0.6f)), b = flat(Rgb(0.2f, 0.3f, 0.6f));
  a.at(5, 5) = Rgb(1, 1, 0);
  EXPECT_NEAR(flip(a, b).mean, flip(b, a).mean, 1e-7);
}

TEST(Strip, PlacesPanelsAndGaps) {
  const std::array panels = {flat(Rgb(1, 0, 0), 3, 2), flat(Rgb(0, 1, 0), 4, 2)};
  const image::Image s = strip(panels, 2, Rgb(0, 0, 1));
  ASSERT_EQ(s.width, 9);
  ASSERT_EQ(s.height, 2);
  EXPECT_EQ(s.at(2, 1)[0], 1.0f);
  EXPECT_EQ(s.at(3, 1)[2], 1.0f);
  EXPECT_EQ(s.at(5, 0)[1], 1.0f);
  EXPECT_EQ(s.at(8, 1)[1], 1.0f);
}

TEST(Strip, DifferenceIsAbsoluteAndBackdropShowsWhereNothingCovers) {
  image::Image a = flat(Rgb(0.5f, 0.5f, 0.5f), 2, 1), b = flat(Rgb(0.4f, 0.6f, 0.5f), 2, 1);
  const Rgb d = difference(a, b, 10.0f).at(0, 0);
  EXPECT_NEAR(d[0], 1.0f, 1e-5f);
  EXPECT_NEAR(d[1], 1.0f, 1e-5f);
  EXPECT_NEAR(d[2], 0.0f, 1e-5f);
  a.alpha = {1.0f, 0.0f};
  a.pixels[1] = Rgb::Zero();
  const image::Image shown = over(a, Rgb::Constant(0.25f));
  EXPECT_EQ(shown.at(0, 0)[0], 0.5f);
  EXPECT_EQ(shown.at(1, 0)[0], 0.25f);
}

}  // namespace
}  // namespace lambent::compare
