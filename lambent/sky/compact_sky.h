// A sky as 9 … 100 coefficients: series of cosines, or spherical harmonics.
#pragma once

#include <functional>
#include <vector>

#include "lambent/math/types.h"
#include "lambent/radiometry/spectra.h"

namespace lambent::sky {

/// What a compact sky is a sum of, over the half dome z ≥ 0 of the Sun's frame (z and −z are
/// alike).
enum class CompactBasis {
  /// cos(2 i θ) cos(j φ), i, j < n: θ the zenith angle, φ the azimuth from the Sun
  /// (dobashi1995fast). Least squares over the hemisphere.
  Cosines,
  /// n bands of spherical harmonics, their polar axis +y so that the zenith is the pole, least
  /// squares over the upper hemisphere alone. Below it the sum means nothing.
  HarmonicsAbove,
  /// n bands, projected from the sky above a black ground: what a light in harmonics is. It rings
  /// at the horizon.
  HarmonicsBlackBelow,
  /// n bands, projected from the sky and its mirror image below the horizon.
  HarmonicsMirrored,
};

using SkyColor = std::function<radiometry::Xyzv(const Vec3d&)>;

struct CompactSky {
  CompactBasis basis = CompactBasis::Cosines;
  int n = 3;
  /// n² of them. Of harmonics, order m < 0 is odd in z: its coefficients are 0.
  std::vector<radiometry::Xyzv> coefficients;
  /// The sum; it may be negative where the sky is dark. Unit directions; below the horizon what
  /// stands there in harmonics, what stands at the horizon in cosines.
  radiometry::Xyzv color(const Vec3d& direction) const;
};

/// n of 1 … 10. The sky is looked up in some 5000 directions above the horizon.
CompactSky compactSky(CompactBasis basis, int n, const SkyColor& sky);

/// How far luminance is off over the upper hemisphere, by solid angle.
struct CompactSkyError {
  double rms = 0;      ///< of the difference, over the root mean square of the sky's luminance
  double largest = 0;  ///< absolute difference, over the same
};
CompactSkyError errorOf(const CompactSky& compact, const SkyColor& sky);

}  // namespace lambent::sky
