// This work is based on:
// - duff2017building: a branchless orthonormal basis, revisited (the copysign form).
// - shirley1997low: a low distortion map between disk and square, §4.
// - phong lobe: the density (r+1)/2π cosʳθ inverted, cos θ = (1 − u)^(1/(r+1)).
#include "lambent/math/directions.h"

#include <algorithm>
#include <cmath>

namespace lambent::math {

static constexpr float kPiF = static_cast<float>(kPi);

Mat3 worldFromTangent(const Vec3& normal) {
  const float sign = std::copysign(1.0f, normal.z());
  const float a = -1 / (sign + normal.z());
  const float b = normal.x() * normal.y() * a;
  Mat3 frame;
  frame.col(0) = Vec3(1 + sign * normal.x() * normal.x() * a, sign * b, -sign * normal.x());
  frame.col(1) = Vec3(b, sign + normal.y() * normal.y() * a, -normal.y());
  frame.col(2) = normal;
  return frame;
}

Vec2 concentricDisc(const Vec2& u) {
  const float a = 2 * u.x() - 1, b = 2 * u.y() - 1;
  if (a == 0 && b == 0) return Vec2(0, 0);
  const bool wide = std::abs(a) > std::abs(b);
  const float radius = wide ? a : b;
  const float angle = wide ? kPiF / 4 * (b / a) : kPiF / 2 - kPiF / 4 * (a / b);
  return Vec2(radius * std::cos(angle), radius * std::sin(angle));
}

Vec2 squareFromDisc(const Vec2& disc) {
  const float x = disc.x(), y = disc.y(), radius = std::min(1.0f, disc.norm());
  if (radius == 0) return Vec2(0.5f, 0.5f);
  const bool wide = std::abs(x) > std::abs(y);
  // The signed radius is the longer of the square's two coordinates, as above.
  const float longer = std::copysign(radius, wide ? x : y);
  const float shorter = longer * (4 / kPiF) * (wide ? std::atan(y / x) : std::atan(x / y));
  const Vec2 square = wide ? Vec2(longer, shorter) : Vec2(shorter, longer);
  return (0.5f * (square + Vec2(1, 1))).cwiseMax(0.0f).cwiseMin(1.0f);
}

Vec3 hemisphereFromSquare(const Vec2& u) {
  const Vec2 disc = concentricDisc(u);
  const float squared = std::min(1.0f, disc.squaredNorm());  // 1 − cos θ
  const float stretch = std::sqrt(2 - squared);              // sin θ = r √(2 − r²)
  return Vec3(disc.x() * stretch, disc.y() * stretch, 1 - squared);
}

Vec2 squareFromHemisphere(const Vec3& direction) {
  const Vec2 flat = direction.head<2>();
  const float length = flat.norm();
  if (length == 0) return Vec2(0.5f, 0.5f);
  const float z = std::clamp(direction.z(), 0.0f, 1.0f);
  // r = √(1 − z), from sin θ where that keeps more digits.
  const float radius =
      length / std::sqrt(1 + z) /
      std::sqrt(std::max(1e-30f, flat.squaredNorm() + direction.z() * direction.z()));
  return squareFromDisc(flat / length * (direction.z() <= 0 ? 1.0f : std::min(1.0f, radius)));
}

static Vec3 fromCosine(float cosTheta, float turn) {
  const float sine = std::sqrt(std::max(0.0f, 1 - cosTheta * cosTheta));
  return Vec3(sine * std::cos(2 * kPiF * turn), sine * std::sin(2 * kPiF * turn), cosTheta);
}

Vec3 uniformSphere(const Vec2& u) {
  return fromCosine(1 - 2 * u.x(), u.y());
}

Vec3 uniformHemisphere(const Vec2& u) {
  return fromCosine(1 - u.x(), u.y());
}

Vec3 cosineHemisphere(const Vec2& u) {
  const Vec2 disc = concentricDisc(u);
  return Vec3(disc.x(), disc.y(), std::sqrt(std::max(0.0f, 1 - disc.squaredNorm())));
}

Vec3 phongLobe(const Vec2& u, float exponent) {
  return fromCosine(std::pow(1 - u.x(), 1 / (exponent + 1)), u.y());
}

Vec3 uniformCone(const Vec2& u, float cosHalfAngle) {
  // 1 − cos θ = u (1 − cos α), and sin² θ = (1 − cos θ)(1 + cos θ): a sun half a degree wide loses
  // half its digits if cos θ is rounded first.
  const float versine = u.x() * (1 - cosHalfAngle);
  const float sine = std::sqrt(std::max(0.0f, versine * (2 - versine)));
  return Vec3(sine * std::cos(2 * kPiF * u.y()), sine * std::sin(2 * kPiF * u.y()), 1 - versine);
}

float uniformSpherePdf() {
  return 1 / (4 * kPiF);
}

float uniformHemispherePdf(float cosTheta) {
  return cosTheta >= 0 ? 1 / (2 * kPiF) : 0;
}

float cosineHemispherePdf(float cosTheta) {
  return std::max(0.0f, cosTheta) / kPiF;
}

float phongLobePdf(float cosTheta, float exponent) {
  return cosTheta > 0 ? (exponent + 1) / (2 * kPiF) * std::pow(cosTheta, exponent) : 0;
}

float uniformConePdf(float cosTheta, float cosHalfAngle) {
  return cosTheta >= cosHalfAngle ? 1 / (2 * kPiF * (1 - cosHalfAngle)) : 0;
}

Vec3 reflectAbout(const Vec3& outgoing, const Vec3& normal) {
  return 2 * normal.dot(outgoing) * normal - outgoing;
}

}  // namespace lambent::math
