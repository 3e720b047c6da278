// Lamps and occluders that move around the asset: its light is captured from them in every frame,
// at a few points of its surface, on the GPU (sloan2002precomputed §6.1, §6.2).
#pragma once

#include <optional>
#include <utility>

#include "apps/viewer/surroundings.h"
#include "lambent/capture/moving_scene.h"
#include "lambent/render/gl_capture.h"

namespace lambent::viewer {

class CapturedLight final : public Surroundings {
 public:
  /// The lamps of capture::demoSurroundings, fitted to whatever asset is shown.
  explicit CapturedLight(int samples) : samples_(samples) {}
  /// Those of a scene. 1 … 64 points to sample light at.
  CapturedLight(capture::MovingScene scene, int samples)
      : given_(std::move(scene)), samples_(samples) {}

  Status attach(render::LiveRenderer& renderer, const asset::Asset& asset) override;
  Status sampleAt(int points, render::LiveRenderer& renderer, const asset::Asset& asset) override;
  int samples() const override { return samples_; }
  Result<bool> advance(render::LiveRenderer& renderer, const view::ViewState& state,
                       const sh::RgbCoefficients& worldLight, double seconds) override;
  scene::Box bounds() const override { return bounds_; }
  Status draw(render::LiveRenderer& renderer, const PixelSize& size) override;

 private:
  std::optional<capture::MovingScene> given_;
  std::optional<render::LightCapture> capture_;
  scene::Box bounds_;  ///< of all places that bodies come to
  int samples_ = 8;
  double time_ = 0;
  /// What the light buffer is filled for.
  struct Filled {
    double time;
    Mat4 worldFromAsset;
    std::vector<float> worldLight;
    bool operator==(const Filled&) const = default;
  };
  std::optional<Filled> filled_;
};

}  // namespace lambent::viewer
