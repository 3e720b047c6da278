// This work is based on what preetham2003modeling says of littlefair1994comparison and
// perez1992modeling: a linear combination of the CIE cloudless sky, a cloudless sky of high
// turbidity, the intermediate sky of nakamura1985luminance and the CIE overcast sky, weighted by
// clearness ε and brightness Δ.
//
// What was taken, and what is ours:
// - clear: CIE 1973, (.91 + 10 e^(−3γ) + .45 cos² γ)(1 − e^(−.32 / cos θ));
// - turbid: the same with (.856 + 16 e^(−3γ) + .3 cos² γ), CIE's polluted atmosphere;
// - intermediate: nakamura1985luminance in its published closed form,
//     (1.35 (sin(3.59 h − .009) + 2.31) sin(2.6 h_s + .316) + h + 4.799) / 2.326 ·
//     e^(−.563 γ ((h_s − .008)(h + 1.059) + .812)),
//     h elevation, h_s the Sun's, γ the angle between;
// - overcast: (1 + 2 cos θ) / 3;
// - ε orders overcast, intermediate, cloudless, and Δ splits the cloudless share: that much is in
//   the sources that we could read. **The knots are ours** (AsrcKnots): no source at hand states
//   numbers.
// - each sky is scaled to its share of the diffuse illuminance, so that the mixture has the
//   measured level whatever the weights. The illuminance is perez1990modeling's.
#include "lambent/sky/asrc_cie.h"

#include <algorithm>
#include <cmath>

#include "lambent/sky/dome_quadrature.h"

namespace lambent::sky {
namespace {

double nakamura(double height, double sunHeight, double sunAngle) {
  const double level =
      ((1.35 * (std::sin(3.59 * height - .009) + 2.31)) * std::sin(2.6 * sunHeight + .316) +
       height + 4.799) /
      2.326;
  const double fall = .563 * sunAngle * ((sunHeight - .008) * (height + 1.059) + .812);
  return std::max(level, 0.0) * std::exp(-fall);
}

GradedSky cloudless(double sunElevation, const Indicatrix& indicatrix) {
  return {{-1, -.32}, indicatrix, sunDirection(modelledElevation(sunElevation)), 1};
}
GradedSky relativeClear(double sunElevation) {
  return cloudless(sunElevation, {10, -3, .45, .91});
}
GradedSky relativeTurbid(double sunElevation) {
  return cloudless(sunElevation, {16, -3, .3, .856});
}

double ramp(double x, double from, double to) {
  return to > from ? std::clamp((x - from) / (to - from), 0.0, 1.0) : double(x >= to);
}

}  // namespace

double intermediateRelativeLuminance(double sunElevation, const Vec3d& direction) {
  const double sunHeight = modelledElevation(sunElevation);
  const SkyAngles angles = skyAngles(direction, sunDirection(sunHeight));
  return nakamura(kPi / 2 - angles.zenith, sunHeight, angles.sun) /
         nakamura(kPi / 2, sunHeight, kPi / 2 - sunHeight);
}

AsrcWeights asrcWeights(const SkyCondition& condition, const AsrcKnots& knots) {
  const double opening = ramp(condition.clearness, knots.overcastUntil, knots.intermediateAt);
  const double cloudlessShare =
      ramp(condition.clearness, knots.intermediateAt, knots.cloudlessFrom);
  const double turbidShare = ramp(condition.brightness, knots.clearUntil, knots.turbidFrom);
  return {cloudlessShare * (1 - turbidShare), cloudlessShare * turbidShare,
          opening * (1 - cloudlessShare), (1 - opening) * (1 - cloudlessShare)};
}

double AsrcSky::luminance(const Vec3d& direction) const {
  double sum = 0;
  if (clearScale > 0) sum += clearScale * relativeClear(sunElevation).luminance(direction);
  if (turbidScale > 0) sum += turbidScale * relativeTurbid(sunElevation).luminance(direction);
  if (intermediateScale > 0)
    sum += intermediateScale * intermediateRelativeLuminance(sunElevation, direction);
  if (overcastScale > 0) sum += overcastScale * OvercastSky{1}.luminance(direction);
  return sum;
}

AsrcSky asrcSky(const MeasuredIrradiance& irradiance, double sunElevation,
                const PerezOptions& options, const AsrcKnots& knots) {
  const PerezSky measured = perezSky(irradiance, sunElevation, options);
  AsrcSky sky;
  sky.sunElevation = modelledElevation(sunElevation);
  sky.condition = measured.condition;
  sky.diffuseIlluminance = measured.diffuseIlluminance;
  sky.directNormalIlluminance = measured.directNormalIlluminance;
  sky.weights = asrcWeights(sky.condition, knots);
  const auto scale = [&](double weight, const auto& relative) {
    return weight > 0 ? weight * sky.diffuseIlluminance / onHorizontalPlane(relative) : 0;
  };
  const GradedSky clear = relativeClear(sky.sunElevation),
                  turbid = relativeTurbid(sky.sunElevation);
  sky.clearScale = scale(sky.weights.clear, [&](const Vec3d& at) { return clear.luminance(at); });
  sky.turbidScale =
      scale(sky.weights.turbid, [&](const Vec3d& at) { return turbid.luminance(at); });
  sky.intermediateScale = scale(sky.weights.intermediate, [&](const Vec3d& at) {
    return intermediateRelativeLuminance(sky.sunElevation, at);
  });
  sky.overcastScale =
      scale(sky.weights.overcast, [](const Vec3d& at) { return OvercastSky{1}.luminance(at); });
  return sky;
}

}  // namespace lambent::sky
