// What receivers hold, at places between them: shaders/texel_receivers.glsl, corner_weights.glsl,
// incident.glsl and lobe.glsl against shade::ReceiverWeights and shade::LitMesh.

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "lambent/sh/basis.h"
#include "lambent/shade/lit_mesh.h"
#include "lambent/shade/rtt_pyramid.h"
#include "tests/shaders/test_glsl.h"

#include "tests/shaders/glsl_begin.h"

#define LAMBENT_LIGHT_PLACE int
#define LAMBENT_INTERPOLATED 0

#define LAMBENT_BANDS 3
#define LAMBENT_GROUPS 7
#define LAMBENT_EACH_GROUP(DO) DO(0) DO(1) DO(2) DO(3) DO(4) DO(5) DO(6)
namespace lambent::glsl::three {
#include "shaders/corner_weights.glsl"
#include "shaders/sh.glsl"
#include "shaders/texel_receivers.glsl"

#include "shaders/incident.glsl"
#include "shaders/lobe.glsl"

const vec4* groups = nullptr;
int lightPlace(int receiver) {
  return receiver * LAMBENT_GROUPS;
}
vec4 lightGroup(int first, int group) {
  return groups[first + group];
}
}  // namespace lambent::glsl::three

#undef LAMBENT_BANDS
#undef LAMBENT_GROUPS
#undef LAMBENT_EACH_GROUP
#define LAMBENT_BANDS 4
#define LAMBENT_GROUPS 12
#define LAMBENT_EACH_GROUP(DO) \
  DO(0) DO(1) DO(2) DO(3) DO(4) DO(5) DO(6) DO(7) DO(8) DO(9) DO(10) DO(11)
namespace lambent::glsl::four {
#include "shaders/sh.glsl"

#include "shaders/incident.glsl"
#include "shaders/lobe.glsl"

const vec4* groups = nullptr;
int lightPlace(int receiver) {
  return receiver * LAMBENT_GROUPS;
}
vec4 lightGroup(int first, int group) {
  return groups[first + group];
}
}  // namespace lambent::glsl::four

#include "tests/shaders/glsl_end.h"

namespace lambent::glsl {
namespace {

constexpr int kMany = 5000;

TEST(TexelReceivers, AreTheLibrarys) {
  math::Random random(1, 0);
  for (const auto& [width, height] : {std::pair{16, 11}, {1, 7}, {2048, 3}})
    for (int i = 0; i < kMany; ++i) {
      const Vec2 uv(between(random, -0.2f, 1.2f), between(random, -0.2f, 1.2f));
      const three::Texels found = three::texelsAround(from(uv), ivec2(width, height));
      const shade::ReceiverWeights expected = shade::ReceiverWeights::ofTexels(width, height, uv);
      for (int k = 0; k < 4; ++k) {
        ASSERT_EQ(found.receiver[k], int(expected.index[std::size_t(k)])) << uv.transpose();
        ASSERT_NEAR(found.weight[k], expected.weight[std::size_t(k)], 1e-6f) << uv.transpose();
      }
    }
}

TEST(CornerWeights, AreThoseOfThePlace) {
  math::Random random(2, 0);
  for (int i = 0; i < kMany; ++i) {
    const Vec3 a = anyDirection(random), b = anyDirection(random), c = anyDirection(random);
    const Vec3 n = (b - a).cross(c - a);
    if (n.norm() < 0.1f) continue;  // of slivers a place tells little
    const float u = 0.5f * random.uniform(), v = 0.5f * random.uniform();
    const Vec3 place = (1 - u - v) * a + u * b + v * c;
    const shade::ReceiverWeights expected = shade::ReceiverWeights::ofTriangle({0, 1, 2}, u, v);
    const vec3 found = three::cornerWeights(from(place), from(a), from(b), from(c));
    for (int k = 0; k < 3; ++k) ASSERT_NEAR(found[k], expected.weight[std::size_t(k)], 2e-6f);
  }
}

shade::LitMesh anyLobes(int bands, int receivers, math::Random& random) {
  shade::LitMesh lit;
  lit.lobeBands = bands;
  for (int i = 0; i < 3 * bands * bands * receivers; ++i)
    lit.lobe.push_back(between(random, -1, 1));
  for (float& c : lit.gain.coefficients) c = between(random, -1, 1);
  return lit;
}

/// As transfer passes lay them out: each receiver's filled up with zeros to whole groups.
std::vector<vec4> groupsOf(const shade::LitMesh& lit) {
  const std::size_t count = 3 * std::size_t(lit.lobeBands) * std::size_t(lit.lobeBands);
  const std::size_t stride = std::size_t(shade::rttStride(lit.lobeBands));
  std::vector<vec4> groups(lit.lobe.size() / count * stride / 4);
  for (std::size_t i = 0; i < lit.lobe.size(); ++i) {
    const std::size_t at = i / count * stride + i % count;
    groups[at / 4][int(at % 4)] = lit.lobe[i];
  }
  return groups;
}

TEST(Lobe, IsTheLibrarysBetweenCornersAndTexels) {
  math::Random random(3, 0);
  const int width = 9, height = 6;
  const shade::LitMesh lit3 = anyLobes(3, width * height, random);
  const shade::LitMesh lit4 = anyLobes(4, width * height, random);
  const std::vector<vec4> groups3 = groupsOf(lit3), groups4 = groupsOf(lit4);
  three::groups = groups3.data();
  four::groups = groups4.data();
  const auto gainOf = [](const shade::LitMesh& lit) {
    const auto& [c0, c1, c2, c3] = lit.gain.coefficients;
    return vec4(c0, c1, c2, c3);
  };
  three::lobeGain = gainOf(lit3);
  four::lobeGain = gainOf(lit4);
  for (int i = 0; i < kMany; ++i) {
    const Vec3 toViewer = anyDirection(random), normal = anyDirection(random);
    const Vec3 reflected = shade::mirrored(toViewer, normal);
    const Vec2 uv = random.uniform2();
    const three::Texels texels = three::texelsAround(from(uv), ivec2(width, height));
    const shade::ReceiverWeights around = shade::ReceiverWeights::ofTexels(width, height, uv);
    three::interpolateIncident(texels.receiver, texels.weight);
    ASSERT_LT(apart(three::lobeRadiance(from(reflected), from(normal)),
                    lit3.glossyAt(around, toViewer, normal)),
              2e-6f);
    four::interpolateIncident(texels.receiver, texels.weight);
    ASSERT_LT(apart(four::lobeRadiance(from(reflected), from(normal)),
                    lit4.glossyAt(around, toViewer, normal)),
              2e-6f);

    const float u = 0.5f * random.uniform(), v = 0.5f * random.uniform();
    const shade::ReceiverWeights corners = shade::ReceiverWeights::ofTriangle({5, 30, 11}, u, v);
    four::interpolateIncident(ivec3(5, 30, 11), vec3(1 - u - v, u, v));
    ASSERT_LT(apart(four::lobeRadiance(from(reflected), from(normal)),
                    lit4.glossyAt(corners, toViewer, normal)),
              2e-6f);
  }
}

}  // namespace
}  // namespace lambent::glsl
