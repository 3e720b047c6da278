#include "lambent/render/gl_target.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "lambent/render/shader_sources.h"

namespace lambent::render {
namespace {

Result<Program> showProgram() {
  const Program::Stage stages[] = {
      {GL_VERTEX_SHADER, "show.vert.glsl", {std::string(shaderSource("show.vert.glsl"))}},
      {GL_FRAGMENT_SHADER,
       "show.frag.glsl",
       {std::string(shaderSource("tone.glsl")), std::string(shaderSource("show.frag.glsl"))}}};
  return Program::make(stages);
}

/// Calls pixel(x, y, rgba) for every texel, y from the top. GL's rows begin at the bottom.
template <class Pixel>
void readBack(const Texture& texture, int width, int height, Pixel pixel) {
  const int strip = std::max(1, std::min(height, (1 << 22) / width));  // GL counts bytes in an int
  std::vector<float> pixels(std::size_t(width) * strip * 4);
  for (int first = 0; first < height; first += strip) {
    const int rows = std::min(strip, height - first);
    glGetTextureSubImage(texture.name(), 0, 0, first, 0, width, rows, 1, GL_RGBA, GL_FLOAT,
                         GLsizei(pixels.size() * sizeof(float)), pixels.data());
    const float* from = pixels.data();
    for (int y = height - 1 - first; y > height - 1 - first - rows; --y)
      for (int x = 0; x < width; ++x, from += 4) pixel(x, y, from);
  }
}

}  // namespace

Result<GlTarget> GlTarget::make(int width, int height) {
  GlTarget target;
  target.width_ = width;
  target.height_ = height;
  target.color_ = makeTexture(GL_RGBA32F, width, height);
  target.depth_ = makeTexture(GL_DEPTH_COMPONENT32F, width, height);
  target.sum_ = makeTexture(GL_RGBA32F, width, height);
  target.behind_ = makeTexture(GL_RGBA32F, width, height);
  GLuint name = 0;
  glCreateFramebuffers(1, &name);
  target.framebuffer_ = Framebuffer(name);
  glNamedFramebufferTexture(name, GL_COLOR_ATTACHMENT0, target.color_.name(), 0);
  glNamedFramebufferTexture(name, GL_DEPTH_ATTACHMENT, target.depth_.name(), 0);
  if (Status s = checkGl("making the picture's targets"); !s) return s.error();
  const GLenum complete = glCheckNamedFramebufferStatus(name, GL_DRAW_FRAMEBUFFER);
  if (complete != GL_FRAMEBUFFER_COMPLETE)
    return report::failed(fmt::format(
        "this OpenGL does not draw into 32-bit float targets (status {:#x})", complete));
  GLuint vertexArray = 0;
  glCreateVertexArrays(1, &vertexArray);
  target.noAttributes_ = VertexArray(vertexArray);
  if (Status s = target.prepare({}); !s) return s.error();
  Result<Program> program = showProgram();
  if (!program) return program.error();
  target.show_ = std::move(*program);
  target.clearSum();
  return target;
}

void GlTarget::beginFrame() const {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
  glViewport(0, 0, width_, height_);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  const float black[4] = {}, far = 1.0f;
  glClearNamedFramebufferfv(framebuffer_.name(), GL_COLOR, 0, black);
  glClearNamedFramebufferfv(framebuffer_.name(), GL_DEPTH, 0, &far);
}

GlTarget::Kind GlTarget::kindOf(const Around& around) {
  return {around.background != nullptr, around.air != nullptr,
          around.air && around.air->hasShafts()};
}

Status GlTarget::prepare(const Around& around) {
  const Kind kind = kindOf(around);
  if (accumulate_.contains(kind)) return Status::ok();
  std::vector<std::string> parts = {
      fmt::format("#define LAMBENT_BACKGROUND {:d}\n#define LAMBENT_AIR {:d}\n", kind.background,
                  kind.air),
  };
  if (kind.air) parts.push_back(airSource(kind.shafts));
  if (kind.background) parts.push_back(environmentSource());
  parts.emplace_back(shaderSource("accumulate.comp.glsl"));
  const Program::Stage stage{GL_COMPUTE_SHADER, "accumulate.comp.glsl", std::move(parts)};
  Result<Program> program = Program::make({&stage, 1});
  if (!program) return program.error();
  accumulate_.emplace(kind, std::move(*program));
  return Status::ok();
}

void GlTarget::clearSum() const {
  const float zero[4] = {};
  glClearTexImage(sum_.name(), 0, GL_RGBA, GL_FLOAT, zero);
  glClearTexImage(behind_.name(), 0, GL_RGBA, GL_FLOAT, zero);
}

void GlTarget::addToSum(const GlView& view, const Around& around) {
  glMemoryBarrier(GL_FRAMEBUFFER_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
  const Kind kind = kindOf(around);
  const bool curtain = kind.shafts && view.background;
  cutLast_ = curtain;
  const Program& program = accumulate_.at(kind);
  glBindImageTexture(0, color_.name(), 0, GL_FALSE, 0, GL_READ_ONLY, GL_RGBA32F);
  glBindImageTexture(1, sum_.name(), 0, GL_FALSE, 0, GL_READ_WRITE, GL_RGBA32F);
  if (kind.background) {
    glBindImageTexture(2, behind_.name(), 0, GL_FALSE, 0, GL_READ_WRITE, GL_RGBA32F);
    around.background->bind(program, view.environmentFromWorld);
  }
  if (kind.air) {
    around.air->bind(program, view, around.sunMap);
    program.set("from", view.eye.x(), view.eye.y(), view.eye.z());
    if (kind.shafts) program.set("curtain", int(curtain));
  }
  if (kind.background || kind.air) {
    program.set("corner", view.corner.x(), view.corner.y(), view.corner.z());
    program.set("right", view.right.x(), view.right.y(), view.right.z());
    program.set("up", view.up.x(), view.up.y(), view.up.z());
  }
  program.use();
  glDispatchCompute(GLuint(width_ + 7) / 8, GLuint(height_ + 7) / 8, 1);
  glMemoryBarrier(GL_FRAMEBUFFER_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT |
                  GL_TEXTURE_UPDATE_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT);
}

Result<image::Image> GlTarget::mean(int samples) const {
  image::Image image(width_, height_);
  image.alpha.resize(image.pixels.size());
  const float count = float(samples);
  readBack(sum_, width_, height_, [&](int x, int y, const float* sum) {
    image.at(x, y) = Rgb(sum[0], sum[1], sum[2]) / count;
    image.alpha[std::size_t(y) * width_ + x] = sum[3] / count;
  });
  if (Status s = checkGl("reading the picture back"); !s) return s.error();
  return image;
}

Result<image::Image> GlTarget::meanOverBackground(int samples) const {
  Result<image::Image> image = mean(samples);
  if (!image) return image;
  const auto cut = [&] {
    for (Rgb& pixel : image->pixels) pixel = pixel.max(0.0f);
  };
  if (!cutLast_) cut();
  readBack(behind_, width_, height_, [&](int x, int y, const float* sum) {
    if (sum[3] > 0.0f)
      image->at(x, y) +=
          (1.0f - image->alpha[std::size_t(y) * width_ + x]) / sum[3] * Rgb(sum[0], sum[1], sum[2]);
  });
  cut();
  image->alpha.clear();
  if (Status s = checkGl("reading the picture back"); !s) return s.error();
  return image;
}

void GlTarget::show(int samples, GLuint framebuffer, float exposureEv, tone::Curve curve) const {
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
  glViewport(0, 0, width_, height_);
  glDisable(GL_DEPTH_TEST);
  show_.set("share", 1.0f / float(std::max(samples, 1)));
  show_.set("exposure", std::exp2(exposureEv));
  show_.set("cutLast", int(cutLast_));
  show_.set("filmicCurve", int(curve == tone::Curve::Filmic));
  glBindTextureUnit(0, sum_.name());
  glBindTextureUnit(1, behind_.name());
  glBindVertexArray(noAttributes_.name());
  show_.use();
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

}  // namespace lambent::render
