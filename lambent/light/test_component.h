// A light as another room would make it, for tests: c (1 + k a·s), brighter towards an axis a.
#pragma once

#include <algorithm>
#include <cmath>

#include "lambent/light/component.h"
#include "lambent/math/directions.h"

namespace lambent::light::test {

class Gradient final : public Component {
 public:
  /// `steepness` k within −1 … 1.
  Gradient(const Vec3& axis, double steepness, const Rgb& radiance)
      : axis_(axis.normalized()), steepness_(steepness), radiance_(radiance) {}

  double power() const override { return 4 * kPi * importance(radiance_); }
  Rgb radiance(const Vec3& direction) const override {
    return radiance_ * float(1 + steepness_ * double(axis_.dot(direction)));
  }
  double pdf(const Vec3& direction) const override {
    return (1 + steepness_ * double(axis_.dot(direction))) / (4 * kPi);
  }
  Drawn draw(double u1, double u2) const override {
    // The cosine t has density (1 + k t)/2; its distribution function, solved for t without
    // cancellation.
    const double k = steepness_, v = 2 * u1 - 1;
    const double t = (2 * v + k) / (1 + std::sqrt(1 + k * (2 * v + k)));
    const double r = std::sqrt(std::max(0.0, 1 - t * t)), turn = 2 * kPi * u2;
    const Vec3 local(float(r * std::cos(turn)), float(r * std::sin(turn)), float(t));
    const Vec3 direction = (math::worldFromTangent(axis_) * local).normalized();
    return {direction, radiance(direction), pdf(direction)};
  }
  void addProjection(int bands, std::span<double> out) const override {
    const std::size_t count = std::size_t(bands) * std::size_t(bands);
    for (std::size_t c = 0; c < 3; ++c) {
      const double color = radiance_[Eigen::Index(c)];
      out[c * count] += color * std::sqrt(4 * kPi);
      if (bands < 2) continue;
      const double linear = color * steepness_ * std::sqrt(4 * kPi / 3);
      out[c * count + 1] += linear * double(axis_.y());
      out[c * count + 2] += linear * double(axis_.z());
      out[c * count + 3] += linear * double(axis_.x());
    }
  }
  ComponentPtr rotated(const Mat3& dstFromSrc) const override {
    return std::make_shared<Gradient>(dstFromSrc * axis_, steepness_, radiance_);
  }

 private:
  Vec3 axis_;
  double steepness_;
  Rgb radiance_;
};

}  // namespace lambent::light::test
