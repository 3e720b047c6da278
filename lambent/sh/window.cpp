// This work is based on:
// - sloan2002precomputed, sloan2008stupid: "Windowing", the Hann and Lanczos windows, and
//   attenuation by the squared Laplacian, w_l = 1/(1 + λ l²(l+1)²).
//
// For the least λ that leaves no negative radiance: the condition is solved on a grid of
// directions; then the true minima near its lowest points join the grid, until nothing negative is
// left (the exchange method for semi-infinite constraints, hettich1993semi). One evaluation of the
// condition costs one multiplication per point and band, since each band's share of f at a point is
// kept.
#include "lambent/sh/window.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "lambent/math/directions.h"
#include "lambent/math/sequences.h"
#include "lambent/sh/basis.h"

namespace lambent::sh {

std::vector<double> hann(int bands, double width) {
  std::vector<double> window(std::size_t(bands), 0.0);
  for (int l = 0; l < bands && l < width; ++l) window[l] = (1 + std::cos(kPi * l / width)) / 2;
  return window;
}

std::vector<double> lanczos(int bands, double width) {
  std::vector<double> window(std::size_t(bands), 0.0);
  for (int l = 0; l < bands && l < width; ++l)
    window[l] = l == 0 ? 1 : std::sin(kPi * l / width) / (kPi * l / width);
  return window;
}

void applyWindow(const std::vector<double>& window, RgbCoefficients& f) {
  assert(int(window.size()) >= f.bands);
  for (int c = 0; c < 3; ++c) {
    const std::span<float> channel = f.channel(c);
    for (int l = 0; l < f.bands; ++l)
      for (int i = l * l; i < (l + 1) * (l + 1); ++i) channel[i] *= float(window[l]);
  }
}

namespace {

using BandValues = std::array<double, kMaxBands>;

std::vector<double> laplacianWindow(int bands, double lambda) {
  std::vector<double> window(std::size_t(bands), 1.0);
  for (int l = 0; l < bands; ++l) {
    const double laplacian = double(l) * (l + 1);
    window[l] = 1 / (1 + lambda * laplacian * laplacian);
  }
  return window;
}

double weigh(const std::vector<double>& window, const BandValues& values) {
  double sum = 0;
  for (std::size_t l = 0; l < window.size(); ++l) sum += window[l] * values[l];
  return sum;
}

/// One channel: where it is sampled, and each band's share of it there.
struct Channel {
  std::span<const float> f;
  int bands;
  std::vector<Vec3d> points;
  std::vector<BandValues> values;

