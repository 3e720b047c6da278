// This work is based on perez1993all (the pattern, equations 1 … 4) and on perez1990modeling
// (clearness, brightness, luminous efficacy).
//   L ∝ (1 + a e^(b / cos θ)) (1 + c e^(d γ) + e cos² γ),
//   x = x₁ + x₂ Z + Δ (x₃ + x₄ Z) for a … e but for c and d of the first row.
//   ε clearness, Δ brightness, Z the Sun's zenith angle: SkyCondition. W precipitable water.
// Deviations:
// - steps between rows of clearness are in the model; PerezOptions::blend mixes two skies, each
//   with its own coefficients and efficacy, about a border. Mixing coefficients instead would make
//   skies of neither kind: c and d of neighbours differ by factors.
// - a factor that would be negative is 0, and b counts as at most 0: where the model is asked for
//   what never was measured (a clear sky with hardly any diffuse light), its b is above 0 and the
//   horizon infinite.
#include "lambent/sky/perez.h"

#include <algorithm>
#include <cmath>

#include "lambent/sky/air_mass.h"
#include "lambent/sky/dome_quadrature.h"
#include "lambent/sky/perez_tables.h"

namespace lambent::sky {
namespace {

constexpr double kSolarConstant = 1367;  // W m⁻²: as perez1990modeling has it

struct BinShare {
  int bin;
  double share;
};
/// The row of a clearness, and the row beyond the border that is near, if one is.
std::pair<BinShare, BinShare> binShares(double clearness, double blend) {
  const double width = std::clamp(blend, 0.0, .03);
  for (int border = 0; border + 1 < kPerezBins; ++border) {
    const double distance = std::log(clearness / kPerezBorders[border]);
    if (width > 0 && std::abs(distance) < width) {
      const double t = (distance / width + 1) / 2;
      const double upper = t * t * (3 - 2 * t);
      return {{border, 1 - upper}, {border + 1, upper}};
    }
  }
  return {{clearnessBin(clearness), 1}, {0, 0}};
}

}  // namespace

SkyCondition skyCondition(const MeasuredIrradiance& irradiance, double sunElevation,
                          double sunDistance) {
  const double height = modelledElevation(sunElevation), zenith = kPi / 2 - height;
  const double diffuse = std::max(irradiance.diffuseHorizontal, 0.0);
  const double direct = std::max(irradiance.directNormal, 0.0);
  const double cubic = 1.041 * zenith * zenith * zenith;
  const double ratio = diffuse > 0 ? direct / diffuse : direct > 0 ? 1e3 : 0;
  const double above = kSolarConstant / (sunDistance * sunDistance);
  return {std::clamp((1 + ratio + cubic) / (1 + cubic), 1.0, 12.0),
          std::clamp(kastenAirMass(height) * diffuse / above, .01, .6)};
}

int clearnessBin(double clearness) {
  return int(std::upper_bound(std::begin(kPerezBorders), std::end(kPerezBorders), clearness) -
             std::begin(kPerezBorders));
}

PerezCoefficients perezCoefficients(int bin, double brightness, double sunZenith) {
  const auto& row = kPerezTable[std::clamp(bin, 0, kPerezBins - 1)];
  const double delta = bin >= 1 && bin <= 4 ? std::max(brightness, .2) : brightness;
  const auto linear = [&](const double(&x)[4]) {
    return x[0] + x[1] * sunZenith + delta * (x[2] + x[3] * sunZenith);
  };
  PerezCoefficients k{linear(row[0]), linear(row[1]), linear(row[2]), linear(row[3]),
                      linear(row[4])};
  if (bin <= 0) {
    const auto& c = row[2];
    const auto& d = row[3];
    k.c = std::exp(std::pow(delta * (c[0] + c[1] * sunZenith), c[2])) - c[3];
    k.d = -std::exp(delta * (d[0] + d[1] * sunZenith)) + d[2] + delta * d[3];
  }
  return k;
}

Efficacy perezEfficacy(int bin, double brightness, double sunZenith, double precipitableWater) {
  const int row = std::clamp(bin, 0, kPerezBins - 1);
  const auto& f = kPerezDiffuseEfficacy[row];
  const auto& n = kPerezDirectEfficacy[row];
  return {std::max(f[0] + f[1] * precipitableWater + f[2] * std::cos(sunZenith) +
                       f[3] * std::log(brightness),
                   0.0),
          std::max(n[0] + n[1] * precipitableWater + n[2] * std::exp(5.73 * sunZenith - 5) +
                       n[3] * brightness,
                   0.0)};
}

double PerezSky::luminance(const Vec3d& direction) const {
  const SkyAngles angles = skyAngles(direction, sun);
  double sum = 0;
  for (const Part& part : parts) {
    if (part.scale > 0) {
      sum += part.scale * part.gradation.at(angles.cosZenith) * part.indicatrix.at(angles);
    }
  }
  return sum;
}

PerezSky perezSky(const MeasuredIrradiance& irradiance, double sunElevation,
                  const PerezOptions& options) {
  const double height = modelledElevation(sunElevation), zenith = kPi / 2 - height;
  PerezSky sky;
  sky.sun = sunDirection(height);
  sky.condition = skyCondition(irradiance, sunElevation, options.sunDistance);
  const auto [first, second] = binShares(sky.condition.clearness, options.blend);
  for (int i = 0; i < 2; ++i) {
    const BinShare& of = i == 0 ? first : second;
    if (!(of.share > 0)) {
      continue;
    }
    PerezSky::Part& part = sky.parts[i];
    const double brightness = sky.condition.brightness;
    const PerezCoefficients k = perezCoefficients(of.bin, brightness, zenith);
    part.gradation = {k.a, std::min(k.b, 0.0)};
    part.indicatrix = {k.c, k.d, k.e, 1};
    const Efficacy efficacy = perezEfficacy(of.bin, brightness, zenith, options.precipitableWater);
    const double illuminance =
        of.share * efficacy.diffuse * std::max(irradiance.diffuseHorizontal, 0.0);
    sky.diffuseIlluminance += illuminance;
    sky.directNormalIlluminance +=
        of.share * efficacy.direct * std::max(irradiance.directNormal, 0.0);
    const auto relative = [&](const Vec3d& direction) {
      const SkyAngles angles = skyAngles(direction, sky.sun);
      return part.gradation.at(angles.cosZenith) * part.indicatrix.at(angles);
    };
    double integral = onHorizontalPlane(relative);
    if (!(integral > 1e-9)) {  // nothing left of the pattern: an even sky
      part.gradation = {0, -1};
      part.indicatrix = {0, -1, 0, 1};
      integral = kPi;
    }
    part.scale = illuminance / integral;
  }
  return sky;
}

}  // namespace lambent::sky
