#include "apps/viewer/captured_light.h"

#include "lambent/capture/blending.h"
#include "lambent/capture/sample_points.h"
#include "lambent/capture/surroundings.h"
#include "lambent/view/placement.h"

namespace lambent::viewer {

Status CapturedLight::attach(render::LiveRenderer& renderer, const asset::Asset& asset) {
  capture::MovingScene scene = given_ ? capture::about(*given_, asset.scene.origin)
                                      : capture::demoSurroundings(scene::bounds(asset.scene));
  const capture::Blending blending =
      capture::blendOver(asset, capture::samplePoints(asset.scene, samples_).points);
  render::CaptureOptions options;
  options.bands = asset.transfer.bands;
  auto made = render::LightCapture::make(scene, blending.samples, options);
  if (!made) return made.error();
  if (Status s = renderer.setLightField(blending, made->lightBuffer(), made->bands()); !s) return s;
  capture_.emplace(std::move(*made));
  scene_ = std::move(scene);
  captured_.reset();
  return Status::ok();
}

Result<bool> CapturedLight::light(render::LiveRenderer& renderer, const view::ViewState& state,
                                  const sh::RgbCoefficients& worldLight) {
  const Mat4 worldFromAsset = view::worldFromAsset(state);
  if (captured_ && captured_->time == time_ && captured_->worldFromAsset == worldFromAsset &&
      captured_->worldLight == worldLight.values)
    return false;
  if (Status s = capture_->capture(time_, worldFromAsset, worldLight); !s) return s.error();
  renderer.lightChanged();
  captured_ = Conditions{time_, worldFromAsset, worldLight.values};
  return true;
}

Status CapturedLight::draw(render::LiveRenderer& renderer, const PixelSize& size) {
  capture_->draw(renderer.framebuffer(), size.width, size.height, renderer.clipFromWorld(), time_);
  return Status::ok();
}

}  // namespace lambent::viewer
