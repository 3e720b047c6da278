// Surfaces with meso-structure by OpenGL against the CPU, and the shaders' formulas against the
// library's.

#include "lambent/render/gl_patches.h"

#include <gtest/gtest.h>

#include "lambent/math/directions.h"
#include "lambent/reference/relit_picture.h"
#include "lambent/render/gl_context.h"
#include "lambent/render/gl_picture_in_blocks.h"
#include "lambent/render/renderer.h"
#include "lambent/render/shader_sources.h"
#include "lambent/render/test_agreement.h"
#include "lambent/render/test_shader.h"
#include "lambent/scene/shapes.h"
#include "lambent/shade/test_assets.h"
#include "lambent/shade/test_patches.h"

namespace lambent::render {
namespace {

using shade::test::addPatched;
using shade::test::bumpyRtt;
using shade::test::SpreadOptions;
using test::expectAgreement;
using test::small;
using transfer::Encoding;
using transfer::Kind;

const scene::Camera kPatchCamera = shade::test::cameraAt(Vec3(1.0f, 1.0f, 3.5f), Vec3(0, -0.2f, 0));

/// A ball over a floor that reaches into the distance.
asset::Asset ballAndFloor(const SpreadOptions& options, int bands = 5, int views = 8) {
  asset::Asset asset;
  addPatched(asset, scene::uvSphere(1.0f, 32, 16), bumpyRtt(24, 16, views, bands), options);
  addPatched(asset, scene::translated(scene::gridPlane(12, 12, 4, 4), Vec3(0, -1, 0)),
             bumpyRtt(16, 16, views, bands), options);
  return asset;
}

SpreadOptions mapped() {
  SpreadOptions options;
  options.idMap = shade::test::patchworkMap(96, 64, Vec2(5, 3));
  return options;
}

// Bytes are rounded on the GPU on every level, where the CPU averages what they stand for.
const test::Agreement kOfBytes{std::size_t(1) << 40, 0.08, 0.3};

TEST(GlPatches, EqualTheCpuForEveryEncodingWithAndWithoutAMap) {
  for (const bool map : {false, true})
    for (const bool filter : {false, true})
      for (const Encoding encoding : {Encoding::Snorm8, Encoding::Float16, Encoding::Float32}) {
        SpreadOptions options = map ? mapped() : SpreadOptions();
        options.encoding = encoding;
        shade::PictureOptions picture = small(2);
        picture.showing.filter = filter;
        expectAgreement("patches-" + std::to_string(map) + std::to_string(filter) +
                            std::to_string(int(encoding)),
                        ballAndFloor(options), kPatchCamera, picture,
                        filter && encoding == Encoding::Snorm8 ? kOfBytes : test::Agreement());
      }
}

/// Smooth waves with heights, as every view sees them.
transfer::SimulatedRtt wavyRtt(int side, int views, int bands) {
  transfer::SimulatedRtt rtt = bumpyRtt(side, side, views, bands);
  rtt.depth = 0.3f;
  for (std::size_t p = 0; p < rtt.positionCount(); ++p)
    for (std::size_t v = 0; v < rtt.viewCount(); ++v)
      rtt.heights.push_back(std::uint8_t(
          127.5 + 120 * std::sin(2 * kPi * double(p % std::size_t(side)) / side) *
                      std::cos(2 * kPi * double(p / std::size_t(side)) / side + 0.1 * double(v))));
  return rtt;
}

// A search that ends at the border of a position may end on either side of it.
const test::Agreement kOfReliefs{std::size_t(1) << 40, 0.02, 0.3};

TEST(GlPatches, EqualTheCpuWhereViewsAreCorrected) {
  for (const bool map : {false, true})
    for (const bool filter : {false, true}) {
      SpreadOptions options = map ? mapped() : SpreadOptions();
      options.encoding = Encoding::Float16;
      asset::Asset asset;
      addPatched(asset, scene::uvSphere(1.0f, 32, 16), wavyRtt(24, 6, 3), options);
      addPatched(asset, scene::translated(scene::gridPlane(12, 12, 4, 4), Vec3(0, -1, 0)),
                 bumpyRtt(16, 16, 6, 3), options);
      shade::PictureOptions picture = small(2);
      picture.showing.filter = filter;
      expectAgreement("reliefs-" + std::to_string(map) + std::to_string(filter), asset,
                      kPatchCamera, picture, filter ? kOfReliefs : test::Agreement());
    }
}

TEST(GlPatches, EqualTheCpuForEveryMacroTransport) {
  for (const Encoding encoding : {Encoding::Snorm8, Encoding::Float16, Encoding::Float32}) {
    SpreadOptions options = mapped();
    options.shadowedBands = 5;
    options.channels = encoding == Encoding::Float16 ? 1 : 3;
    options.matrices = encoding;
    const asset::Asset asset = ballAndFloor(options);
    for (const Kind macro : transfer::kKinds) {
      shade::PictureOptions picture = small(1);
      picture.showing.mesoStructure = macro;
      expectAgreement("macro-" + std::to_string(int(macro)), asset, kPatchCamera, picture);
    }
  }
}

// Seven bands do not fit into what the rasteriser interpolates; matrices of fewer bands, and of
// more, than the texture has.
TEST(GlPatches, EqualTheCpuForOtherBandsAndViews) {
  for (const auto& [bands, views, matrixBands] : {std::tuple{7, 4, 7}, {3, 3, 3}, {4, 1, 0}}) {
    SpreadOptions options = mapped();
    options.shadowedBands = matrixBands;
    options.encoding = Encoding::Float16;
    expectAgreement("bands-" + std::to_string(bands), ballAndFloor(options, bands, views),
                    kPatchCamera, small(1));
  }
}

TEST(GlPatches, EqualTheCpuWithoutDependenceOnTheView) {
  for (const int views : {7, 8}) {
    shade::PictureOptions picture = small(2);
    picture.showing.viewDependent = false;
    expectAgreement("pasted-" + std::to_string(views), ballAndFloor(mapped(), 3, views),
                    kPatchCamera, picture);
  }
}

TEST(GlPatches, EqualTheCpuForAnOrthographicCamera) {
  scene::Camera camera = shade::test::cameraAt(Vec3(6, 6, 16), Vec3::Zero());  // before all
  camera.orthographicHalfHeight = 3.0f;
  expectAgreement("patches-orthographic", ballAndFloor({}, 3, 4), camera, small(2));
}

TEST(GlPatches, FallIntoBlocksWithoutSeams) {
  SpreadOptions options;
  options.shadowedBands = 3;
  expectAgreement("patches-blocks", ballAndFloor(options, 3, 4), kPatchCamera, small(1), {12'000});
}

TEST(GlPatches, StandBesideOtherSurfaces) {
  asset::Asset asset = ballAndFloor(mapped(), 3, 4);
  shade::test::addDiffuse(asset, shade::test::sphere(Vec3(1.6f, 0, 0.5f), 0.4f, 8), {});
  shade::test::addMirror(asset, shade::test::sphere(Vec3(-1.6f, 0, 0.5f), 0.4f, 24),
                         Rgb(0.9f, 0.8f, 0.7f));
  expectAgreement("patches-beside", asset, kPatchCamera, small(2));
}

TEST(GlPatches, EqualTheCpuUnderATint) {
  for (const bool map : {false, true}) {
    asset::Asset asset = ballAndFloor(map ? mapped() : SpreadOptions(), 3, 4);
    scene::Texture& texture = asset.scene.textures.emplace_back();
    texture.width = 16, texture.height = 8;
    texture.wrapV = scene::Wrap::ClampToEdge;
    for (int i = 0; i < 128; ++i)
      texture.rgba.insert(texture.rgba.end(), {std::uint8_t(i % 3 ? 250 : 40), std::uint8_t(2 * i),
                                               std::uint8_t(255 - i), 255});
    asset.scene.materials[0].baseColorTexture = 0;
    for (const Vec3& p : asset.scene.meshes[1].positions)
      asset.scene.meshes[1].colors.emplace_back(0.9f, 0.5f + 0.1f * p.x(), 0.4f - 0.1f * p.z());
    expectAgreement("patches-tinted-" + std::to_string(map), asset, kPatchCamera, small(2));
  }
}

/// How far the mean of many sub-samples is from what rays see.
double apart(const std::string& name, const asset::Asset& asset, const scene::Camera& camera,
             const shade::PictureOptions& options) {
  const light::Environment sky = shade::test::sky();
  const auto light = sky.project(5);
  const auto rays = reference::relitPicture(asset, light, sky, camera, options);
  const auto drawn = render::picture(asset, light, sky, camera, options);
  EXPECT_TRUE(rays && drawn) << name;
  if (!rays || !drawn) return 1.0;
  double squares = 0;
  Rgb sum = Rgb::Zero(), whole = Rgb::Zero();
  for (std::size_t i = 0; i < rays->pixels.size(); ++i) {
    squares += double((drawn->pixels[i] - rays->pixels[i]).square().mean());
    sum += drawn->pixels[i] - rays->pixels[i], whole += rays->pixels[i];
  }
  EXPECT_LT((sum / whole).abs().maxCoeff(), 0.01f) << name << (sum / whole).transpose();
  return std::sqrt(squares / double(rays->pixels.size()));
}

// All or nothing: without noise.
TEST(GlPatches, LayersAreSeenBeforeWhatTheyLieOn) {
  for (const bool map : {false, true}) {
    asset::Asset asset = ballAndFloor(map ? mapped() : SpreadOptions(), 3, 4);
    SpreadOptions options = map ? SpreadOptions() : mapped();
    options.encoding = Encoding::Float16;
    shade::test::addLayer(asset, 0, bumpyRtt(12, 20, 3, 4), options, {255});
    shade::test::addLayer(asset, 1, bumpyRtt(20, 12, 6, 2), options, {255});
    expectAgreement("patches-layered-" + std::to_string(map), asset, kPatchCamera, small(2));
  }
}

TEST(GlPatches, LayersBlendAsTheirMasksSay) {
  const SpreadOptions options;
  asset::Asset asset;
  addPatched(asset, scene::uvSphere(1.0f, 32, 16),
             shade::test::flatRtt(2, 2, 2, 3, Rgb(0.2f, 0.4f, 0.6f)), options);
  shade::test::addLayer(asset, 0, shade::test::flatRtt(1, 3, 1, 3, Rgb(0.9f, 0.1f, 0.3f)), options,
                        {0, 64, 128, 255});
  shade::test::addLayer(asset, 0, shade::test::flatRtt(1, 1, 4, 3, Rgb(0.05f, 0.7f, 0.5f)), options,
                        {0, 0, 255, 128, 0, 0, 0, 0});
  EXPECT_LT(apart("blended", asset, kPatchCamera, small(64)), 0.03);
}

TEST(GlPatches, ALayerMayLieOnABareSurface) {
  asset::Asset asset;
  shade::test::addDiffuse(asset, shade::test::sphere(Vec3::Zero(), 1.0f, 16), {});
  shade::test::addLayer(asset, 0, bumpyRtt(12, 20, 3, 4), {}, {0, 255});
  EXPECT_LT(apart("on a bare one", asset, kPatchCamera, small(64)), 0.03);
}

TEST(GlPatches, SayWhatIsNotHeld) {
  const asset::Asset asset = ballAndFloor({}, 2, 1);
  const light::Environment sky = shade::test::sky();
  shade::PictureOptions picture = small(1);
  picture.showing.mesoStructure = Kind::Shadowed;
  const auto result = render::picture(asset, sky.project(3), sky, kPatchCamera, picture);
  ASSERT_FALSE(result);
  EXPECT_NE(result.error().message.find("--transfer shadowed"), std::string::npos);
}

TEST(Renderer, DrawsFramesAndPicturesOfTheSameAsset) {
  const asset::Asset asset = ballAndFloor({}, 2, 2);
  const light::Environment sky = shade::test::sky();
  const sh::RgbCoefficients light = sky.project(3);
  Result<Renderer> renderer = Renderer::make(asset, light, sky, small(2));
  ASSERT_TRUE(renderer) << renderer.error().message;
  const auto first = renderer->picture(kPatchCamera);
  ASSERT_TRUE(renderer->drawFrame(shade::test::cameraAt(Vec3(0, 0, 5), Vec3::Zero())));
  const auto again = renderer->picture(kPatchCamera);
  ASSERT_TRUE(first && again);
  for (std::size_t i = 0; i < first->pixels.size(); ++i)
    ASSERT_TRUE((first->pixels[i] == again->pixels[i]).all()) << i;
}

TEST(ShaderConventions, ViewSquareEqualsTheLibrarys) {
  const Result<GlContext> context = GlContext::create();
  ASSERT_TRUE(context) << context.error().message;
  std::vector<Vec3> directions;
  std::vector<float> inputs;
  for (int j = 0; j <= 20; ++j)
    for (int i = 0; i <= 20; ++i)
      directions.push_back(math::hemisphereFromSquare(Vec2(i / 20.0f, j / 20.0f)));
  directions.emplace_back(Vec3(0.8f, 0.6f, -0.1f).normalized());  // below the horizon
  for (const Vec3& d : directions) {
    inputs.insert(inputs.end(), {d.x(), d.y(), d.z()});
    inputs.resize(inputs.size() + 13);
  }
  const std::vector<float> squares =
      test::onGpu(std::string(shaderSource("view_square.glsl")),
                  "outputs[p] = vec4(squareFromHemisphere(inputs[p][0].xyz), 0.0, 0.0);\n", inputs);
  ASSERT_EQ(squares.size(), 4 * directions.size());
  for (std::size_t p = 0; p < directions.size(); ++p) {
    const Vec2 expected = math::squareFromHemisphere(directions[p]);
    EXPECT_NEAR(squares[4 * p], expected.x(), 2e-5f) << directions[p].transpose();
    EXPECT_NEAR(squares[4 * p + 1], expected.y(), 2e-5f) << directions[p].transpose();
  }
}

TEST(ShaderConventions, ProbesEqualTheLibrarys) {
  const Result<GlContext> context = GlContext::create();
  ASSERT_TRUE(context) << context.error().message;
  struct Case {
    Vec2 longer, shorter, positions;
  };
  std::vector<Case> cases;
  std::vector<float> inputs;
  for (const float length : {0.003f, 0.02f, 0.09f, 0.7f, 5.0f})
    for (const float ratio : {0.05f, 0.23f, 0.61f, 0.97f, 1.7f})
      for (const float turn : {0.0f, 0.4f, 1.3f, 2.6f}) {
        const Vec2 along(std::cos(turn), std::sin(turn));
        cases.push_back(
            {length * along, length * ratio * Vec2(-along.y(), along.x()), Vec2(64.0f, 40.0f)});
      }
  for (const Case& c : cases) {
    inputs.insert(inputs.end(), {c.longer.x(), c.longer.y(), c.shorter.x(), c.shorter.y(),
                                 c.positions.x(), c.positions.y()});
    inputs.resize(inputs.size() + 10);
  }
  const std::vector<float> probes =
      test::onGpu(std::string(shaderSource("rtt_footprint.glsl")),
                  "Probes found = probesOf(inputs[p][0].xy, inputs[p][0].zw, inputs[p][1].xy);\n"
                  "outputs[p] = vec4(found.level, float(found.count), found.stride);\n",
                  inputs);
  ASSERT_EQ(probes.size(), 4 * cases.size());
  for (std::size_t p = 0; p < cases.size(); ++p) {
    const shade::RttProbes expected =
        shade::probesOf(cases[p].longer, cases[p].shorter, cases[p].positions);
    EXPECT_NEAR(probes[4 * p], expected.level, 1e-4f) << p;
    EXPECT_EQ(int(probes[4 * p + 1]), expected.count) << p;
    EXPECT_NEAR(probes[4 * p + 2], expected.step.x(), 1e-5f) << p;
    EXPECT_NEAR(probes[4 * p + 3], expected.step.y(), 1e-5f) << p;
  }
}

}  // namespace
}  // namespace lambent::render
