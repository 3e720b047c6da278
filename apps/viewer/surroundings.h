// The seam for what moves around the asset: lamps and occluders that light it from near and are
// seen beside it.
#pragma once

#include "apps/viewer/gl_window.h"
#include "lambent/asset/asset.h"
#include "lambent/render/live_renderer.h"
#include "lambent/view/view_state.h"

namespace lambent::viewer {

class Surroundings {
 public:
  virtual ~Surroundings() = default;

  /// Another asset is shown from now on, by this renderer: chooses where its light is sampled.
  virtual Status attach(render::LiveRenderer& renderer, const asset::Asset& asset) = 0;
  /// Time goes on, in seconds.
  virtual void elapse(double seconds) = 0;
  /// Before a frame: lights the asset as things stand. `worldLight`: the distant light, in the
  /// world. True if anything has changed since the last call, so that the picture begins anew.
  virtual Result<bool> light(render::LiveRenderer& renderer, const view::ViewState& state,
                             const sh::RgbCoefficients& worldLight) = 0;
  /// In the world, of all that moves as it stands.
  virtual scene::Box bounds() const = 0;
  /// After a sample: adds what moves to renderer.framebuffer(), as renderer.clipFromWorld() has it.
  virtual Status draw(render::LiveRenderer& renderer, const PixelSize& size) = 0;

  /// At how many points of the asset light is sampled. Another number takes effect at the next
  /// attach().
  virtual int samples() const = 0;
  virtual void setSamples(int count) = 0;
};

}  // namespace lambent::viewer
