// Patches by formula for the tests of this room: responses without the work of building them.
#pragma once

#include <algorithm>
#include <cmath>

#include "lambent/math/random.h"
#include "lambent/transfer/field.h"

namespace lambent::synthesis {

/// A plain weave of 4×4 threads: over and under in turn.
inline Rgb weaveAlbedo(float u, float v) {
  const float a = u * 4 - std::floor(u * 4) - 0.5f, b = v * 4 - std::floor(v * 4) - 0.5f;
  const bool over = (int(u * 4) + int(v * 4)) % 2 != 0;
  const float across = over ? a : b, along = over ? b : a;
  if (std::abs(across) > 0.42f) return Rgb::Constant(0.05f);
  return (1 - 2 * across * across - along * along) *
         (over ? Rgb(0.9f, 0.6f, 0.3f) : Rgb(0.3f, 0.6f, 0.9f));
}

/// Smooth noise of three octaves that repeats itself.
inline Rgb stuccoAlbedo(float u, float v) {
  float sum = 0.0f;
  for (int octave = 0; octave < 3; ++octave) {
    const int n = 6 << octave;
    const float x = u * float(n), y = v * float(n);
    const int i = int(x), j = int(y);
    float a = x - float(i), b = y - float(j);
    a = a * a * (3 - 2 * a), b = b * b * (3 - 2 * b);
    const auto value = [&](int p, int q) {
      return math::Random(std::uint64_t(octave), std::uint64_t(p % n), std::uint64_t(q % n))
          .uniform();
    };
    sum += std::ldexp(0.5f, -octave) * ((1 - b) * ((1 - a) * value(i, j) + a * value(i + 1, j)) +
                                        b * ((1 - a) * value(i, j + 1) + a * value(i + 1, j + 1)));
  }
  return Rgb::Constant(std::clamp(2.5f * (sum - 0.25f), 0.0f, 1.0f));
}

/// Pebbles of a few greys on dark ground, wide apart, over a period.
inline Rgb pebblesAlbedo(float u, float v) {
  constexpr int kPebbles = 12;
  for (int k = 0; k < kPebbles; ++k) {
    // Every other row is shifted, and each pebble a little out of line.
    math::Random random(17, std::uint64_t(k));
    const float x = (float(k % 3) + 0.5f * float(k / 3 % 2) + 0.2f * random.uniform()) / 3.0f;
    const float y = (float(k / 3) + 0.2f * random.uniform()) / 4.0f;
    const float dx = u - x - std::round(u - x), dy = v - y - std::round(v - y);
    if (dx * dx + dy * dy < 0.09f * 0.09f) return Rgb::Constant(0.5f + 0.4f * random.uniform());
  }
  return Rgb::Constant(0.1f);
}

/// A patch that responds to the mean light by its albedo and to band 1 by a fraction of it, more so
/// seen from above.
template <class Albedo>
transfer::SimulatedRtt patchOf(const Albedo& albedo, int side, int views = 1) {
  transfer::SimulatedRtt rtt;
  rtt.width = rtt.height = side;
  rtt.views = views;
  rtt.bands = 2;
  rtt.values.resize(4 * rtt.planeSize());
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const Rgb a = albedo((float(x) + 0.5f) / float(side), (float(y) + 0.5f) / float(side));
      for (int c = 0; c < 4; ++c) {
        for (int vy = 0; vy < views; ++vy) {
          for (int vx = 0; vx < views; ++vx) {
            const float seen = 1.0f / (1.0f + 0.3f * float(vx + vy));
            for (int k = 0; k < 3; ++k) {
              rtt.values[rtt.index(c, x, y, vx, vy) + std::size_t(k)] =
                  (c == 0 ? 1.0f : 0.2f * float(c)) * seen * a[k];
            }
          }
        }
      }
    }
  }
  return rtt;
}

}  // namespace lambent::synthesis
