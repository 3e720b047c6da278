#include "lambent/shade/lobe.h"

#include <algorithm>
#include <cmath>

#include "lambent/math/types.h"
#include "lambent/sh/window.h"
#include "lambent/sh/zonal.h"

namespace lambent::shade {

namespace {

double exponentShown(const transfer::Lobe& lobe, const Showing& showing) {
  return showing.lobeExponent.value_or(lobe.exponent);
}

/// E_soft(μ): what a lobe of these moments shows of an even light of radiance 1 above a horizon.
double shareAboveHorizon(const sh::ZonalMoments& lobe, double mu) {
  const sh::ZonalMoments horizon = sh::hemisphere(int(lobe.size()));
  double sum = 0;
  for (std::size_t l = 0; l < lobe.size(); ++l)
    sum += (2 * double(l) + 1) * lobe[l] * horizon[l] * std::legendre(unsigned(l), mu);
  return sum / (4 * kPi);
}

/// E(μ) of Phong's lobe: the shares of circles about R, of which each stands for as much of the lobe.
double shareAboveHorizon(double exponent, double mu) {
  constexpr int kCircles = 1000;
  double sum = 0;
  for (int i = 0; i < kCircles; ++i) {
    const double z = std::pow((i + 0.5) / kCircles, 1 / (exponent + 1));
    const double across = std::sqrt((1 - z * z) * (1 - mu * mu));
    sum += across > 0 ? std::acos(std::clamp(-z * mu / across, -1.0, 1.0)) / kPi : 1;
  }
  return sum / kCircles;
}

}  // namespace

std::vector<float> lobeFactors(int bands, const transfer::Lobe& lobe, const Showing& showing) {
  sh::ZonalMoments moments = sh::phongLobe(bands, exponentShown(lobe, showing));
  if (showing.softLobes) {
    const std::vector<double> window = sh::leastSoftening(moments);
    for (int l = 0; l < bands; ++l) moments[l] *= window[l];
  }
  std::vector<float> factors;
  for (int i = 0; i < sh::coefficientCount(bands); ++i)
    factors.push_back(float(moments[sh::bandOf(i)]));
  return factors;
}

sh::RgbCoefficients softened(const sh::RgbCoefficients& light) {
  sh::RgbCoefficients result = light;
  sh::applyWindow(sh::leastSoftening(light), result);
  return result;
}

float LobeGain::at(float cosine) const {
  const float mu = std::clamp(cosine, 0.0f, 1.0f);
  const auto& [c0, c1, c2, c3] = coefficients;
  return 1.0f + mu * (c0 + mu * (c1 + mu * (c2 + mu * c3)));
}

LobeGain lobeGain(int bands, const transfer::Lobe& lobe, const Showing& showing,
                  transfer::Kind kind) {
  if (!showing.softLobes || kind == transfer::Kind::Unshadowed) return {};
  const double exponent = exponentShown(lobe, showing);
  sh::ZonalMoments soft = sh::phongLobe(bands, exponent);
  const std::vector<double> window = sh::leastSoftening(soft);
  if (window.back() == 1) return {};
  for (int l = 0; l < bands; ++l) soft[l] *= window[l];
  const double material = std::min(exponent, 3.0 * bands);

  // Newton's form of the polynomial through (E(μ)/E_soft(μ) − 1)/μ, then multiplied out.
  constexpr int kNodes = 4;
  std::array<double, kNodes> node, value;
  for (int i = 0; i < kNodes; ++i) {
    node[i] = 0.5 + 0.5 * std::cos(2 * kPi * i / (2 * kNodes - 1));
    value[i] =
        (shareAboveHorizon(material, node[i]) / shareAboveHorizon(soft, node[i]) - 1) / node[i];
  }
  for (int order = 1; order < kNodes; ++order)
    for (int i = kNodes - 1; i >= order; --i)
      value[i] = (value[i] - value[i - 1]) / (node[i] - node[i - order]);
  std::array<double, kNodes> sum{};
  for (int i = kNodes - 1; i >= 0; --i) {
    for (int k = kNodes - 1; k > 0; --k) sum[k] = sum[k - 1] - node[i] * sum[k];
    sum[0] = value[i] - node[i] * sum[0];
  }
  LobeGain gain;
  std::copy(sum.begin(), sum.end(), gain.coefficients.begin());
  return gain;
}

}  // namespace lambent::shade
