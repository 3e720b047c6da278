// The harmonics of shaders/sh.glsl against lambent/sh: one table, the same numbers.

#include <cmath>

#include <gtest/gtest.h>

#include "lambent/render/gl_context.h"
#include "lambent/render/gl_objects.h"
#include "lambent/render/shader_sources.h"
#include "lambent/sh/basis.h"

namespace lambent::render {
namespace {

constexpr const char* kEvaluate = R"(
layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Directions { vec4 directions[]; };
layout(std430, binding = 1) writeonly buffer Values { float values[]; };
void main() {
  uint p = gl_GlobalInvocationID.x;
  if (p >= uint(directions.length())) return;
  float y[kCoefficients];
  harmonics(directions[p].xyz, y);
  for (int i = 0; i < kCoefficients; ++i) values[int(p) * kCoefficients + i] = y[i];
})";

/// The axes, the diagonals, and a spiral between.
std::vector<Vec3> directions() {
  std::vector<Vec3> result;
  for (int x = -1; x <= 1; ++x)
    for (int y = -1; y <= 1; ++y)
      for (int z = -1; z <= 1; ++z)
        if (x || y || z) result.push_back(Vec3(float(x), float(y), float(z)).normalized());
  for (int i = 0; i < 100; ++i) {
    const float z = (i + 0.5f) / 50 - 1, r = std::sqrt(1 - z * z), phi = 2.399963f * i;
    result.emplace_back(r * std::cos(phi), r * std::sin(phi), z);
  }
  return result;
}

std::vector<float> onGpu(const std::vector<Vec3>& at, int bands) {
  const Program::Stage stage{GL_COMPUTE_SHADER,
                             "harmonics",
                             {"#define LAMBENT_BANDS " + std::to_string(bands),
                              std::string(shaderSource("sh.glsl")), kEvaluate}};
  const Result<Program> program = Program::make({&stage, 1});
  if (!program) {
    ADD_FAILURE() << program.error().message;
    return {};
  }
  std::vector<float> padded;
  for (const Vec3& d : at) padded.insert(padded.end(), {d.x(), d.y(), d.z(), 0.0f});
  const Buffer in = makeBuffer(padded);
  std::vector<float> values(at.size() * sh::coefficientCount(bands));
  const Buffer out = makeBuffer(values.size() * sizeof(float));
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, in.name());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, out.name());
  program->use();
  glDispatchCompute(GLuint(at.size() + 63) / 64, 1, 1);
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  glGetNamedBufferSubData(out.name(), 0, GLsizeiptr(values.size() * sizeof(float)), values.data());
  EXPECT_TRUE(checkGl("evaluating harmonics"));
  return values;
}

TEST(ShaderConventions, HarmonicsEqualTheLibrarys) {
  const Result<GlContext> context = GlContext::create();
  ASSERT_TRUE(context) << context.error().message;
  const std::vector<Vec3> at = directions();
  for (int bands = 1; bands <= sh::kMaxBands; ++bands) {
    const std::vector<float> values = onGpu(at, bands);
    ASSERT_FALSE(values.empty());
    const int n = sh::coefficientCount(bands);
    std::vector<double> expected(n);
    for (std::size_t p = 0; p < at.size(); ++p) {
      sh::evaluate(bands, Vec3d(at[p].cast<double>()), std::span<double>(expected));
      for (int i = 0; i < n; ++i)
        ASSERT_NEAR(values[p * n + i], expected[i], 1e-5)
            << bands << " bands, coefficient " << i << ", direction " << at[p].transpose();
    }
  }
}

// A table that needs no other code to be right.
TEST(ShaderConventions, FirstHarmonicsHaveTheStatedSigns) {
  const Result<GlContext> context = GlContext::create();
  ASSERT_TRUE(context) << context.error().message;
  const std::vector<float> y = onGpu({Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()}, 2);
  const float k0 = 0.282095f, k1 = 0.488603f;
  const std::vector<float> expected = {k0, 0, 0, k1, k0, k1, 0, 0, k0, 0, k1, 0};
  ASSERT_EQ(y.size(), expected.size());
  for (std::size_t i = 0; i < y.size(); ++i) EXPECT_NEAR(y[i], expected[i], 1e-6f) << i;
}

TEST(GlContext, GivesBackWhatWasCurrent) {
  const Result<GlContext> outer = GlContext::create();
  ASSERT_TRUE(outer) << outer.error().message;
  const Buffer buffer = makeBuffer(64);
  {
    const Result<GlContext> inner = GlContext::create();
    ASSERT_TRUE(inner) << inner.error().message;
    EXPECT_FALSE(glIsBuffer(buffer.name()));
  }
  EXPECT_TRUE(glIsBuffer(buffer.name()));
}

TEST(Program, ReportsTheCompilersWords) {
  const Result<GlContext> context = GlContext::create();
  ASSERT_TRUE(context) << context.error().message;
  const Program::Stage stage{GL_COMPUTE_SHADER, "broken.glsl", {"this is no shader"}};
  const Result<Program> program = Program::make({&stage, 1});
  ASSERT_FALSE(program);
  EXPECT_NE(program.error().message.find("broken.glsl"), std::string::npos);
}

}  // namespace
}  // namespace lambent::render
