// This work is based on:
// - levy2002least: §4.2, charts turned upright, the large ones first, each put as low as it fits.
// Where we deviate: there a chart drops onto a horizon; here it is put wherever its texels are
// free, into bays and holes of other charts too, in the best of eight directions. That costs no
// more: a conflict tells how far to the right the chart must move at least, so that few places are
// tried.
#include "lambent/atlas/pack.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <string>

#include "lambent/atlas/touched_texels.h"
#include "lambent/math/random.h"
#include "lambent/work/parallel_for.h"

namespace lambent::atlas {
namespace {

/// Texels that a chart comes this near to are its own: coordinates will be rounded to floats.
constexpr double kMargin = 1.0 / 512.0;
/// Charts of less area than this, in texels, are drawn larger.
constexpr double kLeastArea = 0.25;
/// Trial packings are made on squares of about this many cells a side.
constexpr int kTrialCells = 512;
/// With more charts than this, each is tried in fewer directions.
constexpr std::size_t kManyCharts = 2000;

/// With no more charts than this, several sequences are tried.
constexpr std::size_t kFewCharts = 200;
/// With more, each looks for a place no lower than the last few have found one.
constexpr std::size_t kRecent = 48;
constexpr std::uint64_t kShuffles = 10;

struct Mask {
  int width = 0, height = 0;
  std::vector<std::uint8_t> cells;
  std::uint8_t& at(int x, int y) { return cells[std::size_t(y) * width + x]; }
  std::uint8_t at(int x, int y) const { return cells[std::size_t(y) * width + x]; }
};

struct Span {
  int row, first, last;
};

/// What a chart covers in one direction, and how it came to lie there.
struct Footprint {
  Mask mask;
  std::vector<Span> spans;    ///< what must be free: the mask with its gutter
  int width = 0, height = 0;  ///< with the gutter
  Placement placement;        ///< onto the mask
};

Eigen::Matrix2d turnBy(double angle) {
  Eigen::Matrix2d turn;
  turn << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
  return turn;
}

/// The angle at which the smallest rectangle around the outlines stands upright.
double uprightAngle(const PackShape& shape) {
  std::vector<Vec2d> points;
  for (const auto& outline : shape.outlines)
    points.insert(points.end(), outline.begin(), outline.end());
  const auto before = [](const Vec2d& a, const Vec2d& b) {
    return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y();
  };
  std::sort(points.begin(), points.end(), before);
  // Hull by the lower and the upper chain (Andrew).
  std::vector<Vec2d> hull;
  for (int chain = 0; chain < 2; ++chain) {
    const std::size_t start = hull.size();
    for (const Vec2d& p : points) {
      while (hull.size() >= start + 2) {
        const Vec2d a = hull.back() - hull[hull.size() - 2], b = p - hull.back();
        if (a.x() * b.y() - a.y() * b.x() > 0.0) break;
        hull.pop_back();
      }
      hull.push_back(p);
    }
    hull.pop_back();
    std::reverse(points.begin(), points.end());
  }
  // Edges from many directions of a round outline are as good as all of them.
  const std::size_t stride = std::max<std::size_t>(1, hull.size() / 256);
  double best = std::numeric_limits<double>::infinity(), angle = 0.0;
  for (std::size_t i = 0; i < hull.size(); i += stride) {
    const Vec2d edge = hull[(i + 1) % hull.size()] - hull[i];
    if (!(edge.norm() > 0.0)) continue;
    const Vec2d x = edge.normalized(), y(-x.y(), x.x());
    double low[2], high[2];
    low[0] = low[1] = std::numeric_limits<double>::infinity();
    high[0] = high[1] = -low[0];
    for (const Vec2d& p : hull) {
      low[0] = std::min(low[0], p.dot(x)), high[0] = std::max(high[0], p.dot(x));
      low[1] = std::min(low[1], p.dot(y)), high[1] = std::max(high[1], p.dot(y));
    }
    const double area = (high[0] - low[0]) * (high[1] - low[1]);
    // Equal ones are told apart by nothing but rounding: the first stays.
    if (area < best * (1.0 - 1e-9)) best = area, angle = std::atan2(-x.y(), x.x());
  }
  return angle;
}

/// Every cell that the chart touches; nothing if it is longer than `longest` cells.
std::optional<Footprint> draw(const PackShape& shape, const Eigen::Matrix2d& linear, int longest) {
  std::vector<std::vector<Vec2d>> outlines = shape.outlines;
  const Vec2d shift = Vec2d::Constant(0.5) - linear * shape.anchor;
  Vec2d lower = Vec2d::Constant(std::numeric_limits<double>::infinity()), upper = -lower;
  for (auto& outline : outlines)
    for (Vec2d& p : outline) {
      p = linear * p + shift;
      lower = lower.cwiseMin(p), upper = upper.cwiseMax(p);
    }
  if (!((upper - lower).maxCoeff() < longest)) return std::nullopt;
  const Vec2d origin((lower - Vec2d::Constant(kMargin)).array().floor());
  Footprint result;
  result.placement = {linear, shift - origin};
  Mask& mask = result.mask;
  mask.width = static_cast<int>(std::floor(upper.x() + kMargin - origin.x())) + 1;
  mask.height = static_cast<int>(std::floor(upper.y() + kMargin - origin.y())) + 1;
  mask.cells.assign(std::size_t(mask.width) * mask.height, 0);
  std::vector<std::vector<double>> crossings(mask.height);
  for (auto& outline : outlines)
    for (std::size_t i = 0; i < outline.size(); ++i) {
      const Vec2d ends[2] = {outline[i] - origin, outline[(i + 1) % outline.size()] - origin};
      forTouchedRows(ends, kMargin, [&](int y, int x0, int x1) {
        for (int x = x0; x <= x1; ++x) mask.at(x, y) = 1;
      });
      const auto [low, high] = std::minmax(ends[0].y(), ends[1].y());
      // Half-open, so that a corner on a row's middle counts once.
      const int first = std::max(0, static_cast<int>(std::ceil(low - 0.5)));
      for (int y = first; y < mask.height && y + 0.5 < high; ++y)
        crossings[y].push_back(ends[0].x() + (y + 0.5 - ends[0].y()) / (ends[1].y() - ends[0].y()) *
                                                 (ends[1].x() - ends[0].x()));
    }
  for (int y = 0; y < mask.height; ++y) {
    std::sort(crossings[y].begin(), crossings[y].end());
    for (std::size_t i = 0; i + 1 < crossings[y].size(); i += 2) {
      const int from = std::max(0, static_cast<int>(std::ceil(crossings[y][i] - 0.5)));
      const int to =
          std::min(mask.width - 1, static_cast<int>(std::floor(crossings[y][i + 1] - 0.5)));
      for (int x = from; x <= to; ++x) mask.at(x, y) = 1;
    }
  }
  return result;
}

Footprint quarterTurn(const Footprint& from) {
  Footprint result;
  result.mask.width = from.mask.height, result.mask.height = from.mask.width;
  result.mask.cells.resize(from.mask.cells.size());
  for (int y = 0; y < from.mask.height; ++y)
    for (int x = 0; x < from.mask.width; ++x)
      result.mask.at(from.mask.height - 1 - y, x) = from.mask.at(x, y);
  Eigen::Matrix2d turn;
  turn << 0.0, -1.0, 1.0, 0.0;
  result.placement.linear = turn * from.placement.linear;
  result.placement.offset = turn * from.placement.offset + Vec2d(from.mask.height, 0.0);
  return result;
}

void setSpans(Footprint& footprint, int gutter) {
  const Mask& mask = footprint.mask;
  footprint.width = mask.width + 2 * gutter, footprint.height = mask.height + 2 * gutter;
  // Widened along rows, then along columns.
  std::vector<std::uint8_t> wide(std::size_t(footprint.width) * mask.height, 0);
  for (int y = 0; y < mask.height; ++y)
    for (int x = 0; x < mask.width; ++x)
      if (mask.at(x, y))
        std::fill_n(wide.begin() + std::ptrdiff_t(y) * footprint.width + x, 2 * gutter + 1, 1);
  std::vector<std::uint8_t> row(footprint.width);
  for (int y = 0; y < footprint.height; ++y) {
    std::fill(row.begin(), row.end(), 0);
    for (int from = std::max(0, y - 2 * gutter); from <= std::min(mask.height - 1, y); ++from)
      for (int x = 0; x < footprint.width; ++x)
        row[x] |= wide[std::size_t(from) * footprint.width + x];
    for (int x = 0; x < footprint.width;) {
      if (!row[x]) {
        ++x;
        continue;
      }
      const int first = x;
      while (x < footprint.width && row[x]) ++x;
      footprint.spans.push_back({y, first, x - 1});
    }
  }
  // Wide spans conflict first.
  std::stable_sort(
      footprint.spans.begin(), footprint.spans.end(),
      [](const Span& a, const Span& b) { return a.last - a.first > b.last - b.first; });
}

/// The square, by rows of runs.
class Ground {
 public:
  explicit Ground(int size)
      : size_(size),
        runs_(std::size_t(size) * size, static_cast<std::int16_t>(size)),
        room_(size, size),
        taken_(std::size_t(size) * size, 0) {}

