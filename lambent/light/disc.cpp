// Discs: of constant radiance, or darker towards the limb and cut by a horizon, as the Sun is; and the
// ground below a horizon, which is all that a horizon leaves of a disc that covers everything.
//
// Legend: v the versine of the disc, 1 − cos of half its angular diameter; t = (1 − cos θ)/v in
// 0 … 1, which is uniform in solid angle; μ = √(1 − t). For a small disc t = (θ/half diameter)², so
// that μ is the cosine between the surface of a far sphere and the line of sight.
//
// The mean of 1 − u (1 − μ) over the disc is 1 − u/3. Legendre polynomials of cos θ = 1 − v t are
// polynomials in μ, so that Gauss-Legendre in μ gives their moments to rounding. A disc that the
// horizon cuts is summed along circles of one elevation e, with e = centre + half diameter · sin ψ
// and the azimuth from the disc's centre φ = φ_max sin χ; the integrand is smooth in ψ and χ.
#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>
#include <vector>

#include "lambent/light/around_axis.h"
#include "lambent/light/built_in.h"
#include "lambent/math/quadrature.h"
#include "lambent/sh/basis.h"
#include "lambent/sh/zonal.h"

namespace lambent::light {
namespace {

double halfDiameter(double versine) {
  return 2 * std::asin(std::sqrt(std::min(versine / 2, 1.0)));
}

/// Moments of μ over the disc.
sh::ZonalMoments limbMoments(int bands, double versine) {
  sh::ZonalMoments moments(std::size_t(bands), 0.0);
  const math::Quadrature rule = math::gaussLegendre(bands + 1, 0, 1);
  for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
    const double mu = rule.nodes[i], x = 1 - versine * (1 - mu * mu);
    const double value = 2 * kPi * versine * 2 * mu * mu * rule.weights[i];
    double previous = 0, p = 1;
    for (int l = 0; l < bands; ++l) {
      moments[std::size_t(l)] += value * p;
      const double next = ((2 * l + 1) * x * p - l * previous) / (l + 1);
      previous = p;
      p = next;
    }
  }
  return moments;
}

/// A part of the disc: where it lies, how large it is (sr), and its μ.
struct Node {
  Vec3d direction;
  double area, mu;
};

/// What stands above the horizon of a disc that the horizon cuts.
std::vector<Node> nodesAbove(const DiscShape& disc) {
  constexpr int kSteps = 8;  // for a disc of 0.2 rad, 1e-7 of the whole; for the Sun's, rounding
  const double half = halfDiameter(disc.versine);
  const double ay = std::clamp(disc.axis.dot(disc.up), -1.0, 1.0), center = std::asin(ay);
  const double aRho = std::cos(center), horizon = std::asin(disc.horizon);
  if (horizon >= center + half || !(aRho > 0)) return {};
  const Vec3d ahead = (disc.axis - ay * disc.up).normalized(), aside = disc.up.cross(ahead);
  const double lowest = std::asin(std::clamp((horizon - center) / half, -1.0, 1.0));
  const math::Quadrature psis = math::gaussLegendre(kSteps, lowest, kPi / 2);
  const math::Quadrature chis = math::gaussLegendre(kSteps, -kPi / 2, kPi / 2);
  std::vector<Node> nodes;
  for (int j = 0; j < kSteps; ++j) {
    const double e = center + half * std::sin(psis.nodes[j]);
    const double y = std::sin(e), rho = std::cos(e);
    // |s − axis|² = off + 2 ρ ρ_axis (1 − cos φ), and 2v at the rim.
    const double off = std::pow(2 * std::sin((e - center) / 2), 2);
    const double inside = (2 * disc.versine - off) / (4 * rho * aRho);
    if (!(inside > 0)) continue;
    const double phiMax = 2 * std::asin(std::sqrt(std::min(inside, 1.0)));
    for (int i = 0; i < kSteps; ++i) {
      const double phi = phiMax * std::sin(chis.nodes[i]);
      const double mu2 = 2 * rho * aRho * std::sin((phiMax - phi) / 2) *
                         std::sin((phiMax + phi) / 2) / disc.versine;
      nodes.push_back({y * disc.up + rho * (std::cos(phi) * ahead + std::sin(phi) * aside),
                       psis.weights[j] * half * std::cos(psis.nodes[j]) * rho * chis.weights[i] *
                           phiMax * std::cos(chis.nodes[i]),
                       std::sqrt(std::clamp(mu2, 0.0, 1.0))});
    }
  }
  return nodes;
}

Rgb shade(const DiscShape& disc, double mu) {
  return disc.radiance * (1 - disc.darkening * float(1 - mu));
}

/// Whether the horizon hides a part of it.
bool isCut(const DiscShape& disc) {
  const double half = halfDiameter(disc.versine);
  return !disc.up.isZero() && std::asin(std::clamp(disc.axis.dot(disc.up), -1.0, 1.0)) - half <
                                  std::asin(std::clamp(disc.horizon, -1.0, 1.0));
}

class Disc final : public Component {
 public:
  explicit Disc(const DiscShape& shape) : shape_(shape), solidAngle_(2 * kPi * shape.versine) {
    const Rgb flat = shape_.radiance * (1 - shape_.darkening);
    const double all = importance(shape_.radiance);
    if (all > 0) darkening_ = std::clamp(1 - importance(flat) / all, 0.0, 1.0);
    if (isCut(shape_)) visible_ = nodesAbove(shape_);
    // A sliver that the nodes miss is drawn seldom, and still.
    power_ = solidAngle_ * all * (1 - darkening_ / 3);
    if (visible_) {
      double sum = 0;
      for (const Node& node : *visible_) sum += node.area * importance(shade(shape_, node.mu));
      power_ = std::max(sum, 1e-6 * power_);
    }
  }
  double power() const override { return power_; }
  Rgb radiance(const Vec3& direction) const override {
    const Vec3d s = direction.cast<double>();
    const double t = place(s);
    if (t > 1 || s.dot(shape_.up) < shape_.horizon) return Rgb::Zero();
    return shade(shape_, std::sqrt(1 - t));
  }
  double pdf(const Vec3& direction) const override {
    const double t = place(direction.cast<double>());
    return t > 1 ? 0 : density(std::sqrt(1 - t));
  }
  Drawn draw(double u1, double u2) const override {
    // A flat disc or one whose radiance is μ, each as often as it adds to the whole.
    const double flat = (1 - darkening_) / (1 - darkening_ / 3);
    const double t = u1 < flat ? u1 / flat : 1 - std::pow((u1 - flat) / (1 - flat), 2.0 / 3);
    const Vec3 s = aroundAxis(shape_.axis, t * shape_.versine, u2).cast<float>();
    const double mu = std::sqrt(std::max(0.0, 1 - t));
    const bool hidden = s.cast<double>().dot(shape_.up) < shape_.horizon;
    return {s, hidden ? Rgb(Rgb::Zero()) : shade(shape_, mu), density(mu)};
  }
  void addProjection(int bands, std::span<double> out) const override {
    if (visible_) {
      const std::size_t count = std::size_t(sh::coefficientCount(bands));
      std::vector<double> y(count);
      for (const Node& node : *visible_) {
        sh::evaluate(bands, node.direction, std::span<double>(y));
        const Rgb radiance = shade(shape_, node.mu);
        for (int c = 0; c < 3; ++c)
          for (std::size_t i = 0; i < count; ++i)
            out[c * count + i] += node.area * double(radiance[c]) * y[i];
      }
      return;
    }
    addZonal(sh::cap(bands, halfDiameter(shape_.versine)), shape_.axis,
             shape_.radiance * (1 - shape_.darkening), out);
    if ((shape_.darkening > 0).any())
      addZonal(limbMoments(bands, shape_.versine), shape_.axis, shape_.radiance * shape_.darkening,
               out);
  }
  ComponentPtr rotated(const Mat3& dstFromSrc) const override {
    DiscShape shape = shape_;
    shape.axis = turned(dstFromSrc, shape_.axis);
    if (!shape.up.isZero()) shape.up = turned(dstFromSrc, shape_.up);
    return std::make_shared<Disc>(shape);
  }
  bool addTo(Environment::Parts& parts) const override {
    parts.discs.push_back({shape_.axis.cast<float>(), shape_.versine, shape_.radiance,
                           shape_.darkening, shape_.up.cast<float>(), shape_.horizon});
    return true;
  }

