// This work is based on:
// - merriman1994motion: regions that diffuse into each other for a short time, and then the
//   strongest takes all, have moved their borders by curvature: teeth vanish, junctions of three
//   settle at even angles.
// Where we deviate: diffusion is a walk from triangle to triangle, not a solution of the heat
// equation, so that it irons out teeth of a triangle's size whatever that is, and it hardly passes
// creases.
#include "lambent/atlas/smooth_borders.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "lambent/work/parallel_for.h"

namespace lambent::atlas {
namespace {

constexpr int kRounds = 3;
constexpr int kSteps = 10;
/// How much less passes a crease: by e for each this much of 1 − cos.
constexpr double kCreaseScale = 0.15;

/// The shares of the few charts that have reached a triangle.
struct Shares {
  static constexpr int kMost = 4;
  std::array<std::uint32_t, kMost> chart;
  std::array<float, kMost> share;
  int count = 0;

  void add(std::uint32_t c, float amount) {
    for (int i = 0; i < count; ++i)
      if (chart[i] == c) {
        share[i] += amount;
        return;
      }
    if (count < kMost) {
      chart[count] = c, share[count] = amount;
      ++count;
      return;
    }
    const auto least = std::min_element(share.begin(), share.end()) - share.begin();
    if (share[least] < amount) chart[least] = c, share[least] = amount;
  }
};

}  // namespace

std::vector<Chart> smoothBorders(const WeldedSurface& surface, const std::vector<Chart>& charts) {
  const std::size_t count = surface.triangles.size();
  std::vector<std::uint32_t> chartOf(count, kNoTriangle);
  for (std::uint32_t c = 0; c < charts.size(); ++c)
    for (const std::uint32_t t : charts[c]) chartOf[t] = c;
  std::vector<std::array<float, 3>> passes(count);
  work::parallelFor(count, [&](std::size_t t) {
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t n = surface.neighbours[t][k];
      passes[t][k] = 0.0f;
      if (n == kNoTriangle) continue;
      const auto& v = surface.triangles[t];
      const double length = (surface.positions[v[k]] - surface.positions[v[(k + 1) % 3]]).norm();
      const double crease = 1.0 - surface.normals[t].dot(surface.normals[n]);
      passes[t][k] = static_cast<float>(length * std::exp(-crease / kCreaseScale));
    }
  });

  std::vector<Shares> now(count), next(count);
  for (int round = 0; round < kRounds; ++round) {
    work::parallelFor(count, [&](std::size_t t) {
      now[t].count = 0;
      if (chartOf[t] != kNoTriangle) now[t].add(chartOf[t], 1.0f);
    });
    for (int step = 0; step < kSteps; ++step) {
      work::parallelFor(count, [&](std::size_t t) {
        next[t] = now[t];
        if (now[t].count == 0) return;
        // Within a chart nothing changes.
        bool inside = now[t].count == 1;
        float total = 0.0f, longest = 0.0f;
        for (int k = 0; k < 3; ++k) {
          const std::uint32_t n = surface.neighbours[t][k];
          if (n == kNoTriangle) continue;
          inside &= now[n].count == 1 && now[n].chart[0] == now[t].chart[0];
          total += passes[t][k];
          const auto& v = surface.triangles[t];
          longest = std::max(
              longest, static_cast<float>(
                           (surface.positions[v[k]] - surface.positions[v[(k + 1) % 3]]).norm()));
        }
        if (inside || !(total > 0.0f)) return;
        // Half stays; more where the ways out are narrow.
        const float keep = std::max(total, longest);
        Shares& mixed = next[t];
        for (int i = 0; i < mixed.count; ++i)
          mixed.share[i] *= (2.0f * keep - total) / (2.0f * keep);
        for (int k = 0; k < 3; ++k) {
          const std::uint32_t n = surface.neighbours[t][k];
          if (n == kNoTriangle) continue;
          for (int i = 0; i < now[n].count; ++i)
            mixed.add(now[n].chart[i], now[n].share[i] * passes[t][k] / (2.0f * keep));
        }
      });
      now.swap(next);
    }
    work::parallelFor(count, [&](std::size_t t) {
      float best = -1.0f;
      for (int i = 0; i < now[t].count; ++i)
        if (now[t].share[i] > best || (now[t].share[i] == best && now[t].chart[i] < chartOf[t]))
          best = now[t].share[i], chartOf[t] = now[t].chart[i];
    });
  }

  std::vector<Chart> result;
  std::vector<bool> seen(count);
  std::vector<std::uint32_t> stack;
  for (std::uint32_t first = 0; first < count; ++first) {
    if (seen[first] || chartOf[first] == kNoTriangle) continue;
    Chart& chart = result.emplace_back();
    seen[first] = true;
    stack.push_back(first);
    while (!stack.empty()) {
      const std::uint32_t t = stack.back();
      stack.pop_back();
      chart.push_back(t);
      for (const std::uint32_t n : surface.neighbours[t])
        if (n != kNoTriangle && !seen[n] && chartOf[n] == chartOf[t])
          seen[n] = true, stack.push_back(n);
    }
    std::sort(chart.begin(), chart.end());
  }
  return result;
}

}  // namespace lambent::atlas
