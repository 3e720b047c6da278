// shaders/phase_function.glsl, aerial_perspective.glsl and shafts.glsl against media and sky.

#include <cmath>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

#include "lambent/sky/aerial_table.h"
#include "lambent/sky/shafts.h"
#include "lambent/sky/sun_frame.h"
#include "tests/shaders/test_glsl.h"

#include "tests/shaders/glsl_begin.h"

namespace lambent::glsl::air {
#include "shaders/phase_function.glsl"

#include "shaders/aerial_perspective.glsl"
#include "shaders/shafts.glsl"

const sky::AirTable* table = nullptr;  // null: constant air
const sky::SunVisible* visible = nullptr;

vec3 three(const float* at) {
  return {at[0], at[1], at[2]};
}
vec3 sourceAt(sky::AirTable::Source source, ivec3 node) {
  const std::size_t row = std::size_t(node.z * airNodes.y + node.y);
  return three(&table->source(source)[(row * std::size_t(airNodes.x) + std::size_t(node.x)) * 3]);
}
vec3 airSourceOfAir(ivec3 node) {
  return sourceAt(sky::AirTable::Air, node);
}
vec3 airSourceOfAerosol(ivec3 node) {
  return sourceAt(sky::AirTable::Aerosol, node);
}
vec3 airSourceMultiple(ivec3 node) {
  return sourceAt(sky::AirTable::Multiple, node);
}
vec3 airLogExtinction(ivec2 node) {
  return three(&table->extinction()[std::size_t(node.y * airNodes.y + node.x) * 3]);
}
float sunVisible(vec3 point) {
  return (*visible)(Vec3d(double(point.x), double(point.y), double(point.z))) ? 1.0f : 0.0f;
}
AirBetween shaftAir(vec3 direction, float metres) {
  return table ? airBetween(direction, metres) : constantAirBetween(metres);
}
}  // namespace lambent::glsl::air

#include "tests/shaders/glsl_end.h"

