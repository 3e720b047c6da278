// Sharp shadows of a small disc over low-frequency transfer. The Sun S is a part of the light L. With
// M the transfer that is shown, D what it is without bounces, and V what is seen of the Sun, a diffuse
// surface sends out
//
//   M · L − D · S + ρ/π ∫ V(s) S(s) max(0, n·s) ds
//
// so that nothing counts twice: what is taken out is exactly what D makes of the Sun, what is put in
// is the same without a limit to its bands. The Sun's bounces, (M − D) · S, stay, and so do lobes and
// meso-structure, which show the Sun as the harmonics have it. D knows light that comes by way of
// mirrors, V does not: a caustic of the Sun is lost.
#pragma once

#include <optional>

#include "lambent/asset/asset.h"
#include "lambent/light/sun.h"
#include "lambent/report/finding.h"
#include "lambent/sh/coefficients.h"
#include "lambent/shade/showing.h"

namespace lambent::shade {

/// How the light's Sun throws shadows: each place sees or does not see it, or as harmonics have it.
enum class SunShadow { Sharp, Soft };

struct SharpSun {
  light::Sun sun;             ///< in the asset's frame
  sh::RgbCoefficients share;  ///< what it is of the harmonics that relight: windowed as they are
};

/// The light's Sun, if it has one: `window` is what every band of the light was multiplied with.
std::optional<SharpSun> sharpSunOf(const light::Environment& environment,
                                   const std::vector<double>& window);

/// The kind of D of a bare surface with a diffuse part: the shadowed one under what is interreflected,
/// otherwise what is shown. None where interreflected transfer is held alone, and for all other meshes:
/// they show the Sun as the harmonics have it. (Without the Sun's bounces a picture would be about as far
/// from the truth as with its soft shadow, somewhat nearer in seven of eight in docs/reproduction.md,
/// but too dark wherever light bounces.)
std::optional<transfer::Kind> kindWithoutBounces(const transfer::EncodedMesh& mesh,
                                                 const Showing& showing);

/// Where an asset cannot show all of a sharp Sun: bounces that it does not hold apart, mirrors, lobes,
/// and meso-structure.
Findings sharpSunFindings(const asset::Asset& asset, const Showing& showing);

}  // namespace lambent::shade
