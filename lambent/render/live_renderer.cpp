// This work is based on:
// - sloan2002precomputed: run-time rendering of radiance transfer, §6. Transfer stays in the
//   asset's own frame: light, camera and environment are brought there, which is a few numbers a
//   frame (step 2: "it is more efficient to rotate the few radiance samples").

#include "lambent/render/live_renderer.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include <fmt/format.h>
#include <Eigen/Geometry>
#include <Eigen/LU>

#include "lambent/render/gl_scene.h"
#include "lambent/render/gl_state.h"
#include "lambent/render/gl_target.h"
#include "lambent/shade/picture_frame.h"

namespace lambent::render {
namespace {

constexpr int kQuickMirrors = 128;  ///< texels along the edge of a face

shade::PictureOptions pictureOptions(const shade::Showing& showing) {
  shade::PictureOptions result;
  result.showing = showing;
  return result;
}

Status checkView(const LiveView& view, const std::optional<shade::Air>& air) {
  shade::PictureOptions options;
  options.air = air;
  if (Status s = shade::checkCamera(view.camera, options); !s) return s;
  const auto isRotation = [](const Mat3& m) {
    return m.allFinite() && (m.transpose() * m - Mat3::Identity()).norm() < 1e-3f &&
           m.determinant() > 0.0f;
  };
  if (!isRotation(view.worldFromAsset.topLeftCorner<3, 3>()) || !view.worldFromAsset.allFinite())
    return report::badUsage("an asset can be turned and moved, but not scaled or mirrored");
  if (!isRotation(view.worldFromEnvironment))
    return report::badUsage("an environment can be turned, but not scaled or mirrored");
  return Status::ok();
}

/// A box around `box` after it was moved.
scene::Box moved(const scene::Box& box, const Mat4& dstFromSrc) {
  scene::Box result;
  for (int corner = 0; corner < 8 && !box.empty(); ++corner) {
    const Vec3 p((corner & 1 ? box.upper : box.lower).x(), (corner & 2 ? box.upper : box.lower).y(),
                 (corner & 4 ? box.upper : box.lower).z());
    result.extend(dstFromSrc.topLeftCorner<3, 3>() * p + dstFromSrc.topRightCorner<3, 1>());
  }
  return result;
}

}  // namespace

struct LiveRenderer::Impl {
  Impl(const asset::Asset& from, const GlLimits& taken, GlScene made)
      : asset(from), bounds(scene::bounds(from.scene)), limits(taken), scene(std::move(made)) {}
  static Result<LiveRenderer> make(const asset::Asset& asset, GlSceneOptions options);

  const asset::Asset& asset;
  scene::Box bounds;
  GlLimits limits;
  GlScene scene;
  std::optional<GlTarget> target;

  light::Environment environment;
  GlEnvironment environmentOnGpu;  ///< brought up to date when something shows it
  bool environmentStale = true;

  std::optional<light::Sun> sun;
  std::optional<shade::Air> air;
  bool airStale = false;                 ///< the scene has another, or shafts without a Sun
  bool hasLight = false, stale = false;  ///< stale: M · L is due
  int samples = 0;                       ///< of the picture, the one that is pending included
  bool background = false;               ///< of the last frame
  /// The frame that others may still draw into, and that is not yet in the sum.
  std::optional<GlView> pending;
  Mat4 clipFromWorld = Mat4::Identity();

  Status showEnvironment(const LiveView& view) {
    if (!environmentStale || !(view.background || scene.hasMirrors())) return Status::ok();
    if (Status s = environmentOnGpu.set(environment, limits.largestTexture); !s) return s;
    environmentStale = false;
    return Status::ok();
  }

  Status breathe() {
    if (airStale) {
      std::optional<shade::Air> seen = air;
      if (seen && !sun) seen->shafts.reset();
      if (Status s = scene.setAir(seen); !s) return s;
      airStale = false;
    }
    return Status::ok();
  }

  GlTarget::Around around(const GlView& view) const {
    GlTarget::Around around = view.unlit ? GlTarget::Around() : scene.around();
    if (view.background) around.background = &environmentOnGpu;
    return around;
  }