namespace lambent::glsl {
namespace {

vec3 fromDouble(const Vec3d& v) {
  return {float(v.x()), float(v.y()), float(v.z())};
}
vec3 fromDouble(const Eigen::Array3d& v) {
  return {float(v[0]), float(v[1]), float(v[2])};
}
/// Relative to the largest channel of what is expected.
double apart(const vec3& a, const Eigen::Array3d& b) {
  const Eigen::Array3d off(double(a.x) - b[0], double(a.y) - b[1], double(a.z) - b[2]);
  return off.abs().maxCoeff() / std::max(b.abs().maxCoeff(), 1e-300);
}

double apartOfOne(const vec3& a, const Eigen::Array3d& b) {
  return apart(a, b) * b.abs().maxCoeff();
}

/// What a renderer sets up.
struct SetPhase {
  vec4 operator()(const media::Isotropic&) const { return {0, 0, 0, 0}; }
  vec4 operator()(const media::RayleighPhase&) const { return {1, 0, 0, 0}; }
  vec4 operator()(const media::HenyeyGreenstein& p) const { return {2, float(p.g), 0, 0}; }
  vec4 operator()(const media::CornetteShanks& p) const { return {3, float(p.g), 0, 0}; }
  vec4 operator()(const media::DoubleHenyeyGreenstein& p) const {
    return {4, float(p.f), float(p.g1), float(p.g2)};
  }
  vec4 operator()(const media::Schlick& p) const { return {5, float(p.k), 0, 0}; }
};

void show(const sky::AirTable& table) {
  air::table = &table;
  air::aerosolPhase = std::visit(SetPhase{}, table.aerosolPhase());
  air::airNodes = {table.size().azimuths, table.size().elevations, table.size().distances};
  const sky::AirTableAxes& axes = table.axes();
  air::airShell = {float(axes.radius), float(axes.height), float(axes.altitude),
                   float(axes.horizon)};
  air::airScale = table.scale();
  air::towardsSun = fromDouble(table.sun());
}

void show(const sky::ConstantAir& constant) {
  air::table = nullptr;
  air::aerosolPhase = std::visit(SetPhase{}, constant.aerosolPhase);
  air::constantExtinction = fromDouble(constant.extinction);
  air::constantAir = fromDouble(constant.air);
  air::constantAerosol = fromDouble(constant.aerosol);
  air::towardsSun = fromDouble(constant.sun);
}

const sky::Scattering& solved() {
  static const sky::Scattering scattering = [] {
    std::vector<double> nm;
    for (int i = 0; i < 16; ++i) nm.push_back(380 + 24 * i);
    sky::Resolution r;
    r.orders = 2;
    r.altitudes = 6;
    r.upward = r.downward = r.around = 4;
    r.zeniths = r.azimuths = 7;
    r.sunFrom = 1.1;
    r.sunTo = 1.4;
    return *sky::Scattering::solve(sky::mediumOf(*sky::preset("clear"), nm), r);
  }();
  return scattering;
}

TEST(PhaseFunctionText, IsTheLibrarys) {
  for (const media::PhaseFunction& phase : std::vector<media::PhaseFunction>{
           media::Isotropic{}, media::RayleighPhase{}, media::HenyeyGreenstein{0.8},
           media::CornetteShanks{0.7}, media::DoubleHenyeyGreenstein{0.2, 0.8, -0.4},
           media::Schlick{0.6}}) {
    air::aerosolPhase = std::visit(SetPhase{}, phase);
    EXPECT_EQ(std::size_t(air::aerosolPhase.x), phase.index());
    for (double cosine = -1; cosine <= 1; cosine += 0.01) {
      const double expected = media::evaluate(phase, cosine);
      EXPECT_NEAR(double(air::phaseOfAerosols(float(cosine))), expected, 2e-5 * expected);
    }
  }
}

TEST(AerialPerspectiveText, KnowsTheGround) {
  for (const double altitude : {0.0, 1800.0}) {
    const sky::AirTable table(solved(), *sky::preset("clear"), {altitude, 0.3}, {16, 5, 9, 2});
    show(table);
    const vec3 color(0.5f, 1, 2);
    for (const double height : {0.0, 1.6, 40.0, 1800.0, 9000.0})
      for (double elevation = -1.5; elevation < 0.2; elevation += 0.013) {
        const Vec3d d(std::cos(elevation) * 0.6, std::sin(elevation), std::cos(elevation) * 0.8);
        const vec3 seen = air::throughAirBehind(fromDouble(d), float(height), color);
        const sky::AirTableAxes& axes = table.axes();
        sky::AirBetween expected;
        if (!axes.isAbove(elevation)) {
          const double above = std::max({altitude, height, 1.6});
          const double metres = axes.toGround(elevation, above);
          EXPECT_NEAR(double(air::airToGround(float(d.y()), float(above))), metres, 2e-3 * metres);
          expected = table.at(d, metres);
        }
        EXPECT_LT(apart(seen, expected.seen({0.5, 1, 2})), 2e-3) << height << ' ' << elevation;
      }
  }
}

TEST(AerialPerspectiveText, IsTheTables) {
  for (const double altitude : {0.0, 1800.0, 15e3}) {
    const sky::AirTable table(solved(), *sky::preset("clear"), {altitude, 0.3}, {16, 5, 9, 2});
    show(table);
    math::Random random(1, std::uint64_t(altitude));
    for (int i = 0; i < 4000; ++i) {
      const Vec3 d = anyDirection(random);
      const float metres = std::pow(10.0f, between(random, 0, 6.5f));
      const sky::AirBetween expected = table.at(d.cast<double>(), double(metres));
      const vec3 color(0.5f, 1, 2);
      const air::AirBetween seen = air::airBetween(from(d), metres);
      // Next to the horizon floats of the planet's size lose digits of where a ray ends.
      ASSERT_LT(apartOfOne(seen.extinction, expected.extinction), 1e-3)
          << d.transpose() << ' ' << metres;
      ASSERT_LT(apart(seen.multiple, expected.multiple), 2e-3) << d.transpose() << ' ' << metres;
      ASSERT_LT(apart(air::throughAir(seen, from(d), color), expected.seen({0.5, 1, 2})), 2e-3);
    }
  }
}

TEST(AerialPerspectiveText, IsOfConstantAir) {
  const sky::ConstantAir constant = sky::constantAir(solved(), *sky::preset("clear"), {100, 0.3});
  show(constant);
  math::Random random(2, 1);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 d = anyDirection(random);
    const float metres = std::pow(10.0f, between(random, 0, 6.0f));
    const sky::AirBetween expected = constant.at(d.cast<double>(), double(metres));
    const air::AirBetween seen = air::constantAirBetween(metres);
    ASSERT_LT(apartOfOne(seen.extinction, expected.extinction), 1e-5);
    ASSERT_LT(apart(air::throughAir(seen, from(d), vec3(0.0f)), expected.fromSun), 1e-4) << metres;
  }
}

void expectSameShafts(const sky::AerialPerspective& form, double length, double tolerance) {
  // A floor with a slit in it, above.
  const sky::SunVisible slit = [&](const Vec3d& p) {
    return std::abs(p.z() + 0.4 * length) < 0.13 * length;
  };
  air::visible = &slit;
  sky::SamplingPlanes planes;
  planes.axis = Vec3d(0.2, 0.05, -1).normalized();
  planes.first = 0.02 * length;
  planes.last = 0.8 * length;
  planes.count = 24;
  planes.samples = 3;
  for (const double rate : {0.0, 1 / length}) {
    planes.rate = rate;
    air::shaftOrigin = vec3(0.0f, 2.0f, 0.0f);
    air::shaftAxis = fromDouble(planes.axis);
    air::shaftDepths = {float(planes.first), float(planes.last)};
    air::shaftRate = float(rate);
    air::shaftPlanes = {planes.count, planes.samples};
    math::Random random(3, 1);
    int skipped = 0;
    for (int i = 0; i < 300; ++i) {
      const Vec3d d =
          Vec3d(double(between(random, -0.5f, 0.9f)), double(between(random, -0.1f, 0.4f)), -1)
              .normalized();
      const double metres = length * double(between(random, 0.1f, 1.0f));
      const sky::ShaftRay ray{{0, 2, 0}, d, metres};
      const Eigen::Array3d expected = sky::shaftsBySplitPlanes(form, ray, slit, planes);
      const Eigen::Array3d all = sky::airBetween(form, d, metres).fromSun;
      const vec3 seen = air::shafts(fromDouble(d), float(metres));
      // A sample next to a shadow's edge may fall on either side of it.
      if (apart(seen, expected) * expected.maxCoeff() > tolerance * all.maxCoeff()) {
        ++skipped;
        ASSERT_LT(apart(seen, expected) * expected.maxCoeff(),
                  1.01 * sky::largestStep(form, ray, planes).maxCoeff() + 1e-12);
      }
    }
    EXPECT_LE(skipped, 3);
  }
}

TEST(ShaftsText, AreTheLibrarysOfConstantAir) {
  const sky::ConstantAir constant = sky::constantAir(solved(), *sky::preset("clear"), {100, 0.3});
  show(constant);
  expectSameShafts(constant, 500, 2e-4);
}

TEST(ShaftsText, AreTheLibrarysOfATable) {
  const sky::AirTable table(solved(), *sky::preset("clear"), {100, 0.3}, {16, 5, 9, 2});
  show(table);
  expectSameShafts(table, 2e4, 1e-3);
}

}  // namespace
}  // namespace lambent::glsl
