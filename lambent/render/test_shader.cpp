#include "lambent/render/test_shader.h"

#include <gtest/gtest.h>

#include "lambent/render/gl_objects.h"

namespace lambent::render::test {

std::vector<float> onGpu(const std::string& parts, const std::string& body,
                         const std::vector<float>& inputs) {
  const std::string source =
      "layout(local_size_x = 64) in;\n"
      "layout(std430, binding = 0) readonly buffer In { vec4 inputs[][4]; };\n"
      "layout(std430, binding = 1) writeonly buffer Out { vec4 outputs[]; };\n"
      "void main() {\n  uint p = gl_GlobalInvocationID.x;\n"
      "  if (p >= uint(inputs.length())) return;\n" +
      body + "}\n";
  const Program::Stage stage{GL_COMPUTE_SHADER, "table", {parts, source}};
  const Result<Program> program = Program::make({&stage, 1});
  if (!program) {
    ADD_FAILURE() << program.error().message;
    return {};
  }
  const std::size_t count = inputs.size() / 16;
  std::vector<float> outputs(4 * count);
  const Buffer in = makeBuffer(inputs), out = makeBuffer(outputs.size() * sizeof(float));
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, in.name());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, out.name());
  program->use();
  glDispatchCompute(GLuint(count + 63) / 64, 1, 1);
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  glGetNamedBufferSubData(out.name(), 0, GLsizeiptr(outputs.size() * sizeof(float)),
                          outputs.data());
  EXPECT_TRUE(checkGl("a table"));
  return outputs;
}

}  // namespace lambent::render::test
