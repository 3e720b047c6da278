// Height fields by a two-dimensional random process that repeats itself: stucco, plaster.
//
// This work is based on:
// - sloan2003biscale: §4.2, "the stucco wall sample used a 2D random process".
// - perlin1985image: band-limited noise from random gradients at a lattice, here a lattice that
//   wraps around.
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "lambent/math/random.h"
#include "lambent/meso/generators.h"
#include "lambent/meso/profile.h"

namespace lambent::meso {

namespace {

double fade(double t) {
  return t * t * t * (t * (t * 6.0 - 15.0) + 10.0);
}

/// Gradient noise over the unit square, about −0.7 … 0.7, that repeats itself with period 1.
class Noise {
 public:
  /// `cells` of the lattice along each axis.
  Noise(int cells, std::uint64_t seed) : cells_(cells) {
    math::Random random(seed, static_cast<std::uint64_t>(cells));
    for (int k = 0; k < cells * cells; ++k) {
      const double angle = 2.0 * kPi * random.uniformDouble();
      gradients_.push_back({std::cos(angle), std::sin(angle)});
    }
  }

  double operator()(double x, double y) const {
    const double u = x * cells_, v = y * cells_;
    const int i = static_cast<int>(std::floor(u)), j = static_cast<int>(std::floor(v));
    const double fu = u - i, fv = v - j;
    const auto gradient = [&](int di, int dj) {
      const int a = ((i + di) % cells_ + cells_) % cells_;
      const int b = ((j + dj) % cells_ + cells_) % cells_;
      const std::array<double, 2>& g = gradients_[static_cast<std::size_t>(b * cells_ + a)];
      return g[0] * (fu - di) + g[1] * (fv - dj);
    };
    const double s = fade(fu), t = fade(fv);
    const double low = gradient(0, 0) + s * (gradient(1, 0) - gradient(0, 0));
    const double high = gradient(0, 1) + s * (gradient(1, 1) - gradient(0, 1));
    return low + t * (high - low);
  }

 private:
  int cells_;
  std::vector<std::array<double, 2>> gradients_;
};

/// A sum of noises, each twice as fine as the one before.
class Octaves {
 public:
  Octaves(int cells, int count, double gain, std::uint64_t seed) : gain_(gain) {
    for (int k = 0; k < count; ++k)
      noises_.emplace_back(cells << k, seed + static_cast<std::uint64_t>(k));
  }
  double operator()(double x, double y) const {
    double sum = 0.0, amplitude = 1.0;
    for (const Noise& noise : noises_) {
      sum += amplitude * noise(x, y);
      amplitude *= gain_;
    }
    return sum;
  }

 private:
  double gain_;
  std::vector<Noise> noises_;
};

/// Heights scaled to lie between 0 and `depth`, as a patch of one colour.
Patch finished(const char* name, std::vector<double> heights, int resolution, const Vec2& size,
               float depth, const Rgb& color) {
  const auto [lowest, highest] = std::minmax_element(heights.begin(), heights.end());
  const double low = *lowest, span = std::max(*highest - low, 1e-12);
  HeightField field;
  field.width = field.height = resolution;
  for (const double h : heights)
    field.heights.push_back(
        static_cast<float>((h - low) / span * double(depth) * double(size.x())));
  scene::Material material;
  material.name = name;
  material.diffuse = color;
  return patchOf(field, size, material, name);
}

}  // namespace

Patch stucco(const StuccoOptions& options) {
  assert(options.resolution >= 2 && options.dabs >= 0);
  const int n = options.resolution;
  std::vector<double> heights(std::size_t(n) * n);
  const Octaves ground(4, 4, 0.55, options.seed);
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < n; ++x)
      heights[std::size_t(y) * n + x] = 0.10 * ground((x + 0.5) / n, (y + 0.5) / n);
  for (int dab = 0; dab < options.dabs; ++dab) {
    math::Random random(options.seed, 0x7374756363ull, static_cast<std::uint64_t>(dab));
    const double cx = random.uniformDouble(), cy = random.uniformDouble();
    const double radius = options.radius * (0.35 + 0.65 * random.uniformDouble());
    const double turn = kPi * random.uniformDouble(), squeeze = 0.6 + 0.4 * random.uniformDouble();
    const double height = radius / options.radius * (0.5 + 0.5 * random.uniformDouble());
    const Octaves grain(12, 2, 0.5, random.bits());
    for (int y = 0; y < n; ++y)
      for (int x = 0; x < n; ++x) {
        const double px = (x + 0.5) / n, py = (y + 0.5) / n;
        const double dx = fromWhole(px - cx), dy = fromWhole(py - cy);
        if (std::max(std::abs(dx), std::abs(dy)) > 1.8 * radius) continue;
        const double u = (std::cos(turn) * dx + std::sin(turn) * dy) / radius;
        const double v = (std::cos(turn) * dy - std::sin(turn) * dx) / (radius * squeeze);
        const double ragged = 0.55 * grain(px, py);
        const double r = std::hypot(u, v) * (1.0 + ragged);
        // Dabs have a flat back and a soft edge, and lie on what is there.
        const double shape = 1.0 - smooth(0.25, 1.0, r);
        double& h = heights[std::size_t(y) * n + x];
        h = std::max(h, h * (1.0 - shape) + shape * (0.35 * h + 0.45 * height + 0.10));
      }
  }
  const Octaves fine(24, 2, 0.6, options.seed + 100);
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < n; ++x)
      heights[std::size_t(y) * n + x] += 0.035 * fine((x + 0.5) / n, (y + 0.5) / n);
  return finished("stucco", std::move(heights), n, options.size, options.depth, options.color);
}

