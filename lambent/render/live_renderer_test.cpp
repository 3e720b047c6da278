// The live renderer against pictures of the CPU: whatever moves or is switched, the CPU makes the
// same picture in the asset's own frame.

#include "lambent/render/live_renderer.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <Eigen/LU>

#include "lambent/radiometry/srgb.h"
#include "lambent/reference/relit_picture.h"
#include "lambent/render/gl_context.h"
#include "lambent/render/gl_objects.h"
#include "lambent/render/test_agreement.h"
#include "lambent/scene/shapes.h"
#include "lambent/sh/rotation.h"
#include "lambent/shade/test_assets.h"
#include "lambent/shade/test_patches.h"

namespace lambent::render {
namespace {

using image::Image;
using shade::test::cameraAt;
using test::kCamera;
using transfer::Encoding;
using transfer::Kind;
using transfer::Numbers;

constexpr int kWidth = 128, kHeight = 96;
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
  asset.transfer.kind = Kind::Interreflected;
  const auto half = [](Numbers& numbers) {
    std::vector<float> values = transfer::decode(numbers);
    for (float& value : values) value *= 0.5f;
    numbers = transfer::encode(values, numbers.encoding, numbers.block);
  };
  for (transfer::EncodedMesh& mesh : asset.transfer.meshes) {
    auto* surface = std::get_if<transfer::Surface<Numbers>>(&mesh);
    if (!surface) continue;
    auto& shadowed = *surface->responses.find(Kind::Shadowed);
    surface->responses.set(Kind::Interreflected, shadowed);
    if (shadowed.diffuse) half(shadowed.diffuse->vectors.numbers);
    if (shadowed.glossy) half(shadowed.glossy->matrices.numbers);
  }
  return asset;
}

struct Scenery {
  light::Environment environment = shade::test::sky();
  sh::RgbCoefficients worldLight = environment.project(5);
};

/// The picture of the CPU: all that moves reduced to the asset's frame.
Result<Image> onCpu(const asset::Asset& asset, const Scenery& scenery,
                    const shade::Showing& showing, const LiveView& view, int samples) {
  const Mat3 assetFromWorld = view.worldFromAsset.topLeftCorner<3, 3>().transpose();
  scene::Camera camera = view.camera;
  camera.worldFromCamera = Mat4(view.worldFromAsset.inverse()) * view.camera.worldFromCamera;
  shade::PictureOptions picture;
  picture.width = kWidth;
  picture.height = kHeight;
  picture.samples = samples;
  picture.background = view.background;
  picture.showing = showing;
  return reference::relitPicture(
      asset, sh::rotate(assetFromWorld, scenery.worldLight),
      scenery.environment.rotated(assetFromWorld * view.worldFromEnvironment), camera, picture);
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
                     const Scenery& scenery, const shade::Showing& showing, const LiveView& view,
                     const test::Agreement& agreement = {}) {
    constexpr int kSamples = 2;
    const Mat3 assetFromWorld = view.worldFromAsset.topLeftCorner<3, 3>().transpose();
    renderer.setLight(sh::rotate(assetFromWorld, scenery.worldLight));
    const Result<Image> gl = live(renderer, view, kSamples);
    ASSERT_TRUE(gl) << gl.error().message;
    const Result<Image> cpu = onCpu(asset, scenery, showing, view, kSamples);
    ASSERT_TRUE(cpu) << cpu.error().message;
    test::Agreement within = agreement;
    within.mirrors = test::mirrorsIn(asset, [&](const asset::Asset& changed) {
      return onCpu(changed, scenery, showing, view, kSamples);
    });
    test::expectSame("live-" + name, *cpu, *gl, within);
  }

  Result<GlContext> context_ = GlContext::create();
};

LiveRenderer rendererOf(const asset::Asset& asset, const shade::Showing& showing = {},
                        std::size_t largestBlock = std::size_t(1) << 27) {
  Result<LiveRenderer> made = LiveRenderer::make(asset, showing, largestBlock);
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
  shade::Showing options;
  LiveRenderer renderer = rendererOf(asset, options);
  ASSERT_TRUE(renderer.setEnvironment(scenery.environment));
  LiveView view;
  view.camera = kCamera;
  const auto expectSwitched = [&](const std::string& name, const test::Agreement& agreement = {}) {
    const Status chosen = renderer.choose(options);
    ASSERT_TRUE(chosen) << chosen.error().message;
    expectAsOnCpu("switch-" + name, renderer, asset, scenery, options, view, agreement);
  };
  for (const std::optional<Kind> kind :
       {std::optional(Kind::Shadowed), std::optional(Kind::Unshadowed),
        std::optional(Kind::Interreflected), std::optional<Kind>()}) {
    options = shade::Showing::of(kind);
    expectSwitched(std::string(shade::choiceName(kind)));
  }
  for (const Kind macro : transfer::kKinds) {
    options.mesoStructure = macro;
    expectSwitched("macro-" + std::to_string(int(macro)));
  }
  options.mesoStructure.reset();
  options.viewDependent = false;
  expectSwitched("pasted");
  options.filter = false;
  expectSwitched("nearest");
  options.viewDependent = options.filter = true;
  options.lobeExponent = 60.0f;
  expectSwitched("lobe");
  options = {};
  expectSwitched("back");
}

