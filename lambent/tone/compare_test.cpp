#include "lambent/tone/compare.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "lambent/image/test_pictures.h"

namespace lambent::tone {
namespace {

using image::Comparison;
using image::Image;
using image::noise;

Image constant(int width, int height, const Rgb& colour) {
  Image image(width, height);
  std::fill(image.pixels.begin(), image.pixels.end(), colour);
  return image;
}

TEST(Compare, IdenticalPicturesDoNotDiffer) {
  const Image image = noise(40, 30, 5.0f);
  const Result<Comparison> c = compare(image, image);
  ASSERT_TRUE(c);
  EXPECT_EQ(c->meanBias, 0.0);
  EXPECT_EQ(c->rmse, 0.0);
  EXPECT_EQ(c->relativeRmse, 0.0);
  EXPECT_EQ(c->relativeMse, 0.0);
  EXPECT_EQ(c->flip, 0.0);
  EXPECT_TRUE(std::isinf(c->psnr));
}

TEST(Compare, KnownNumbers) {
  const Image reference = constant(8, 8, Rgb(0.5f, 1.0f, 2.0f));
  const Image test = constant(8, 8, Rgb(0.6f, 1.0f, 1.8f));
  const Result<Comparison> c = compare(test, reference);
  ASSERT_TRUE(c);
  EXPECT_NEAR(c->bias[0], 0.1, 1e-6);
  EXPECT_NEAR(c->bias[2], -0.2, 1e-6);
  EXPECT_NEAR(c->meanBias, -0.1 / 3, 1e-6);
  EXPECT_NEAR(c->relativeBias, -0.1 / 3.5, 1e-6);
  EXPECT_NEAR(c->rmse, std::sqrt(0.05 / 3), 1e-6);
  EXPECT_NEAR(c->relativeRmse, std::sqrt(0.05 / 5.25), 1e-6);
  EXPECT_NEAR(c->relativeMse, (0.01 / 0.26 + 0.04 / 4.01) / 3, 1e-6);
  EXPECT_EQ(c->psnrPeak, 2.0);
  EXPECT_NEAR(c->psnr, 10 * std::log10(4 / (0.05 / 3)), 1e-4);
  EXPECT_NEAR(c->largest, 0.2, 1e-6);
  CompareOptions display;
  display.displayReferred = true;
  EXPECT_EQ(compare(test, reference, display)->psnrPeak, 255.0);
  // Codes 0.5 → 188, 0.6 → 203, 1 → 255, and what is beyond 1 is 255 too: one step of 15 in three.
  EXPECT_NEAR(compare(test, reference, display)->psnr,
              20 * std::log10(255 / std::sqrt(15.0 * 15.0 / 3)), 1e-9);
}

TEST(Compare, SizesMustAgreeAndWhatIsNotFiniteIsCounted) {
  const Result<Comparison> sizes = compare(Image(2, 3), Image(3, 2));
  ASSERT_FALSE(sizes);
  EXPECT_EQ(sizes.error().kind, ErrorKind::BadInput);
  EXPECT_NE(sizes.error().message.find("2×3 and 3×2"), std::string::npos);
  EXPECT_FALSE(compare(Image(), Image()));
  Image a = noise(8, 8);
  const Image b = a;
  a.at(1, 1)[2] = std::numeric_limits<float>::quiet_NaN();
  a.at(2, 1)[0] = std::numeric_limits<float>::infinity();
  const Result<Comparison> c = compare(a, b);
  ASSERT_TRUE(c);
  EXPECT_EQ(c->nonFinitePixels, 2u);
  EXPECT_EQ(c->rmse, 0.0);
  EXPECT_TRUE(std::isfinite(c->flip));
  EXPECT_FALSE(compare(constant(1, 1, Rgb(NAN, 0, 0)), Image(1, 1)));
}

TEST(Compare, SceneReferredPicturesAreToneMapped) {
  const Image dim = constant(16, 16, Rgb(20, 20, 20)), bright = constant(16, 16, Rgb(40, 40, 40));
  CompareOptions options;
  const double shown = compare(dim, bright, options)->flip;
  options.exposureEv = -6;
  EXPECT_GT(compare(dim, bright, options)->flip, shown);
}

}  // namespace
}  // namespace lambent::tone