Patch plaster(const PlasterOptions& options) {
  assert(options.resolution >= 2 && options.strokes >= 0);
  const int n = options.resolution;
  std::vector<double> heights(std::size_t(n) * n);
  const Octaves ground(3, 3, 0.5, options.seed);
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < n; ++x)
      heights[std::size_t(y) * n + x] = 0.35 * ground((x + 0.5) / n, (y + 0.5) / n);
  for (int stroke = 0; stroke < options.strokes; ++stroke) {
    math::Random random(options.seed, 0x706c6173ull, static_cast<std::uint64_t>(stroke));
    const double cx = random.uniformDouble(), cy = random.uniformDouble();
    const double turn = 0.5 + 0.9 * (random.uniformDouble() - 0.5) +
                        (random.uniformDouble() < 0.3 ? 0.5 * kPi : 0.0);
    const double length = 0.16 + 0.16 * random.uniformDouble();
    const double width = 0.055 + 0.045 * random.uniformDouble();
    const double bend = 1.6 * (random.uniformDouble() - 0.5);
    const double level = 0.5 * random.uniformDouble();
    const std::uint64_t grain = random.bits();
    const Noise rag(14, grain), pressure(6, grain + 1);
    for (int y = 0; y < n; ++y)
      for (int x = 0; x < n; ++x) {
        const double px = (x + 0.5) / n, py = (y + 0.5) / n;
        const double dx = fromWhole(px - cx), dy = fromWhole(py - cy);
        const double along = std::cos(turn) * dx + std::sin(turn) * dy;
        const double across = std::cos(turn) * dy - std::sin(turn) * dx - bend * along * along;
        if (std::abs(along) > 1.5 * length || std::abs(across) > 1.5 * width) continue;
        const double ragged = 0.18 * rag(px, py);
        const double u = std::abs(along) / length + ragged, v = std::abs(across) / width + ragged;
        if (u > 1.3 || v > 1.3) continue;
        // The trowel flattens its way, scores it a little, and leaves a ridge at its sides.
        const double cover = (1.0 - smooth(0.8, 1.0, u)) * (1.0 - smooth(0.85, 1.0, v));
        const double score = 0.03 * std::sin(2.0 * kPi * across / 0.016) * (0.5 + pressure(px, py));
        const double ridge = 0.20 * std::exp(-std::pow((v - 0.97) / 0.09, 2)) *
                             (1.0 - smooth(0.7, 1.0, u)) * (across > 0.0 ? 1.0 : 0.45);
        double& h = heights[std::size_t(y) * n + x];
        h = h * (1.0 - cover) + cover * (0.25 * h + level * 0.75 + score) + ridge;
      }
  }
  const Octaves fine(32, 2, 0.6, options.seed + 100);
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < n; ++x)
      heights[std::size_t(y) * n + x] += 0.018 * fine((x + 0.5) / n, (y + 0.5) / n);
  return finished("plaster", std::move(heights), n, options.size, options.depth, options.color);
}

}  // namespace lambent::meso
