// Between the library's vectors and those of the texts, and random ones.
#pragma once

#include "lambent/math/directions.h"
#include "lambent/math/random.h"
#include "lambent/math/types.h"
#include "tests/shaders/glsl.h"

namespace lambent::glsl {

inline vec2 from(const Vec2& v) {
  return {v.x(), v.y()};
}
inline vec3 from(const Vec3& v) {
  return {v.x(), v.y(), v.z()};
}
inline vec3 from(const Rgb& v) {
  return {v[0], v[1], v[2]};
}
inline mat3 from(const Mat3& m) {
  return {from(Vec3(m.col(0))), from(Vec3(m.col(1))), from(Vec3(m.col(2)))};
}

/// The largest difference between components.
inline float apart(const vec2& a, const Vec2& b) {
  return std::max(std::abs(a.x - b.x()), std::abs(a.y - b.y()));
}
inline float apart(const vec3& a, const Vec3& b) {
  return (Vec3(a.x, a.y, a.z) - b).cwiseAbs().maxCoeff();
}
inline float apart(const vec3& a, const Rgb& b) {
  return apart(a, Vec3(b.matrix()));
}

/// In [low, high).
inline float between(math::Random& random, float low, float high) {
  return low + (high - low) * random.uniform();
}
inline Vec3 anyDirection(math::Random& random) {
  return math::uniformSphere(random.uniform2());
}
inline Vec3 anyUpward(math::Random& random) {
  return math::uniformHemisphere(random.uniform2());
}
inline Rgb anyColor(math::Random& random) {
  return {random.uniform(), random.uniform(), random.uniform()};
}

}  // namespace lambent::glsl
