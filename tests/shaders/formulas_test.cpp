// Texts that are formulas and nothing else.

#include <vector>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "lambent/radiometry/srgb.h"
#include "lambent/scene/scene.h"
#include "lambent/sh/basis.h"
#include "lambent/shade/lit_mesh.h"
#include "lambent/shade/macro_transport.h"
#include "lambent/shade/rtt_footprint.h"
#include "lambent/tone/tone_curve.h"
#include "tests/shaders/test_glsl.h"

#include "tests/shaders/glsl_begin.h"

namespace lambent::glsl::formulas {
#include "shaders/rtt_footprint.glsl"
#include "shaders/shading_normal.glsl"
#include "shaders/tangent_frame.glsl"
#include "shaders/tone.glsl"
#include "shaders/view_square.glsl"
}  // namespace lambent::glsl::formulas

#define LAMBENT_BANDS 1
namespace lambent::glsl::one {
#include "shaders/sh.glsl"
}
#undef LAMBENT_BANDS
#define LAMBENT_BANDS 5
namespace lambent::glsl::five {
#include "shaders/sh.glsl"
}
#undef LAMBENT_BANDS
#define LAMBENT_BANDS 10
namespace lambent::glsl::ten {
#include "shaders/sh.glsl"
}

#include "tests/shaders/glsl_end.h"

