// What lies over a picture: marks, and the seams of a patch; on a floor seen from straight above.
#include "lambent/render/gl_marks.h"

#include <cmath>

#include <gtest/gtest.h>

#include "lambent/render/gl_context.h"
#include "lambent/render/live_renderer.h"
#include "lambent/shade/test_assets.h"
#include "lambent/shade/test_patches.h"

namespace lambent::render {
namespace {

constexpr int kSide = 128;                // pixels, of a floor of 2 m
const Rgb kOverlay(1000.0f, 0.0f, 0.0f);  // far from all that the floor shows

/// Pieces of 8×8 texels, each of 4×4 pixels.
asset::Asset patchwork() {
  shade::test::SpreadOptions options;
  options.tangent = Vec3::UnitX();
  // So large that no two pieces happen to go on from each other, to within a texel.
  options.scale = 8.0f;
  options.idMap = shade::test::patchworkMap(32, 32, Vec2(0.25f, 0.25f));
  asset::Asset asset;
  shade::test::addPatched(asset, shade::test::floor(Vec3::Zero(), 1.0f),
                          shade::test::bumpyRtt(16, 16, 4, 3), options);
  return asset;
}

LiveView fromAbove() {
  LiveView view;
  view.camera.orthographicHalfHeight = 1.0f;
  view.camera.worldFromCamera << 1, 0, 0, 0, /**/ 0, 0, 1, 3, /**/ 0, -1, 0, 0, /**/ 0, 0, 0, 1;
  view.others.extend(Vec3(-1, -1, -1));  // a floor alone is between no two planes
  view.others.extend(Vec3(1, 1, 1));
  return view;
}

bool isOverlay(const image::Image& picture, int x, int y) {
  return picture.pixels[std::size_t(y * kSide + x)][0] > 500.0f;
}

class Marks : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(context_) << context_.error().message;
    auto made = LiveRenderer::make(asset_, {});
    ASSERT_TRUE(made) << made.error().message;
    renderer_.emplace(std::move(*made));
    renderer_->setLight(light::Environment::uniform(Rgb::Ones()).project(3));
    ASSERT_TRUE(renderer_->setEnvironment(light::Environment::uniform(Rgb::Ones())));
    ASSERT_TRUE(renderer_->resize(kSide, kSide));
  }
  void TearDown() override { EXPECT_TRUE(checkGl("a test")); }

  Result<GlContext> context_ = GlContext::create();
  asset::Asset asset_ = patchwork();
  std::optional<LiveRenderer> renderer_;
};

TEST_F(Marks, SeamsAreLinesWherePiecesMeet) {
  LiveView view = fromAbove();
  for (const bool shown : {false, true}) {
    if (shown) view.seams = kOverlay;
    renderer_->begin();
    ASSERT_TRUE(renderer_->add(view));
    const auto picture = renderer_->picture();
    ASSERT_TRUE(picture) << picture.error().message;
    const auto off = [](int pixel) {  // from the nearest line between squares, pixels
      const float at = (float(pixel) + 0.5f) / 32.0f, line = std::round(at);
      return line < 1.0f || line > 3.0f ? 32.0f : 32.0f * std::abs(at - line);
    };
    for (int y = 0; y < kSide; ++y)
      for (int x = 0; x < kSide; ++x) {
        if (off(x) < 5.0f && off(y) < 5.0f) continue;  // four pieces meet
        const bool near = shown && std::min(off(x), off(y)) < 0.75f;
        ASSERT_EQ(isOverlay(*picture, x, y), near) << x << ", " << y;
      }
  }
}

TEST_F(Marks, AreHiddenByWhatLiesBeforeThem) {
  const Vec3 up = Vec3::UnitY();
  const Vec3 seen(0.5f, 0.0f, 0.25f), below(-0.5f, -0.1f, 0.25f);
  const Mark marks[] = {{seen, seen, up, kOverlay, Vec2(4, 4)},
                        {below, below, up, kOverlay, Vec2(4, 4)},
                        {Vec3(-0.5f, 0, -0.5f), Vec3(0.5f, 0, -0.5f), up, kOverlay, Vec2(1, 1)}};
  const auto made = GlMarks::make(marks);
  ASSERT_TRUE(made) << made.error().message;
  renderer_->begin();
  ASSERT_TRUE(renderer_->add(fromAbove()));
  made->draw(renderer_->framebuffer(), kSide, kSide,
             {fromAbove().camera, renderer_->clipFromWorld()});
  const auto picture = renderer_->picture();
  ASSERT_TRUE(picture) << picture.error().message;
  int dot = 0, line = 0, others = 0;
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) {
      if (!isOverlay(*picture, x, y)) continue;
      const float px = float(x) + 0.5f, py = float(y) + 0.5f;
      if (std::hypot(px - 96.0f, py - 80.0f) < 5.0f)
        ++dot;
      else if (std::abs(py - 32.0f) < 1.5f && px > 30.0f && px < 98.0f)
        ++line;
      else
        ++others;
    }
  EXPECT_NEAR(dot, 16 * kPi, 4) << "a disc of a radius of four pixels";
  EXPECT_NEAR(line, 2 * 64, 8) << "64 pixels long and 2 wide";
  EXPECT_EQ(others, 0);
}

}  // namespace
}  // namespace lambent::render
