// What the tests of this room share: units of angle, and random moments and places.
#pragma once

#include <cmath>
#include <random>
#include <string>

#include <Eigen/Geometry>

#include "lambent/astronomy/horizontal.h"
#include "lambent/astronomy/moment.h"
#include "lambent/astronomy/place.h"

namespace lambent::astronomy {

inline constexpr double kDegree = kPi / 180;
inline constexpr double kMinute = kDegree / 60;
inline constexpr double kSecond = kMinute / 60;

inline double angleBetween(const Horizontal& a, const Horizontal& b) {
  const Vec3d u = worldDirection(a), v = worldDirection(b);
  return std::atan2(u.cross(v).norm(), u.dot(v));
}

/// Moments evenly over the years `first` … `last`, places evenly over the sphere.
class Samples {
 public:
  Samples(unsigned seed, int first, int last)
      : random_(seed),
        low_(parseMoment(std::to_string(first) + "-01-01", "00:00", 0)->day),
        high_(parseMoment(std::to_string(last) + "-12-31", "00:00", 0)->day) {}
  Moment moment() {
    Moment out;
    out.day = std::uniform_int_distribution<int>(low_, high_)(random_);
    out.second = std::uniform_real_distribution<double>(0, 86400)(random_);
    return out;
  }
  Place place() {
    std::uniform_real_distribution<double> unit(-1, 1);
    const double sine = unit(random_), longitude = kPi * unit(random_);
    return {std::asin(sine), longitude, 4000 * (unit(random_) + 1)};
  }

 private:
  std::mt19937 random_;
  int low_, high_;
};

}  // namespace lambent::astronomy