  struct Place {
    int x, y;
  };
  /// The lowest place from row `lowest` on, and there the leftmost, whose top stays below `limit`.
  std::optional<Place> find(const Footprint& footprint, int lowest, int limit) const {
    const int lastX = size_ - footprint.width;
    const int lastY = std::min(size_, limit) - footprint.height;
    const Span& widest = footprint.spans.front();
    for (int y = lowest; y <= lastY; ++y) {
      if (room_[y + widest.row] <= widest.last - widest.first) continue;
      int x = 0;
      std::size_t free = 0, at = 0;  // consecutive spans that fit at x
      while (x <= lastX && free < footprint.spans.size()) {
        const Span& span = footprint.spans[at];
        const std::int16_t* row = &runs_[std::size_t(y + span.row) * size_];
        const int run = row[x + span.first];
        if (run > x + span.last) {
          ++free;
          if (++at == footprint.spans.size()) at = 0;
          continue;
        }
        const int end = run < 0 ? -run : -row[run];  // one past the last taken cell
        x = end - span.first;
        free = 0;
      }
      if (x <= lastX) return Place{x, y};
    }
    return std::nullopt;
  }

  void take(const Footprint& footprint, Place place, int gutter) {
    const Mask& mask = footprint.mask;
    for (int y = 0; y < mask.height; ++y) {
      const int row = place.y + gutter + y;
      for (int x = 0; x < mask.width; ++x)
        if (mask.at(x, y)) taken_[std::size_t(row) * size_ + place.x + gutter + x] = 1;
      renew(row);
    }
  }

