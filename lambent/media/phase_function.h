// How a medium scatters: the density of directions about the one in which light travels.
#pragma once

#include <variant>
#include <vector>

namespace lambent::media {

struct Isotropic {
  bool operator==(const Isotropic&) const = default;
};
/// 3/(16π) (1 + cos²θ) (preetham2003modeling).
struct RayleighPhase {
  bool operator==(const RayleighPhase&) const = default;
};
/// henyey1941diffuse; g, −1 < g < 1, is the mean cosine, positive forward.
struct HenyeyGreenstein {
  double g = 0;
  bool operator==(const HenyeyGreenstein&) const = default;
};
/// cornette1992physically: its mean cosine is 3g(4+g²)/(5(2+g²)), not g.
struct CornetteShanks {
  double g = 0;
  bool operator==(const CornetteShanks&) const = default;
};
/// (1 − f)·HG(g1) + f·HG(g2).
struct DoubleHenyeyGreenstein {
  double f = 0, g1 = 0, g2 = 0;
  bool operator==(const DoubleHenyeyGreenstein&) const = default;
};
/// (1 − k²)/(4π (1 − k cos θ)²): forward for k > 0, where the paper's sign scatters backward.
struct Schlick {
  double k = 0;
  bool operator==(const Schlick&) const = default;
};

using PhaseFunction = std::variant<Isotropic, RayleighPhase, HenyeyGreenstein, CornetteShanks,
                                   DoubleHenyeyGreenstein, Schlick>;

/// sr⁻¹, for the cosine of the angle between the directions of *travel* before and after: 1 goes
/// straight on. Integrates to 1 over the sphere.
double evaluate(const PhaseFunction& phase, double cosine);
/// ∫ cos θ.
double meanCosine(const PhaseFunction& phase);

}  // namespace lambent::media
