// This work is based on:
// - preetham2003modeling: "Scattering": Rayleigh and Henyey-Greenstein.
// - cornette1992physically: eq. 11. henyey1941diffuse: eq. 2. blasi1993rendering: Schlick's approximation; the sign of k is
//   turned so that k > 0 scatters forward.
#include "lambent/media/phase_function.h"

#include <cmath>

#include "lambent/math/types.h"

namespace lambent::media {
namespace {

constexpr double kSphere = 4 * kPi;

double henyeyGreenstein(double g, double cosine) {
  const double base = 1 + g * g - 2 * g * cosine;
  return (1 - g * g) / (kSphere * base * std::sqrt(base));
}

struct Evaluate {
  double c;
  double operator()(const Isotropic&) const { return 1 / kSphere; }
  double operator()(const RayleighPhase&) const { return 0.75 * (1 + c * c) / kSphere; }
  double operator()(const HenyeyGreenstein& p) const { return henyeyGreenstein(p.g, c); }
  double operator()(const CornetteShanks& p) const {
    return 1.5 * (1 + c * c) / (2 + p.g * p.g) * henyeyGreenstein(p.g, c);
  }
  double operator()(const DoubleHenyeyGreenstein& p) const {
    return (1 - p.f) * henyeyGreenstein(p.g1, c) + p.f * henyeyGreenstein(p.g2, c);
  }
  double operator()(const Schlick& p) const {
    const double base = 1 - p.k * c;
    return (1 - p.k * p.k) / (kSphere * base * base);
  }
};

struct MeanCosine {
  double operator()(const Isotropic&) const { return 0; }
  double operator()(const RayleighPhase&) const { return 0; }
  double operator()(const HenyeyGreenstein& p) const { return p.g; }
  double operator()(const CornetteShanks& p) const {
    return 3 * p.g * (4 + p.g * p.g) / (5 * (2 + p.g * p.g));
  }
  double operator()(const DoubleHenyeyGreenstein& p) const { return (1 - p.f) * p.g1 + p.f * p.g2; }
  double operator()(const Schlick& p) const {
    const double k = p.k;
    if (std::abs(k) < 1e-3) return 2 * k / 3;  // what follows has no digits left there
    return 1 / k - (1 - k * k) / (2 * k * k) * std::log((1 + k) / (1 - k));
  }
};

}  // namespace

double evaluate(const PhaseFunction& phase, double cosine) {
  return std::visit(Evaluate{cosine}, phase);
}

double meanCosine(const PhaseFunction& phase) {
  return std::visit(MeanCosine{}, phase);
}

}  // namespace lambent::media
