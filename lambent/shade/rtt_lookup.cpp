// This work is based on:
// - sloan2003biscale: §5, "Accessing the RTT": bilinear over views, nearest over positions.
// - shirley1997low: the square of the view samples (math::squareFromHemisphere).
// - williams1983pyramidal: between positions and levels of the pyramid.
//
// The interpolation over views is kept inside the grid of samples: the square's border is the
// horizon, and its opposite sides are not neighbours.

#include "lambent/shade/rtt_lookup.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "lambent/math/directions.h"
#include "lambent/sh/coefficients.h"

namespace lambent::shade {

RttViews viewsAround(int views, const Vec3& toViewer) {
  const Vec2 square =
      math::squareFromHemisphere(Vec3(toViewer.x(), toViewer.y(), std::max(0.0f, toViewer.z())));
  const float last = float(views - 1);
  const float x = std::clamp(square.x() * float(views) - 0.5f, 0.0f, last);
  const float y = std::clamp(square.y() * float(views) - 0.5f, 0.0f, last);
  const int x0 = int(x), y0 = int(y);
  const int x1 = std::min(x0 + 1, views - 1), y1 = std::min(y0 + 1, views - 1);
  const float wx = x - float(x0), wy = y - float(y0);
  return {{y0 * views + x0, y0 * views + x1, y1 * views + x0, y1 * views + x1},
          {(1 - wy) * (1 - wx), (1 - wy) * wx, wy * (1 - wx), wy * wx}};
}

namespace {

/// Numbers of one position and view with the most bands that there can be.
constexpr int kMostNumbers = rttStride(sh::kMaxBands);

/// The weighted sum of responses, number for number.
struct Response {
  const RttPyramid& pyramid;
  const RttViews& views;
  alignas(64) std::array<float, kMostNumbers> sum{};

  void add(int level, int x, int y, float weight) {
    const int stride = pyramid.stride();
    const float* position = pyramid.at(level, x, y);
    for (int v = 0; v < 4; ++v) {
      const float share = weight * views.weight[v];
      if (share == 0.0f) continue;
      const float* from = position + std::size_t(views.index[v]) * stride;
      for (int k = 0; k < stride; ++k) sum[k] += share * from[k];
    }
  }

  void addNearest(const Vec2& q, float weight) {
    const RttLevel& level = pyramid.levels[0];
    add(0, std::min(int(q.x() * float(level.width)), level.width - 1),
        std::min(int(q.y() * float(level.height)), level.height - 1), weight);
  }

  /// `between`: as RttProbes has it.
  void addBilinear(int k, const Vec2& q, float between, float weight) {
    const RttLevel& level = pyramid.levels[k];
    const float x = q.x() * float(level.width) - 0.5f, y = q.y() * float(level.height) - 0.5f;
    const float left = std::floor(x), low = std::floor(y);
    const float wx = sharpened(x - left, between), wy = sharpened(y - low, between);
    const int x1 = (int(left) + 1) % level.width, x0 = (int(left) + level.width) % level.width;
    const int y1 = (int(low) + 1) % level.height, y0 = (int(low) + level.height) % level.height;
    add(k, x0, y0, weight * (1 - wy) * (1 - wx));
    add(k, x1, y0, weight * (1 - wy) * wx);
    add(k, x0, y1, weight * wy * (1 - wx));
    add(k, x1, y1, weight * wy * wx);
  }

  void addLevel(int k, const Vec2& q, float between, float weight) {
    if (weight == 0.0f) return;
    if (k == 0 && between == 0.0f)
      addNearest(q, weight);
    else
      addBilinear(k, q, k == 0 ? between : 1.0f, weight);
  }

  static float sharpened(float share, float between) {
    return std::clamp((share - 0.5f) / between + 0.5f, 0.0f, 1.0f);
  }
};

}  // namespace

Rgb respond(const RttPyramid& pyramid, const Vec2& q, const RttProbes& probes,
            const RttViews& views, const float* light) {
  assert(pyramid.bands <= sh::kMaxBands);
  const float level = std::min(probes.level, float(pyramid.levels.size() - 1));
  const int finer = int(level), coarser = std::min(finer + 1, int(pyramid.levels.size()) - 1);
  const float share = 1.0f / float(probes.count), mix = level - float(finer);
  Response response{pyramid, views, {}};
  for (int i = 0; i < probes.count; ++i) {
    const Vec2 at = q + (float(i) - 0.5f * float(probes.count - 1)) * probes.step;
    const Vec2 wrapped = at - Vec2(at.array().floor());
    response.addLevel(finer, wrapped, probes.between, share * (1 - mix));
    response.addLevel(coarser, wrapped, probes.between, share * mix);
  }
  Rgb radiance = Rgb::Zero();
  for (int i = 0; i < pyramid.bands * pyramid.bands; ++i)
    for (int c = 0; c < 3; ++c) radiance[c] += response.sum[3 * i + c] * light[3 * i + c];
  return radiance;
}

}  // namespace lambent::shade
