#include "lambent/image/strip.h"

#include <gtest/gtest.h>

#include <array>

namespace lambent::image {
namespace {

Image flat(const Rgb& color, int width, int height) {
  Image image(width, height);
  for (Rgb& pixel : image.pixels) pixel = color;
  return image;
}

TEST(Strip, PlacesPanelsAndGaps) {
  const std::array panels = {flat(Rgb(1, 0, 0), 3, 2), flat(Rgb(0, 1, 0), 4, 2)};
  const Image s = strip(panels, 2, Rgb(0, 0, 1));
  ASSERT_EQ(s.width, 9);
  ASSERT_EQ(s.height, 2);
  EXPECT_EQ(s.at(2, 1)[0], 1.0f);
  EXPECT_EQ(s.at(3, 1)[2], 1.0f);
  EXPECT_EQ(s.at(5, 0)[1], 1.0f);
  EXPECT_EQ(s.at(8, 1)[1], 1.0f);
  EXPECT_EQ(strip({}, 2, Rgb::Zero()).width, 0);
}

TEST(Strip, BackdropShowsWhereNothingCovers) {
  Image a = flat(Rgb(0.5f, 0.5f, 0.5f), 3, 1);
  a.alpha = {1.0f, 0.0f, 0.5f};
  a.pixels[1] = Rgb::Zero();
  const Image shown = over(a, Rgb::Constant(0.25f));
  EXPECT_EQ(shown.at(0, 0)[0], 0.5f);
  EXPECT_EQ(shown.at(1, 0)[0], 0.25f);
  EXPECT_EQ(shown.at(2, 0)[0], 0.625f);
  EXPECT_TRUE(shown.alpha.empty());
}

}  // namespace
}  // namespace lambent::image
