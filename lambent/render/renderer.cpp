// Run-time rendering of radiance transfer (sloan2002precomputed §6) by OpenGL: a compute pass
// applies transfer vectors and matrices to the light; the surfaces are then drawn once for each
// sub-sample, shifted so that a pixel's centre falls on the place that reference::relitPicture
// shoots its ray through, and added up. So every sub-sample of every pixel has its counterpart on
// the CPU.

#include "lambent/render/renderer.h"

#include <algorithm>

#include <fmt/format.h>

#include "lambent/render/gl_context.h"
#include "lambent/render/gl_scene.h"
#include "lambent/render/gl_target.h"
#include "lambent/shade/picture_frame.h"

namespace lambent::render {
namespace {

constexpr int kMostVeilSamples = 16;  ///< of what mirrors show
constexpr int kCoarseMirrors = 128;   ///< texels along the edge of a face

}  // namespace

struct Renderer::Impl {
  const light::Environment& environment;
  shade::PictureOptions options;
  scene::Box bounds;
  // In this sequence: the context goes last.
  GlContext context;
  GlTarget target;
  GlScene scene;
  GlEnvironment inMirrors;

  static Result<Renderer> make(const asset::Asset& asset, const sh::RgbCoefficients& light,
                               const light::Environment& environment,
                               const shade::PictureOptions& options, GlSceneOptions sceneOptions);

  /// One frame, sub-sample number `sample`, seen through `place` of every pixel, under a point of
  /// the sharp Sun, if there is one.
  Result<GlView> draw(const scene::Camera& camera, int sample, const Vec2& place,
                      const light::SunPoint* sun) {
    GlView view =
        viewThrough(camera, options.width, options.height, bounds, place, options.samples);
    if (sun) view.sun = *sun;
    view.sample = sample;
    view.background = options.background;
    if (options.air && options.air->shafts) view.shafts = options.air->planes(camera, bounds);
    GlScene::Surroundings surroundings{inMirrors};
    if (options.sun) surroundings.sun = options.sun->sun;
    surroundings.veilSamples = std::min(options.samples, kMostVeilSamples);
    if (Status s = scene.captureMirrors(surroundings); !s) return s.error();
    if (Status s = scene.mapSun(view); !s) return s.error();
    target.beginFrame();
    scene.draw(view, inMirrors);
    return view;
  }

  std::vector<light::SunPoint> sunPoints(int count) const {
    return options.sun ? light::pointsOf(options.sun->sun, count) : std::vector<light::SunPoint>();
  }
};

Renderer::Renderer(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;
Renderer::~Renderer() = default;

Result<Renderer> Renderer::make(const asset::Asset& asset, const sh::RgbCoefficients& light,
                                const light::Environment& environment,
                                const shade::PictureOptions& options) {
  GlSceneOptions sceneOptions;
  sceneOptions.largestBlock = kLargestBlock;
  return Impl::make(asset, light, environment, options, sceneOptions);
}

Result<Renderer> Renderer::make(const asset::Asset& asset, const sh::RgbCoefficients& light,
                                const light::Environment& environment,
                                const shade::PictureOptions& options, std::size_t largestBlock) {
  GlSceneOptions sceneOptions;
  sceneOptions.largestBlock = largestBlock;
  sceneOptions.mirrorSide = kCoarseMirrors;
  return Impl::make(asset, light, environment, options, sceneOptions);
}

/// Of `sceneOptions` sizes are taken, within what this OpenGL takes.
Result<Renderer> Renderer::Impl::make(const asset::Asset& asset, const sh::RgbCoefficients& light,
                                      const light::Environment& environment,
                                      const shade::PictureOptions& options,
                                      GlSceneOptions sceneOptions) {
  if (Status s = shade::checkPicture(asset, light, {}, options); !s) return s.error();
  Result<GlContext> context = GlContext::create();
  if (!context) return context.error();
  const GlLimits limits = limitsOfGl();
  const int width = options.width, height = options.height;
  if (width > limits.largestTexture || height > limits.largestTexture)
    return report::failed(fmt::format(
        "a picture of {}×{} pixels: this OpenGL makes {} a side. Ask for fewer, or make the "
        "picture on the CPU",
        width, height, limits.largestTexture));

  sceneOptions.largestBlock = std::min(sceneOptions.largestBlock, limits.largestStorageBlock);
  sceneOptions.largestTexture = limits.largestTexture;
  sceneOptions.showing = options.showing;
  if (options.sun) sceneOptions.sunShare = options.sun->share;
  sceneOptions.air = options.air;
  Result<GlScene> scene = GlScene::makeLit(asset, light, sceneOptions);
  if (!scene) return scene.error();
  GlEnvironment inMirrors;
  if (scene->hasMirrors()) {
    if (Status s = inMirrors.set(environment, limits.largestTexture); !s) return s.error();
  }
  Result<GlTarget> target = GlTarget::make(width, height);
  if (!target) return target.error();
  if (Status s = target->prepare(scene->around()); !s) return s.error();
  return Renderer(std::unique_ptr<Impl>(new Impl{environment, options, scene::bounds(asset.scene),
                                                 std::move(*context), std::move(*target),
                                                 std::move(*scene), std::move(inMirrors)}));
}

Status Renderer::drawFrame(const scene::Camera& camera) {
  if (Status s = shade::checkCamera(camera, impl_->options); !s) return s;
  const std::vector<light::SunPoint> sun = impl_->sunPoints(1);
  const auto drawn = impl_->draw(camera, 0, Vec2(0.5f, 0.5f), sun.empty() ? nullptr : &sun[0]);
  if (!drawn) return drawn.error();
  glFinish();
  return checkGl("drawing");
}

Result<image::Image> Renderer::picture(const scene::Camera& camera, const Progress& progress) {
  if (Status s = shade::checkCamera(camera, impl_->options); !s) return s.error();
  const std::vector<Vec2> places = scene::subpixelPositions(impl_->options.samples);
  const std::vector<light::SunPoint> sun = impl_->sunPoints(impl_->options.samples);
  impl_->target.clearSum();
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto drawn = impl_->draw(camera, int(i), places[i], sun.empty() ? nullptr : &sun[i]);
    if (!drawn) return drawn.error();
    impl_->target.addToSum(*drawn, impl_->scene.around());
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
