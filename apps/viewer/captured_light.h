// Lamps and occluders that move around the asset: its light is captured from them in every frame,
// at a few points of its surface, on the GPU (sloan2002precomputed §6.1, §6.2).
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "apps/viewer/surroundings.h"
#include "lambent/capture/moving_scene.h"
#include "lambent/render/gl_capture.h"

namespace lambent::viewer {

class CapturedLight final : public Surroundings {
 public:
  /// The lamps of capture::demoSurroundings, fitted to whatever asset is shown.
  explicit CapturedLight(int samples) : samples_(samples) {}
  CapturedLight(capture::MovingScene scene, int samples)
      : given_(std::move(scene)), samples_(samples) {}

  Status attach(render::LiveRenderer& renderer, const asset::Asset& asset) override;
  void elapse(double seconds) override { time_ += seconds; }
  Result<bool> light(render::LiveRenderer& renderer, const view::ViewState& state,
                     const sh::RgbCoefficients& worldLight) override;
  scene::Box bounds() const override { return capture::bounds(scene_, time_); }
  Status draw(render::LiveRenderer& renderer, const PixelSize& size) override;
  int samples() const override { return samples_; }
  void setSamples(int count) override { samples_ = count; }

 private:
  /// What the light depends on.
  struct Conditions {
    double time = 0;
    Mat4 worldFromAsset;
    std::vector<float> worldLight;
  };

  std::optional<capture::MovingScene> given_;  ///< none: the demonstration
  capture::MovingScene scene_;
  int samples_;
  double time_ = 0;
  std::optional<render::LightCapture> capture_;
  std::optional<Conditions> captured_;
};

}  // namespace lambent::viewer
