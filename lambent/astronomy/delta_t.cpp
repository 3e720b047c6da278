#include "lambent/astronomy/delta_t.h"

#include <cmath>
#include <initializer_list>
#include <iterator>

#include <erfa.h>

namespace lambent::astronomy {
namespace {

/// Coefficients from the constant term up.
double polynomial(double t, std::initializer_list<double> coefficients) {
  double sum = 0;
  for (auto c = std::rbegin(coefficients); c != std::rend(coefficients); ++c) sum = sum * t + *c;
  return sum;
}

constexpr int kFirstLeapDay = 36934;  // 1960 January 1: UTC begins
constexpr int kLastLeapDay = 61406;   // 2027 January 1: no leap second is announced before
constexpr double kTerrestrialMinusAtomic = 32.184;
constexpr double kFadeYears = 20;

double decimalYear(double modifiedJulianDay) {
  return 2000 + (modifiedJulianDay - 51544) / 365.25;
}

double byLeapSeconds(const Moment& moment) {
  const CivilTime utc = civilTime(moment);
  double atomicMinusUtc = 0;
  // A warning (1: a year after its release) comes with the last value that it knows.
  eraDat(utc.year, utc.month, utc.day, moment.second / 86400, &atomicMinusUtc);
  return atomicMinusUtc + kTerrestrialMinusAtomic;
}

}  // namespace

double polynomialDeltaT(double year) {
  if (year < 1700) return polynomial(year - 1600, {120, -0.9808, -0.01532, 1.0 / 7129});
  if (year < 1800)
    return polynomial(year - 1700, {8.83, 0.1603, -0.0059285, 0.00013336, -1.0 / 1174000});
  if (year < 1860)
    return polynomial(year - 1800, {13.72, -0.332447, 0.0068612, 0.0041116, -0.00037436,
                                    0.0000121272, -0.0000001699, 0.000000000875});
  if (year < 1900)
    return polynomial(year - 1860,
                      {7.62, 0.5737, -0.251754, 0.01680668, -0.0004473624, 1.0 / 233174});
  if (year < 1920)
    return polynomial(year - 1900, {-2.79, 1.494119, -0.0598939, 0.0061966, -0.000197});
  if (year < 1941) return polynomial(year - 1920, {21.20, 0.84493, -0.076100, 0.0020936});
  if (year < 1961) return polynomial(year - 1950, {29.07, 0.407, -1.0 / 233, 1.0 / 2547});
  if (year < 1986) return polynomial(year - 1975, {45.45, 1.067, -1.0 / 260, -1.0 / 718});
  if (year < 2005)
    return polynomial(year - 2000,
                      {63.86, 0.3345, -0.060374, 0.0017275, 0.000651814, 0.00002373599});
  if (year < 2050) return polynomial(year - 2000, {62.92, 0.32217, 0.005589});
  const double centuries = (year - 1820) / 100;
  const double parabola = -20 + 32 * centuries * centuries;
  return year < 2150 ? parabola - 0.5628 * (2150 - year) : parabola;
}

double terrestrialMinusUtc(const Moment& moment) {
  const double year = decimalYear(moment.day + moment.second / 86400);
  if (moment.day < kFirstLeapDay) return polynomialDeltaT(year);
  if (moment.day < kLastLeapDay) return byLeapSeconds(moment);
  const double lastYear = decimalYear(kLastLeapDay);
  const double gap = byLeapSeconds({kLastLeapDay - 1, 0}) - polynomialDeltaT(lastYear);
  return polynomialDeltaT(year) + gap * std::exp(-(year - lastYear) / kFadeYears);
}

}  // namespace lambent::astronomy
