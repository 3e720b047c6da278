#include "lambent/render/gl_state.h"

#include <cstddef>

namespace lambent::render {

GlStateGuard::GlStateGuard() {
  for (std::size_t i = 0; i < kSwitches.size(); ++i) on_[i] = glIsEnabled(kSwitches[i]);
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &drawFramebuffer_);
  glGetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &readFramebuffer_);
  glGetIntegerv(GL_CURRENT_PROGRAM, &program_);
  glGetIntegerv(GL_VERTEX_ARRAY_BINDING, &vertexArray_);
  glGetIntegerv(GL_VIEWPORT, viewport_);
  glGetIntegerv(GL_POLYGON_MODE, polygonMode_);
  glGetIntegerv(GL_DEPTH_FUNC, &depthFunction_);
  glGetIntegerv(GL_FRONT_FACE, &frontFace_);
  glGetIntegerv(GL_CULL_FACE_MODE, &culled_);
  glGetIntegerv(GL_CLIP_ORIGIN, &clipOrigin_);
  glGetIntegerv(GL_CLIP_DEPTH_MODE, &clipDepth_);
  glGetIntegerv(GL_ACTIVE_TEXTURE, &activeTexture_);
  glGetDoublev(GL_DEPTH_RANGE, depthRange_);
  glGetBooleanv(GL_DEPTH_WRITEMASK, &depthMask_);
  glGetBooleanv(GL_COLOR_WRITEMASK, colorMask_);

  for (const GLenum which : kSwitches) glDisable(which);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  glDepthMask(GL_TRUE);
  glDepthRange(0.0, 1.0);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
  glClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
  for (GLuint unit = 0; unit < 7; ++unit) glBindSampler(unit, 0);
}

GlStateGuard::~GlStateGuard() {
  for (std::size_t i = 0; i < kSwitches.size(); ++i) (on_[i] ? glEnable : glDisable)(kSwitches[i]);
  // What was deleted while it was in use is no more, now that it was put aside.
  const auto known = [](GLint name, GLboolean there) { return there ? GLuint(name) : 0u; };
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER,
                    known(drawFramebuffer_, glIsFramebuffer(GLuint(drawFramebuffer_))));
  glBindFramebuffer(GL_READ_FRAMEBUFFER,
                    known(readFramebuffer_, glIsFramebuffer(GLuint(readFramebuffer_))));
  glUseProgram(known(program_, glIsProgram(GLuint(program_))));
  glBindVertexArray(known(vertexArray_, glIsVertexArray(GLuint(vertexArray_))));
  glViewport(viewport_[0], viewport_[1], viewport_[2], viewport_[3]);
  glPolygonMode(GL_FRONT_AND_BACK, GLenum(polygonMode_[0]));
  glDepthFunc(GLenum(depthFunction_));
  glFrontFace(GLenum(frontFace_));
  glCullFace(GLenum(culled_));
  glClipControl(GLenum(clipOrigin_), GLenum(clipDepth_));
  glActiveTexture(GLenum(activeTexture_));
  glDepthRange(depthRange_[0], depthRange_[1]);
  glDepthMask(depthMask_);
  glColorMask(colorMask_[0], colorMask_[1], colorMask_[2], colorMask_[3]);
}

}  // namespace lambent::render
