// OpenGL's state is shared with whoever draws into the same window (Dear ImGui): what a frame
// depends on is set, and given back as it was.
#pragma once

#include <array>

#include <epoxy/gl.h>

namespace lambent::render {

/// Sets what drawing opaque surfaces depends on; gives it back when it goes: framebuffers,
/// viewport, program, vertex array, depth, front and culled face, masks, and the switches that are
/// turned off here. Bindings of textures, images and storage buffers are not given back.
class GlStateGuard {
 public:
  GlStateGuard();
  ~GlStateGuard();
  GlStateGuard(const GlStateGuard&) = delete;
  GlStateGuard& operator=(const GlStateGuard&) = delete;

 private:
  static constexpr std::array<GLenum, 16> kSwitches = {
      GL_BLEND,          GL_CULL_FACE,         GL_DEPTH_TEST,          GL_SCISSOR_TEST,
      GL_STENCIL_TEST,   GL_COLOR_LOGIC_OP,    GL_FRAMEBUFFER_SRGB,    GL_RASTERIZER_DISCARD,
      GL_DEPTH_CLAMP,    GL_PRIMITIVE_RESTART, GL_POLYGON_OFFSET_FILL, GL_DITHER,
      GL_CLIP_DISTANCE0, GL_CLIP_DISTANCE1,    GL_CLIP_DISTANCE2,      GL_CLIP_DISTANCE3};
  std::array<GLboolean, kSwitches.size()> on_{};
  GLint drawFramebuffer_ = 0, readFramebuffer_ = 0, program_ = 0, vertexArray_ = 0;
  GLint viewport_[4] = {}, polygonMode_[2] = {}, depthFunction_ = 0, frontFace_ = 0, culled_ = 0;
  GLint clipOrigin_ = 0, clipDepth_ = 0, activeTexture_ = 0;
  GLdouble depthRange_[2] = {};
  GLboolean depthMask_ = 0, colorMask_[4] = {};
};

}  // namespace lambent::render
