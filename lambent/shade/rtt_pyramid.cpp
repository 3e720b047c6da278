// This work is based on:
// - williams1983pyramidal: pyramidal parametrics. Of sloan2003biscale's future work ("improved
//   filtering over the RTTs spatial index"): radiance is linear in B, so the mean of B over a
//   stretch of the patch, under one macro-scale light, is the mean of the radiance there.
//
// Positions of a level share the period evenly. Where a width is odd, a position of the next level
// covers a broken number of them, and each gives by the share that is covered (a box filter of the
// exact width), so that no place counts more than another.

#include "lambent/shade/rtt_pyramid.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "lambent/work/parallel_for.h"

namespace lambent::shade {
namespace {

/// What a position of the next level takes, along one axis: positions first … and their weights.
struct Span {
  int first = 0;
  std::vector<float> weights;  ///< sum to 1
};

std::vector<Span> spans(int from, int to) {
  std::vector<Span> result(to);
  const double ratio = double(from) / to;
  for (int i = 0; i < to; ++i) {
    const double begin = i * ratio, end = (i + 1) * ratio;
    Span& span = result[i];
    span.first = int(begin + 1e-9);
    for (int k = span.first; k < from && k < end - 1e-9; ++k)
      span.weights.push_back(float((std::min(end, k + 1.0) - std::max(begin, double(k))) / ratio));
  }
  return result;
}

RttLevel halved(const RttLevel& fine, std::size_t perPosition, std::size_t views) {
  RttLevel coarse;
  coarse.width = std::max(1, fine.width / 2);
  coarse.height = std::max(1, fine.height / 2);
  coarse.values.resize(std::size_t(coarse.width) * coarse.height * perPosition);
  const std::size_t heights = fine.heights.empty() ? 0 : views;  // of a position
  coarse.heights.resize(std::size_t(coarse.width) * coarse.height * heights);
  const std::vector<Span> across = spans(fine.width, coarse.width);
  const std::vector<Span> along = spans(fine.height, coarse.height);
  work::parallelFor(coarse.height, [&](int y) {
    std::vector<float> height(heights);
    for (int x = 0; x < coarse.width; ++x) {
      const std::size_t at = std::size_t(y) * coarse.width + x;
      float* to = coarse.values.data() + at * perPosition;
      std::fill(height.begin(), height.end(), 0.5f);  // so that cutting off rounds
      for (std::size_t j = 0; j < along[y].weights.size(); ++j)
        for (std::size_t i = 0; i < across[x].weights.size(); ++i) {
          const float weight = along[y].weights[j] * across[x].weights[i];
          const std::size_t place =
              (std::size_t(along[y].first) + j) * fine.width + across[x].first + i;
          const float* from = fine.values.data() + place * perPosition;
          for (std::size_t k = 0; k < perPosition; ++k) to[k] += weight * from[k];
          for (std::size_t v = 0; v < heights; ++v)
            height[v] += weight * float(fine.heights[place * views + v]);
        }
      for (std::size_t v = 0; v < heights; ++v)
        coarse.heights[at * views + v] = std::uint8_t(std::min(height[v], 255.0f));
    }
  });
  return coarse;
}

}  // namespace

RttPyramid makePyramid(const transfer::Rtt<transfer::Floats>& rtt, int mostLevels) {
  assert(rtt.values.size() == rtt.planeSize() * std::size_t(rtt.bands) * rtt.bands);
  RttPyramid pyramid;
  pyramid.views = rtt.views;
  pyramid.bands = rtt.bands;
  if (!rtt.heights.empty()) pyramid.relief = rtt.depth * rtt.size.cwiseInverse();
  const int coefficients = rtt.bands * rtt.bands, stride = pyramid.stride();
  const std::size_t perPosition = pyramid.viewCount() * stride;

  RttLevel& first = pyramid.levels.emplace_back();
  first.width = rtt.width;
  first.height = rtt.height;
  first.values.resize(rtt.positionCount() * perPosition);
  work::parallelFor(rtt.positionCount(), [&](std::size_t position) {
    float* to = first.values.data() + position * perPosition;
    for (int i = 0; i < coefficients; ++i) {
      const float* from = rtt.values.data() + i * rtt.planeSize() + position * rtt.viewCount() * 3;
      for (std::size_t v = 0; v < rtt.viewCount(); ++v)
        std::copy_n(from + 3 * v, 3, to + v * stride + 3 * i);
    }
  });
  first.heights = rtt.heights;
  while (int(pyramid.levels.size()) < mostLevels &&
         (pyramid.levels.back().width > 1 || pyramid.levels.back().height > 1))
    pyramid.levels.push_back(halved(pyramid.levels.back(), perPosition, pyramid.viewCount()));
  return pyramid;
}

}  // namespace lambent::shade
