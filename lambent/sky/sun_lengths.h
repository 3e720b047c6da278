// Optical lengths from anywhere in the air to its top, as a table.
#pragma once

#include <vector>

#include "lambent/sky/medium.h"

namespace lambent::sky {

class SunLengths {
 public:
  SunLengths() = default;
  explicit SunLengths(const Medium& medium);
  /// Of each Part, m, from an altitude towards a zenith angle (rad); a direction below the horizon
  /// counts as the horizon. Good to 2e-4 of each and 5 m: an optical
  /// thickness of 10⁻⁴ in the bluest air.
  void at(double altitude, double zenithAngle, float (&lengths)[kParts]) const;
  /// Zenith angle of the horizon, rad.
  double horizonAngle(double altitude) const;

 private:
  media::Shell shell_{};
  std::vector<float> logLengths_;  ///< log(1 m + length), [altitude][angle][4]
};

}  // namespace lambent::sky
