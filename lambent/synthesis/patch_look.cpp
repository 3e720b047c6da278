#include "lambent/synthesis/patch_look.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "lambent/radiometry/luminance.h"
#include "lambent/work/parallel_for.h"

namespace lambent::synthesis {
namespace {

constexpr int kMostAcross = 64;      ///< positions that likeness is measured on
constexpr double kAlike = 0.93;      ///< correlation from which a patch is like itself
constexpr double kWorthALook = 0.6;  ///< of few places, from which all are looked at
constexpr double kUnlike = -1.0;     ///< else
constexpr int kFirstStride = 4;

int around(int i, int count) {
  return (i % count + count) % count;
}

/// The numbers of a place that are compared: colour, and the two of the lean.
struct Place {
  std::array<float, 5> v{};
};

Place turnedPlace(const Place& place, int quarters) {
  const float x = place.v[3], y = place.v[4];
  Place out = place;
  if (quarters == 1) out.v[3] = -y, out.v[4] = x;
  if (quarters == 2) out.v[3] = -x, out.v[4] = -y;
  if (quarters == 3) out.v[3] = y, out.v[4] = -x;
  return out;
}

/// The look at `width` × `height` positions at most, its mean taken off.
struct Coarse {
  int width = 0, height = 0;
  std::vector<Place> places;
  double variance = 0.0;

  explicit Coarse(const PatchLook& look) {
    const int fx = (look.width + kMostAcross - 1) / kMostAcross;
    const int fy = (look.height + kMostAcross - 1) / kMostAcross;
    width = std::max(1, look.width / fx), height = std::max(1, look.height / fy);
    places.resize(std::size_t(width) * std::size_t(height));
    std::array<double, 5> mean{};
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        std::array<double, 5> sum{};
        const int x0 = x * look.width / width, x1 = (x + 1) * look.width / width;
        const int y0 = y * look.height / height, y1 = (y + 1) * look.height / height;
        for (int py = y0; py < y1; ++py)
          for (int px = x0; px < x1; ++px) {
            const std::size_t p = std::size_t(py) * std::size_t(look.width) + std::size_t(px);
            for (int c = 0; c < 3; ++c) sum[std::size_t(c)] += double(look.color[p][c]);
            sum[3] += double(look.lean[p].x()), sum[4] += double(look.lean[p].y());
          }
        Place& place = places[std::size_t(y) * std::size_t(width) + std::size_t(x)];
        for (std::size_t c = 0; c < 5; ++c) {
          place.v[c] = float(sum[c] / double((x1 - x0) * (y1 - y0)));
          mean[c] += double(place.v[c]) / double(places.size());
        }
      }
    for (Place& place : places)
      for (std::size_t c = 0; c < 5; ++c) {
        if (c < 3) place.v[c] -= float(mean[c]);
        variance += double(place.v[c]) * double(place.v[c]) / double(places.size());
      }
  }

  /// The correlation of the patch with itself turned and moved by whole positions, by every
  /// `stride`th place along each axis.
  double likeness(int quarters, int sx, int sy, int stride = 1) const {
    double sum = 0.0, count = 0.0;
    for (int y = 0; y < height; y += stride)
      for (int x = 0; x < width; x += stride) {
        int tx = x, ty = y;  // turned about the origin, which lies between positions
        if (quarters == 1) tx = -1 - y, ty = x;
        if (quarters == 2) tx = -1 - x, ty = -1 - y;
        if (quarters == 3) tx = y, ty = -1 - x;
        const Place a =
            turnedPlace(places[std::size_t(y) * std::size_t(width) + std::size_t(x)], quarters);
        const Place& b = places[std::size_t(around(ty + sy, height)) * std::size_t(width) +
                                std::size_t(around(tx + sx, width))];
        for (std::size_t c = 0; c < 5; ++c) {
          const double d = double(a.v[c]) - double(b.v[c]);
          sum += d * d;
        }
        count += 1.0;
      }
    return 1.0 - sum / count / (2.0 * variance);
  }
};

/// The top of a parabola through three values at −1, 0, 1, of which the middle is the largest:
/// where, and how much above the middle.
std::pair<double, double> summit(double before, double at, double after) {
  const double bend = before - 2.0 * at + after;
  if (!(bend < 0.0)) return {0.0, 0.0};
  const double where = std::clamp(0.5 * (before - after) / bend, -0.5, 0.5);
  return {where, -0.5 * bend * where * where};
}

}  // namespace