TEST_F(Live, EqualsTheCpuThroughEveryCamera) {
  const asset::Asset asset = everything();
  const Scenery scenery;
  LiveRenderer renderer = rendererOf(asset);
  ASSERT_TRUE(renderer.setEnvironment(scenery.environment));
  LiveView view;
  view.worldFromAsset = placed(turn(30, Vec3(1, 1, 0)), Vec3(5, -3, 2));
  const auto expectThrough = [&](const std::string& name, const scene::Camera& assetCamera,
                                 const test::Agreement& agreement = {}) {
    view.camera = assetCamera;
    view.camera.worldFromCamera = view.worldFromAsset * assetCamera.worldFromCamera;
    expectAsOnCpu(name, renderer, asset, scenery, {}, view, agreement);
  };
  scene::Camera camera = kCamera;
  camera.orthographicHalfHeight = 2.2f;
  expectThrough("orthographic", camera);
  camera = kCamera;
  camera.worldFromCamera.col(0) *= -1.0f;  // right is left
  expectThrough("mirrored", camera);
  expectThrough("inside", cameraAt(Vec3(0.6f, 1.3f, 1.8f), Vec3(0, 0.6f, -0.5f)),
                {.inMirrors = 12});  // a rim, seen from nearby
}

TEST_F(Live, FallsIntoBlocksWithoutSeams) {
  const asset::Asset asset = everything();
  const Scenery scenery;
  shade::Showing options;
  options.mesoStructure = Kind::Unshadowed;
  LiveRenderer renderer = rendererOf(asset, options, 24'000);
  ASSERT_TRUE(renderer.setEnvironment(scenery.environment));
  LiveView view;
  view.camera = kCamera;
  expectAsOnCpu("blocks", renderer, asset, scenery, options, view);
}

/// Two lights over the asset, the second's share rising along x: the buffer, and what the CPU makes
/// of it.
struct TwoLights {
  sh::RgbCoefficients first = shade::test::sky().project(5), second = first;
  capture::Blending blending;

  explicit TwoLights(const asset::Asset& asset) {
    second = sh::rotate(turn(150, Vec3(1, 0.2f, 0)), first);
    for (float& value : second.values) value *= 0.7f;
    blending.samples = {Vec3(-1, 0, 0), Vec3(0, 9, 0),
                        Vec3(1, 0, 0)};  // the middle one is not used
    for (const transfer::EncodedMesh& mesh : asset.transfer.meshes) {
      auto& weights = blending.meshes.emplace_back();
      const transfer::Receivers* receivers = transfer::receiversOf(mesh);
      if (!receivers) continue;
      for (const Vec3& p : receivers->positions) {
        const float share = std::clamp(0.5f + 0.3f * p.x(), 0.0f, 1.0f);
        weights.push_back({{2, 0, 0, 1}, {share, 0.4f * (1 - share), 0.6f * (1 - share), 0.0f}});
      }
    }
  }
  std::vector<float> buffer(int bands) const {
    std::vector<float> numbers;
    for (const sh::RgbCoefficients& light : {first, sh::RgbCoefficients(5), second})
      for (int k = 0; k < sh::coefficientCount(bands); ++k)
        for (int c = 0; c < 3; ++c) numbers.push_back(light.channel(c)[k]);
    return numbers;
  }
};

/// What is linear in the light can be blended after it was applied: where all receivers of a point
/// have one share, the picture is the blend of two pictures. So receivers are given transfer that
/// holds their share: M_p (s a + (1 − s) b) = (s M_p) a + ((1 − s) M_p) b.
asset::Asset scaledByShare(asset::Asset asset, const capture::Blending& blending, bool ofSecond) {
  for (std::size_t m = 0; m < asset.transfer.meshes.size(); ++m) {
    const transfer::Receivers* receivers = transfer::receiversOf(asset.transfer.meshes[m]);
    const auto scale = [&](Numbers& numbers) {
      std::vector<float> values = transfer::decode(numbers);
      const std::size_t each = values.size() / receivers->size();
      for (std::size_t i = 0; i < values.size(); ++i) {
        const float share = blending.meshes[m][i / each].weight[0];
        values[i] *= ofSecond ? share : 1.0f - share;
      }
      numbers = transfer::encode(values, Encoding::Float32);
    };
    if (auto* surface = std::get_if<transfer::Surface<Numbers>>(&asset.transfer.meshes[m]))
      surface->responses.each([&](Kind, auto& response) {
        if (response.diffuse) scale(response.diffuse->vectors.numbers);
        if (response.glossy) scale(response.glossy->matrices.numbers);
      });
    if (auto* biScale = std::get_if<transfer::BiScale<Numbers>>(&asset.transfer.meshes[m]))
      biScale->matrices.each([&](Kind, auto& matrices) { scale(matrices.numbers); });
  }
  return asset;
}

TEST_F(Live, BlendsLightsAsTheCpuDoes) {
  asset::Asset asset = everything();
  asset.scene.materials[std::size_t(asset.scene.meshes[3].material)].mirror = Rgb(0, 0, 1e-6f);
  const TwoLights lights(asset);
  LiveView view;
  view.camera = kCamera;
  view.background = false;
  shade::PictureOptions picture;
  picture.width = kWidth;
  picture.height = kHeight;
  picture.samples = 1;
  // A field reaches lobes as it is, for each receiver sees another mixture of its lights.
  shade::Showing whole;
  whole.softLobes = false;
  picture.showing = whole;
  const light::Environment black;
  const auto one = reference::relitPicture(scaledByShare(asset, lights.blending, false),
                                           lights.first, black, kCamera, picture);
  const auto other = reference::relitPicture(scaledByShare(asset, lights.blending, true),
                                             lights.second, black, kCamera, picture);
  ASSERT_TRUE(one && other);
  Image cpu = *one;
  for (std::size_t i = 0; i < cpu.pixels.size(); ++i) cpu.pixels[i] += other->pixels[i];

  for (const std::size_t largestBlock : {std::size_t(1) << 27, std::size_t(24'000)}) {
    LiveRenderer renderer = rendererOf(asset, whole, largestBlock);
    const Buffer buffer = makeChangingBuffer(lights.buffer(5).size() * sizeof(float));
    // First nothing; then a pass of somebody's fills the buffer.
    ASSERT_TRUE(renderer.setLightField(lights.blending, buffer.name(), 5));
    ASSERT_TRUE(live(renderer, view, 1));
    const std::vector<float> numbers = lights.buffer(5);
    glNamedBufferSubData(buffer.name(), 0, GLsizeiptr(numbers.size() * sizeof(float)),
                         numbers.data());
    renderer.lightChanged();
    Result<Image> gl = live(renderer, view, 1);
    ASSERT_TRUE(gl);
    // Ringing is cut off before the two are added here, and after there.
    test::expectSame("live-field", cpu, *gl, {0, 0.1, 0.3});
    // A switch keeps the field, and one light sets it aside.
    shade::Showing options;
    options = shade::Showing::of(Kind::Unshadowed);
    ASSERT_TRUE(renderer.choose(options));
    ASSERT_TRUE(live(renderer, view, 1));
    ASSERT_TRUE(renderer.choose(whole));
    gl = live(renderer, view, 1);
    ASSERT_TRUE(gl);
    test::expectSame("live-field-again", cpu, *gl, {0, 0.1, 0.3});
    renderer.setLight(lights.first);
    picture.background = false;
    const auto plain = reference::relitPicture(asset, lights.first, black, kCamera, picture);
    gl = live(renderer, view, 1);
    ASSERT_TRUE(plain && gl);
    test::expectSame("live-field-aside", *plain, *gl);
  }
}

TEST_F(Live, SaysWhatDoesNotFit) {
  const asset::Asset asset = everything();
  LiveRenderer renderer = rendererOf(asset);
  TwoLights lights(asset);
  const Buffer small = makeChangingBuffer(64);
  Status s = renderer.setLightField(lights.blending, small.name(), 5);
  ASSERT_FALSE(s);
  EXPECT_NE(s.error().message.find("64 bytes"), std::string::npos) << s.error().message;
  lights.blending.meshes[0][0].sample[0] = 7;
  s = renderer.setLightField(lights.blending, small.name(), 5);
  ASSERT_FALSE(s);
  EXPECT_NE(s.error().message.find("sample 7"), std::string::npos) << s.error().message;
  lights.blending.meshes.pop_back();
  EXPECT_FALSE(renderer.setLightField(lights.blending, small.name(), 5));

  LiveView view;
  view.worldFromAsset.topLeftCorner<3, 3>() *= 2.0f;
  s = renderer.add(view);
  ASSERT_FALSE(s);
  EXPECT_NE(s.error().message.find("scaled"), std::string::npos);
  shade::Showing options;
  options.lobeExponent = -1.0f;
  EXPECT_FALSE(renderer.choose(options));
  EXPECT_FALSE(renderer.picture());
  EXPECT_FALSE(renderer.resize(0, 5));
}

/// A framebuffer as a window has it.
struct Window {
  Texture color = makeTexture(GL_RGBA8, kWidth, kHeight);
  Framebuffer framebuffer;
  Window() {
    GLuint name = 0;
    glCreateFramebuffers(1, &name);
    framebuffer = Framebuffer(name);
    glNamedFramebufferTexture(name, GL_COLOR_ATTACHMENT0, color.name(), 0);
  }
  /// [y from the top][x][4] code values.
  std::vector<std::uint8_t> pixels() const {
    std::vector<std::uint8_t> rows(4u * kWidth * kHeight), result;
    glGetTextureImage(color.name(), 0, GL_RGBA, GL_UNSIGNED_BYTE, GLsizei(rows.size()),
                      rows.data());
    for (int y = kHeight - 1; y >= 0; --y)
      result.insert(result.end(), rows.begin() + std::ptrdiff_t(4) * kWidth * y,
                    rows.begin() + std::ptrdiff_t(4) * kWidth * (y + 1));
    return result;
  }
};

TEST_F(Live, ShowsWhatPictureReadsBack) {
  const asset::Asset asset = everything();
  const Scenery scenery;
  LiveRenderer renderer = rendererOf(asset);
  ASSERT_TRUE(renderer.setEnvironment(scenery.environment));
  renderer.setLight(scenery.worldLight);
  LiveView view;
  view.camera = kCamera;
  const Window window;
  for (const bool background : {true, false})
    for (const auto curve : {tone::Curve::Filmic, tone::Curve::Linear}) {
      view.background = background;
      const Result<Image> picture = live(renderer, view, 3);
      ASSERT_TRUE(picture);
      // What a window's own drawing may leave behind.
      glEnable(GL_SCISSOR_TEST);
      glScissor(0, 0, 3, 3);
      glEnable(GL_BLEND);
      glColorMask(GL_FALSE, GL_TRUE, GL_FALSE, GL_TRUE);
      ASSERT_TRUE(renderer.show(window.framebuffer.name(), 0.7f, curve));
      EXPECT_TRUE(glIsEnabled(GL_SCISSOR_TEST));
      EXPECT_TRUE(glIsEnabled(GL_BLEND));
      GLboolean mask[4];
      glGetBooleanv(GL_COLOR_WRITEMASK, mask);
      EXPECT_FALSE(mask[0]);
      glDisable(GL_SCISSOR_TEST);
      glDisable(GL_BLEND);
      glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);

      const Image expected = tone::toneMap(*picture, 0.7f, curve);
      const std::vector<std::uint8_t> shown = window.pixels();
      for (std::size_t i = 0; i < expected.pixels.size(); ++i)
        for (int c = 0; c < 3; ++c)
          ASSERT_NEAR(shown[4 * i + std::size_t(c)],
                      255.0f * radiometry::srgbEncode(expected.pixels[i][c]), 0.51f)
              << i;
    }
}

TEST_F(Live, StateThatOthersLeftChangesNothing) {
  const asset::Asset asset = everything();
  const Scenery scenery;
  LiveRenderer renderer = rendererOf(asset);
  ASSERT_TRUE(renderer.setEnvironment(scenery.environment));
  renderer.setLight(scenery.worldLight);
  LiveView view;
  view.camera = kCamera;
  const Result<Image> before = live(renderer, view, 2);
  for (const GLenum which : {GL_BLEND, GL_SCISSOR_TEST, GL_CULL_FACE, GL_STENCIL_TEST,
                             GL_FRAMEBUFFER_SRGB, GL_RASTERIZER_DISCARD, GL_DEPTH_CLAMP})
    glEnable(which);
  glCullFace(GL_FRONT_AND_BACK);
  glBlendFunc(GL_ONE, GL_ONE);
  glScissor(5, 5, 1, 1);
  glStencilFunc(GL_NEVER, 0, 0);
  glDepthFunc(GL_GREATER);
  glDepthMask(GL_FALSE);
  glDepthRange(1, 0);
  glPolygonMode(GL_FRONT_AND_BACK, GL_LINE);
  glClipControl(GL_UPPER_LEFT, GL_ZERO_TO_ONE);
  glFrontFace(GL_CW);
  const Result<Image> after = live(renderer, view, 2);
  ASSERT_TRUE(before && after);
  for (std::size_t i = 0; i < before->pixels.size(); ++i)
    ASSERT_TRUE((before->pixels[i] == after->pixels[i]).all()) << i;
}

// What others draw after add() is in the picture, and hides and is hidden by depth.
TEST_F(Live, TakesInWhatOthersDraw) {
  asset::Asset asset;
  shade::test::addDiffuse(asset, shade::test::sphere(Vec3::Zero(), 0.5f, 8), {});
  LiveRenderer renderer = rendererOf(asset);
  renderer.setLight(shade::test::sky().project(5));
  LiveView view;
  view.camera = cameraAt(Vec3(0, 0, 5), Vec3::Zero());
  view.background = false;
  for (const float z : {-20.0f, 3.0f}) view.others.extend(Vec3(0, 0, z));
  ASSERT_TRUE(renderer.add(view));
  // The far and the near end of the other things are within clip space.
  for (const float z : {-20.0f, 3.0f}) {
    const Eigen::Vector4f clip = renderer.clipFromWorld() * Eigen::Vector4f(0, 0, z, 1);
    EXPECT_LT(std::abs(clip.z()), clip.w()) << z;
  }
  const float lamp[4] = {5, 4, 3, 1};
  glClearNamedFramebufferfv(renderer.framebuffer(), GL_COLOR, 0, lamp);
  const Result<Image> picture = renderer.picture();
  ASSERT_TRUE(picture);
  EXPECT_EQ(picture->at(3, 3).x(), 5.0f);
  EXPECT_EQ(picture->alpha[0], 1.0f);
}

TEST_F(Live, UnlitShowsTheBaseColour) {
  asset::Asset asset;
  scene::Mesh mesh = shade::test::sphere(Vec3::Zero(), 1.0f, 12);
  mesh.colors.assign(mesh.positions.size(), Rgb(0.25f, 0.5f, 1.0f));
  shade::test::addDiffuse(asset, mesh, {});
  const Rgb diffuse = asset.scene.materials[0].diffuse;
  LiveRenderer renderer = rendererOf(asset);  // and no light at all
  LiveView view;
  view.camera = kCamera;
  view.background = false;
  view.unlit = true;
  ASSERT_TRUE(renderer.add(view));
  const Result<Image> picture = renderer.picture();
  ASSERT_TRUE(picture);
  EXPECT_TRUE(
      picture->at(kWidth / 2, kHeight / 2)
          .isApprox(Rgb(0.25f, 0.5f, 1.0f) * (diffuse + asset.scene.materials[0].glossy), 1e-5f));
}

/// Objects of every kind that are alive, among the first names: drivers hand out small names.
int objectsAlive() {
  int alive = 0;
  for (GLuint name = 1; name < 4096; ++name)
    alive += glIsBuffer(name) + glIsTexture(name) + glIsFramebuffer(name) + glIsVertexArray(name) +
             glIsProgram(name) + glIsShader(name);
  return alive;
}

TEST_F(Live, LeavesNoObjectsBehind) {
  asset::Asset asset;
  shade::test::addGlossy(asset, shade::test::sphere(Vec3::Zero(), 0.6f, 4), 3, 3, 1,
                         Encoding::Float16);
  shade::test::addMirror(asset, shade::test::sphere(Vec3(1, 0, 0), 0.3f, 4), Rgb::Ones());
  shade::test::addPatched(asset, scene::uvSphere(0.3f, 6, 4), shade::test::bumpyRtt(4, 4, 2, 2),
                          {});
  const TwoLights lights(asset);
  const Buffer buffer = makeBuffer(lights.buffer(5));
  const int before = objectsAlive();
  LiveView view;
  view.camera = kCamera;
  for (int round = 0; round < 50; ++round) {
    LiveRenderer renderer = rendererOf(asset);
    ASSERT_TRUE(renderer.setLightField(lights.blending, buffer.name(), 5));
    shade::Showing options;
    if (round % 2) options = shade::Showing::of(Kind::Unshadowed);
    options.filter = round % 2;
    ASSERT_TRUE(renderer.choose(options));
    ASSERT_TRUE(renderer.add(view));
    ASSERT_TRUE(renderer.picture());
    EXPECT_GT(objectsAlive(), before + 20);
  }
  EXPECT_EQ(objectsAlive(), before);
}

}  // namespace
}  // namespace lambent::render
