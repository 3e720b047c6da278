// Patches that come from files, and whether they tile.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>

#include "lambent/image/io.h"
#include "lambent/meso/check_tiling.h"
#include "lambent/meso/generators.h"
#include "lambent/meso/load_patch.h"
#include "lambent/meso/periodic_scene.h"
#include "lambent/meso/test_patches.h"
#include "lambent/radiometry/srgb.h"

namespace lambent::meso {
namespace {

class PatchFiles : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() /
              ("lambent-patch-" + std::to_string(getpid()) + "-" +
               testing::UnitTest::GetInstance()->current_test_info()->name());
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  /// The patch, and in findings_ what was said of it.
  Result<Patch> load(const std::string& name, const PatchFileOptions& options = {}) {
    auto loaded = loadPatch(folder_ / name, options);
    if (!loaded) return loaded.error();
    findings_ = std::move(loaded->findings);
    return std::move(loaded->value);
  }
  std::filesystem::path folder_;
  Findings findings_;
};

/// A ramp from black at the left to white at the right, which does not tile along x.
image::Image ramp(int width, int height) {
  image::Image picture(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      picture.at(x, y) = Rgb::Constant(radiometry::srgbDecode(float(x) / float(width - 1)));
  return picture;
}

TEST_F(PatchFiles, APngIsHeightsByItsCodeValues) {
  ASSERT_TRUE(image::write(ramp(32, 16), folder_ / "ramp.png"));
  PatchFileOptions options;
  options.size = Vec2(0.4f, 0.2f);
  options.depth = 0.03f;
  auto patch = load("ramp.png", options);
  ASSERT_TRUE(patch) << patch.error().message;
  EXPECT_NEAR(extentOf(*patch).depth(), 0.03f, 1e-6f);
  EXPECT_EQ(patch->triangleCount(), 2u * 32 * 16);
  for (const Vec3& p : patch->scene.meshes[0].positions)
    if (p.x() < 0.4f) {
      EXPECT_NEAR(p.z(), 0.03f * (p.x() / 0.4f * 32 - 0.5f) / 31, 1e-4f);
    }
  // Of both axes, x alone does not tile.
  ASSERT_EQ(findings_.size(), 1u);
  EXPECT_EQ(findings_[0].code, "height-field-seam");
  EXPECT_NE(findings_[0].message.find("along x"), std::string::npos);
  EXPECT_NE(findings_[0].message.find("0.03 m"), std::string::npos);
  EXPECT_NE(findings_[0].message.find("--blend"), std::string::npos);
}

TEST_F(PatchFiles, BlendedBordersTile) {
  ASSERT_TRUE(image::write(ramp(64, 64), folder_ / "ramp.png"));
  PatchFileOptions options;
  options.blend = 0.25f;
  auto patch = load("ramp.png", options);
  ASSERT_TRUE(patch);
  EXPECT_TRUE(findings_.empty()) << findings_[0].message;
}

TEST_F(PatchFiles, TheTopOfAPictureLiesFarAway) {
  image::Image picture(8, 8);
  for (int x = 0; x < 8; ++x) picture.at(x, 0) = Rgb::Ones();
  ASSERT_TRUE(image::write(picture, folder_ / "top.exr"));
  auto patch = load("top.exr");
  ASSERT_TRUE(patch) << patch.error().message;
  float where = -1.0f;
  for (const Vec3& p : patch->scene.meshes[0].positions)
    if (p.z() > 0.5f) where = std::max(where, p.y());
  EXPECT_NEAR(where, 0.1f * 7.5f / 8, 1e-5f);
}

TEST_F(PatchFiles, AColourPictureLiesOverTheHeights) {
  ASSERT_TRUE(image::write(image::Image(8, 8), folder_ / "flat.png"));
  image::Image color(2, 2);
  color.at(0, 0) = Rgb(1, 0, 0), color.at(1, 0) = Rgb(0, 1, 0);  // the far row
  color.at(0, 1) = Rgb(0, 0, 1), color.at(1, 1) = Rgb(1, 1, 1);
  ASSERT_TRUE(image::write(color, folder_ / "color.png"));
  PatchFileOptions options;
  options.color = folder_ / "color.png";
  auto patch = load("flat.png", options);
  ASSERT_TRUE(patch) << patch.error().message;
  auto scene = PeriodicScene::build(*patch);
  ASSERT_TRUE(scene);
  const auto colorAt = [&](float x, float y) {
    PeriodicHit hit;
    EXPECT_EQ(scene->trace(Vec3(x, y, 0.1f), Vec3(0, 0, -1), hit), RayEnd::Lit);
    return scene->surfaceAt(hit).diffuse;
  };
  EXPECT_GT(colorAt(0.025f, 0.075f)[0], 0.99f);  // far left: red
  EXPECT_LT(colorAt(0.025f, 0.075f)[1], 0.01f);
  EXPECT_GT(colorAt(0.075f, 0.075f)[1], 0.99f);  // far right: green
  EXPECT_GT(colorAt(0.025f, 0.025f)[2], 0.99f);  // near left: blue
}

TEST_F(PatchFiles, AWeaveComesBackFromItsMesh) {
  const Patch patch = weave();
  ASSERT_TRUE(savePatch(patch, folder_ / "weave.glb"));
  PatchFileOptions options;
  options.size = patch.size;
  auto back = load("weave.glb", options);
  ASSERT_TRUE(back) << back.error().message;
  EXPECT_EQ(back->triangleCount(), patch.triangleCount() + 2);
  const std::vector<Vec3>&there = patch.scene.meshes[0].positions,
        &here = back->scene.meshes[0].positions;
  ASSERT_EQ(there.size(), here.size());
  for (std::size_t v = 0; v < there.size(); ++v) ASSERT_LT((there[v] - here[v]).norm(), 1e-6f) << v;
  for (const Finding& finding : findings_) EXPECT_NE(finding.code, "mesh-seam") << finding.message;
}

TEST_F(PatchFiles, AMeshThatDoesNotTileIsToldOf) {
  // A strip that rises along x: its ends do not meet.
  std::ofstream(folder_ / "ramp.obj") << "v 0 0 0\nv 1 0.2 0\nv 1 0.2 -1\nv 0 0 -1\nf 1 2 3 4\n";
  auto patch = load("ramp.obj");
  ASSERT_TRUE(patch) << patch.error().message;
  EXPECT_EQ(patch->size, Vec2(1, 1));
  int seams = 0;
  for (const Finding& finding : findings_)
    if (finding.code == "mesh-seam") {
      ++seams;
      EXPECT_NE(finding.message.find("along x"), std::string::npos) << finding.message;
    }
  EXPECT_EQ(seams, 1);
}

TEST_F(PatchFiles, TheUpAxisIsAsked) {
  std::ofstream(folder_ / "z.obj") << "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";
  auto standing = load("z.obj");
  ASSERT_FALSE(standing);
  EXPECT_NE(standing.error().message.find("--up z"), std::string::npos);
  PatchFileOptions options;
  options.up = UpAxis::Z;
  auto lying = load("z.obj", options);
  ASSERT_TRUE(lying) << lying.error().message;
  EXPECT_GT(lying->scene.meshes[0].normals[0].z(), 0.99f);
}

TEST_F(PatchFiles, HostileFilesAreRefusedByName) {
  const auto refusal = [&](const char* name, const PatchFileOptions& options = {}) {
    auto patch = load(name, options);
    EXPECT_FALSE(patch) << name;
    return patch ? std::string() : patch.error().message;
  };
  EXPECT_NE(refusal("missing.png").find("missing.png"), std::string::npos);
  std::ofstream(folder_ / "text.png") << "not a picture";
  EXPECT_NE(refusal("text.png").find("text.png"), std::string::npos);
  ASSERT_TRUE(image::write(image::Image(1, 8), folder_ / "thin.png"));
  EXPECT_NE(refusal("thin.png").find("2×2"), std::string::npos);
  image::Image picture(4, 4);
  picture.at(2, 1) = Rgb::Constant(std::numeric_limits<float>::infinity());
  ASSERT_TRUE(image::write(picture, folder_ / "infinite.exr"));
  EXPECT_NE(refusal("infinite.exr").find("column 2, row 1"), std::string::npos);
  EXPECT_NE(refusal("patch.txt").find(".png"), std::string::npos);
  PatchFileOptions options;
  options.blend = 0.9f;
  EXPECT_FALSE(refusal("thin.png", options).empty());
}

TEST_F(PatchFiles, LargeHeightFieldsAreAveragedDown) {
  image::Image picture(100, 60);
  for (int x = 0; x < 100; ++x)
    for (int y = 0; y < 60; ++y) picture.at(x, y) = Rgb::Constant(float((x + y) % 2));
  ASSERT_TRUE(image::write(picture, folder_ / "checks.exr"));
  PatchFileOptions options;
  options.maximumSamples = 50;
  auto patch = load("checks.exr", options);
  ASSERT_TRUE(patch);
  EXPECT_EQ(patch->triangleCount(), 2u * 50 * 30);
  EXPECT_NEAR(extentOf(*patch).depth(), 0.0f, 1e-6f);
  EXPECT_EQ(findings_.at(0).code, "height-field-reduced");
}

}  // namespace
}  // namespace lambent::meso