 private:
  /// runs_: where a cell is free, the next taken one (or the size); where taken, minus the next
  /// free one (or minus the size).
  void renew(int row) {
    const std::uint8_t* taken = &taken_[std::size_t(row) * size_];
    std::int16_t* runs = &runs_[std::size_t(row) * size_];
    int next = size_, longest = 0;
    for (int x = size_ - 1; x >= 0; --x) {
      if (x + 1 < size_ && taken[x] != taken[x + 1]) next = x + 1;
      runs[x] = static_cast<std::int16_t>(taken[x] ? -next : next);
      if (!taken[x]) longest = std::max(longest, next - x);
    }
    room_[row] = longest;
  }

  int size_;
  std::vector<std::int16_t> runs_;
  std::vector<int> room_;  ///< longest free run of each row
  std::vector<std::uint8_t> taken_;
};

struct Order {
  const std::vector<std::uint32_t>& charts;
  const std::vector<double>& angles;  ///< of each chart, to stand upright
};

/// Sequences to try: the large ones first, the long ones first, and some in which a chart may come
/// before others that are not much larger.
std::vector<std::vector<std::uint32_t>> ordersOf(const std::vector<PackShape>& shapes) {
  std::vector<std::vector<std::uint32_t>> orders;
  std::vector<double> keys(shapes.size());
  const auto add = [&] {
    std::vector<std::uint32_t>& order = orders.emplace_back(shapes.size());
    std::iota(order.begin(), order.end(), 0u);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return keys[a] > keys[b]; });
  };
  for (std::size_t c = 0; c < keys.size(); ++c) keys[c] = shapes[c].area;
  add();
  if (shapes.size() > kFewCharts) return orders;
  for (std::size_t c = 0; c < keys.size(); ++c) {
    double farthest = 0.0;
    for (const Vec2d& p : shapes[c].outlines.front())
      farthest = std::max(farthest, (p - shapes[c].outlines.front().front()).norm());
    keys[c] = farthest;
  }
  add();
  for (std::uint64_t shuffle = 0; shuffle < kShuffles; ++shuffle) {
    math::Random random(shuffle, shapes.size());
    for (std::size_t c = 0; c < keys.size(); ++c)
      keys[c] = shapes[c].area * std::exp(2.0 * (random.uniformDouble() - 0.5));
    add();
  }
  return orders;
}

