#include "lambent/render/gl_objects.h"

#include <algorithm>

#include <fmt/format.h>

namespace lambent::render {

Buffer makeBuffer(std::size_t bytes, const void* data) {
  GLuint name = 0;
  glCreateBuffers(1, &name);
  Buffer buffer(name);
  // A multiple of four bytes, because shaders read words; and never empty, which GL refuses.
  const std::size_t whole = std::max<std::size_t>((bytes + 3) / 4 * 4, 4);
  const bool exact = whole == bytes;
  glNamedBufferStorage(name, GLsizeiptr(whole), exact ? data : nullptr,
                       exact ? 0 : GL_DYNAMIC_STORAGE_BIT);
  if (!exact && data && bytes > 0) glNamedBufferSubData(name, 0, GLsizeiptr(bytes), data);
  return buffer;
}

Buffer makeChangingBuffer(std::size_t bytes) {
  GLuint name = 0;
  glCreateBuffers(1, &name);
  Buffer buffer(name);
  glNamedBufferStorage(name, GLsizeiptr(std::max<std::size_t>(bytes, 4)), nullptr,
                       GL_DYNAMIC_STORAGE_BIT);
  return buffer;
}

Texture makeTexture(GLenum format, int width, int height) {
  GLuint name = 0;
  glCreateTextures(GL_TEXTURE_2D, 1, &name);
  Texture texture(name);
  glTextureStorage2D(name, 1, format, width, height);
  glTextureParameteri(name, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTextureParameteri(name, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  return texture;
}

Status checkGl(std::string_view doing) {
  std::string names;
  for (GLenum code = glGetError(); code != GL_NO_ERROR; code = glGetError()) {
    if (!names.empty()) names += ", ";
    switch (code) {
      case GL_OUT_OF_MEMORY:
        names += "out of memory";
        break;
      case GL_INVALID_ENUM:
        names += "GL_INVALID_ENUM";
        break;
      case GL_INVALID_VALUE:
        names += "GL_INVALID_VALUE";
        break;
      case GL_INVALID_OPERATION:
        names += "GL_INVALID_OPERATION";
        break;
      case GL_INVALID_FRAMEBUFFER_OPERATION:
        names += "GL_INVALID_FRAMEBUFFER_OPERATION";
        break;
      default:
        names += fmt::format("error {:#x}", code);
    }
    if (code == GL_CONTEXT_LOST) break;
  }
  if (names.empty()) return Status::ok();
  return report::failed(fmt::format("OpenGL, {}: {}", doing, names));
}

GlLimits limitsOfGl() {
  GLint64 bytes = 0;
  GLint side = 0;
  glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &bytes);
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &side);
  return {bytes > 0 ? std::size_t(bytes) : 0, int(side)};
}

Result<Program> Program::make(std::span<const Stage> stages) {
  Program result;
  result.program_ = GlObject<DeleteProgram>(glCreateProgram());
  const GLuint program = result.program_.name();
  for (const Stage& stage : stages) {
    std::string source = "#version 450 core\n";
    for (const std::string& part : stage.parts) source += part + '\n';
    const GlObject<DeleteShader> shader(glCreateShader(stage.kind));
    const char* text = source.c_str();
    glShaderSource(shader.name(), 1, &text, nullptr);
    glCompileShader(shader.name());
    GLint compiled = GL_FALSE;
    glGetShaderiv(shader.name(), GL_COMPILE_STATUS, &compiled);
    if (!compiled) {
      std::string log(4096, '\0');
      GLsizei length = 0;
      glGetShaderInfoLog(shader.name(), GLsizei(log.size()), &length, log.data());
      log.resize(length);
      return report::failed(
          fmt::format("this OpenGL does not compile the shader {}: {}", stage.name, log));
    }
    glAttachShader(program, shader.name());
  }
  glLinkProgram(program);
  GLint linked = GL_FALSE;
  glGetProgramiv(program, GL_LINK_STATUS, &linked);
  if (!linked) {
    std::string log(4096, '\0');
    GLsizei length = 0;
    glGetProgramInfoLog(program, GLsizei(log.size()), &length, log.data());
    log.resize(length);
    return report::failed(fmt::format("this OpenGL does not link the shaders with {}: {}",
                                      stages.empty() ? "" : stages.back().name, log));
  }
  return result;
}

// A uniform that the compiler found unused has location −1, which GL's setters ignore.
int Program::location(const char* uniform) const {
  return glGetUniformLocation(program_.name(), uniform);
}
void Program::set(const char* uniform, int value) const {
  glProgramUniform1i(program_.name(), location(uniform), value);
}
void Program::set(const char* uniform, unsigned value) const {
  glProgramUniform1ui(program_.name(), location(uniform), value);
}
void Program::set(const char* uniform, int x, int y) const {
  glProgramUniform2i(program_.name(), location(uniform), x, y);
}
void Program::set(const char* uniform, int x, int y, int z) const {
  glProgramUniform3i(program_.name(), location(uniform), x, y, z);
}
void Program::set(const char* uniform, int x, int y, int z, int w) const {
  glProgramUniform4i(program_.name(), location(uniform), x, y, z, w);
}
void Program::set(const char* uniform, float value) const {
  glProgramUniform1f(program_.name(), location(uniform), value);
}
void Program::set(const char* uniform, float x, float y) const {
  glProgramUniform2f(program_.name(), location(uniform), x, y);
}
void Program::set(const char* uniform, float x, float y, float z) const {
  glProgramUniform3f(program_.name(), location(uniform), x, y, z);
}
void Program::set(const char* uniform, float x, float y, float z, float w) const {
  glProgramUniform4f(program_.name(), location(uniform), x, y, z, w);
}
void Program::setMatrix(const char* uniform, const float* columnMajor) const {
  glProgramUniformMatrix4fv(program_.name(), location(uniform), 1, GL_FALSE, columnMajor);
}
void Program::setMatrix(const char* uniform, const Mat3& matrix) const {
  glProgramUniformMatrix3fv(program_.name(), location(uniform), 1, GL_FALSE, matrix.data());
}

}  // namespace lambent::render