 private:
  /// t, above 1 outside of the disc. |s − axis|² = 2 (1 − cos): compares small angles without
  /// cancellation.
  double place(const Vec3d& s) const {
    return (s - shape_.axis).squaredNorm() / (2 * shape_.versine);
  }
  double density(double mu) const {
    return (1 - darkening_ * (1 - mu)) / ((1 - darkening_ / 3) * solidAngle_);
  }
  DiscShape shape_;
  double solidAngle_, power_ = 0;
  double darkening_ = 0;                      ///< of what directions are drawn by
  std::optional<std::vector<Node>> visible_;  ///< of a disc that the horizon cuts
};

class Ground final : public Component {
 public:
  Ground(const Vec3d& up, double horizon, const Rgb& radiance)
      : up_(up), horizon_(horizon), radiance_(radiance) {}
  double power() const override { return solidAngle() * importance(radiance_); }
  Rgb radiance(const Vec3& direction) const override {
    return isBelow(direction) ? radiance_ : Rgb(Rgb::Zero());
  }
  double pdf(const Vec3& direction) const override {
    return isBelow(direction) ? 1 / solidAngle() : 0;
  }
  Drawn draw(double u1, double u2) const override {
    return {aroundAxis(-up_, u1 * (1 + horizon_), u2).cast<float>(), radiance_, 1 / solidAngle()};
  }
  void addProjection(int bands, std::span<double> out) const override {
    addZonal(sh::cap(bands, halfDiameter(1 + horizon_)), -up_, radiance_, out);
  }
  ComponentPtr rotated(const Mat3& dstFromSrc) const override {
    return makeGround(turned(dstFromSrc, up_), horizon_, radiance_);
  }
  bool addTo(Environment::Parts& parts) const override {
    const Vec3 down = -up_.cast<float>();
    parts.discs.push_back({down, 2, radiance_, Rgb::Zero(), down, -horizon_});
    return true;
  }

