#include "lambent/sky/spectral_weights.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace lambent::sky {

SpectralTaps::SpectralTaps(std::span<const double> nodes, double nm) {
  assert(nodes.size() >= 4);
  const double at = std::clamp(nm, nodes.front(), nodes.back());
  const std::size_t above =
      std::size_t(std::upper_bound(nodes.begin(), nodes.end(), at) - nodes.begin());
  first = std::clamp<std::size_t>(above, 2, nodes.size() - 2) - 2;
  for (std::size_t i = 0; i < 4; ++i) {
    double product = 1;
    for (std::size_t j = 0; j < 4; ++j)
      if (i != j) product *= (at - nodes[first + j]) / (nodes[first + i] - nodes[first + j]);
    weight[i] = float(product);
  }
}

ColorUnderSun::ColorUnderSun(std::span<const double> nodes, const Atmosphere& atmosphere) {
  constexpr double kStep = 5;
  // The Sun's spectrum has more detail than the steps: it is weighed at every nm, and what falls
  // between two steps is shared among them.
  std::vector<double> nm, coarse;
  for (double at = nodes.front(); at <= nodes.back(); at += 1) nm.push_back(at);
  for (double at = nodes.front(); at <= nodes.back(); at += kStep) coarse.push_back(at);
  const radiometry::XyzvWeights fine = radiometry::xyzvWeights(nm);
  weights_.resize(coarse.size());
  for (std::size_t k = 0; k < nm.size(); ++k) {
    const double sun = solarIrradianceOf(atmosphere, nm[k]);
    const double place = (nm[k] - coarse.front()) / kStep;
    const std::size_t low = std::min(std::size_t(place), coarse.size() - 1);
    const std::size_t high = std::min(low + 1, coarse.size() - 1);
    const double t = std::min(place - double(low), 1.0);
    for (int c = 0; c < 4; ++c) {
      const double w = sun * fine(c, Eigen::Index(k));
      weights_[low][std::size_t(c)] += float((1 - t) * w);
      weights_[high][std::size_t(c)] += float(t * w);
    }
  }
  for (const double at : coarse) taps_.emplace_back(nodes, at);
}

radiometry::Xyzv ColorUnderSun::operator()(const float* logs) const {
  float sum[4] = {};
  for (std::size_t k = 0; k < taps_.size(); ++k) {
    const float value = std::exp(taps_[k](logs));
    for (std::size_t c = 0; c < 4; ++c) sum[c] += weights_[k][c] * value;
  }
  return {double(sum[0]), double(sum[1]), double(sum[2]), double(sum[3])};
}

}  // namespace lambent::sky
