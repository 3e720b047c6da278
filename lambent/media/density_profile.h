// How the density of a medium changes with altitude, relative to that at the ground.
#pragma once

#include <variant>
#include <vector>

namespace lambent::media {

class DensityProfile {
 public:
  struct Point {
    double altitude;  ///< m
    double density;   ///< ≥ 0
    bool operator==(const Point&) const = default;
  };
  struct Exponential {
    double scaleHeight;  ///< m, > 0
    bool operator==(const Exponential&) const = default;
  };
  /// coesa1976us: seven layers of constant lapse rate, of air at rest; exponential above 84.852 km.
  struct UsStandard1976 {
    bool operator==(const UsStandard1976&) const = default;
  };
  struct Tabulated {
    std::vector<Point> points;
    bool operator==(const Tabulated&) const = default;
  };
  using Law = std::variant<Exponential, UsStandard1976, Tabulated>;

  static DensityProfile exponential(double scaleHeight) { return {Exponential{scaleHeight}}; }
  static DensityProfile usStandard1976() { return {UsStandard1976{}}; }
  /// Linear between points of rising altitude, of which two at one altitude are a step; constant
  /// beyond the first and the last. At least one point.
  static DensityProfile tabulated(std::vector<Point> points);

  /// At an altitude in m. Below the ground an exponential goes on, so that a ray that grazes it
  /// sees no step.
  double at(double altitude) const;
  /// The altitudes, m, between which it is smooth, rising; without 0 and the top.
  std::vector<double> breaks() const;
  /// Those of them where it truly bends or steps.
  std::vector<double> kinks() const;
  /// ∫ of it from altitude 0 up to `top`, m.
  double column(double top) const;

  const Law& law() const { return law_; }
  bool operator==(const DensityProfile&) const = default;

 private:
  DensityProfile(Law law) : law_(std::move(law)) {}
  Law law_;
};

}  // namespace lambent::media
