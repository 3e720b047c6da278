// What daylight is made of, by wavelength: the Sun's spectrum, what air and ozone do to it, what
// eyes make of it, and the spectra of daylight of a given colour.
//
// Wavelengths are in nm. Each function is linear between the entries of one table; the tables stand
// in the files *.inc, each with its source.
#pragma once

#include <span>
#include <vector>

#include "lambent/math/types.h"

namespace lambent::radiometry {

// --- Tables ---

/// Spectral irradiance of the Sun outside of the atmosphere at its mean distance, W m⁻² nm⁻¹: means
/// over 10 nm at 330, 340 … 830 nm (ASTM G173-03); clamped outside.
double solarIrradiance(double nm);

/// The same spectrum as bruneton2017qualitative tabulates it, which published comparisons of sky
/// radiance are in: a mean over 11.75 nm stands at the *lower* end of its band, so the spectrum
/// lies 6 nm too low. 2.01449, 1.84687, 1.54572, 1.33778 at 450, 550, 650, 720 nm. Clamped outside
/// of 336.5 … 818.25 nm.
double solarIrradianceOfComparisons(double nm);

/// Molecular (Rayleigh) scattering coefficient of air at 15 °C and 1013.25 hPa, 1/m: table III of
/// penndorf1957tables at 330 … 830 nm times 273.16/288.16; clamped outside.
double penndorf15C(double nm);

/// Absorption cross-section of ozone at 233 K, m² per molecule: means over 10 nm at 335 … 835 nm
/// (serdyuchenko2014high from 365 nm on); clamped outside.
double ozoneCrossSection(double nm);
/// One Dobson unit, molecules per m².
inline constexpr double kDobsonUnit = 2.6867e20;

/// CIE 1931 2° colour-matching functions x̄, ȳ, z̄ at 360, 365 … 830 nm; 0 outside.
Vec3d cie1931(double nm);
/// CIE 1951 scotopic luminous efficiency V′ at 380, 385 … 780 nm; 0 outside.
double scotopicEfficiency(double nm);

// --- What eyes see ---

inline constexpr double kPhotopicEfficacy = 683.002;  ///< lm/W at the peak of V
inline constexpr double kScotopicEfficacy = 1700.06;  ///< lm/W at the peak of V′, as SI implies it

/// X, Y, Z in cd m⁻² (Y is luminance) and scotopic luminance V′ in scotopic cd m⁻².
using Xyzv = Eigen::Array<double, 4, 1, Eigen::DontAlign>;
using XyzvWeights = Eigen::Matrix<double, 4, Eigen::Dynamic>;

/// The matrix that makes Xyzv of spectral radiances (W m⁻² sr⁻¹ nm⁻¹) at `nm`, which rise strictly:
/// the integral of the 5-nm functions against the radiance that is linear between its samples,
/// exact but for rounding. The radiance counts 0 outside of its samples: of a flat spectrum 380 …
/// 740 nm hold all but 10⁻⁴ of Y and V′, and all but 5·10⁻⁴ of X and Z. One sample or none weighs
/// 0.
XyzvWeights xyzvWeights(std::span<const double> nm);
/// xyzvWeights(nm) times the spectrum; both spans are of one length.
Xyzv xyzvOf(std::span<const double> nm, std::span<const double> spectralRadiance);

/// Linear RGB, Rec. 709, W m⁻² sr⁻¹ of luminous equivalent: its luminance, .2126 R + .7152 G +
/// .0722 B, is Y / 683.002 lm/W. Colours outside of the gamut have negative components.
Eigen::Array3d linearRgbOf(const Xyzv& xyzv);

/// Magnitudes per square arcsecond of a luminance in cd m⁻²: 12.58 − 2.5 log₁₀ L, the usual
/// rounding of what garstang1986model has (12.59); +∞ for a luminance of 0.
double magnitudesPerSquareArcsecond(double luminance);

// --- Daylight ---

/// What the basis S₀ + M₁ S₁ + M₂ S₂ of daylight's spectrum is weighted by (judd1964spectral).
struct DaylightCoefficients {
  double m1, m2;
};
/// For a chromaticity. The denominator, .0241 + .2562 x − .7341 y, is kept below −.001:
/// chromaticities below y = .034 + .349 x, far from any daylight's, are not reproduced.
DaylightCoefficients daylightCoefficients(double x, double y);
/// The relative spectral power itself, 100 at 560 nm; may be negative for saturated colours. Linear
/// between 300, 310 … 830 nm, 0 outside.
double daylightPower(const DaylightCoefficients& coefficients, double nm);
/// Spectral radiances (W m⁻² sr⁻¹ nm⁻¹) at `nm` of daylight with chromaticity x, y and luminance Y
/// ≥ 0 in cd m⁻². Negative power is set to 0 before the scale to Y, which makes a saturated colour
/// a little paler; power at all of 300 … 830 nm counts for the scale, whatever `nm` holds.
std::vector<double> daylightSpectrum(double x, double y, double luminance,
                                     std::span<const double> nm);
/// X, Y, Z of a chromaticity and luminance, and the V′ that daylight of that chromaticity has (≥
/// 0). y is kept above 10⁻⁶.
Xyzv daylightXyzv(double x, double y, double luminance);

}  // namespace lambent::radiometry
