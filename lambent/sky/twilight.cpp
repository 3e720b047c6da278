// This work is based on seidelmann1992explanatory: the decimal logarithm of the
// illuminance on a horizontal plane as cubics of the Sun's elevation, three of them below the
// horizon.
// Deviation: the cubics leave steps of 1% where they meet; we take their values every 3° and
// join them monotonically with a continuous slope (fritsch1980monotone).
#include "lambent/sky/twilight.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "lambent/math/types.h"

namespace lambent::sky {
namespace {

/// Of the zenith and horizon-ward cubics l₀ + l₁ x + l₂ x² + l₃ x³, x the elevation over 90°.
double log10Illuminance(double degrees) {
  struct Cubic {
    double l0, l1, l2, l3;
  };
  const Cubic c = degrees >= -.8   ? Cubic{2.88, 22.26, -207.64, 1034.30}
                  : degrees >= -5  ? Cubic{2.88, 21.81, -258.11, -858.36}
                  : degrees >= -12 ? Cubic{2.70, 12.17, -431.69, -1899.83}
                                   : Cubic{13.84, 262.72, 1447.42, 2797.93};
  const double x = degrees / 90;
  return c.l0 + x * (c.l1 + x * (c.l2 + x * c.l3));
}

constexpr int kNodes = 7;
constexpr double kNodeStep = 3;  // degrees

struct TwilightCurve {
  std::array<double, kNodes> value;  ///< log₁₀ of the factor at −18°, −15° … 0°
  std::array<double, kNodes> slope;  ///< per step
};

TwilightCurve makeTwilightCurve() {
  TwilightCurve curve{};
  for (int i = 0; i < kNodes; ++i) {
    curve.value[i] = log10Illuminance(kNodeStep * (i - (kNodes - 1))) - log10Illuminance(0);
  }
  const auto rise = [&](int i) { return curve.value[i + 1] - curve.value[i]; };
  curve.slope.front() = rise(0);
  curve.slope.back() = rise(kNodes - 2);
  for (int i = 1; i + 1 < kNodes; ++i) {
    const double before = rise(i - 1), after = rise(i);
    curve.slope[i] = before > 0 && after > 0 ? 2 * before * after / (before + after) : 0;
  }
  return curve;
}

}  // namespace

double twilightFactor(double sunElevation) {
  static const TwilightCurve curve = makeTwilightCurve();
  if (!(sunElevation < 0)) {
    return 1;
  }
  const double u = std::max(sunElevation * 180 / kPi / kNodeStep + (kNodes - 1), 0.0);
  const int i = std::min(int(u), kNodes - 2);
  const double t = u - i, s = 1 - t;
  const double log10Factor = curve.value[i] * s * s * (1 + 2 * t) + curve.slope[i] * t * s * s +
                             curve.value[i + 1] * t * t * (1 + 2 * s) -
                             curve.slope[i + 1] * s * t * t;
  return std::pow(10, log10Factor);
}

}  // namespace lambent::sky
