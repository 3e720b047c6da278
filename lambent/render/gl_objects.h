// OpenGL objects that are deleted when their owner goes, made with direct state access. A context
// must be current, and outlive them.
#pragma once

#include <atomic>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <epoxy/gl.h>

#include "lambent/math/types.h"
#include "lambent/report/result.h"

namespace lambent::render {

/// The name of an object, with the call that deletes it.
template <class Delete>
class GlObject {
 public:
  GlObject() = default;
  explicit GlObject(GLuint name) : name_(name) {
    if (name_) ++alive_;
  }
  GlObject(GlObject&& other) noexcept : name_(std::exchange(other.name_, 0)) {}
  GlObject& operator=(GlObject&& other) noexcept {
    std::swap(name_, other.name_);
    return *this;
  }
  ~GlObject() {
    if (!name_) return;
    Delete()(name_);
    --alive_;
  }
  GLuint name() const { return name_; }
  /// How many of this kind there are in the process: what a soak watches.
  static long alive() { return alive_; }

 private:
  static inline std::atomic<long> alive_ = 0;
  GLuint name_ = 0;
};

struct DeleteBuffer {
  void operator()(GLuint name) const { glDeleteBuffers(1, &name); }
};
struct DeleteTexture {
  void operator()(GLuint name) const { glDeleteTextures(1, &name); }
};
struct DeleteFramebuffer {
  void operator()(GLuint name) const { glDeleteFramebuffers(1, &name); }
};
struct DeleteVertexArray {
  void operator()(GLuint name) const { glDeleteVertexArrays(1, &name); }
};
struct DeleteShader {
  void operator()(GLuint name) const { glDeleteShader(name); }
};
struct DeleteProgram {
  void operator()(GLuint name) const { glDeleteProgram(name); }
};

using Buffer = GlObject<DeleteBuffer>;
using Texture = GlObject<DeleteTexture>;
using Framebuffer = GlObject<DeleteFramebuffer>;
using VertexArray = GlObject<DeleteVertexArray>;

/// Immutable storage of `bytes` (at least 4), filled from `data` if given.
Buffer makeBuffer(std::size_t bytes, const void* data = nullptr);
/// The same, for what glNamedBufferSubData will write again and again.
Buffer makeChangingBuffer(std::size_t bytes);
template <class T>
Buffer makeBuffer(const std::vector<T>& values) {
  return makeBuffer(values.size() * sizeof(T), values.data());
}
/// One level, no filtering: shaders fetch texels.
Texture makeTexture(GLenum format, int width, int height);

/// GL's errors since the last call, if any, as "`doing`: GL_OUT_OF_MEMORY …".
Status checkGl(std::string_view doing);

/// What the current context takes.
struct GlLimits {
  std::size_t largestStorageBlock = 0;  ///< bytes of one shader storage buffer
  int largestTexture = 0;               ///< side, in texels
};
GlLimits limitsOfGl();

class Program {
 public:
  struct Stage {
    GLenum kind;  ///< GL_VERTEX_SHADER, …
    std::string_view name;
    std::vector<std::string> parts;  ///< joined, after the #version line
  };
  /// Compiles and links; the compiler's words are in the error.
  static Result<Program> make(std::span<const Stage> stages);

  void use() const { glUseProgram(program_.name()); }
  void set(const char* uniform, int value) const;
  void set(const char* uniform, unsigned value) const;
  void set(const char* uniform, int x, int y) const;
  void set(const char* uniform, int x, int y, int z) const;
  void set(const char* uniform, int x, int y, int z, int w) const;
  void set(const char* uniform, float value) const;
  void set(const char* uniform, float x, float y) const;
  void set(const char* uniform, float x, float y, float z) const;
  void set(const char* uniform, float x, float y, float z, float w) const;
  void setMatrix(const char* uniform, const float* columnMajor) const;  ///< 4×4
  void setMatrix(const char* uniform, const Mat3& matrix) const;

 private:
  int location(const char* uniform) const;
  GlObject<DeleteProgram> program_;
};

}  // namespace lambent::render
