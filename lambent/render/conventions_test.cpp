// One table of numbers, tests/conventions/table.json, which library, shaders and the web package
// all come to. Besides, the harmonics of shaders/sh.glsl against lambent/sh at many more
// directions.

#include <cmath>
#include <fstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "lambent/light/environment.h"
#include "lambent/math/directions.h"
#include "lambent/radiometry/srgb.h"
#include "lambent/render/gl_environment.h"
#include "lambent/tone/tone_curve.h"

#include "lambent/render/gl_context.h"
#include "lambent/render/gl_objects.h"
#include "lambent/render/harmonics_source.h"
#include "lambent/render/shader_sources.h"
#include "lambent/render/test_shader.h"
#include "lambent/sh/basis.h"
#include "lambent/sh/rotation.h"
#include "lambent/sh/window.h"
#include "lambent/sh/zonal.h"
#include "lambent/shade/lobe.h"

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

enum class Source { Loops, WrittenOut };

std::vector<float> harmonicsOnGpu(const std::vector<Vec3>& at, int bands,
                                  Source source = Source::Loops) {
  const Program::Stage stage{
      GL_COMPUTE_SHADER,
      "harmonics",
      {source == Source::WrittenOut ? harmonicsSource(bands)
                                    : "#define LAMBENT_BANDS " + std::to_string(bands) + "\n" +
                                          std::string(shaderSource("sh.glsl")),
       kEvaluate}};
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
  for (const Source source : {Source::Loops, Source::WrittenOut})
    for (int bands = 1; bands <= sh::kMaxBands; ++bands) {
      const std::vector<float> values = harmonicsOnGpu(at, bands, source);
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
  const std::vector<float> y = harmonicsOnGpu({Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()}, 2);
  const float k0 = 0.282095f, k1 = 0.488603f;
  const std::vector<float> expected = {k0, 0, 0, k1, k0, k1, 0, 0, k0, 0, k1, 0};
  ASSERT_EQ(y.size(), expected.size());
  for (std::size_t i = 0; i < y.size(); ++i) EXPECT_NEAR(y[i], expected[i], 1e-6f) << i;
}

using Json = nlohmann::json;

const Json& table() {
  static const Json json = [] {
    std::ifstream file(LAMBENT_CONVENTIONS);
    return Json::parse(file, nullptr, false);
  }();
  return json;
}

Vec3d vectorOf(const Json& json) {
  return Vec3d(json.at(0).get<double>(), json.at(1).get<double>(), json.at(2).get<double>());
}

void expectNumbers(std::span<const double> actual, const Json& expected, double tolerance,
                   const std::string& what) {
  ASSERT_EQ(actual.size(), expected.size()) << what;
  for (std::size_t i = 0; i < actual.size(); ++i)
    EXPECT_NEAR(actual[i], expected.at(i).get<double>(), tolerance) << what << ", " << i;
}

TEST(ConventionTable, IsThere) {
  ASSERT_FALSE(table().is_discarded()) << LAMBENT_CONVENTIONS;
}

TEST(ConventionTable, LibraryHasItsHarmonics) {
  ASSERT_GE(table().at("harmonics").size(), 20u);
  for (const Json& entry : table().at("harmonics")) {
    const int bands = entry.at("bands").get<int>();
    std::vector<double> y(std::size_t(sh::coefficientCount(bands)));
    sh::evaluate(bands, vectorOf(entry.at("direction")), std::span<double>(y));
    expectNumbers(y, entry.at("values"), 1e-12, "double");
    std::vector<float> single(y.size());
    sh::evaluate(bands, Vec3(vectorOf(entry.at("direction")).cast<float>()),
                 std::span<float>(single));
    expectNumbers(std::vector<double>(single.begin(), single.end()), entry.at("values"), 3e-6,
                  "single");
  }
}

TEST(ConventionTable, ShadersHaveItsHarmonics) {
  const Result<GlContext> context = GlContext::create();
  ASSERT_TRUE(context) << context.error().message;
  for (const Source source : {Source::Loops, Source::WrittenOut})
    for (const Json& entry : table().at("harmonics")) {
      const std::vector<float> y = harmonicsOnGpu({vectorOf(entry.at("direction")).cast<float>()},
                                                  entry.at("bands").get<int>(), source);
      expectNumbers(std::vector<double>(y.begin(), y.end()), entry.at("values"), 1e-5, "shader");
    }
}

TEST(ConventionTable, LibraryTurnsCoefficientsAsItDoes) {
  const Json& rotation = table().at("rotation");
  const int bands = rotation.at("bands").get<int>();
  Mat3d dstFromSrc;
  for (int row = 0; row < 3; ++row)
    dstFromSrc.row(row) = vectorOf(rotation.at("dstFromSrc").at(std::size_t(row))).transpose();
  const auto before = rotation.at("before").get<std::vector<double>>();
  const std::size_t n = before.size();
  const std::vector<double> matrix = sh::rotationMatrix(bands, dstFromSrc);
  std::vector<double> after(n, 0.0);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) after[i] += matrix[i * n + j] * before[j];
  expectNumbers(after, rotation.at("after"), 1e-10, "matrix");
  const std::vector<float> in(before.begin(), before.end());
  std::vector<float> out(n);
  sh::rotate(bands, dstFromSrc.cast<float>(), in, out);
  expectNumbers(std::vector<double>(out.begin(), out.end()), rotation.at("after"), 5e-6, "vector");
}

