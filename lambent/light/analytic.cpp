// Lights that a formula gives: uniform, disc, directional, clamped cosine. All are zonal, so their
// projections are Legendre moments turned to the axis (exact, in double precision).
//
// This work is based on:
// - sloan2002precomputed: §3, eq. 6: rotation of zonal functions as an evaluation of the basis.
#include <algorithm>
#include <cassert>
#include <cmath>
#include <vector>

#include <Eigen/Geometry>

#include "lambent/light/built_in.h"
#include "lambent/math/directions.h"
#include "lambent/sh/basis.h"
#include "lambent/sh/zonal.h"

namespace lambent::light {
namespace {

Vec3d turned(const Mat3& dstFromSrc, const Vec3d& axis) {
  return (dstFromSrc.cast<double>() * axis).normalized();
}

void addZonal(const sh::ZonalMoments& moments, const Vec3d& axis, const Rgb& color,
              std::span<double> out) {
  const std::size_t count = moments.size() * moments.size();
  std::vector<double> one(count);
  sh::turnTo(moments, axis, std::span<double>(one));
  for (int c = 0; c < 3; ++c)
    for (std::size_t i = 0; i < count; ++i) out[c * count + i] += double(color[c]) * one[i];
}

/// A unit vector at an angle from `axis`, given by versine = 1 − cos: that keeps the digits of
/// small angles, which cos itself loses.
Vec3d aroundAxis(const Vec3d& axis, double versine, double turn) {
  const Mat3d frame = math::worldFromTangent(axis.cast<float>()).cast<double>();
  // The frame is of single precision: made orthogonal to the axis again in double.
  const Vec3d x = (frame.col(0) - axis * axis.dot(frame.col(0))).normalized();
  const Vec3d y = axis.cross(x);
  const double sine = std::sqrt(std::max(0.0, versine * (2 - versine)));
  return (1 - versine) * axis +
         sine * (std::cos(2 * kPi * turn) * x + std::sin(2 * kPi * turn) * y);
}

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

class Disc final : public Component {
 public:
  Disc(const Vec3d& axis, double angularDiameter, const Rgb& radiance)
      : axis_(axis), halfAngle_(angularDiameter / 2), radiance_(radiance) {
    assert(angularDiameter <= 2 * kPi * (1 + 1e-12));
    const double s = std::sin(halfAngle_ / 2);
    versine_ = 2 * s * s;
    solidAngle_ = 2 * kPi * versine_;
  }
  double power() const override { return solidAngle_ * importance(radiance_); }
  Rgb radiance(const Vec3& direction) const override {
    return within(direction) ? radiance_ : Rgb(Rgb::Zero());
  }
  double pdf(const Vec3& direction) const override {
    return within(direction) ? 1 / solidAngle_ : 0;
  }
  Drawn draw(double u1, double u2) const override {
    return {aroundAxis(axis_, u1 * versine_, u2).cast<float>(), radiance_, 1 / solidAngle_};
  }
  void addProjection(int bands, std::span<double> out) const override {
    addZonal(sh::cap(bands, halfAngle_), axis_, radiance_, out);
  }
  ComponentPtr rotated(const Mat3& dstFromSrc) const override {
    return makeDisc(turned(dstFromSrc, axis_), 2 * halfAngle_, radiance_);
  }
  bool addTo(Environment::Parts& parts) const override {
    parts.discs.push_back({axis_.cast<float>(), versine_, radiance_});
    return true;
  }

 private:
  bool within(const Vec3& direction) const {
    // |s − axis|² = 2 (1 − cos): compares small angles without cancellation.
    return (direction.cast<double>() - axis_).squaredNorm() <= 2 * versine_;
  }
  Vec3d axis_;
  double halfAngle_, versine_, solidAngle_;
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
ComponentPtr makeDisc(const Vec3d& axis, double angularDiameter, const Rgb& radiance) {
  if (!(angularDiameter > 0)) return makeUniform(Rgb::Zero());  // a disc without area is black
  return std::make_shared<Disc>(axis.normalized(), angularDiameter, radiance);
}
ComponentPtr makeDirectional(const Vec3d& direction, const Rgb& irradiance) {
  return std::make_shared<Directional>(direction.normalized(), irradiance);
}
ComponentPtr makeClampedCosine(const Vec3d& axis, const Rgb& radiance) {
  return std::make_shared<ClampedCosine>(axis.normalized(), radiance);
}

}  // namespace lambent::light