/// `scale` in cells a metre; nothing if they do not fit.
std::optional<Packing> tryToPack(const std::vector<PackShape>& shapes, const Order& order, int size,
                                 int gutter, double scale, bool thorough) {
  Packing packing;
  packing.scale = scale;
  packing.placements.resize(shapes.size());
  Ground ground(size);
  // Of many charts, in falling sequence of size, those just placed tell where there is still room.
  std::vector<int> recent;
  std::size_t placed = 0;
  for (const std::uint32_t c : order.charts) {
    const PackShape& shape = shapes[c];
    const double own = std::max(scale, std::sqrt(kLeastArea / shape.area));
    int limit = size + 1;
    const int lowest =
        recent.size() < kRecent ? 0 : *std::min_element(recent.begin(), recent.end());
    std::optional<Ground::Place> best;
    Footprint chosen;
    for (int half = 0; half < (thorough ? 2 : 1); ++half) {
      std::optional<Footprint> drawn =
          draw(shape, own * turnBy(order.angles[c] + 0.25 * kPi * half), size - 2 * gutter);
      if (!drawn) continue;
      Footprint& footprint = *drawn;
      for (int quarter = 0; quarter < (shapes.size() > kManyCharts ? 2 : 4); ++quarter) {
        if (quarter > 0) footprint = quarterTurn(footprint);
        footprint.spans.clear();
        setSpans(footprint, gutter);
        if (const auto place = ground.find(footprint, lowest, limit - 1)) {
          best = place;
          limit = place->y + footprint.height;
          chosen = footprint;
        }
      }
    }
    if (!best) return std::nullopt;
    ground.take(chosen, *best, gutter);
    if (shapes.size() > kFewCharts) {
      if (recent.size() < kRecent)
        recent.push_back(best->y);
      else
        recent[placed % kRecent] = best->y;
      ++placed;
    }
    packing.placements[c] = chosen.placement;
    packing.placements[c].offset += Vec2d(best->x + gutter, best->y + gutter);
  }
  return packing;
}

}  // namespace

Result<Packing> pack(const std::vector<PackShape>& shapes, const PackOptions& options) {
  std::vector<double> angles(shapes.size());
  work::parallelFor(shapes.size(), [&](std::size_t c) { angles[c] = uprightAngle(shapes[c]); });
  const std::vector<std::vector<std::uint32_t>> orders = ordersOf(shapes);
  double area = 0.0;
  for (const PackShape& shape : shapes) area += shape.area;
  const bool thorough = shapes.size() <= kManyCharts / 4;

  // Trials: a sequence, and the share of the square that the charts shall cover. Returns the best
  // of those that fit.
  struct Trial {
    double share = 0.0;
    std::size_t order = 0;
    std::optional<Packing> packing;
  };
  const auto bestOf = [&](std::vector<Trial> trials, int cell) {
    const int size = options.size / cell, gutter = (options.gutter + cell - 1) / cell;
    work::parallelFor(trials.size(), [&](std::size_t i) {
      trials[i].packing = tryToPack(shapes, {orders[trials[i].order], angles}, size, gutter,
                                    size * std::sqrt(trials[i].share / area), thorough);
    });
    Trial best;
    for (Trial& trial : trials)
      if (trial.packing && trial.share > best.share) best = std::move(trial);
    return best;
  };
  // First on a square of few cells. What fits there fits the real one.
  const int cell = std::max(1, options.size / kTrialCells);
  Trial best;
  for (double most = 0.85; !best.packing && most > 1e-9; most *= most > 0.5 ? 0.55 : 0.15) {
    std::vector<Trial> trials;
    for (int i = 0; i < 6; ++i) trials.push_back({most * (1.0 - 0.08 * i), 0, {}});
    best = bestOf(std::move(trials), cell);
    // Where even gutters do not fit, coarse cells are to blame.
    if (!best.packing && cell > 1 && most < 0.1) break;
  }
  while (best.packing && orders.size() > 1) {
    std::vector<Trial> trials;
    for (std::size_t order = 0; order < orders.size(); ++order)
      for (const double more : {0.015, 0.03, 0.045})
        trials.push_back({best.share + more, order, {}});
    Trial better = bestOf(std::move(trials), cell);
    if (!better.packing) break;
    best = std::move(better);
  }
  std::optional<Packing> packing;
  if (best.packing) {
    packing = std::move(best.packing);
    packing->scale *= cell;
    for (Placement& placement : packing->placements)
      placement.linear *= cell, placement.offset *= cell;
  }
  // Then on the real one, where gutters and borders take less room.
  if (cell > 1 || !packing) {
    std::vector<Trial> trials;
    if (packing) {
      for (const double more : {0.01, 0.02, 0.03, 0.045, 0.06, 0.08})
        trials.push_back({best.share + more, best.order, {}});
      Trial better = bestOf(std::move(trials), 1);
      if (better.packing) packing = std::move(better.packing);
    }
    for (double most = 0.6; !packing && most > 1e-9; most *= 0.15) {
      trials.clear();
      for (int i = 0; i < 4; ++i) trials.push_back({most * (1.0 - 0.22 * i), 0, {}});
      packing = bestOf(std::move(trials), 1).packing;
    }
  }
  if (!packing)
    return report::badUsage("a map of " + std::to_string(options.size) +
                            " texels a side has no "
                            "room for " +
                            std::to_string(shapes.size()) + " charts with gutters of " +
                            std::to_string(options.gutter) +
                            " texels; ask for a larger map, or join the mesh's loose pieces");
  return std::move(*packing);
}

}  // namespace lambent::atlas
