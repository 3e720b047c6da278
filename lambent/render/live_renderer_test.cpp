// The live renderer against pictures of the CPU: whatever moves or is switched, the CPU makes the
// same picture in the asset's own frame.

#include "lambent/render/live_renderer.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <Eigen/LU>

#include "lambent/render/gl_context.h"
#include "lambent/render/gl_objects.h"
#include "lambent/render/test_agreement.h"
#include "lambent/scene/shapes.h"
#include "lambent/sh/rotation.h"
#include "lambent/shade/picture.h"
#include "lambent/shade/test_assets.h"
#include "lambent/shade/test_patches.h"

namespace lambent::render {
namespace {

using encode::Encoding;
using image::Image;
using shade::MacroTransport;
using shade::TransferChoice;
using shade::test::cameraAt;

constexpr int kWidth = 128, kHeight = 96;
const scene::Camera kCamera = cameraAt(Vec3(1.5f, 1.8f, 5.0f), Vec3::Zero());

Mat3 turn(float degrees, const Vec3& axis) {
  return Eigen::AngleAxisf(degrees * float(kPi) / 180.0f, axis.normalized()).toRotationMatrix();
}

Mat4 placed(const Mat3& rotation, const Vec3& translation) {
  Mat4 result = Mat4::Identity();
  result.topLeftCorner<3, 3>() = rotation;
  result.topRightCorner<3, 1>() = translation;
  return result;
}

/// Every kind of surface at once, diffuse ones and glossy ones with shadowed transfer beside.
asset::Asset everything() {
  asset::Asset asset;
  shade::test::addDiffuse(asset, shade::test::sphere(Vec3(-1.3f, 0.7f, 0.8f), 0.5f, 10),
                          {5, 3, Encoding::Float16, true});
  shade::test::addGlossy(asset, shade::test::sphere(Vec3(0, 0.7f, 0.5f), 0.6f, 10), 5, 4, 1,
                         Encoding::Float16);
  shade::test::addTexels(asset, shade::test::floor(Vec3::Zero(), 2.2f), Vec3::UnitY(), 16, 11, 4,
                         Encoding::Float32);
  shade::test::addMirror(asset, shade::test::sphere(Vec3(1.3f, 0.7f, 0.6f), 0.5f, 20),
                         Rgb(0.9f, 0.8f, 0.7f));
  shade::test::SpreadOptions patch;
  patch.shadowedBands = 5;
  patch.channels = 3;
  patch.encoding = Encoding::Float16;
  shade::test::addPatched(asset,
                          scene::translated(scene::uvSphere(0.6f, 24, 12), Vec3(0.1f, 0.7f, -1)),
                          shade::test::bumpyRtt(16, 12, 4, 5), patch);
  // Interreflected transfer, here: of everything shadowed the double.
  asset.transfer.kind = transport::TransferKind::Interreflected;
  for (encode::EncodedMesh& mesh : asset.transfer.meshes) {
    mesh.shadowed.channels = mesh.channels;
    mesh.shadowed.matrixChannels = mesh.matrixChannels;
    const auto half = [](const encode::Numbers& numbers) {
      if (numbers.empty()) return numbers;
      std::vector<float> values = encode::decode(numbers);
      for (float& value : values) value *= 0.5f;
      return encode::encode(values, numbers.encoding, numbers.block);
    };
    mesh.shadowed.vectors = half(mesh.vectors);
    mesh.shadowed.matrices = half(mesh.matrices);
  }
  return asset;
}

struct Scenery {
  light::Environment environment = shade::test::sky();
  sh::RgbCoefficients worldLight = environment.project(5);
};

/// The picture of the CPU: all that moves reduced to the asset's frame.
Result<Image> onCpu(const asset::Asset& asset, const Scenery& scenery, const LiveOptions& options,
                    const LiveView& view, int samples) {
  const Mat3 assetFromWorld = view.worldFromAsset.topLeftCorner<3, 3>().transpose();
  scene::Camera camera = view.camera;
  camera.worldFromCamera = Mat4(view.worldFromAsset.inverse()) * view.camera.worldFromCamera;
  shade::PictureOptions picture;
  picture.width = kWidth;
  picture.height = kHeight;
  picture.samples = samples;
  picture.background = view.background;
  picture.transfer = options.transfer;
  picture.lobeExponent = options.lobeExponent;
  picture.biScale = options.biScale;
  return shade::picture(asset, sh::rotate(assetFromWorld, scenery.worldLight),
                        scenery.environment.rotated(assetFromWorld * view.worldFromEnvironment),
                        camera, picture);
}

Result<Image> live(LiveRenderer& renderer, const LiveView& view, int samples) {
  renderer.begin();
  for (const Vec2& place : scene::subpixelPositions(samples))
    if (Status s = renderer.add(view, place, samples); !s) return s.error();
  return renderer.picture();
}

class Live : public testing::Test {
 protected:
  void SetUp() override { ASSERT_TRUE(context_) << context_.error().message; }
  void TearDown() override { EXPECT_TRUE(checkGl("a test")); }

