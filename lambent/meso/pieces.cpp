// Height fields made of pieces that lie side by side, by formula: bricks, scales, pebbles.
//
// This work is based on:
// - worley1996cellular: pebbles are the cells of scattered points, here on a plane that repeats.
#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <vector>

#include "lambent/math/random.h"
#include "lambent/meso/generators.h"
#include "lambent/meso/profile.h"
#include "lambent/meso/relief.h"

namespace lambent::meso {

Patch bricks(const BrickOptions& options) {
  assert(options.courses >= 2 && options.courses % 2 == 0 && options.bricks >= 1);
  const double width = 1.0 / options.bricks, height = 1.0 / options.courses;  // of a brick's place
  const double joint = options.joint * height, rounding = options.rounding * height;
  return relief("bricks", options.size, options.resolution, [&](double x, double y) -> Relief {
    const double course = std::floor(y / height);
    const double shift = std::fmod(course, 2.0) == 0.0 ? 0.0 : 0.5;
    // Signed distance to a brick with round corners; lengths along y are those along x.
    const double dx = std::abs(fromWhole(x / width - shift - 0.5)) * width;
    const double dy = std::abs(y / height - course - 0.5) * height;
    const double ex = dx - (0.5 * (width - joint) - rounding);
    const double ey = dy - (0.5 * (height - joint) - rounding);
    const double out = std::hypot(std::max(ex, 0.0), std::max(ey, 0.0)) +
                       std::min(std::max(ex, ey), 0.0) - rounding;
    // A quarter round down to the mortar, which lies a little below the faces.
    const double in = std::clamp(-out / rounding, 0.0, 1.0);
    const double edge = std::sqrt(1.0 - std::pow(1.0 - in, 2));
    return {options.depth * height * edge,
            mixed(options.mortar, options.brick, smooth(-0.1 * joint, 0.1 * joint, -out))};
  });
}

namespace {

constexpr double kHang = 1.7;  ///< rows that the middle of a scale hangs below its root

struct ScalePlace {
  double across;  ///< −1 … 1 from side to side
  double lean;    ///< 0 at the upper end, 1 at the tip
  double inside;  ///< rows above the arc that ends the scale
};

/// x in scales, y in rows; the scale of `row` there. Its arc hangs down in the middle and ends at
/// the root at its sides.
ScalePlace placeOnScale(double x, double y, double row) {
  const double across = 2.0 * fromWhole(x - (std::fmod(row, 2.0) == 0.0 ? 0.5 : 1.0));
  const double up = y - row;
  const double arc = -kHang * std::sqrt(std::max(0.0, 1.0 - across * across));
  return {across, (1.0 - up) / (1.0 + kHang), up - arc};
}

}  // namespace

Patch scales(const ScaleOptions& options) {
  assert(options.rows >= 2 && options.rows % 2 == 0 && options.across >= 1);
  const double width = 1.0 / options.across, height = 1.0 / options.rows;
  // Every scale rises towards its tip, is arched across, and ends in a round lip.
  const auto shown = [&](const ScalePlace& place) -> Relief {
    const double lip = std::sqrt(1.0 - std::pow(1.0 - std::clamp(place.inside / 0.2, 0.0, 1.0), 2));
    const double arch = 1.0 - 0.4 * place.across * place.across;
    return {options.depth * height * (0.2 + 0.8 * place.lean) * arch * (0.5 + 0.5 * lip),
            mixed(options.root, options.tip, smooth(0.2, 0.95, place.lean))};
  };
  return relief("scales", options.size, options.resolution, [&](double x, double y) -> Relief {
    // Rows overlap like tiles: a row's tips lie over the bodies of the one below it. A place shows
    // the highest row whose scale reaches down to it; its own row's bodies fill what is left.
    const double row = std::floor(y / height);
    for (int k = 2; k > 0; --k) {
      const ScalePlace place = placeOnScale(x / width, y / height, row + k);
      if (place.inside > 0.0) return shown(place);
    }
    return shown(placeOnScale(x / width, y / height, row));
  });
}

namespace {

struct Pebble {
  double x, y;  ///< in periods
  double height, tone;
};

/// Points apart from each other, by best of many: each is the one, of ever more at random, that
/// lies furthest from those before it.
std::vector<Pebble> scattered(const PebbleOptions& options) {
  std::vector<Pebble> pebbles;
  for (int k = 0; k < options.count; ++k) {
    math::Random random(options.seed, 0x706562626cull, static_cast<std::uint64_t>(k));
    Pebble best{};
    double furthest = -1.0;
    for (int attempt = 0; attempt < 6 * (k + 1); ++attempt) {
      const double x = random.uniformDouble(), y = random.uniformDouble();
      double nearest = std::numeric_limits<double>::infinity();
      for (const Pebble& p : pebbles)
        nearest = std::min(nearest, std::hypot(fromWhole(x - p.x), fromWhole(y - p.y)));
      if (nearest > furthest) furthest = nearest, best.x = x, best.y = y;
    }
    best.height = 0.75 + 0.25 * random.uniformDouble(), best.tone = random.uniformDouble();
    pebbles.push_back(best);
  }
  return pebbles;
}

}  // namespace

Patch pebbles(const PebbleOptions& options) {
  assert(options.count >= 1);
  const std::vector<Pebble> all = scattered(options);
  const double typical = 1.0 / std::sqrt(double(options.count));
  return relief("pebbles", options.size, options.resolution, [&](double x, double y) -> Relief {
    // How far inside its cell a place lies: the nearest of the bisectors towards the others, which
    // a soft minimum rounds the corners of.
    const Pebble* own = nullptr;
    double dx = 0.0, dy = 0.0, nearest = std::numeric_limits<double>::infinity();
    for (const Pebble& p : all) {
      const double px = fromWhole(p.x - x), py = fromWhole(p.y - y), r = std::hypot(px, py);
      if (r < nearest) nearest = r, own = &p, dx = px, dy = py;
    }
    const double softness = 0.05 * typical;
    double sum = 0.0;
    for (const Pebble& p : all)
      for (int ty = -1; ty <= 1; ++ty)
        for (int tx = -1; tx <= 1; ++tx) {
          const double px = fromWhole(p.x - x) + tx - dx, py = fromWhole(p.y - y) + ty - dy;
          const double apart = std::hypot(px, py);
          if (apart < 1e-9) continue;
          const double bisector = 0.5 * apart + (dx * px + dy * py) / apart;
          sum += std::exp(-bisector / softness);
        }
    const double inside = -softness * std::log(sum) - 0.5 * options.gap * typical;
    const double round = std::clamp(inside / (0.35 * typical), 0.0, 1.0);
    const double dome = std::sqrt(1.0 - std::pow(1.0 - round, 2));
    const Rgb stone = mixed(options.dark, options.light, own->tone);
    return {options.depth * typical * own->height * dome,
            mixed(options.ground, stone, smooth(-0.02 * typical, 0.02 * typical, inside))};
  });
}

}  // namespace lambent::meso
