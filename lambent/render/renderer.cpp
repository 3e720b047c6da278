// Run-time rendering of radiance transfer (sloan2002precomputed §6) by OpenGL: a compute pass
// applies transfer vectors and matrices to the light; the surfaces are then drawn once for each
// sub-sample, shifted so that a pixel's centre falls on the place that shade::picture shoots its
// ray through, and added up. So every sub-sample of every pixel has its counterpart on the CPU.

#include "lambent/render/renderer.h"

#include <algorithm>

#include <fmt/format.h>
#include <Eigen/LU>

#include "lambent/render/gl_context.h"
#include "lambent/render/gl_scene.h"
#include "lambent/render/gl_target.h"
#include "lambent/shade/picture_frame.h"

namespace lambent::render {
namespace {

constexpr std::size_t kLargestBlock = std::size_t(128) << 20;

/// clipFromWorld, shifted so that what stands at `place` of each pixel (from its upper left corner)
/// comes to stand at the pixel's centre, which is where GL samples.
Mat4 shifted(const Mat4& clipFromWorld, const Vec2& place, int width, int height) {
  Mat4 result = clipFromWorld;
  result.row(0) += (0.5f - place.x()) * 2.0f / float(width) * clipFromWorld.row(3);
  result.row(1) -= (0.5f - place.y()) * 2.0f / float(height) * clipFromWorld.row(3);
  return result;
}

Eigen::Vector4f eyeOf(const scene::Camera& camera) {
  const Eigen::Vector3f back = camera.worldFromCamera.block<3, 1>(0, 2).normalized();
  const Eigen::Vector3f position = camera.worldFromCamera.block<3, 1>(0, 3);
  if (camera.orthographicHalfHeight) return {back.x(), back.y(), back.z(), 0.0f};
  return {position.x(), position.y(), position.z(), 1.0f};
}

}  // namespace

struct Renderer::Impl {
  const light::Environment& environment;
  shade::PictureOptions options;
  scene::Box bounds;
  // In this sequence: the context goes last.
  GlContext context;
  GlTarget target;
  GlScene scene;

  /// One frame, seen through `place` of every pixel.
  void draw(const scene::Camera& camera, const Vec2& place) const {
    const int width = options.width, height = options.height;
    glBindFramebuffer(GL_FRAMEBUFFER, target.framebuffer.name());
    glViewport(0, 0, width, height);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LESS);
    const float handedness = camera.worldFromCamera.topLeftCorner<3, 3>().determinant();
    glFrontFace(handedness > 0.0f ? GL_CCW : GL_CW);
    target.clear();
    scene.draw({shifted(scene::clipFromWorld(camera, width, height, bounds), place, width, height),
                eyeOf(camera), shade::sampleWidth(camera, height, options.samples)});
  }
};

Renderer::Renderer(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;
Renderer::~Renderer() = default;

Result<Renderer> Renderer::make(const asset::Asset& asset, const sh::RgbCoefficients& light,
                                const light::Environment& environment,
                                const shade::PictureOptions& options) {
  return make(asset, light, environment, options, kLargestBlock);
}

Result<Renderer> Renderer::make(const asset::Asset& asset, const sh::RgbCoefficients& light,
                                const light::Environment& environment,
                                const shade::PictureOptions& options, std::size_t largestBlock) {
  if (Status s = shade::checkPicture(asset, light, {}, options); !s) return s.error();
  Result<GlContext> context = GlContext::create();
  if (!context) return context.error();
  const int width = options.width, height = options.height;
  if (width > context->largestTexture() || height > context->largestTexture())
    return report::failed(fmt::format(
        "a picture of {}×{} pixels: this OpenGL makes {} a side. Ask for fewer, or make the "
        "picture on the CPU",
        width, height, context->largestTexture()));

  GlSceneOptions sceneOptions;
  sceneOptions.largestBlock = std::min(largestBlock, context->largestStorageBlock());
  sceneOptions.largestTexture = context->largestTexture();
  sceneOptions.lobeExponent = options.lobeExponent;
  sceneOptions.biScale = options.biScale;
  Result<GlScene> scene = GlScene::make(asset, light, environment, sceneOptions);
  if (!scene) return scene.error();
  Result<GlTarget> target = GlTarget::make(width, height);
  if (!target) return target.error();
  return Renderer(
      std::unique_ptr<Impl>(new Impl{environment, options, scene::bounds(asset.scene),
                                     std::move(*context), std::move(*target), std::move(*scene)}));
}

Status Renderer::drawFrame(const scene::Camera& camera) {
  if (Status s = shade::checkCamera(camera); !s) return s;
  impl_->draw(camera, Vec2(0.5f, 0.5f));
  glFinish();
  return checkGl("drawing");
}

Result<image::Image> Renderer::picture(const scene::Camera& camera, const Progress& progress) {
  if (Status s = shade::checkCamera(camera); !s) return s.error();
  const std::vector<Vec2> places = scene::subpixelPositions(impl_->options.samples);
  impl_->target.clearSum();
  for (std::size_t i = 0; i < places.size(); ++i) {
    impl_->draw(camera, places[i]);
    impl_->target.addToSum();
    if (Status s = checkGl("drawing"); !s) return s.error();
    if (progress) {
      glFinish();
      if (!progress({"picture", i + 1, places.size(), "samples"})) return report::cancelled();
    }
  }
  Result<image::Image> image = impl_->target.mean(int(places.size()));
  if (image) shade::finishPicture(*image, impl_->environment, camera, impl_->options);
  return image;
}

}  // namespace lambent::render
