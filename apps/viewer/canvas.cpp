#include "apps/viewer/canvas.h"

#include <epoxy/gl.h>

#include "lambent/radiometry/srgb.h"

namespace lambent::viewer {

void Canvas::Sheet::make(const PixelSize& wanted) {
  if (wanted == size) return;
  size = wanted;
  color = render::makeTexture(GL_RGBA8, size.width, size.height);
  GLuint name = 0;
  glCreateFramebuffers(1, &name);
  framebuffer = render::Framebuffer(name);
  glNamedFramebufferTexture(name, GL_COLOR_ATTACHMENT0, color.name(), 0);
}

Status Canvas::resize(const PixelSize& window, const PixelSize& picture) {
  window_.make(window);
  picture_.make(picture);
  return render::checkGl("making room for the window");
}

void Canvas::beginOver(bool shown) {
  const float grey[] = {0.075f, 0.078f, 0.085f, 1.0f};
  glClearNamedFramebufferfv(window_.framebuffer.name(), GL_COLOR, 0, grey);
  const auto [width, height] = picture_.size;
  const int top = window_.size.height;
  if (shown)
    glBlitNamedFramebuffer(picture_.framebuffer.name(), window_.framebuffer.name(), 0, 0, width,
                           height, 0, top - height, width, top, GL_COLOR_BUFFER_BIT, GL_NEAREST);
  glBindFramebuffer(GL_FRAMEBUFFER, window_.framebuffer.name());
  glViewport(0, 0, window_.size.width, window_.size.height);
}

void Canvas::toWindow() const {
  const auto [width, height] = window_.size;
  glBlitNamedFramebuffer(window_.framebuffer.name(), 0, 0, 0, width, height, 0, 0, width, height,
                         GL_COLOR_BUFFER_BIT, GL_NEAREST);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

image::Image Canvas::read() const {
  const auto [width, height] = window_.size;
  std::vector<unsigned char> bytes(4 * std::size_t(width) * std::size_t(height));
  glBindFramebuffer(GL_READ_FRAMEBUFFER, window_.framebuffer.name());
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, bytes.data());
  glBindFramebuffer(GL_READ_FRAMEBUFFER, 0);
  image::Image image(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < 3; ++c) {
        const std::size_t at =
            4 * (std::size_t(height - 1 - y) * std::size_t(width) + std::size_t(x));
        image.at(x, y)[c] = radiometry::srgbDecode(float(bytes[at + std::size_t(c)]) / 255.0f);
      }
  return image;
}

}  // namespace lambent::viewer
