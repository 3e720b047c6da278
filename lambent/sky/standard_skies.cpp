// This work is based on CIE S 011 / ISO 15469:2004 and darula2002cie:
//   L / L_z = f(γ) φ(θ) / (f(θ_s) φ(0)),   φ(θ) = 1 + a e^(b / cos θ),
//   f(γ) = 1 + c (e^(d γ) − e^(d π/2)) + e cos² γ,
// on the clear sky of 1973 as preetham2003modeling has it, and on the overcast sky of
// moon1942illumination.
//   γ angle from the Sun, θ from the zenith, θ_s the Sun's: SkyAngles. f's constant,
//   1 − c e^(d π/2), is Indicatrix::k.
// Deviations:
// - the level of the fifteen: darula2002cie fits zenith luminance by type, and its fit grows
//   without bounds with the Sun in the zenith. We take the same typical ratio of diffuse to
//   extraterrestrial illuminance, integrate the sky and scale it; where the fit holds, the two
//   agree (a test says how well). sin h of the Sun above the air is the inverse of kasten1965new's
//   air mass, which is 3% more at 10° and leaves light at sunset.
// - with the Sun below the horizon: twilight.h.
#include "lambent/sky/standard_skies.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "lambent/sky/air_mass.h"
#include "lambent/sky/dome_quadrature.h"
#include "lambent/sky/twilight.h"

namespace lambent::sky {
namespace {

constexpr double kSolarIlluminance = 133.8e3;  // lx, above the air: as darula2002cie has it

std::array<StandardSkyShape, 15> makeStandardSkies() {
  constexpr Gradation kGradations[] = {{4, -.7},   {1.1, -.8}, {0, -1},
                                       {-1, -.55}, {-1, -.32}, {-1, -.15}};
  constexpr double kIndicatrices[][3] = {{0, -1, 0},    {2, -1.5, .15}, {5, -2.5, .3},
                                         {10, -3, .45}, {16, -3, .3},   {24, -2.8, .15}};
  struct Type {
    int gradation, indicatrix;
    double diffuseRatio;
  };
  constexpr Type kTypes[] = {{1, 1, .10}, {1, 2, .18}, {2, 1, .15}, {2, 2, .22}, {3, 1, .20},
                             {3, 2, .38}, {3, 3, .42}, {3, 4, .41}, {4, 2, .40}, {4, 3, .36},
                             {4, 4, .23}, {5, 4, .10}, {5, 5, .28}, {6, 5, .28}, {6, 6, .30}};
  std::array<StandardSkyShape, 15> skies;
  for (size_t i = 0; i < skies.size(); ++i) {
    const auto& [c, d, e] = kIndicatrices[kTypes[i].indicatrix - 1];
    skies[i] = {kGradations[kTypes[i].gradation - 1],
                {c, d, e, 1 - c * std::exp(d * kPi / 2)},
                kTypes[i].diffuseRatio};
  }
  return skies;
}

/// tan of an elevation, that goes on straight above 75°.
double boundedTangent(double elevation) {
  constexpr double kBend = 75 * kPi / 180;
  const double tangent = std::tan(std::min(elevation, kBend));
  return tangent + (1 + tangent * tangent) * std::max(elevation - kBend, 0.0);
}

}  // namespace

double OvercastSky::luminance(const Vec3d& direction) const {
  return zenithLuminance * (1 + 2 * std::clamp(direction.y(), 0.0, 1.0)) / 3;
}

OvercastSky cieOvercast(double sunElevation) {
  const double height = modelledElevation(sunElevation);
  return {(123 + 8600 * std::sin(height)) * twilightFactor(sunElevation)};
}

double GradedSky::luminance(const Vec3d& direction) const {
  const SkyAngles angles = skyAngles(direction, sun);
  const double zenith = gradation.at(1) * indicatrix.at(skyAngles(Vec3d(0, 1, 0), sun));
  return zenithLuminance * gradation.at(angles.cosZenith) * indicatrix.at(angles) / zenith;
}

GradedSky cieClear(double sunElevation, double turbidity) {
  const double height = modelledElevation(sunElevation);
  const double linke = std::clamp(turbidity, 1.4, 12.0);
  const double zenithLuminance = 1000 * ((1.376 * linke - 1.81) * boundedTangent(height) + .38);
  return {{-1, -.32},
          {10, -3, .45, .91},
          sunDirection(height),
          zenithLuminance * twilightFactor(sunElevation)};
}

const StandardSkyShape& standardSkyShape(int type) {
  static const std::array<StandardSkyShape, 15> skies = makeStandardSkies();
  return skies[size_t(std::clamp(type, 1, 15) - 1)];
}

double relativeLuminance(const StandardSkyShape& shape, double sunElevation,
                         const Vec3d& direction) {
  const Vec3d sun = sunDirection(modelledElevation(sunElevation));
  return GradedSky{shape.gradation, shape.indicatrix, sun, 1}.luminance(direction);
}

GradedSky standardSky(int type, double sunElevation) {
  const StandardSkyShape& shape = standardSkyShape(type);
  const double height = modelledElevation(sunElevation);
  GradedSky sky{shape.gradation, shape.indicatrix, sunDirection(height), 1};
  const double diffuse = shape.diffuseRatio * kSolarIlluminance / kastenAirMass(height);
  const double relative =
      onHorizontalPlane([&sky](const Vec3d& direction) { return sky.luminance(direction); });
  sky.zenithLuminance = diffuse / relative * twilightFactor(sunElevation);
  return sky;
}

}  // namespace lambent::sky
