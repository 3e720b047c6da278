#include "lambent/light/windowing.h"

#include <gtest/gtest.h>

#include "lambent/light/environment.h"
#include "lambent/sh/rotation.h"
#include "lambent/sh/window.h"

#include <Eigen/Geometry>

namespace lambent::light {
namespace {

using Kind = Windowing::Kind;

sh::RgbCoefficients sun() {
  return Environment::disc(Vec3(1, 2, -2) / 3, 0.2, Rgb(3, 2, 1)).project(5);
}

TEST(Windowing, IsRead) {
  EXPECT_EQ(parseWindowing("none")->kind, Kind::None);
  EXPECT_EQ(parseWindowing("minimal")->kind, Kind::Minimal);
  EXPECT_EQ(parseWindowing("hann")->width, 0.0);
  const Windowing lanczos = *parseWindowing("lanczos:6.5");
  EXPECT_EQ(lanczos.kind, Kind::Lanczos);
  EXPECT_EQ(lanczos.width, 6.5);
}

TEST(Windowing, SaysWhatIsWrong) {
  for (const char* text : {"", "gauss", "none:2", "minimal:1", "hann:", "hann:x", "hann:-1",
                           "hann:0", "hann:inf", "lanczos:3 "}) {
    const auto windowing = parseWindowing(text);
    ASSERT_FALSE(windowing) << text;
    EXPECT_EQ(windowing.error().kind, ErrorKind::BadUsage);
    EXPECT_NE(windowing.error().message.find(text), std::string::npos);
  }
}

TEST(Windowing, MultipliesTheBands) {
  const sh::RgbCoefficients hard = sun();
  sh::RgbCoefficients soft = hard;
  soften({Kind::Hann, 4.0}, soft);
  const std::vector<double> window = sh::hann(5, 4.0);
  for (int c = 0; c < 3; ++c)
    for (int i = 0; i < 25; ++i)
      EXPECT_NEAR(soft.channel(c)[i], hard.channel(c)[i] * window[sh::bandOf(i)], 1e-6);
  soft = hard;
  soften({}, soft);
  EXPECT_EQ(soft.values, hard.values);
}

TEST(Windowing, DoesNotMindATurn) {
  const Mat3 turn = Eigen::AngleAxisf(1.2f, Vec3(1, -1, 3).normalized()).toRotationMatrix();
  for (const Windowing& windowing :
       {Windowing{Kind::Lanczos, 0.0}, Windowing{Kind::Minimal, 0.0}}) {
    sh::RgbCoefficients before = sh::rotate(turn, sun()), after = sun();
    soften(windowing, before);
    soften(windowing, after);
    after = sh::rotate(turn, after);
    for (std::size_t i = 0; i < before.values.size(); ++i)
      EXPECT_NEAR(before.values[i], after.values[i], 2e-5);
  }
}

}  // namespace
}  // namespace lambent::light