  BandValues at(const Vec3d& s) const {
    std::array<double, kMaxBands * kMaxBands> y;
    evaluate(bands, s, y);
    BandValues result{};
    for (int l = 0; l < bands; ++l)
      for (int i = l * l; i < (l + 1) * (l + 1); ++i) result[l] += double(f[i]) * y[i];
    return result;
  }
  void add(const Vec3d& s) {
    points.push_back(s);
    values.push_back(at(s));
  }
};

double lowest(const Channel& channel, const std::vector<double>& window) {
  double least = weigh(window, channel.values.front());
  for (const BandValues& v : channel.values) least = std::min(least, weigh(window, v));
  return least;
}

struct Minimum {
  Vec3d direction;
  double value;
};

/// Descends from a sampled point to the minimum of its basin: Newton steps on a quadratic fitted to
/// a stencil in the tangent plane, held to steps that go down.
Minimum descend(const Channel& channel, const std::vector<double>& window, Vec3d s, double radius) {
  double value = weigh(window, channel.at(s));
  while (radius > 1e-7) {
    const Mat3d frame = math::worldFromTangent(s.cast<float>()).cast<double>();
    const auto near = [&](double u, double v) -> Vec3d {
      return (s + u * frame.col(0) + v * frame.col(1)).normalized();
    };
    const auto probe = [&](double u, double v) { return weigh(window, channel.at(near(u, v))); };
    const double h = std::max(radius / 4, 1e-4);
    const double east = probe(h, 0), west = probe(-h, 0), up = probe(0, h), down = probe(0, -h);
    const double gu = (east - west) / (2 * h), gv = (up - down) / (2 * h);
    const double huu = (east - 2 * value + west) / (h * h), hvv = (up - 2 * value + down) / (h * h);
    const double huv = (probe(h, h) - probe(h, -h) - probe(-h, h) + probe(-h, -h)) / (4 * h * h);
    const double determinant = huu * hvv - huv * huv;
    double u = -gu, v = -gv;
    const bool bowl = huu > 0 && determinant > 1e-12 * (huu * huu + hvv * hvv);
    if (bowl) {
      u = (huv * gv - hvv * gu) / determinant;
      v = (huv * gu - huu * gv) / determinant;
    }
    const double length = std::hypot(u, v);
    if (length == 0) break;
    const double cut = bowl ? std::min(1.0, radius / length) : radius / length;
    const Vec3d next = near(cut * u, cut * v);
    const double nextValue = weigh(window, channel.at(next));
    if (nextValue < value) {
      s = next;
      value = nextValue;
      if (bowl) radius = std::min(radius, 2 * length * cut);
    } else {
      radius /= 4;
    }
  }
  return {s, value};
}

/// The minima below the lowest basins of the sampled points, at most kBasins of them.
std::vector<Minimum> refinedMinima(const Channel& channel, const std::vector<double>& window,
                                   double peak) {
  constexpr std::size_t kBasins = 24;
  const double spacing = 0.7 / channel.bands;
  std::vector<std::pair<double, std::size_t>> sorted;
  for (std::size_t i = 0; i < channel.points.size(); ++i) {
    const double value = weigh(window, channel.values[i]);
    // Between grid points the function falls by less than this (Bernstein's inequality).
    if (value < 0.2 * peak) sorted.emplace_back(value, i);
  }
  std::sort(sorted.begin(), sorted.end());
  std::vector<Vec3d> starts;
  for (const auto& [value, i] : sorted) {
    const Vec3d& p = channel.points[i];
    const bool fresh = std::none_of(starts.begin(), starts.end(),
                                    [&](const Vec3d& q) { return (p - q).norm() < spacing; });
    if (!fresh) continue;
    starts.push_back(p);
    if (starts.size() == kBasins) break;
  }
  std::vector<Minimum> minima;
  for (const Vec3d& start : starts) minima.push_back(descend(channel, window, start, spacing / 2));
  return minima;
}

constexpr double kMaxLambda = 1e12;  // by then the window is 1, 0, 0, …

/// The least λ for which no sampled point of any channel is below zero.
double leastLambda(const std::vector<Channel>& channels, int bands) {
  const auto holds = [&](double lambda) {
    const std::vector<double> window = laplacianWindow(bands, lambda);
    return std::all_of(channels.begin(), channels.end(),
                       [&](const Channel& c) { return lowest(c, window) >= 0; });
  };
  if (holds(0)) return 0;
  double bad = 0, good = 1e-7;
  while (!holds(good)) {
    bad = good;
    good *= 1.7;
    if (good > kMaxLambda) return kMaxLambda;
  }
  for (int i = 0; i < 60 && good - bad > 1e-12 * good; ++i) {
    const double middle = (bad + good) / 2;
    (holds(middle) ? good : bad) = middle;
  }
  return good;
}

}  // namespace

std::vector<double> minimalRinging(const RgbCoefficients& f) {
  assert(f.bands >= 1 && f.bands <= kMaxBands);
  std::vector<double> meanOnly(std::size_t(f.bands), 0.0);
  meanOnly[0] = 1;
  std::vector<Channel> channels;
  double peak = 0;
  for (int c = 0; c < 3; ++c) {
    const std::span<const float> channel = f.channel(c);
    if (std::all_of(channel.begin(), channel.end(), [](float v) { return v == 0; })) continue;
    if (!(channel[0] > 0)) return meanOnly;
    channels.push_back({channel, f.bands, {}, {}});
    for (const Vec3& s : math::sphericalFibonacci(48 * f.bands * f.bands))
      channels.back().add(s.cast<double>());
    for (const BandValues& v : channels.back().values)
      peak = std::max(peak, std::abs(weigh(laplacianWindow(f.bands, 0), v)));
  }
  if (channels.empty()) return laplacianWindow(f.bands, 0);
  double lambda = 0;
  for (int round = 0; round < 30; ++round) {
    lambda = leastLambda(channels, f.bands);
    if (lambda >= kMaxLambda) return meanOnly;
    const std::vector<double> window = laplacianWindow(f.bands, lambda);
    bool holds = true;
    for (Channel& channel : channels) {
      // Against the mean, which no window changes: the peak of what is left is no less.
      const double tolerance = 1e-7 * double(channel.f[0]) / std::sqrt(4 * kPi);
      for (const Minimum& minimum : refinedMinima(channel, window, peak)) {
        if (minimum.value < -tolerance) holds = false;
        if (minimum.value < 0) channel.add(minimum.direction);
      }
    }
    if (holds) break;
  }
  return laplacianWindow(f.bands, lambda);
}

namespace {

/// The least s that leaves (1−s) · plain + s · soft non-negative at all the points that it saw.
class LeastShare {
 public:
  void see(double plain, double soft) {
    if (plain >= 0) return;
    share_ = soft <= 0 ? 1 : std::max(share_, plain / (plain - soft));
  }
  std::vector<double> window(const ZonalMoments& soft) const {
    std::vector<double> window;
    for (const double moment : soft) window.push_back(1 - share_ + share_ * moment);
    return window;
  }

 private:
  double share_ = 0;
};

}  // namespace

std::vector<double> leastSoftening(const RgbCoefficients& f) {
  assert(f.bands >= 1 && f.bands <= kMaxBands);
  const ZonalMoments soft = sharpestNonNegative(f.bands);
  LeastShare least;
  std::array<double, kMaxBands * kMaxBands> y;
  for (const Vec3& s : math::sphericalFibonacci(100 * f.bands * f.bands)) {
    evaluate(f.bands, s.cast<double>().eval(), y);
    for (int c = 0; c < 3; ++c) {
      const std::span<const float> channel = f.channel(c);
      double plain = 0, softened = 0;
      for (int l = 0, i = 0; l < f.bands; ++l) {
        double share = 0;
        for (; i < (l + 1) * (l + 1); ++i) share += double(channel[i]) * y[i];
        plain += share;
        softened += soft[l] * share;
      }
      least.see(plain, softened);
    }
  }
  return least.window(soft);
}

std::vector<double> leastSoftening(const ZonalMoments& f) {
  const int bands = int(f.size());
  const ZonalMoments soft = sharpestNonNegative(bands);
  LeastShare least;
  const int angles = 100 * bands;
  for (int i = 0; i <= angles; ++i) {
    const double t = std::cos(kPi * i / angles);
    double plain = 0, softened = 0;
    for (int l = 0; l < bands; ++l) {
      const double share = (2 * l + 1) * f[l] * std::legendre(unsigned(l), t);
      plain += share;
      softened += soft[l] * share;
    }
    least.see(plain, softened);
  }
  return least.window(soft);
}

}  // namespace lambent::sh
