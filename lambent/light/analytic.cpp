// Lights that a formula gives: uniform, directional, clamped cosine; discs are in disc.cpp. All are
// zonal, so their projections are Legendre moments turned to the axis (exact, in double precision).
//
// This work is based on:
// - sloan2002precomputed: §3, eq. 6: rotation of zonal functions as an evaluation of the basis.
#include <algorithm>
#include <cmath>
#include <limits>

#include "lambent/light/around_axis.h"
#include "lambent/light/built_in.h"
#include "lambent/sh/basis.h"
#include "lambent/sh/zonal.h"

namespace lambent::light {
namespace {

class Uniform final : public Component {
 public:
  explicit Uniform(const Rgb& radiance) : radiance_(radiance) {}
  double power() const override { return 4 * kPi * importance(radiance_); }
  Rgb radiance(const Vec3&) const override { return radiance_; }
  double pdf(const Vec3&) const override { return 1 / (4 * kPi); }
  Drawn draw(double u1, double u2) const override {
    return {aroundAxis(Vec3d::UnitZ(), 2 * u1, u2).cast<float>(), radiance_, 1 / (4 * kPi)};
  }
  void addProjection(int bands, std::span<double> out) const override {
    // ∫ y₀₀ ds = √(4π); every other basis function integrates to 0.
    for (int c = 0; c < 3; ++c)
      out[c * sh::coefficientCount(bands)] += std::sqrt(4 * kPi) * double(radiance_[c]);
  }
  ComponentPtr rotated(const Mat3&) const override { return makeUniform(radiance_); }
  bool addTo(Environment::Parts& parts) const override {
    parts.uniform += radiance_;
    return true;
  }

 private:
  Rgb radiance_;
};

class Directional final : public Component {
 public:
  Directional(const Vec3d& direction, const Rgb& irradiance)
      : direction_(direction), irradiance_(irradiance) {}
  double power() const override { return importance(irradiance_); }
  Rgb radiance(const Vec3&) const override { return Rgb::Zero(); }
  double pdf(const Vec3&) const override { return 0; }
  Drawn draw(double, double) const override {
    return {direction_.cast<float>(), irradiance_, std::numeric_limits<double>::infinity()};
  }
  void addProjection(int bands, std::span<double> out) const override {
    addZonal(sh::delta(bands), direction_, irradiance_, out);
  }
  ComponentPtr rotated(const Mat3& dstFromSrc) const override {
    return makeDirectional(turned(dstFromSrc, direction_), irradiance_);
  }
  bool addTo(Environment::Parts&) const override { return true; }  // no radiance to look up

 private:
  Vec3d direction_;
  Rgb irradiance_;
};

class ClampedCosine final : public Component {
 public:
  ClampedCosine(const Vec3d& axis, const Rgb& radiance) : axis_(axis), radiance_(radiance) {}
  double power() const override { return kPi * importance(radiance_); }
  Rgb radiance(const Vec3& direction) const override {
    return radiance_ * float(cosine(direction));
  }
  double pdf(const Vec3& direction) const override { return cosine(direction) / kPi; }
  Drawn draw(double u1, double u2) const override {
    const double cosTheta = std::sqrt(1 - u1);
    return {aroundAxis(axis_, 1 - cosTheta, u2).cast<float>(), radiance_ * float(cosTheta),
            cosTheta / kPi};
  }
  void addProjection(int bands, std::span<double> out) const override {
    addZonal(sh::clampedCosine(bands), axis_, radiance_, out);
  }
  ComponentPtr rotated(const Mat3& dstFromSrc) const override {
    return makeClampedCosine(turned(dstFromSrc, axis_), radiance_);
  }

 private:
  double cosine(const Vec3& direction) const {
    return std::max(0.0, direction.cast<double>().dot(axis_));
  }
  Vec3d axis_;
  Rgb radiance_;
};

}  // namespace

ComponentPtr makeUniform(const Rgb& radiance) {
  return std::make_shared<Uniform>(radiance);
}
ComponentPtr makeDirectional(const Vec3d& direction, const Rgb& irradiance) {
  return std::make_shared<Directional>(direction.normalized(), irradiance);
}
ComponentPtr makeClampedCosine(const Vec3d& axis, const Rgb& radiance) {
  return std::make_shared<ClampedCosine>(axis.normalized(), radiance);
}

}  // namespace lambent::light
