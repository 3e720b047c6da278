#include "lambent/radiometry/srgb.h"

#include <gtest/gtest.h>

namespace lambent::radiometry {
namespace {

TEST(Srgb, KnownValuesAndRoundTrip) {
  EXPECT_NEAR(srgbEncode(0.5f), 0.735357f, 1e-5f);
  EXPECT_NEAR(srgbDecode(0.5f), 0.214041f, 1e-5f);
  EXPECT_FLOAT_EQ(srgbEncode(1.0f), 1.0f);
  EXPECT_NEAR(srgbEncode(0.0031308f), srgbEncode(0.00313081f), 1e-6f);
  for (int i = 0; i <= 255; ++i) {
    const float code = static_cast<float>(i) / 255.0f;
    EXPECT_NEAR(srgbEncode(srgbDecode(code)), code, 1e-6f);
  }
}

}  // namespace
}  // namespace lambent::radiometry
