#include "lambent/radiometry/luminance.h"

#include <gtest/gtest.h>

namespace lambent::radiometry {
namespace {

TEST(Luminance, WeightsSumToOne) {
  EXPECT_FLOAT_EQ(luminance(Rgb(1, 1, 1)), 1.0f);
  EXPECT_FLOAT_EQ(luminance(Rgb(0, 1, 0)), 0.7152f);
}

}  // namespace
}  // namespace lambent::radiometry
