#include "lambent/render/test_agreement.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <gtest/gtest.h>

#include "lambent/image/io.h"
#include "lambent/radiometry/srgb.h"
#include "lambent/reference/relit_picture.h"
#include "lambent/render/gl_picture_in_blocks.h"
#include "lambent/shade/test_assets.h"
#include "lambent/tone/tone_curve.h"

namespace lambent::render::test {

using image::Image;
using shade::PictureOptions;

namespace {

/// As a PNG would hold it, in units of 1/255.
Rgb codeValues(const Rgb& toneMapped) {
  return 255.0f * toneMapped.unaryExpr([](float x) { return radiometry::srgbEncode(x); });
}

struct Difference {
  double mean = 0;      ///< of all pixels and channels, in 1/255 after the tone curve
  double interior = 0;  ///< the 99th percentile of what lies wholly on surfaces
  double alpha = 0;     ///< mean
  double mirrors = 0;   ///< the mean of these, which are not part of the first two
};

Difference difference(const Image& a, const Image& b, const std::vector<bool>& mirrors) {
  EXPECT_EQ(a.width, b.width);
  EXPECT_EQ(a.height, b.height);
  const Image ta = tone::toneMap(a, 0.0f, tone::Curve::Filmic);
  const Image tb = tone::toneMap(b, 0.0f, tone::Curve::Filmic);
  Difference result;
  std::vector<double> interior;
  std::size_t inMirrors = 0, others = 0;
  for (int y = 0; y < a.height; ++y)
    for (int x = 0; x < a.width; ++x) {
      const Rgb d = (codeValues(ta.at(x, y)) - codeValues(tb.at(x, y))).abs();
      const std::size_t i = std::size_t(y) * a.width + x;
      const bool mirror = !mirrors.empty() && mirrors[i];
      (mirror ? result.mirrors : result.mean) += double(d.mean());
      ++(mirror ? inMirrors : others);
      if (!a.alpha.empty()) {
        result.alpha += std::abs(a.alpha[i] - b.alpha[i]);
        if (!mirror && a.alpha[i] == 1.0f && b.alpha[i] == 1.0f) interior.push_back(d.maxCoeff());
      }
    }
  result.mean /= double(std::max<std::size_t>(others, 1));
  result.mirrors /= double(std::max<std::size_t>(inMirrors, 1));
  result.alpha /= double(a.pixels.size());
  if (!interior.empty()) {
    std::sort(interior.begin(), interior.end());
    result.interior = interior[interior.size() * 99 / 100];
  }
  return result;
}

/// LAMBENT_TEST_PICTURES=DIR in the environment: where to leave the pictures to look at.
void keep(const Image& image, const std::string& name) {
  const char* directory = std::getenv("LAMBENT_TEST_PICTURES");
  if (!directory) return;
  const auto path = std::filesystem::path(directory) / (name + ".png");
  EXPECT_TRUE(image::write(tone::toneMap(image, 0.0f, tone::Curve::Filmic), path));
}

}  // namespace

void expectAgreement(const std::string& name, const asset::Asset& asset,
                     const scene::Camera& camera, const PictureOptions& options,
                     const Agreement& agreement) {
  const light::Environment sky = shade::test::sky();
  const sh::RgbCoefficients light = sky.project(5);
  const Result<Image> cpu = reference::relitPicture(asset, light, sky, camera, options);
  ASSERT_TRUE(cpu) << cpu.error().message;
  const Result<Image> gl =
      pictureInBlocks(asset, light, sky, camera, options, agreement.largestBlock);
  ASSERT_TRUE(gl) << gl.error().message;
  Agreement within = agreement;
  within.mirrors = mirrorsIn(asset, camera, options);
  expectSame(name, *cpu, *gl, within);
}

std::vector<bool> mirrorsIn(const asset::Asset& asset, const scene::Camera& camera,
                            const PictureOptions& options) {
  const light::Environment sky = shade::test::sky();
  return mirrorsIn(asset, [&](const asset::Asset& changed) {
    return reference::relitPicture(changed, sky.project(5), sky, camera, options);
  });
}

void expectSame(const std::string& name, const Image& cpu, const Image& gl,
                const Agreement& agreement) {
  keep(cpu, name + "-cpu");
  keep(gl, name + "-gl");
  ASSERT_EQ(cpu.alpha.size(), gl.alpha.size());
  const Difference d = difference(cpu, gl, agreement.mirrors);
  testing::Test::RecordProperty("mean", std::to_string(d.mean));
  testing::Test::RecordProperty("mirrors", std::to_string(d.mirrors));
  testing::Test::RecordProperty("interior", std::to_string(d.interior));
  EXPECT_LT(d.mean, agreement.mean) << name;
  EXPECT_LT(d.interior, agreement.interior) << name;
  EXPECT_LT(d.mirrors, agreement.inMirrors) << name;
  EXPECT_LT(d.alpha, 5e-4) << name;
  Rgb brightest = Rgb::Zero();
  for (const Rgb& pixel : gl.pixels) brightest = brightest.max(pixel);
  EXPECT_GT(brightest.minCoeff(), 0.05f) << name << " is black";
}

}  // namespace lambent::render::test
