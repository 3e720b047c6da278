#include "lambent/render/gl_marks.h"

#include <string>
#include <vector>

#include "lambent/render/gl_state.h"
#include "lambent/render/gl_view.h"
#include "lambent/render/shader_sources.h"

namespace lambent::render {
namespace {

/// As mark.vert.glsl has it.
struct PackedMark {
  float from[3], red;
  float to[3], green;
  float normal[3], blue;
  float radii[4];
};

}  // namespace

Result<GlMarks> GlMarks::make(std::span<const Mark> marks) {
  const std::string common(shaderSource("mark.glsl"));
  const Program::Stage stages[] = {
      {GL_VERTEX_SHADER, "mark.vert.glsl", {common, std::string(shaderSource("mark.vert.glsl"))}},
      {GL_FRAGMENT_SHADER,
       "mark.frag.glsl",
       {common, std::string(shaderSource("mark.frag.glsl"))}}};
  Result<Program> program = Program::make(stages);
  if (!program) return program.error();
  GlMarks made;
  made.program_ = std::move(*program);
  std::vector<PackedMark> packed;
  for (const auto& [from, to, normal, color, radii] : marks)
    packed.push_back({{from.x(), from.y(), from.z()},
                      color[0],
                      {to.x(), to.y(), to.z()},
                      color[1],
                      {normal.x(), normal.y(), normal.z()},
                      color[2],
                      {radii.x(), radii.y(), 0.0f, 0.0f}});
  made.marks_ = makeBuffer(packed);
  made.count_ = int(packed.size());
  GLuint name = 0;
  glCreateVertexArrays(1, &name);
  made.noAttributes_ = VertexArray(name);
  if (Status s = checkGl("uploading marks"); !s) return s.error();
  return made;
}

void GlMarks::draw(GLuint framebuffer, int width, int height, const MarkView& view) const {
  if (count_ == 0) return;
  const GlStateGuard guard;
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  glViewport(0, 0, width, height);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LEQUAL);
  glDepthMask(GL_FALSE);
  // Clip space is 2·w high, in which the second row says how long a metre is.
  const float upwards = view.clipFromSurface.row(1).head<3>().norm();
  program_.use();
  program_.setMatrix("clipFromSurface", view.clipFromSurface.data());
  const auto eye = eyeOf(view.camera);
  program_.set("eye", eye.x(), eye.y(), eye.z(), eye.w());
  program_.set("size", float(width), float(height));
  program_.set("pixel", 2.0f / (upwards * float(height)));
  program_.set("brightness", view.brightness);
  glBindVertexArray(noAttributes_.name());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, marks_.name());
  glDrawArrays(GL_TRIANGLES, 0, 6 * count_);
}

}  // namespace lambent::render