TEST(ConventionTable, LibraryHasItsZonalFunctions) {
  const int bands = int(table().at("cosineFactors").size());
  expectNumbers(sh::clampedCosine(bands), table().at("cosineFactors"), 1e-10, "cosine");
  for (const Json& entry : table().at("lobeMoments"))
    expectNumbers(sh::phongLobe(bands, entry.at("exponent").get<double>()), entry.at("values"),
                  1e-10, "lobe");
  for (const Json& entry : table().at("softLobes")) {
    const int n = entry.at("bands").get<int>();
    const double exponent = entry.at("exponent").get<double>();
    expectNumbers(sh::leastSoftening(sh::phongLobe(n, exponent)), entry.at("window"), 1e-9,
                  "soft lobe");
    const transfer::Lobe lobe{Rgb::Ones(), float(exponent)};
    const shade::LobeGain gain = shade::lobeGain(n, lobe, {}, transfer::Kind::Shadowed);
    for (const Json& at : entry.at("gain"))
      EXPECT_NEAR(gain.at(at.at(0).get<float>()), at.at(1).get<float>(), 2e-4) << n << exponent;
  }
  for (const Json& entry : table().at("disc")) {
    const double diameter = entry.at("diameter").get<double>() * kPi / 180.0;
    const sh::ZonalMoments moments = sh::cap(bands, diameter / 2);
    std::vector<double> zonal;
    for (int l = 0; l < bands; ++l)
      zonal.push_back(std::sqrt((2 * l + 1) / (4 * kPi)) * moments[std::size_t(l)]);
    expectNumbers(zonal, entry.at("zonal"), 1e-10, "disc");
    const sh::RgbCoefficients light =
        light::Environment::disc(Vec3::UnitZ(), diameter, Rgb::Ones()).project(bands);
    for (int l = 0; l < bands; ++l)
      EXPECT_NEAR(light.channel(1)[std::size_t(sh::index(l, 0))],
                  entry.at("zonal").at(std::size_t(l)).get<double>(), 1e-6);
  }
}

/// 16 floats for each entry: the numbers of `member`, and zeros.
std::vector<float> inputsOf(const Json& entries, const char* member) {
  std::vector<float> inputs;
  for (const Json& entry : entries) {
    const Json& numbers = entry.is_array() ? Json{entry.at(0)} : entry.at(member);
    for (const Json& number : numbers) inputs.push_back(number.get<float>());
    inputs.resize((inputs.size() + 15) / 16 * 16);
  }
  return inputs;
}