Rgb PatchLook::colorAt(const Vec2& q) const {
  const float fx = (q.x() - std::floor(q.x())) * float(width) - 0.5f;
  const float fy = (q.y() - std::floor(q.y())) * float(height) - 0.5f;
  const int x = int(std::floor(fx)), y = int(std::floor(fy));
  const float s = fx - float(x), t = fy - float(y);
  const auto at = [&](int px, int py) -> const Rgb& {
    return color[std::size_t(around(py, height)) * std::size_t(width) +
                 std::size_t(around(px, width))];
  };
  return (1 - t) * ((1 - s) * at(x, y) + s * at(x + 1, y)) +
         t * ((1 - s) * at(x, y + 1) + s * at(x + 1, y + 1));
}

Rgb perceived(const Rgb& color) {
  return color.max(0.0f).unaryExpr([](float c) { return std::cbrt(c); });
}

PatchLook lookOf(const transfer::Rtt<transfer::Floats>& rtt) {
  assert(rtt.bands >= 1 && rtt.views >= 1);
  PatchLook look;
  look.width = rtt.width, look.height = rtt.height;
  look.color.resize(rtt.positionCount()), look.lean.assign(rtt.positionCount(), Vec2::Zero());
  // The view in the middle, or the mean of the four around it.
  const int last = rtt.views / 2, first = rtt.views % 2 == 1 ? last : last - 1;
  const auto response = [&](int coefficient, int x, int y) -> Rgb {
    Rgb sum = Rgb::Zero();
    for (int vy = first; vy <= last; ++vy)
      for (int vx = first; vx <= last; ++vx) {
        const std::size_t i = rtt.index(coefficient, x, y, vx, vy);
        sum += Rgb(rtt.values[i], rtt.values[i + 1], rtt.values[i + 2]);
      }
    return sum / float((last - first + 1) * (last - first + 1));
  };
  const float white = std::sqrt(4.0f * float(kPi));  // the first coefficient of radiance 1
  for (int y = 0; y < rtt.height; ++y)
    for (int x = 0; x < rtt.width; ++x) {
      const std::size_t p = std::size_t(y) * std::size_t(rtt.width) + std::size_t(x);
      look.color[p] = white * response(0, x, y);
      if (rtt.bands < 2) continue;
      look.lean[p] =
          Vec2(radiometry::luminance(response(3, x, y)), radiometry::luminance(response(1, x, y)));
    }
  return look;
}

std::vector<LookSymmetry> symmetriesOf(const PatchLook& look, bool square) {
  const Coarse coarse(look);
  std::vector<LookSymmetry> all = {{}};
  if (!(coarse.variance > 0.0)) return all;  // what is even everywhere never shows where it lies
  const int w = coarse.width, h = coarse.height;
  for (int quarters = 0; quarters < 4; ++quarters) {
    if (quarters % 2 == 1 && (!square || w != h)) continue;
    std::vector<double> like(std::size_t(w) * std::size_t(h));
    work::parallelFor(h, [&](int sy) {
      for (int sx = 0; sx < w; ++sx)
        like[std::size_t(sy) * std::size_t(w) + std::size_t(sx)] =
            coarse.likeness(quarters, sx, sy, kFirstStride) < kWorthALook
                ? kUnlike
                : coarse.likeness(quarters, sx, sy);
    });
    const auto at = [&](int sx, int sy) {
      return like[std::size_t(around(sy, h)) * std::size_t(w) + std::size_t(around(sx, w))];
    };
    for (int sy = 0; sy < h; ++sy)
      for (int sx = 0; sx < w; ++sx) {
        if (quarters == 0 && sx == 0 && sy == 0) continue;
        const double own = at(sx, sy);
        if (own < kWorthALook) continue;
        bool highest = true;  // of equals, the first
        for (int dy = -1; dy <= 1; ++dy)
          for (int dx = -1; dx <= 1; ++dx) {
            if (dx == 0 && dy == 0) continue;
            const bool before = dy < 0 || (dy == 0 && dx < 0);
            highest &= before ? own > at(sx + dx, sy + dy) : own >= at(sx + dx, sy + dy);
          }
        if (!highest) continue;
        const auto beside = [&](int dx, int dy) {
          return coarse.likeness(quarters, sx + dx, sy + dy);
        };
        const auto [x, riseX] = summit(beside(-1, 0), own, beside(1, 0));
        const auto [y, riseY] = summit(beside(0, -1), own, beside(0, 1));
        const double likeness = own + riseX + riseY;
        if (likeness < kAlike) continue;
        const Vec2 shift((float(sx) + float(x)) / float(w), (float(sy) + float(y)) / float(h));
        all.push_back({quarters, shift - Vec2(shift.array().floor()), likeness});
      }
  }
  return all;
}

Vec2 turned(const Vec2& q, int quarters) {
  switch (quarters & 3) {
    case 1:
      return Vec2(-q.y(), q.x());
    case 2:
      return -q;
    case 3:
      return Vec2(q.y(), -q.x());
    default:
      return q;
  }
}

}  // namespace lambent::synthesis
