// This work is based on:
// - sloan2003biscale: §5, "Accessing the RTT": bilinear over views, nearest over positions.
// - shirley1997low: the square of the view samples (math::squareFromHemisphere).
// - williams1983pyramidal: between positions and levels of the pyramid.
// - mcmillan1995plenoptic, policarpo2005relief: views of a relief, each with its depths, warped to
//   one between them by a search along the ray.
//
//   q, q_k    where the true ray, and that of view k, meet the plane midway in the patch's depth
//   t, t_k    their slopes: along the plane, for a step of 1 away from it, towards the viewer
//   h, h_k(q) heights over that plane, of what is seen and of what view k sees through q, in depths
//             of the patch: −½ … ½
//
// Views of a relief are shifted against each other: the point at the height h of the true ray lies
// at q + h t, and view k sees it through q_k = q + h (t − t_k). It is there that h_k(q_k) = h. What
// the view sees where the ray comes in, at h = ½, is mostly at a height at which it sees the same
// again; otherwise a search goes down the ray. A view from which something hides the point shows
// another height at q_k: it counts by how near that is.
//
// Measured, 2026-11, with 8×8 views, 20° above a weave 0.29 of its period deep, and above a plate
// with holes, relative RMSE: uncorrected 18% and 16%; a search in every view 2.5% and 2.8%; a step
// first, and the search where it fails, 2.9% and 2.8%. Steps that begin at h = 0 find what lies
// behind: 2.9% and 6.1%; they alone, without a search, 6% of the weave, twice or three times 5% and
// 4%. Heights between positions, instead of the nearest one's, are wrong at every outline: 4%.
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

namespace {

/// cos θ of the lowest rays that are told apart: below, nothing is shifted further.
constexpr float kLowestRay = 0.1f;
/// Heights that are taken for the same, depths of the patch.
constexpr float kSameHeight = 0.02f;
/// How far heights are apart where a view counts by half, depths of the patch.
constexpr float kHalfSure = 0.01f;
constexpr int kSearchSteps = 8;

/// Of the middle of a view's cell: Vec2 per step of 1 away from the plane.
Vec2 slopeOfView(int views, int x, int y) {
  const Vec3 v = math::hemisphereFromSquare(
      Vec2((float(x) + 0.5f) / float(views), (float(y) + 0.5f) / float(views)));
  return v.head<2>() / v.z();
}

}  // namespace

RttViews viewsAround(int views, const Vec3& toViewer, const Vec2& relief) {
  const Vec2 square =
      math::squareFromHemisphere(Vec3(toViewer.x(), toViewer.y(), std::max(0.0f, toViewer.z())));
  const float last = float(views - 1);
  const float x = std::clamp(square.x() * float(views) - 0.5f, 0.0f, last);
  const float y = std::clamp(square.y() * float(views) - 0.5f, 0.0f, last);
  const int x0 = int(x), y0 = int(y);
  const int x1 = std::min(x0 + 1, views - 1), y1 = std::min(y0 + 1, views - 1);
  const float wx = x - float(x0), wy = y - float(y0);
  RttViews around{{y0 * views + x0, y0 * views + x1, y1 * views + x0, y1 * views + x1},
                  {(1 - wy) * (1 - wx), (1 - wy) * wx, wy * (1 - wx), wy * wx}};
  if (relief == Vec2::Zero()) return around;
  around.corrected = true;
  const Vec2 slope = toViewer.head<2>() / std::max(toViewer.z(), kLowestRay);
  for (int v = 0; v < 4; ++v)
    around.apart[v] =
        (slope - slopeOfView(views, v & 1 ? x1 : x0, v & 2 ? y1 : y0)).cwiseProduct(relief);
  return around;
}

namespace {

/// Numbers of one position and view with the most bands that there can be.
constexpr int kMostNumbers = rttStride(sh::kMaxBands);

/// The heights that one view shows on one level.
struct HeightsOfView {
  const RttLevel& level;
  std::size_t views, view;