TEST(ConventionTable, PicturesOfEnvironmentsLieAsItSays) {
  const Result<GlContext> context = GlContext::create();
  ASSERT_TRUE(context) << context.error().message;
  const Json& entries = table().at("latLong");
  const std::vector<float> found = test::onGpu(
      environmentSource(), "outputs[p] = vec4(latLongFromDirection(inputs[p][0].xyz), 0.0, 0.0);\n",
      inputsOf(entries, "direction"));
  // The library's look-up: red is u, green is v, away from where they wrap.
  image::Image picture(512, 256);
  for (int y = 0; y < 256; ++y)
    for (int x = 0; x < 512; ++x) picture.at(x, y) = Rgb((x + 0.5f) / 512, (y + 0.5f) / 256, 0);
  const light::Environment environment = light::Environment::latLong(picture);
  for (std::size_t p = 0; p < entries.size(); ++p) {
    const double u = entries[p].at("uv").at(0).get<double>();
    const double v = entries[p].at("uv").at(1).get<double>();
    EXPECT_NEAR(found[4 * p], u, 1e-6) << p;
    EXPECT_NEAR(found[4 * p + 1], v, 1e-6) << p;
    const Rgb seen =
        environment.radiance(vectorOf(entries[p].at("direction")).cast<float>().normalized());
    EXPECT_NEAR(seen[0], u, 1e-5) << p;
    EXPECT_NEAR(seen[1], v, 1e-5) << p;
  }
}

TEST(ConventionTable, ToneCurvesAreIts) {
  const Result<GlContext> context = GlContext::create();
  ASSERT_TRUE(context) << context.error().message;
  const std::string tone(shaderSource("tone.glsl"));
  const std::vector<float> filmic =
      test::onGpu(tone, "outputs[p] = vec4(filmic(inputs[p][0].xxx), 0.0);\n",
                  inputsOf(table().at("filmic"), ""));
  const std::vector<float> cut =
      test::onGpu(tone, "outputs[p] = vec4(cutToOne(inputs[p][0].xxx), 0.0);\n",
                  inputsOf(table().at("filmic"), ""));
  for (std::size_t p = 0; p < table().at("filmic").size(); ++p) {
    const Json& pair = table().at("filmic")[p];
    const float x = pair.at(0).get<float>();
    EXPECT_NEAR(filmic[4 * p + 1], pair.at(1).get<double>(), 1e-6) << x;
    EXPECT_NEAR(tone::filmic(Rgb::Constant(x))[1], pair.at(1).get<double>(), 1e-6) << x;
    std::vector<Rgb> pixel = {Rgb::Constant(x)};
    tone::toneMap(pixel, 0.0f, tone::Curve::Linear);
    EXPECT_EQ(cut[4 * p + 2], pixel[0][2]) << x;
  }
  const std::vector<float> coded =
      test::onGpu(tone, "outputs[p] = vec4(srgbEncode(inputs[p][0].xxx), 0.0);\n",
                  inputsOf(table().at("srgb"), ""));
  for (std::size_t p = 0; p < table().at("srgb").size(); ++p) {
    const Json& pair = table().at("srgb")[p];
    const double x = pair.at(0).get<double>(), code = pair.at(1).get<double>();
    EXPECT_NEAR(coded[4 * p], code, 1e-5) << x;
    EXPECT_NEAR(radiometry::srgbEncode(float(x)), code, 1e-6) << x;
    EXPECT_NEAR(radiometry::srgbDecode(float(code)), x, 1e-6) << x;
  }
}

TEST(ConventionTable, ViewSquareIsIts) {
  const Result<GlContext> context = GlContext::create();
  ASSERT_TRUE(context) << context.error().message;
  const Json& entries = table().at("viewSquare");
  const std::vector<float> found =
      test::onGpu(std::string(shaderSource("view_square.glsl")),
                  "outputs[p] = vec4(squareFromHemisphere(inputs[p][0].xyz), 0.0, 0.0);\n",
                  inputsOf(entries, "direction"));
  for (std::size_t p = 0; p < entries.size(); ++p) {
    const Vec3d direction = vectorOf(entries[p].at("direction"));
    const Vec2 square(entries[p].at("square").at(0).get<float>(),
                      entries[p].at("square").at(1).get<float>());
    EXPECT_NEAR(found[4 * p], square.x(), 2e-5) << p;
    EXPECT_NEAR(found[4 * p + 1], square.y(), 2e-5) << p;
    EXPECT_LT((math::squareFromHemisphere(direction.cast<float>()) - square).norm(), 2e-5f) << p;
    EXPECT_LT((math::hemisphereFromSquare(square) - direction.cast<float>()).norm(), 2e-6f) << p;
  }
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
