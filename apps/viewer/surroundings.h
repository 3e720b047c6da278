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

  /// Another asset is shown from now on: where light is sampled, and renderer.setLightField(…).
  virtual Status attach(render::LiveRenderer& renderer, const asset::Asset& asset) = 0;
  /// Before a frame: moves on, fills the light buffer and calls renderer.lightChanged(). True if
  /// anything moved, so that the picture begins anew.
  virtual Result<bool> advance(render::LiveRenderer& renderer, const view::ViewState& state,
                               const light::Environment& environment) = 0;
  /// In the world, around everything that draw() may draw.
  virtual scene::Box bounds() const = 0;
  /// After a sample: adds what moves to renderer.framebuffer(), seen through `place` of the pixel.
  virtual Status draw(render::LiveRenderer& renderer, const render::LiveView& view,
                      const PixelSize& size, const Vec2& place) = 0;
};

}  // namespace lambent::viewer
