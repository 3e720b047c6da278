#include "lambent/image/compare.h"

#include <gtest/gtest.h>

#include <cmath>

#include "lambent/image/code_difference.h"
#include "lambent/image/flip.h"
#include "lambent/image/test_pictures.h"
#include "lambent/radiometry/luminance.h"
#include "lambent/radiometry/srgb.h"

namespace lambent::image {
namespace {

Image constant(int width, int height, const Rgb& colour) {
  Image image(width, height);
  std::fill(image.pixels.begin(), image.pixels.end(), colour);
  return image;
}

double meanFlip(const Image& a, const Image& b, float ppd = 67.0f) {
  return meanOf(flip(a, b, ppd));
}

TEST(Compare, RadiancesBesideEachOther) {
  const std::vector<Rgb> truth = {Rgb(1, 1, 1), Rgb(3, 3, 3)};
  const std::vector<Rgb> judged = {Rgb(1.5f, 1, 1), Rgb(3, 3, 2)};
  const Result<Comparison> c = compare(std::span<const Rgb>(judged), std::span<const Rgb>(truth));
  ASSERT_TRUE(c);
  EXPECT_NEAR(c->bias[0], 0.25, 1e-7);
  EXPECT_NEAR(c->relativeBias, -0.5 / 12, 1e-9);
  EXPECT_NEAR(c->relativeRmse, std::sqrt(1.25 / 30), 1e-9);
  EXPECT_FALSE(compare(std::span<const Rgb>(), std::span<const Rgb>()));
  const std::vector<Rgb> black = {Rgb::Zero(), Rgb::Zero()};
  EXPECT_TRUE(
      std::isinf(compare(std::span<const Rgb>(judged), std::span<const Rgb>(black))->relativeBias));
}

TEST(Compare, DifferenceAndColourMap) {
  const Image d =
      difference(constant(2, 1, Rgb(0.5f, 0.2f, 0)), constant(2, 1, Rgb(0.4f, 0.4f, 0)), 10);
  EXPECT_NEAR(d.at(1, 0)[0], 1.0, 1e-5);
  EXPECT_NEAR(d.at(1, 0)[1], 2.0, 1e-5);
  const Image map = colourMap({0.0f, 0.25f, 0.5f, 0.75f, 1.0f, 7.0f}, 6, 1);
  for (int x = 1; x < 5; ++x) {
    EXPECT_GT(radiometry::luminance(map.at(x, 0)), radiometry::luminance(map.at(x - 1, 0)));
  }
  EXPECT_TRUE((map.at(5, 0) == map.at(4, 0)).all());
}

TEST(Flip, EndsOfTheScale) {
  const Image black = constant(32, 32, Rgb(0, 0, 0)), white = constant(32, 32, Rgb(1, 1, 1));
  EXPECT_EQ(meanFlip(black, black), 0.0);
  // Without features FLIP is ΔE_c. HyAB of black and white is 100. The scale ends at that of green
  // and blue: L*a*b* (87.737, −86.185, 83.181) and (32.302, 79.197, −107.864), a and b times L/100
  // by Hunt: 55.435 + √(101.20² + 107.82²) = 203.31. Both to the power 0.7.
  const double largest = std::pow(203.31, 0.7), knee = 0.4 * largest;
  EXPECT_NEAR(meanFlip(black, white),
              0.95 + 0.05 * (std::pow(100.0, 0.7) - knee) / (largest - knee), 2e-3);
  EXPECT_NEAR(meanFlip(constant(8, 8, Rgb(0, 1, 0)), constant(8, 8, Rgb(0, 0, 1))), 1.0, 1e-3);
}

TEST(Flip, IsSymmetric) {
  const Image a = noise(48, 40), b = gradient(48, 40);
  const std::vector<float> ab = flip(a, b), ba = flip(b, a);
  for (size_t i = 0; i < ab.size(); ++i) ASSERT_NEAR(ab[i], ba[i], 1e-6f);
}

TEST(Flip, GrowsWithTheDifference) {
  const Image reference = gradient(64, 48);
  const Image grain = noise(64, 48, 1.0f, 4);
  double before = 0;
  for (const float amount : {0.01f, 0.02f, 0.05f, 0.1f, 0.2f, 0.4f}) {
    Image test = reference;
    for (size_t i = 0; i < test.pixels.size(); ++i)
      test.pixels[i] += amount * (grain.pixels[i] - 0.5f);
    const double error = meanFlip(test, reference);
    EXPECT_GT(error, 1.05 * before) << amount;
    EXPECT_LT(error, 1.0);
    before = error;
  }
}

TEST(Flip, FineGrainIsLessVisibleFromAfar) {
  const Image reference = constant(64, 64, Rgb(0.4f, 0.4f, 0.4f));
  Image test = reference;
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) test.at(x, y) += (x + y) % 2 ? 0.1f : -0.1f;
  }
  EXPECT_LT(meanFlip(test, reference, 134.0f), meanFlip(test, reference, 30.0f));
}

TEST(Flip, SeesWhereTheDifferenceIs) {
  const Image reference = gradient(80, 60);
  Image test = reference;
  for (int y = 20; y < 26; ++y) {
    for (int x = 30; x < 36; ++x) test.at(x, y) = Rgb(1, 0, 0);
  }
  const std::vector<float> map = flip(test, reference);
  EXPECT_GT(map[23 * 80 + 33], 0.5f);
  EXPECT_LT(map[23 * 80 + 70], 1e-3f);
  EXPECT_LT(map[50 * 80 + 33], 1e-3f);
}

TEST(CodeDifference, CountsStepsOfThePng) {
  Image a(2, 2), b(2, 2);
  const auto code = [](int step) { return radiometry::srgbDecode(float(step) / 255.0f); };
  a.at(0, 0) = Rgb(code(10), code(20), code(255));
  b.at(0, 0) = Rgb(code(13), code(20), 7.0f);  // clamped to 255
  a.at(1, 0) = Rgb(std::nanf(""), -1.0f, 0.0f);
  a.at(0, 1) = Rgb(code(1), 0.0f, 0.0f);
  const CodeDifference apart = codeDifference(a, b);
  EXPECT_EQ(apart.largest, 3);
  EXPECT_EQ(apart.litPixels, 2u);
  EXPECT_DOUBLE_EQ(apart.mean, 4.0 / 12.0);
  EXPECT_DOUBLE_EQ(apart.meanLit, 4.0 / 6.0);
  for (int step = 0; step < 256; ++step) {
    const Image x = Image(1, 1), y = [&] {
      Image one(1, 1);
      one.at(0, 0) = Rgb::Constant(code(step));
      return one;
    }();
    EXPECT_EQ(codeDifference(y, x).largest, step);
    EXPECT_DOUBLE_EQ(codeDifference(x, y).mean, double(step));
  }
  EXPECT_EQ(codeDifference(Image(3, 1), Image(3, 1)).meanLit, 0.0);
}

}  // namespace
}  // namespace lambent::image