  /// Draws, and compares with the CPU.
  void expectAsOnCpu(const std::string& name, LiveRenderer& renderer, const asset::Asset& asset,
                     const Scenery& scenery, const LiveOptions& options, const LiveView& view,
                     const test::Agreement& agreement = {}) {
    constexpr int kSamples = 2;
    const Mat3 assetFromWorld = view.worldFromAsset.topLeftCorner<3, 3>().transpose();
    renderer.setLight(sh::rotate(assetFromWorld, scenery.worldLight));
    const Result<Image> gl = live(renderer, view, kSamples);
    ASSERT_TRUE(gl) << gl.error().message;
    const Result<Image> cpu = onCpu(asset, scenery, options, view, kSamples);
    ASSERT_TRUE(cpu) << cpu.error().message;
    test::expectSame("live-" + name, *cpu, *gl, agreement);
  }

  Result<GlContext> context_ = GlContext::create();
};

LiveRenderer rendererOf(const asset::Asset& asset, const LiveOptions& options = {},
                        std::size_t largestBlock = std::size_t(1) << 27) {
  Result<LiveRenderer> made = LiveRenderer::make(asset, options, largestBlock);
  if (!made) ADD_FAILURE() << made.error().message;
  EXPECT_TRUE(made->resize(kWidth, kHeight));
  return std::move(*made);
}

TEST_F(Live, EqualsTheCpuWhateverMoves) {
  const asset::Asset asset = everything();
  Scenery scenery;
  LiveRenderer renderer = rendererOf(asset);
  ASSERT_TRUE(renderer.setEnvironment(scenery.environment));
  LiveView view;
  view.camera = kCamera;
  for (int step = 0; step < 4; ++step) {
    // Light, environment, object and camera, each by an angle of its own.
    const Mat3 rotation = turn(40.0f * float(step), Vec3(0.2f, 1, 0.3f));
    view.worldFromAsset = placed(rotation, Vec3(0.3f, 0.1f, -0.2f) * float(step));
    view.worldFromEnvironment = turn(70.0f * float(step), Vec3(1, 2, -1));
    view.background = step % 2 == 0;
    scenery.worldLight = sh::rotate(view.worldFromEnvironment, scenery.environment.project(5));
    view.camera = cameraAt(Vec3(1.5f, 1.8f + 0.5f * float(step), 5.0f), Vec3::Zero());
    expectAsOnCpu("moves-" + std::to_string(step), renderer, asset, scenery, {}, view);
  }
}

TEST_F(Live, EqualsTheCpuAfterEverySwitch) {
  const asset::Asset asset = everything();
  Scenery scenery;
  LiveOptions options;
  LiveRenderer renderer = rendererOf(asset, options);
  ASSERT_TRUE(renderer.setEnvironment(scenery.environment));
  LiveView view;
  view.camera = kCamera;
  const auto expectSwitched = [&](const std::string& name, const test::Agreement& agreement = {}) {
    const Status chosen = renderer.choose(options);
    ASSERT_TRUE(chosen) << chosen.error().message;
    expectAsOnCpu("switch-" + name, renderer, asset, scenery, options, view, agreement);
  };
  for (const TransferChoice choice : {TransferChoice::Shadowed, TransferChoice::Unshadowed,
                                      TransferChoice::Interreflected, TransferChoice::Best}) {
    options.transfer = choice;
    expectSwitched(std::string(nameOf(choice)));
  }
  for (const MacroTransport macro :
       {MacroTransport::Off, MacroTransport::Shadowed, MacroTransport::Interreflected}) {
    options.biScale.macro = macro;
    expectSwitched("macro-" + std::to_string(int(macro)));
  }
  options.biScale.macro.reset();
  options.biScale.viewDependent = false;
  expectSwitched("pasted");
  options.biScale.filter = false;
  expectSwitched("nearest");
  options.biScale = {};
  options.lobeExponent = 60.0f;
  expectSwitched("lobe");
  options = {};
  expectSwitched("back");
}

}  // namespace
}  // namespace lambent::render
