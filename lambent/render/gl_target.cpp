#include "lambent/render/gl_target.h"

#include <algorithm>

#include <fmt/format.h>

#include "lambent/render/shader_sources.h"

namespace lambent::render {

Result<GlTarget> GlTarget::make(int width, int height) {
  GlTarget target;
  target.width = width;
  target.height = height;
  target.color = makeTexture(GL_RGBA32F, width, height);
  target.depth = makeTexture(GL_DEPTH_COMPONENT32F, width, height);
  target.sum = makeTexture(GL_RGBA32F, width, height);
  GLuint name = 0;
  glCreateFramebuffers(1, &name);
  target.framebuffer = Framebuffer(name);
  glNamedFramebufferTexture(name, GL_COLOR_ATTACHMENT0, target.color.name(), 0);
  glNamedFramebufferTexture(name, GL_DEPTH_ATTACHMENT, target.depth.name(), 0);
  if (Status s = checkGl("making the picture's targets"); !s) return s.error();
  const GLenum complete = glCheckNamedFramebufferStatus(name, GL_DRAW_FRAMEBUFFER);
  if (complete != GL_FRAMEBUFFER_COMPLETE)
    return report::failed(fmt::format(
        "this OpenGL does not draw into 32-bit float targets (status {:#x})", complete));
  const Program::Stage stage{GL_COMPUTE_SHADER,
                             "accumulate.comp.glsl",
                             {std::string(shaderSource("accumulate.comp.glsl"))}};
  Result<Program> program = Program::make({&stage, 1});
  if (!program) return program.error();
  target.accumulate = std::move(*program);
  target.clearSum();
  return target;
}

void GlTarget::clear() const {
  const float black[4] = {}, far = 1.0f;
  glClearNamedFramebufferfv(framebuffer.name(), GL_COLOR, 0, black);
  glClearNamedFramebufferfv(framebuffer.name(), GL_DEPTH, 0, &far);
}

void GlTarget::clearSum() const {
  const float zero[4] = {};
  glClearTexImage(sum.name(), 0, GL_RGBA, GL_FLOAT, zero);
}

void GlTarget::addToSum() const {
  glMemoryBarrier(GL_FRAMEBUFFER_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
  accumulate.use();
  glBindImageTexture(0, color.name(), 0, GL_FALSE, 0, GL_READ_ONLY, GL_RGBA32F);
  glBindImageTexture(1, sum.name(), 0, GL_FALSE, 0, GL_READ_WRITE, GL_RGBA32F);
  glDispatchCompute(GLuint(width + 7) / 8, GLuint(height + 7) / 8, 1);
  glMemoryBarrier(GL_FRAMEBUFFER_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT |
                  GL_TEXTURE_UPDATE_BARRIER_BIT);
}

// GL's rows begin at the bottom.
Result<image::Image> GlTarget::mean(int samples) const {
  image::Image image(width, height);
  image.alpha.resize(image.pixels.size());
  const float count = float(samples);
  const int strip = std::max(1, std::min(height, (1 << 22) / width));  // GL counts bytes in an int
  std::vector<float> pixels(std::size_t(width) * strip * 4);
  for (int first = 0; first < height; first += strip) {
    const int rows = std::min(strip, height - first);
    glGetTextureSubImage(sum.name(), 0, 0, first, 0, width, rows, 1, GL_RGBA, GL_FLOAT,
                         GLsizei(pixels.size() * sizeof(float)), pixels.data());
    const float* from = pixels.data();
    for (int y = height - 1 - first; y > height - 1 - first - rows; --y) {
      for (int x = 0; x < width; ++x, from += 4) {
        image.at(x, y) = Rgb(from[0], from[1], from[2]) / count;
        image.alpha[std::size_t(y) * width + x] = from[3] / count;
      }
    }
  }
  if (Status s = checkGl("reading the picture back"); !s) return s.error();
  return image;
}

}  // namespace lambent::render
