#include "lambent/compare/metrics.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <vector>

#include "lambent/radiometry/tone.h"

namespace lambent::compare {

Metrics measure(std::span<const Rgb> truth, std::span<const Rgb> judged) {
  assert(truth.size() == judged.size());
  Metrics m;
  m.count = truth.size();
  if (truth.empty()) return m;
  Eigen::Array3d difference = Eigen::Array3d::Zero(), sum = Eigen::Array3d::Zero();
  double squared = 0.0, power = 0.0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const Eigen::Array3d a = truth[i].cast<double>(), d = judged[i].cast<double>() - a;
    difference += d;
    sum += a;
    squared += d.square().sum();
    power += a.square().sum();
    m.worst = std::max(m.worst, d.abs().maxCoeff());
  }
  const double n = double(truth.size());
  m.bias = (difference / n).cast<float>();
  m.rmse = std::sqrt(squared / (3.0 * n));
  const auto ratio = [](double part, double whole) {
    return part == 0.0    ? 0.0
           : whole != 0.0 ? part / whole
                          : std::copysign(std::numeric_limits<double>::infinity(), part);
  };
  m.relativeBias = ratio(difference.sum(), sum.sum());
  m.relativeRmse = std::sqrt(ratio(squared, power));
  const double mean = sum.sum() / (3.0 * n);
  const double epsilon = 0.01 * mean * mean;
  double relative = 0.0;
  for (std::size_t i = 0; i < truth.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      const double a = truth[i][c], d = double(judged[i][c]) - a;
      relative += ratio(d * d, a * a + epsilon);
    }
  m.relativeMse = relative / (3.0 * n);
  return m;
}

Metrics measure(const image::Image& truth, const image::Image& judged) {
  assert(truth.width == judged.width && truth.height == judged.height);
  if (truth.alpha.empty() || judged.alpha.empty())
    return measure(std::span<const Rgb>(truth.pixels), std::span<const Rgb>(judged.pixels));
  std::vector<Rgb> a, b;
  for (std::size_t i = 0; i < truth.pixels.size(); ++i) {
    if (truth.alpha[i] <= 0.0f && judged.alpha[i] <= 0.0f) continue;
    a.push_back(truth.pixels[i]);
    b.push_back(judged.pixels[i]);
  }
  return measure(std::span<const Rgb>(a), std::span<const Rgb>(b));
}

double psnr(const image::Image& truth, const image::Image& judged) {
  assert(truth.pixels.size() == judged.pixels.size());
  double squared = 0.0;
  for (std::size_t i = 0; i < truth.pixels.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      const double d = double(radiometry::srgbEncode(judged.pixels[i][c])) -
                       double(radiometry::srgbEncode(truth.pixels[i][c]));
      squared += d * d;
    }
  if (squared == 0.0) return std::numeric_limits<double>::infinity();
  return -10.0 * std::log10(squared / (3.0 * double(truth.pixels.size())));
}

}  // namespace lambent::compare