 private:
  double solidAngle() const { return 2 * kPi * (1 + horizon_); }
  bool isBelow(const Vec3& direction) const {
    return direction.cast<double>().dot(up_) <= horizon_;
  }
  Vec3d up_;
  double horizon_;  ///< a sine
  Rgb radiance_;
};

}  // namespace

ComponentPtr makeGround(const Vec3d& up, double horizon, const Rgb& radiance) {
  if (!(horizon > -1)) return makeUniform(Rgb::Zero());
  return std::make_shared<Ground>(up.normalized(), std::min(horizon, 1.0), radiance);
}

ComponentPtr makeDisc(const DiscShape& shape) {
  assert(shape.versine <= 2 * (1 + 1e-12));
  if (!(shape.versine > 0)) return makeUniform(Rgb::Zero());  // a disc without area is black
  if (shape.versine >= 2 && !shape.up.isZero())
    return makeGround(-shape.up, -shape.horizon, shape.radiance);
  DiscShape unit = shape;
  unit.axis.normalize();
  if (!unit.up.isZero()) unit.up.normalize();
  return std::make_shared<Disc>(unit);
}

ComponentPtr makeLimbDarkened(const Environment::LimbDarkened& disc) {
  assert(disc.angularDiameter > 0 && disc.angularDiameter <= 0.2);
  const double sine = std::sin(disc.angularDiameter / 4);
  DiscShape shape{.axis = disc.direction.cast<double>().normalized(),
                  .versine = 2 * sine * sine,
                  .radiance = Rgb::Ones(),
                  .darkening = disc.darkening,
                  .up = disc.up.cast<double>().normalized(),
                  .horizon = disc.horizon > -kPi / 2 ? std::sin(disc.horizon) : -2};
  const double v = shape.versine;
  Eigen::Array3d irradiance;  // of a centre of 1
  if (isCut(shape)) {
    irradiance.setZero();
    for (const Node& node : nodesAbove(shape))
      irradiance +=
          node.area * node.direction.dot(shape.axis) * shade(shape, node.mu).cast<double>();
  } else {
    // 2πv ∫ (1 − u + u √(1 − t)) (1 − v t) dt
    const Eigen::Array3d u = shape.darkening.cast<double>();
    irradiance = 2 * kPi * v * ((1 - u) * (1 - v / 2) + u * (2.0 / 3 - v * 4 / 15));
  }
  // So little of it stands above the horizon that its border alone would decide how bright it is.
  if (!(irradiance.minCoeff() > 1e-7 * kPi * v)) return makeUniform(Rgb::Zero());
  shape.radiance = (disc.irradiance.cast<double>() / irradiance).cast<float>();
  return makeDisc(shape);
}

}  // namespace lambent::light
