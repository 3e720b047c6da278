// Glossy lobes as they are shown: sloan2002precomputed eq. 12, softened where Showing::softLobes is on.
#pragma once

#include <array>
#include <vector>

#include "lambent/sh/coefficients.h"
#include "lambent/shade/showing.h"
#include "lambent/transfer/field.h"
#include "lambent/transfer/kind.h"

namespace lambent::shade {

/// α_i G_i for every coefficient: the lobe's moments, each band's for all its coefficients; softened
/// where lobes are.
std::vector<float> lobeFactors(int bands, const transfer::Lobe& lobe, const Showing& showing);
/// The light that reaches soft lobes.
sh::RgbCoefficients softened(const sh::RgbCoefficients& light);

/// A softened lobe is wider than the material's: more of it lies below the horizon, where matrices
/// hold no light, and evenly lit surfaces would come out too dark, at 5 bands by 3% seen along the
/// normal and by a quarter from the side. What it shows is therefore multiplied by
///   1 + Σ_k c_k μ^(k+1), k = 0 … 3, μ = max(N·R, 0),
/// the polynomial through E(μ)/E_soft(μ) at four Chebyshev-Radau nodes, of which one is 1, where
///   E(μ) = Σ_l (2l+1)/4π ĥ_l H_l P_l(μ)
/// is the share of a lobe about R above the horizon of N (H_l: sh::hemisphere). It is within 2.5% of
/// that ratio.
struct LobeGain {
  std::array<float, 4> coefficients{};  ///< zeros: 1 everywhere

  float at(float cosine) const;  ///< of μ in [−1, 1]
};

/// Ones where lobes are as the material has them, and where the kind knows no horizon (Unshadowed).
/// Lobes sharper than exponent 3n, which n bands cannot tell apart near a horizon, are taken as
/// that wide: the gain stays below 1.5.
LobeGain lobeGain(int bands, const transfer::Lobe& lobe, const Showing& showing,
                  transfer::Kind kind);

}  // namespace lambent::shade