  /// Over the patch's middle, in its depths.
  float at(const Vec2& q) const {
    const Vec2 in = q - Vec2(q.array().floor());
    const int x = std::min(int(in.x() * float(level.width)), level.width - 1);
    const int y = std::min(int(in.y() * float(level.height)), level.height - 1);
    const std::size_t place = std::size_t(y) * level.width + x;
    return float(level.heights[place * views + view]) / 255.0f - 0.5f;
  }
};

/// Where the true ray meets what a view sees.
struct Meeting {
  float height = 0.0f;  ///< h
  float missed = 0.0f;  ///< h − h_k(q_k)
};

Meeting meetingOf(const HeightsOfView& heights, const Vec2& q, const Vec2& apart) {
  float high = 0.5f, over = high - heights.at(q + high * apart), low = high, under = over;
  Meeting found;
  found.height = high - over;
  found.missed = found.height - heights.at(q + found.height * apart);
  if (std::abs(found.missed) <= kSameHeight) return found;
  // From the top down, until the ray is below what the view sees.
  for (int i = 1; i <= kSearchSteps && under > 0.0f; ++i) {
    high = low, over = under;
    low = 0.5f - float(i) / float(kSearchSteps);
    under = low - heights.at(q + low * apart);
  }
  found.height = over > under ? high + (low - high) * (over / (over - under)) : low;
  found.missed = found.height - heights.at(q + found.height * apart);
  return found;
}

/// How much of the correction a level takes: all where its positions are small beside the shifts,
/// none where they are as large.
float corrected(const RttPyramid& pyramid, int level, const Vec2& apart) {
  if (level == 0) return 1.0f;
  const RttLevel& first = pyramid.levels[0];
  const float shift = apart.cwiseProduct(Vec2(float(first.width), float(first.height))).norm();
  return std::clamp(2.0f - 4.0f * (std::exp2(float(level)) - 1.0f) / std::max(shift, 1e-6f), 0.0f,
                    1.0f);
}

/// The weighted sum of responses, number for number.
struct Response {
  const RttPyramid& pyramid;
  const RttViews& views;
  alignas(64) std::array<float, kMostNumbers> sum{};

  void add(int level, int x, int y, int view, float weight) {
    if (weight == 0.0f) return;
    const int stride = pyramid.stride();
    const float* from = pyramid.at(level, x, y) + std::size_t(view) * stride;
    for (int k = 0; k < stride; ++k) sum[k] += weight * from[k];
  }

  void addNearest(const Vec2& q, int view, float weight) {
    const RttLevel& level = pyramid.levels[0];
    add(0, std::min(int(q.x() * float(level.width)), level.width - 1),
        std::min(int(q.y() * float(level.height)), level.height - 1), view, weight);
  }

  /// `between`: as RttProbes has it.
  void addBilinear(int k, const Vec2& q, int view, float between, float weight) {
    const RttLevel& level = pyramid.levels[k];
    const float x = q.x() * float(level.width) - 0.5f, y = q.y() * float(level.height) - 0.5f;
    const float left = std::floor(x), low = std::floor(y);
    const float wx = sharpened(x - left, between), wy = sharpened(y - low, between);
    const int x1 = (int(left) + 1) % level.width, x0 = (int(left) + level.width) % level.width;
    const int y1 = (int(low) + 1) % level.height, y0 = (int(low) + level.height) % level.height;
    add(k, x0, y0, view, weight * (1 - wy) * (1 - wx));
    add(k, x1, y0, view, weight * (1 - wy) * wx);
    add(k, x0, y1, view, weight * wy * (1 - wx));
    add(k, x1, y1, view, weight * wy * wx);
  }

  void addLevel(int k, const Vec2& q, float between, float weight) {
    if (weight == 0.0f) return;
    std::array<Vec2, 4> places = {q, q, q, q};
    std::array<float, 4> shares = views.weight;
    if (views.corrected && pyramid.relief != Vec2::Zero()) {
      float total = 0.0f;
      for (int v = 0; v < 4; ++v) {
        if (shares[v] == 0.0f) continue;
        const Vec2 apart = corrected(pyramid, k, views.apart[v]) * views.apart[v];
        const HeightsOfView heights{pyramid.levels[k], pyramid.viewCount(),
                                    std::size_t(views.index[v])};
        const Meeting found = meetingOf(heights, q, apart);
        places[v] = q + found.height * apart;
        places[v] -= Vec2(places[v].array().floor());
        shares[v] /= kHalfSure * kHalfSure + found.missed * found.missed;
        total += shares[v];
      }
      for (float& share : shares) share /= total;
    }
    for (int v = 0; v < 4; ++v)
      if (k == 0 && between == 0.0f)
        addNearest(places[v], views.index[v], weight * shares[v]);
      else
        addBilinear(k, places[v], views.index[v], k == 0 ? between : 1.0f, weight * shares[v]);
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
