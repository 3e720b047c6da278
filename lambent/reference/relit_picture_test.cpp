#include "lambent/reference/relit_picture.h"

#include <gtest/gtest.h>

#include "lambent/sh/basis.h"
#include "lambent/shade/shade.h"
#include "lambent/shade/test_assets.h"
#include "lambent/work/thread_limit.h"

namespace lambent::reference {
namespace {

using shade::exitRadiance;
using shade::PictureOptions;
using shade::test::cameraAt;
namespace test = shade::test;

sh::RgbCoefficients uniformLight(int bands, const Rgb& radiance) {
  sh::RgbCoefficients light(bands);
  for (int c = 0; c < 3; ++c) light.channel(c)[0] = radiance[c] * float(std::sqrt(4 * kPi));
  return light;
}

PictureOptions small(int side, int samples) {
  PictureOptions options;
  options.width = options.height = side;
  options.samples = samples;
  return options;
}

TEST(RelitPicture, OfADiffuseSphereInUniformLightShowsItsAlbedo) {
  asset::Asset asset;
  test::addDiffuse(asset, test::sphere(Vec3::Zero(), 1.0f, 16), {});
  const auto image = relitPicture(asset, uniformLight(5, Rgb(1.0f, 0.5f, 0.25f)), {},
                                  cameraAt(Vec3(0, 0, 6), Vec3::Zero()), small(32, 4));
  ASSERT_TRUE(image) << image.error().message;
  EXPECT_TRUE(image->at(16, 16).isApprox(Rgb(0.8f, 0.4f, 0.2f), 1e-4f));
  EXPECT_EQ(image->alpha[16 * 32 + 16], 1.0f);
  EXPECT_TRUE((image->at(0, 0) == 0.0f).all());
  EXPECT_EQ(image->alpha[0], 0.0f);
}

// Light from above, from +x and from the camera, one each in red, green and blue: which side of the
// sphere is lit says which way up and round the picture is.
TEST(RelitPicture, IsTheRightWayUpAndRound) {
  asset::Asset asset;
  test::addDiffuse(asset, test::sphere(Vec3::Zero(), 1.0f, 32), {});
  sh::RgbCoefficients light = uniformLight(2, Rgb::Ones());
  light.channel(0)[sh::index(1, -1)] = 3.0f;  // +y
  light.channel(1)[sh::index(1, 1)] = 3.0f;   // +x
  light.channel(2)[sh::index(1, 0)] = 3.0f;   // +z
  const auto image =
      relitPicture(asset, light, {}, cameraAt(Vec3(0, 0, 6), Vec3::Zero()), small(64, 4));
  ASSERT_TRUE(image) << image.error().message;
  const Rgb top = image->at(32, 20), bottom = image->at(32, 44), left = image->at(20, 32),
            right = image->at(44, 32), middle = image->at(32, 32);
  EXPECT_GT(top[0], bottom[0] + 0.1f);
  EXPECT_GT(right[1], left[1] + 0.1f);
  EXPECT_GT(middle[2], top[2] + 0.02f);
  EXPECT_NEAR(top[1], bottom[1], 0.02f);
}

TEST(RelitPicture, InterpolatesTexelsTheRightWayRound) {
  asset::Asset asset;
  test::addTexels(asset, test::floor(Vec3::Zero(), 1.0f), Vec3::UnitY(), 16, 16, 0,
                  transfer::Encoding::Float16);
  // From above, with −z (v = 0, the far side) at the top of the picture.
  scene::Camera camera;
  camera.worldFromCamera.block<3, 1>(0, 1) = Vec3(0, 0, -1);
  camera.worldFromCamera.block<3, 1>(0, 2) = Vec3(0, 1, 0);
  camera.worldFromCamera.block<3, 1>(0, 3) = Vec3(0, 3, 0);
  camera.orthographicHalfHeight = 1.0f;
  const auto image = relitPicture(asset, uniformLight(4, Rgb::Ones()), {}, camera, small(16, 1));
  ASSERT_TRUE(image) << image.error().message;
  const std::vector<Rgb> exit = exitRadiance(asset, 0, uniformLight(4, Rgb::Ones()));
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x)
      EXPECT_TRUE(image->at(x, y).isApprox(exit[y * 16 + x], 1e-3f) ||
                  (image->at(x, y) - exit[y * 16 + x]).abs().maxCoeff() < 1e-4f)
          << x << ", " << y;
}

// Texels on a second set of texture coordinates: what the first one does is nothing to them, and
// what the second one does is nothing to the base colour.
TEST(RelitPicture, TexelsMayLieOnCoordinatesOfTheirOwn) {
  asset::Asset first;
  test::addTexels(first, test::floor(Vec3::Zero(), 1.0f), Vec3::UnitY(), 16, 11, 0,
                  transfer::Encoding::Float16);
  asset::Asset second = first;
  scene::Mesh& mesh = second.scene.meshes[0];
  mesh.texelUvs = mesh.uvs;
  for (Vec2& uv : mesh.uvs) uv = 3.0f * uv - Vec2(0.7f, 0.1f);
  const auto picture = [](const asset::Asset& asset) {
    return relitPicture(asset, uniformLight(4, Rgb::Ones()), {},
                        cameraAt(Vec3(0.5f, 3, 2), Vec3::Zero()), small(32, 2));
  };
  const auto one = picture(first), other = picture(second);
  ASSERT_TRUE(one && other);
  EXPECT_EQ(one->alpha, other->alpha);
  for (std::size_t i = 0; i < one->pixels.size(); ++i)
    EXPECT_TRUE((one->pixels[i] == other->pixels[i]).all());
  for (Vec2& uv : mesh.texelUvs) uv.x() = 1.0f - uv.x();
  const auto turned = picture(second);
  ASSERT_TRUE(turned);
  EXPECT_FALSE((one->at(10, 16) == turned->at(10, 16)).all());
}

TEST(RelitPicture, MirrorShowsTheEnvironment) {
  asset::Asset asset;
  test::addMirror(asset, test::sphere(Vec3::Zero(), 1.0f, 64), Rgb(1.0f, 0.5f, 0.25f));
  const light::Environment sky = test::sky();
  const auto image = relitPicture(asset, uniformLight(2, Rgb::Ones()), sky,
                                  cameraAt(Vec3(0, 0, 8), Vec3::Zero()), small(33, 1));
  ASSERT_TRUE(image) << image.error().message;
  const Rgb seen = sky.radiance(Vec3::UnitZ()) * Rgb(1.0f, 0.5f, 0.25f);
  EXPECT_TRUE(image->at(16, 16).isApprox(seen, 0.02f));
}

// Behind a plane mirror stands the same scene turned over: what a camera sees there is what the
// camera turned over sees of the scene itself.
TEST(RelitPicture, PlaneMirrorShowsTheSceneTurnedOver) {
  asset::Asset asset;
  test::addMirror(asset, test::floor(Vec3::Zero(), 20.0f), Rgb::Constant(0.5f));
  test::addDiffuse(asset, test::sphere(Vec3(0, 1.5f, 0), 1.0f, 32), {});
  sh::RgbCoefficients light = uniformLight(2, Rgb::Ones());
  light.channel(0)[sh::index(1, -1)] = 0.5f;
  light.channel(1)[sh::index(1, 1)] = 0.5f;
  const light::Environment sky = test::sky();
  const scene::Camera camera = cameraAt(Vec3(2, 5, 6), Vec3(0, -1, 0));
  PictureOptions options = small(65, 1);
  const auto shown = relitPicture(asset, light, sky, camera, options);
  ASSERT_TRUE(shown) << shown.error().message;

  asset::Asset alone;
  test::addDiffuse(alone, test::sphere(Vec3(0, 1.5f, 0), 1.0f, 32), {});
  scene::Camera turnedOver = camera;
  turnedOver.worldFromCamera = Eigen::Vector4f(1, -1, 1, 1).asDiagonal() * camera.worldFromCamera;
  options.background = true;
  const auto behind = relitPicture(alone, light, sky, turnedOver, options);
  ASSERT_TRUE(behind) << behind.error().message;
  const auto before = relitPicture(alone, light, sky, camera, small(65, 1));
  ASSERT_TRUE(before) << before.error().message;
  int mirrored = 0, far = 0;
  for (std::size_t i = 0; i < shown->pixels.size(); ++i) {
    if (before->alpha[i] > 0 || shown->alpha[i] == 0)
      continue;  // the sphere itself, or past the mirror
    ++mirrored;
    far += (shown->pixels[i] - 0.5f * behind->pixels[i]).abs().maxCoeff() > 2e-3f;
  }
  EXPECT_GT(mirrored, 1000);
  EXPECT_LE(far, 20);  // where a ray just meets or misses the sphere's outline
}

TEST(RelitPicture, MirrorsShowMirrorsAndEndSomewhere) {
  asset::Asset asset;
  const auto wall = [](float z, bool turned) {
    scene::Mesh mesh = test::floor(Vec3::Zero(), 5.0f);
    for (Vec3& p : mesh.positions) p = Vec3(p.x(), turned ? p.z() : -p.z(), z);
    for (Vec3& n : mesh.normals) n = Vec3(0, 0, turned ? -1 : 1);
    return mesh;
  };
  test::addMirror(asset, wall(-1, false), Rgb::Constant(0.5f));
  test::addMirror(asset, wall(1, true), Rgb::Constant(0.5f));
  const light::Environment everywhere = light::Environment::uniform(Rgb::Ones());
  const auto image = relitPicture(asset, uniformLight(2, Rgb::Ones()), everywhere,
                                  cameraAt(Vec3(0, 0, 0), Vec3(0, 0, -1)), small(9, 1));
  ASSERT_TRUE(image) << image.error().message;
  // Straight on, light leaves nowhere: the last mirror shows the environment.
  EXPECT_NEAR(image->at(4, 4)[0], std::pow(0.5f, 9), 1e-5f);
}

TEST(RelitPicture, PutsTheEnvironmentBehind) {
  asset::Asset asset;
  test::addDiffuse(asset, test::sphere(Vec3::Zero(), 0.5f, 8), {});
  const light::Environment sky = test::sky();
  const scene::Camera camera = cameraAt(Vec3(0, 0, 6), Vec3::Zero());
  PictureOptions options = small(16, 1);
  options.background = true;
  const auto image = relitPicture(asset, uniformLight(2, Rgb::Ones()), sky, camera, options);
  ASSERT_TRUE(image) << image.error().message;
  EXPECT_TRUE(image->alpha.empty());
  const Rgb corner = sky.radiance(scene::cameraRay(camera, 16, 16, 0.5f, 0.5f).direction);
  EXPECT_TRUE(image->at(0, 0).isApprox(corner, 1e-5f));
  EXPECT_TRUE(image->at(8, 8).isApprox(Rgb::Constant(0.8f), 1e-3f));
}

TEST(RelitPicture, ShowsBackFacesBlackAndCovered) {
  asset::Asset asset;
  test::addDiffuse(asset, test::floor(Vec3::Zero(), 1.0f), {});
  const auto image = relitPicture(asset, uniformLight(5, Rgb::Ones()), {},
                                  cameraAt(Vec3(0, -3, 1e-3f), Vec3::Zero()), small(8, 1));
  ASSERT_TRUE(image) << image.error().message;
  EXPECT_TRUE((image->at(4, 4) == 0.0f).all());
  EXPECT_EQ(image->alpha[4 * 8 + 4], 1.0f);
}

TEST(RelitPicture, CutsNegativeRadianceOff) {
  asset::Asset asset;
  test::addDiffuse(asset, test::sphere(Vec3::Zero(), 1.0f, 16), {});
  const auto image = relitPicture(asset, uniformLight(5, Rgb::Constant(-1.0f)), {},
                                  cameraAt(Vec3(0, 0, 6), Vec3::Zero()), small(8, 1));
  ASSERT_TRUE(image) << image.error().message;
  for (const Rgb& pixel : image->pixels) EXPECT_TRUE((pixel >= 0.0f).all());
}

TEST(RelitPicture, SaysWhatDoesNotFit) {
  asset::Asset asset;
  const scene::Camera camera = cameraAt(Vec3(0, 0, 6), Vec3::Zero());
  const sh::RgbCoefficients light = uniformLight(3, Rgb::Ones());
  const auto kindOf = [&](const asset::Asset& a, const PictureOptions& options) {
    const auto result = relitPicture(a, light, {}, camera, options);
    return result ? "none" : result.error().kind == ErrorKind::BadUsage ? "usage" : "input";
  };
  EXPECT_STREQ(kindOf(asset, small(8, 1)), "input");  // no triangles
  test::addDiffuse(asset, test::sphere(Vec3::Zero(), 1.0f, 4), {});
  EXPECT_STREQ(kindOf(asset, small(8, 1)), "none");
  EXPECT_STREQ(kindOf(asset, small(0, 1)), "usage");
  EXPECT_STREQ(kindOf(asset, small(8, 0)), "usage");

  asset::Asset fewer = asset;
  auto& onFewer = std::get<transfer::Surface<transfer::Numbers>>(fewer.transfer.meshes[0]);
  transfer::Receivers receivers = *onFewer.receivers;
  receivers.positions.pop_back();
  onFewer.receivers = std::make_shared<const transfer::Receivers>(receivers);
  EXPECT_STREQ(kindOf(fewer, small(8, 1)), "input");
  asset::Asset shorter = asset;
  std::get<transfer::Surface<transfer::Numbers>>(shorter.transfer.meshes[0])
      .responses.find(asset.transfer.kind)
      ->diffuse->vectors.numbers.single.pop_back();
  EXPECT_STREQ(kindOf(shorter, small(8, 1)), "input");
  asset::Asset wild = asset;
  wild.scene.meshes[0].triangles[0][1] = 1u << 30;
  EXPECT_STREQ(kindOf(wild, small(8, 1)), "input");
  asset::Asset without = asset;
  without.transfer.meshes.clear();
  EXPECT_STREQ(kindOf(without, small(8, 1)), "input");
}

TEST(RelitPicture, HasTheSameBytesWhateverTheThreads) {
  asset::Asset asset;
  test::addGlossy(asset, test::sphere(Vec3(0, 1, 0), 1.0f, 12), 5, 4, 1,
                  transfer::Encoding::Float16);
  test::addTexels(asset, test::floor(Vec3::Zero(), 2.0f), Vec3::UnitY(), 16, 16, 0,
                  transfer::Encoding::Float16);
  const light::Environment sky = test::sky();
  const sh::RgbCoefficients light = sky.project(5);
  const scene::Camera camera = cameraAt(Vec3(1.5f, 2, 5), Vec3::Zero());
  PictureOptions options = small(48, 4);
  options.background = true;
  std::vector<image::Image> images;
  for (const std::size_t threads : {1, 2, 8}) {
    const work::ThreadLimit limit(threads);
    auto image = relitPicture(asset, light, sky, camera, options);
    ASSERT_TRUE(image) << image.error().message;
    images.push_back(std::move(*image));
  }
  for (const image::Image& image : images)
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
      ASSERT_TRUE((image.pixels[i] == images[0].pixels[i]).all()) << i;
}

TEST(RelitPicture, StopsWhenAsked) {
  asset::Asset asset;
  test::addDiffuse(asset, test::sphere(Vec3::Zero(), 1.0f, 4), {});
  const auto result =
      relitPicture(asset, uniformLight(3, Rgb::Ones()), {}, cameraAt(Vec3(0, 0, 6), Vec3::Zero()),
                   small(64, 1), [](const ProgressUpdate&) { return false; });
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().kind, ErrorKind::Cancelled);
}

}  // namespace
}  // namespace lambent::reference
