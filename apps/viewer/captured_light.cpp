#include "apps/viewer/captured_light.h"

#include "lambent/capture/blending.h"
#include "lambent/capture/sample_points.h"
#include "lambent/capture/surroundings.h"
#include "lambent/view/placement.h"

namespace lambent::viewer {

namespace {

/// All places of a body lie in a sphere about the middle of what it goes about.
void extendBy(scene::Box& box, const capture::Body& body) {
  scene::Box own;
  for (const Vec3& p : body.mesh.positions) own.extend(p);
  if (own.empty()) return;
  const Vec3 center = capture::worldFromBody(body.motion, 0).topRightCorner<3, 1>();
  const bool goesAbout = body.motion.orbit.period != 0;
  const Vec3 middle = goesAbout ? body.motion.orbit.center : center;
  const float reach = own.lower.cwiseAbs().cwiseMax(own.upper.cwiseAbs()).norm() +
                      body.motion.swing.amplitude.norm() +
                      (goesAbout ? (body.motion.place - middle).norm() : 0.0f);
  box.extend(middle - Vec3::Constant(reach));
  box.extend(middle + Vec3::Constant(reach));
}

}  // namespace

Status CapturedLight::attach(render::LiveRenderer& renderer, const asset::Asset& asset) {
  const capture::MovingScene scene =
      given_ ? *given_ : capture::demoSurroundings(scene::bounds(asset.scene));
  const capture::Blending blending =
      capture::blendOver(asset, capture::samplePoints(asset.scene, samples_).points);
  render::CaptureOptions options;
  options.bands = asset.transfer.bands;
  auto made = render::LightCapture::make(scene, blending.samples, options);
  if (!made) return made.error();
  if (Status s = renderer.setLightField(blending, made->lightBuffer(), made->bands()); !s) return s;
  capture_.emplace(std::move(*made));
  bounds_ = {};
  for (const capture::Body& body : scene.bodies) extendBy(bounds_, body);
  filled_.reset();
  return Status::ok();
}

Status CapturedLight::sampleAt(int points, render::LiveRenderer& renderer,
                               const asset::Asset& asset) {
  const int before = std::exchange(samples_, points);
  Status attached = attach(renderer, asset);
  if (!attached) samples_ = before;
  return attached;
}

Result<bool> CapturedLight::advance(render::LiveRenderer& renderer, const view::ViewState& state,
                                    const sh::RgbCoefficients& worldLight, double seconds) {
  time_ += seconds;
  Filled wanted{time_, view::worldFromAsset(state), worldLight.values};
  if (filled_ == wanted) return false;
  if (Status s = capture_->capture(time_, wanted.worldFromAsset, worldLight); !s) return s.error();
  renderer.lightChanged();
  filled_ = std::move(wanted);
  return true;
}

Status CapturedLight::draw(render::LiveRenderer& renderer, const PixelSize& size) {
  capture_->draw(renderer.framebuffer(), size.width, size.height, renderer.clipFromWorld(), time_);
  return Status::ok();
}

}  // namespace lambent::viewer
