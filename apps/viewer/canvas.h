// Where a frame is put together before it goes to the window: the picture, and the panel beside and
// over it. It can be read back, in a hidden window too.
#pragma once

#include "apps/viewer/gl_window.h"
#include "lambent/image/image.h"
#include "lambent/render/gl_objects.h"
#include "lambent/report/result.h"

namespace lambent::viewer {

class Canvas {
 public:
  /// Of the window and of the picture in its upper left corner; nothing happens if they are so
  /// already.
  Status resize(const PixelSize& window, const PixelSize& picture);
  unsigned pictureFramebuffer() const { return picture_.framebuffer.name(); }
  /// Puts the picture (or `shown` = false: grey) on the canvas, and makes it what is drawn to.
  void beginOver(bool shown);
  void toWindow() const;
  /// What stands on it, as linear values whose sRGB coding is what was drawn.
  image::Image read() const;

 private:
  struct Sheet {
    PixelSize size;
    render::Texture color;
    render::Framebuffer framebuffer;
    void make(const PixelSize& wanted);
  };
  Sheet window_, picture_;
};

}  // namespace lambent::viewer
