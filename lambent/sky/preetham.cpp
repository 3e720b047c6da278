// This work is based on preetham1999practical: equations 3 and 4 (form and turbidity), appendix 1
// (the Sun's light at the ground), appendix 2 (coefficients), and on preetham2003modeling.
//   Y = Y_z F(θ, γ) / F(0, θ_s), and the same for the chromaticity x and y, each with its own
//   F = (1 + A e^(B / cos θ)) (1 + C e^(D γ) + E cos² γ), coefficients linear in the turbidity T;
//   Y_z = (4.0453 T − 4.9710) tan χ − .2155 T + 2.4192 kcd m⁻², χ = (4/9 − T/120)(π − 2 θ_s).
// Deviations:
// - T is kept in 2 … 10. The factor of tan χ is negative below T = 1.23, and Y_z is negative with a
//   low Sun above T = 11.2; neither is a sky. tan χ itself is finite for every T ≥ 1 (χ ≤ 78.5°).
// - With the Sun in the zenith the model's zenith stands at the Sun's own place: Y_z rises to 2.6
//   times what it is with the Sun at 30° from there (T = 2). That is the table, and it is kept: it
//   is continuous, and at 60° from the zenith, aside of the Sun, luminance rises by a sixth
//   meanwhile.
// - A Sun below the horizon: the sky of sunset times twilightFactor(). The model is far too bright
//   already at sunset (2 kcd m⁻² in the zenith for T = 2, where .2 are measured), so that its
//   twilight is as well: what is simulated is right there.
// - Spectra never are negative (radiometry/daylight.cpp).
#include "lambent/sky/preetham.h"

#include <algorithm>
#include <cmath>

#include "lambent/sky/air_mass.h"
#include "lambent/sky/twilight.h"