  void fold() {
    if (!pending) return;
    target->addToSum(*pending, around(*pending));
    pending.reset();
  }
};

LiveRenderer::LiveRenderer(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
LiveRenderer::LiveRenderer(LiveRenderer&&) noexcept = default;
LiveRenderer& LiveRenderer::operator=(LiveRenderer&&) noexcept = default;
LiveRenderer::~LiveRenderer() = default;

Result<LiveRenderer> LiveRenderer::make(const asset::Asset& asset, const shade::Showing& showing) {
  GlSceneOptions options;
  options.largestBlock = kLargestBlock;
  options.showing = showing;
  return Impl::make(asset, options);
}

Result<LiveRenderer> LiveRenderer::make(const asset::Asset& asset, const shade::Showing& showing,
                                        std::size_t largestBlock) {
  GlSceneOptions options;
  options.largestBlock = largestBlock;
  options.mirrorSide = kQuickMirrors;
  options.showing = showing;
  return Impl::make(asset, options);
}

/// Within what this OpenGL takes.
Result<LiveRenderer> LiveRenderer::Impl::make(const asset::Asset& asset, GlSceneOptions options) {
  if (Status s =
          shade::checkPicture(asset, sh::RgbCoefficients(1), {}, pictureOptions(options.showing));
      !s)
    return s.error();
  if (epoxy_gl_version() < 45)
    return report::failed(fmt::format(
        "this context has OpenGL {}.{}, but 4.5 is needed. Install a newer driver, or Mesa (on "
        "Debian: libgl1-mesa-dri)",
        epoxy_gl_version() / 10, epoxy_gl_version() % 10));
  const GlStateGuard guard;
  const GlLimits limits = limitsOfGl();
  options.largestBlock = std::min(options.largestBlock, limits.largestStorageBlock);
  options.largestTexture = limits.largestTexture;
  Result<GlScene> scene = GlScene::make(asset, options);
  if (!scene) return scene.error();
  return LiveRenderer(std::make_unique<Impl>(asset, limits, std::move(*scene)));
}

Status LiveRenderer::choose(const shade::Showing& showing) {
  if (Status s = shade::checkOptions(pictureOptions(showing)); !s) return s;
  if (Status s = shade::checkHeld(impl_->asset, showing); !s) return s;
  const GlStateGuard guard;
  if (Status s = impl_->scene.choose(showing); !s) return s;
  impl_->stale = impl_->hasLight;
  return Status::ok();
}

Status LiveRenderer::setEnvironment(const light::Environment& environment) {
  const GlStateGuard guard;
  impl_->fold();  // as it was seen
  impl_->environment = environment;
  impl_->environmentStale = true;
  impl_->scene.environmentChanged();
  return Status::ok();
}

Status LiveRenderer::setSun(const std::optional<shade::SharpSun>& sun) {
  const GlStateGuard guard;
  const std::optional<sh::RgbCoefficients> share = sun ? std::optional(sun->share) : std::nullopt;
  if (Status s = impl_->scene.setSunShare(share); !s) return s;
  if (impl_->air && impl_->sun.has_value() != sun.has_value()) impl_->airStale = true;
  impl_->sun = sun ? std::optional(sun->sun) : std::nullopt;
  impl_->stale = impl_->hasLight;
  return Status::ok();
}

Status LiveRenderer::setAir(const std::optional<shade::Air>& air) {
  shade::PictureOptions options;
  options.air = air;
  if (air) options.sun.emplace();  // setSun() says whether there is one
  if (Status s = shade::checkOptions(options); !s) return s;
  const GlStateGuard guard;
  impl_->fold();  // as it was seen
  impl_->air = air;
  impl_->airStale = true;
  return Status::ok();
}

void LiveRenderer::setLight(const sh::RgbCoefficients& assetLight) {
  assert(assetLight.bands >= 1 && assetLight.bands <= sh::kMaxBands);
  impl_->scene.setLight(assetLight);
  impl_->hasLight = impl_->stale = true;
}

Status LiveRenderer::setLightField(const capture::Blending& blending, unsigned lightBuffer,
                                   int bands) {
  const transfer::EncodedField& field = impl_->asset.transfer;
  if (bands < 1 || bands > sh::kMaxBands)
    return report::badUsage(
        fmt::format("a light field of {} bands: 1 to {} can be", bands, sh::kMaxBands));
  if (blending.meshes.size() != field.meshes.size())
    return report::badUsage(fmt::format("blending for {} meshes, but the asset has {}",
                                        blending.meshes.size(), field.meshes.size()));
  for (std::size_t m = 0; m < field.meshes.size(); ++m) {
    const transfer::Receivers* held = transfer::receiversOf(field.meshes[m]);
    const std::size_t receivers = held ? held->size() : 0;
    if (receivers > 0 && blending.meshes[m].size() != receivers)
      return report::badUsage(fmt::format("blending for {} receivers of mesh {}, which has {}",
                                          blending.meshes[m].size(), m, receivers));
    for (const capture::BlendWeights& weights : blending.meshes[m])
      for (int k = 0; k < 4; ++k)
        if (weights.weight[k] != 0.0f && weights.sample[k] >= blending.samples.size())
          return report::badUsage(fmt::format("blending names sample {}, but there are {}",
                                              weights.sample[k], blending.samples.size()));
  }
  GLint64 bytes = 0;
  if (!glIsBuffer(lightBuffer)) return report::badUsage("a light field without a buffer");
  glGetNamedBufferParameteri64v(lightBuffer, GL_BUFFER_SIZE, &bytes);
  const std::size_t needed =
      blending.samples.size() * 3 * std::size_t(sh::coefficientCount(bands)) * sizeof(float);
  if (std::size_t(bytes) < needed)
    return report::badUsage(
        fmt::format("a light field's buffer of {} bytes, where {} samples of {} bands take {}",
                    bytes, blending.samples.size(), bands, needed));
  const GlStateGuard guard;
  if (impl_->sun)
    if (Status s = setSun(std::nullopt); !s) return s;
  if (Status s = impl_->scene.setLightField(blending, lightBuffer, bands); !s) return s;
  impl_->hasLight = impl_->stale = true;
  return Status::ok();
}

void LiveRenderer::lightChanged() {
  impl_->stale = impl_->hasLight;
}

Status LiveRenderer::resize(int width, int height) {
  if (impl_->target && impl_->target->width() == width && impl_->target->height() == height)
    return Status::ok();
  const int largest = impl_->limits.largestTexture;
  if (width < 1 || height < 1 || width > largest || height > largest)
    return report::badUsage(fmt::format("a frame of {}×{} pixels: each side can be 1 to {} here",
                                        width, height, largest));
  Result<GlTarget> made = GlTarget::make(width, height);
  if (!made) return made.error();
  impl_->pending.reset();
  impl_->samples = 0;
  impl_->target = std::move(*made);
  return Status::ok();
}

void LiveRenderer::begin() {
  impl_->pending.reset();
  impl_->samples = 0;
  if (impl_->target) impl_->target->clearSum();
}

Status LiveRenderer::add(const LiveView& view, const Vec2& place, int samples) {
  if (!impl_->target) return report::badUsage("a frame without a size: call resize() first");
  if (Status s = checkView(view, impl_->air); !s) return s;
  const GlStateGuard guard;
  impl_->fold();
  if (Status s = impl_->breathe(); !s) return s;
  if (Status s = impl_->showEnvironment(view); !s) return s;
  if (impl_->stale && !view.unlit) {
    if (Status s = impl_->scene.relight(); !s) return s;
    impl_->stale = false;
  }

  const Mat4 assetFromWorld = view.worldFromAsset.inverse();
  scene::Camera camera = view.camera;
  camera.worldFromCamera = assetFromWorld * view.camera.worldFromCamera;
  scene::Box box = impl_->bounds;
  if (!view.others.empty()) {
    const scene::Box others = moved(view.others, assetFromWorld);
    box.extend(others.lower);
    box.extend(others.upper);
  }
  const GlTarget& target = *impl_->target;
  GlView seen = viewThrough(camera, target.width(), target.height(), box, place, samples);
  seen.environmentFromWorld =
      view.worldFromEnvironment.transpose() * view.worldFromAsset.topLeftCorner<3, 3>();
  seen.unlit = view.unlit;
  seen.seams = view.seams;
  seen.sample = impl_->samples;
  seen.background = view.background;
  if (impl_->sun && impl_->air && impl_->air->shafts && !view.unlit)
    seen.shafts = impl_->air->planes(camera, impl_->bounds);
  if (impl_->sun)
    seen.sun = light::pointsOf(*impl_->sun, samples)[std::size_t(impl_->samples % samples)];
  if (!view.unlit) {
    const GlScene::Surroundings surroundings{impl_->environmentOnGpu, seen.environmentFromWorld,
                                             impl_->sun};
    if (Status s = impl_->scene.captureMirrors(surroundings); !s) return s;
  }
  if (Status s = impl_->scene.mapSun(seen); !s) return s;
  if (Status s = impl_->target->prepare(impl_->around(seen)); !s) return s;
  target.beginFrame();
  impl_->scene.draw(seen, impl_->environmentOnGpu);
  impl_->clipFromWorld = seen.clipFromWorld * assetFromWorld;
  impl_->background = view.background;
  impl_->pending = seen;
  ++impl_->samples;
  return checkGl("drawing a frame");
}

unsigned LiveRenderer::framebuffer() const {
  return impl_->target ? impl_->target->framebuffer() : 0;
}

Mat4 LiveRenderer::clipFromWorld() const {
  return impl_->clipFromWorld;
}

Status LiveRenderer::show(unsigned framebuffer, float exposureEv, tone::Curve curve) const {
  if (!impl_->target) return report::badUsage("a frame without a size: call resize() first");
  const GlStateGuard guard;
  impl_->fold();
  impl_->target->show(impl_->samples, framebuffer, exposureEv, curve);
  return checkGl("showing a frame");
}

Result<image::Image> LiveRenderer::picture() const {
  if (!impl_->target || impl_->samples == 0)
    return report::badUsage("a picture of no frames: call add() first");
  const GlStateGuard guard;
  impl_->fold();
  if (impl_->background) return impl_->target->meanOverBackground(impl_->samples);
  Result<image::Image> image = impl_->target->mean(impl_->samples);
  if (image)
    for (Rgb& pixel : image->pixels) pixel = pixel.max(0.0f);
  return image;
}

}  // namespace lambent::render