namespace lambent::glsl {
namespace {

constexpr int kMany = 20'000;

template <int N>
void expectHarmonics(int bands, void (*harmonics)(vec3, float*), float tolerance) {
  math::Random random(1, std::uint64_t(bands));
  for (int i = 0; i < kMany; ++i) {
    const Vec3 d = anyDirection(random);
    float y[N];
    harmonics(from(d), y);
    std::vector<double> expected(N);
    sh::evaluate(bands, Vec3d(d.cast<double>()), std::span<double>(expected));
    for (int k = 0; k < N; ++k)
      ASSERT_NEAR(y[k], expected[std::size_t(k)], tolerance) << bands << " bands, " << k;
  }
}

TEST(Sh, IsTheLibrarys) {
  expectHarmonics<1>(1, one::harmonics, 1e-7f);
  expectHarmonics<25>(5, five::harmonics, 5e-7f);
  expectHarmonics<100>(10, ten::harmonics, 2e-6f);
}

TEST(ViewSquare, IsTheLibrarys) {
  math::Random random(2, 0);
  for (int i = 0; i < kMany; ++i) {
    Vec3 d = i % 2 ? anyUpward(random) : anyDirection(random);
    if (i % 7 == 0) d = Vec3(1e-4f * d.x(), 1e-4f * d.y(), 1.0f).normalized();
    ASSERT_LT(apart(formulas::squareFromHemisphere(from(d)), math::squareFromHemisphere(d)), 5e-7f)
        << d.transpose();
  }
  EXPECT_EQ(apart(formulas::squareFromHemisphere(vec3(0, 0, 1)), Vec2(0.5f, 0.5f)), 0.0f);
}

TEST(TangentFrame, IsTheLibrarys) {
  math::Random random(3, 0);
  for (int i = 0; i < kMany; ++i) {
    const Vec3 normal = anyDirection(random);
    // Along the normal no tangent is left, and the frame is made up.
    const Vec3 tangent =
        i % 5 == 0 ? Vec3(0, 0, 0) : Vec3(between(random, 0.1f, 3.0f) * anyDirection(random));
    const mat3 found = formulas::worldFromPatch(from(normal), from(tangent));
    const Mat3 expected = shade::worldFromPatch(normal, tangent);
    // What is left of a tangent close to the normal has lost digits.
    const float left = tangent.isZero() ? 1.0f : normal.cross(tangent.normalized()).norm();
    for (int k = 0; k < 3; ++k)
      ASSERT_LT(apart(found[k], Vec3(expected.col(k))), 5e-7f / left) << normal.transpose();
  }
}

TEST(RttFootprint, HasTheLibrarysConstants) {
  EXPECT_EQ(formulas::kMostProbes, shade::kMostProbes);
  EXPECT_EQ(formulas::kLeastCosine, shade::kLeastCosine);
}

TEST(RttFootprint, AxesAreTheLibrarys) {
  math::Random random(4, 0);
  for (int i = 0; i < kMany; ++i) {
    const Mat3 frame = shade::worldFromPatch(anyDirection(random), anyDirection(random));
    const Vec3 toViewer = i % 9 == 0 ? Vec3(Vec3::UnitZ()) : anyDirection(random);
    const float width = between(random, 0.001f, 0.1f);
    const auto found = formulas::footprintAxes(from(frame), from(toViewer), width);
    const auto expected = shade::footprintAxes(frame, toViewer, width);
    ASSERT_LT(apart(found.longer, expected.longer), 1e-6f * expected.longer.norm());
    ASSERT_LT(apart(found.shorter, expected.shorter), 1e-6f * width);
  }
}

TEST(RttFootprint, ProbesAreTheLibrarys) {
  math::Random random(5, 0);
  int several = 0;
  for (int i = 0; i < kMany; ++i) {
    const auto axis = [&] {
      const float length = std::exp2(between(random, -9.0f, 2.0f));
      const float turn = between(random, 0.0f, 6.2831853f);
      return Vec2(length * std::cos(turn), length * std::sin(turn));
    };
    const Vec2 longer = axis(), shorter = axis(), positions(64, 40);
    const auto found = formulas::probesOf(from(longer), from(shorter), from(positions));
    const auto expected = shade::probesOf(longer, shorter, positions);
    ASSERT_EQ(found.count, expected.count);
    ASSERT_NEAR(found.level, expected.level, 5e-7f);
    ASSERT_LT(apart(found.stride, expected.step), 1e-6f * (longer.norm() + shorter.norm()));
    several += found.count > 1;
  }
  EXPECT_GT(several, kMany / 10);
}

TEST(Tone, IsTheLibrarys) {
  math::Random random(6, 0);
  std::vector<float> values = {0.0f, -1.0f, std::nanf(""), 0.18f, 0.0031308f, 1.0f, 1e9f};
  for (int i = 0; i < kMany; ++i) values.push_back(std::exp2(between(random, -20.0f, 17.0f)));
  for (const float x : values) {
    const vec3 c(x, 0.5f, -x);
    const Rgb pixel(x, 0.5f, -x);
    std::vector<Rgb> cut = {pixel}, curved = {pixel};
    tone::toneMap(cut, 0.0f, tone::Curve::Linear);
    tone::toneMap(curved, 0.0f, tone::Curve::Filmic);
    ASSERT_LT(apart(formulas::cutToOne(c), cut[0]), 1e-9f) << x;
    ASSERT_LT(apart(formulas::filmic(c), curved[0]), 2e-7f) << x;
    const vec3 coded = formulas::srgbEncode(formulas::filmic(c));
    ASSERT_NEAR(coded.x, radiometry::srgbEncode(curved[0][0]), 5e-7f) << x;
  }
}

TEST(ShadingNormal, IsThatOfSurfaces) {
  math::Random random(7, 0);
  int turned = 0;
  for (int i = 0; i < kMany; ++i) {
    scene::Scene scene;
    scene::Mesh& mesh = scene.meshes.emplace_back();
    for (int k = 0; k < 3; ++k) {
      mesh.positions.push_back(anyDirection(random));
      mesh.normals.push_back(anyDirection(random));
    }
    mesh.triangles.push_back({0, 1, 2});
    const float u = 0.5f * random.uniform(), v = 0.5f * random.uniform();
    const scene::SurfacePoint point = scene::surfaceAt(scene, 0, 0, u, v);
    const Vec3 interpolated =
        (1 - u - v) * mesh.normals[0] + u * mesh.normals[1] + v * mesh.normals[2];
    const vec3 found = formulas::shadingNormal(from(interpolated), from(point.geometricNormal));
    ASSERT_LT(apart(found, point.normal), 2e-6f);
    turned += interpolated.dot(point.geometricNormal) < 0.0f;
  }
  EXPECT_GT(turned, kMany / 10);
  const Vec3 front = Vec3(1, 2, 3).normalized();
  EXPECT_EQ(apart(formulas::shadingNormal(vec3(0.0f), from(front)), front), 0.0f);
}

TEST(ShadingNormal, ReflectsAsTheLibraryDoes) {
  math::Random random(8, 0);
  for (int i = 0; i < kMany; ++i) {
    const Vec3 outgoing = anyDirection(random), normal = anyDirection(random);
    const vec3 found = formulas::reflectAbout(from(outgoing), from(normal));
    ASSERT_LT(apart(found, math::reflectAbout(outgoing, normal)), 5e-7f);
    ASSERT_LT(apart(found, shade::mirrored(outgoing, normal)), 5e-7f);
  }
}

}  // namespace
}  // namespace lambent::glsl