namespace lambent::sky {
namespace {

// The five coefficients, each k₁ T + k₀.
struct LinearInTurbidity {
  double k1, k0;
};
constexpr LinearInTurbidity kLuminance[5] = {
    {.1787, -1.4630}, {-.3554, .4275}, {-.0227, 5.3251}, {.1206, -2.5771}, {-.0670, .3703}};
constexpr LinearInTurbidity kChromaticityX[5] = {
    {-.0193, -.2592}, {-.0665, .0008}, {-.0004, .2125}, {-.0641, -.8989}, {-.0033, .0452}};
constexpr LinearInTurbidity kChromaticityY[5] = {
    {-.0167, -.2608}, {-.0950, .0092}, {-.0079, .2102}, {-.0441, -1.6537}, {-.0109, .0529}};

// Rows T², T, 1; columns θ_s³, θ_s², θ_s, 1.
constexpr double kZenithX[3][4] = {{.00166, -.00375, .00209, 0},
                                   {-.02903, .06377, -.03202, .00394},
                                   {.11693, -.21196, .06052, .25886}};
constexpr double kZenithY[3][4] = {{.00275, -.00610, .00317, 0},
                                   {-.04214, .08970, -.04153, .00516},
                                   {.15346, -.26756, .06670, .26688}};

double zenithPolynomial(const double (&m)[3][4], double t, double s) {
  const auto row = [&](int i) { return m[i][3] + s * (m[i][2] + s * (m[i][1] + s * m[i][0])); };
  return row(2) + t * (row(1) + t * row(0));
}

PreethamSky::Part makePart(const LinearInTurbidity (&k)[5], double turbidity, double zenithValue,
                           const Vec3d& sun) {
  const auto at = [&](int i) { return k[i].k1 * turbidity + k[i].k0; };
  PreethamSky::Part part{{at(0), at(1)}, {at(2), at(3), at(4), 1}, 1};
  part.scale = zenithValue / part.at(skyAngles(Vec3d(0, 1, 0), sun));
  return part;
}

struct AbsorptionAt {
  double nm, perCm;
};
constexpr AbsorptionAt kOzoneAbsorption[] = {
#include "lambent/sky/preetham_ozone.inc"
};
// Mixed gases and water vapour, at 759 … 771 and 689 … 800 nm.
constexpr AbsorptionAt kGasAbsorption[] = {{759, 0}, {760, 3}, {770, .210}, {771, 0}};
constexpr AbsorptionAt kWaterAbsorption[] = {
    {689, 0},    {690, .016}, {700, .024}, {710, .0125}, {720, 1},     {730, .87}, {740, .061},
    {750, .001}, {760, 1e-5}, {770, 1e-5}, {780, .0006}, {790, .0175}, {800, .036}};

/// 0 outside of the table but for its last entry, which goes on.
double absorption(std::span<const AbsorptionAt> table, double nm) {
  const auto above = std::ranges::upper_bound(table, nm, {}, &AbsorptionAt::nm);
  if (above == table.begin()) return nm < 350 ? table.front().perCm : 0;
  if (above == table.end()) return table.back().perCm;
  const AbsorptionAt& below = *std::prev(above);
  const double t = (nm - below.nm) / (above->nm - below.nm);
  return (1 - t) * below.perCm + t * above->perCm;
}

}  // namespace

ZenithColor preethamZenith(double turbidity, double sunZenith) {
  const double chi = (4. / 9 - turbidity / 120) * (kPi - 2 * sunZenith);
  const double kcd = (4.0453 * turbidity - 4.9710) * std::tan(chi) - .2155 * turbidity + 2.4192;
  return {1000 * std::max(kcd, 0.0), zenithPolynomial(kZenithX, turbidity, sunZenith),
          zenithPolynomial(kZenithY, turbidity, sunZenith)};
}

PreethamSky preethamSky(double turbidity, double sunElevation) {
  const double t = std::clamp(turbidity, 2.0, 10.0);
  const double height = modelledElevation(sunElevation);
  const ZenithColor zenith = preethamZenith(t, kPi / 2 - height);
  PreethamSky sky;
  sky.sun = sunDirection(height);
  sky.luminancePart =
      makePart(kLuminance, t, zenith.luminance * twilightFactor(sunElevation), sky.sun);
  sky.xPart = makePart(kChromaticityX, t, zenith.x, sky.sun);
  sky.yPart = makePart(kChromaticityY, t, zenith.y, sky.sun);
  return sky;
}

double PreethamSky::Part::at(const SkyAngles& angles) const {
  return scale * gradation.at(angles.cosZenith) * indicatrix.at(angles);
}

double PreethamSky::luminance(const Vec3d& direction) const {
  return luminancePart.at(skyAngles(direction, sun));
}

Vec3d PreethamSky::xyY(const Vec3d& direction) const {
  const SkyAngles angles = skyAngles(direction, sun);
  return {xPart.at(angles), yPart.at(angles), luminancePart.at(angles)};
}

radiometry::Xyzv PreethamSky::color(const Vec3d& direction) const {
  const Vec3d c = xyY(direction);
  return radiometry::daylightXyzv(c[0], c[1], c[2]);
}

std::vector<double> PreethamSky::spectrum(const Vec3d& direction,
                                          std::span<const double> nm) const {
  const Vec3d c = xyY(direction);
  return radiometry::daylightSpectrum(c[0], c[1], c[2], nm);
}

double preethamSunTransmittance(const SunPath& path, double sunElevation, double nm) {
  const double m = kastenAirMass(sunElevation);
  const double micrometres = nm / 1000;
  const double beta = std::max(.04608 * path.turbidity - .04586, 0.0);
  const double gas = absorption(kGasAbsorption, nm) * m;
  const double water = absorption(kWaterAbsorption, nm) * path.precipitableWater * m;
  return std::exp(-.008735 * m * std::pow(micrometres, -4.08) -
                  beta * m * std::pow(micrometres, -path.angstromExponent) -
                  absorption(kOzoneAbsorption, nm) * path.ozone * m -
                  1.41 * gas / std::pow(1 + 118.93 * gas, .45) -
                  .2385 * water / std::pow(1 + 20.07 * water, .45));
}

}  // namespace lambent::sky
