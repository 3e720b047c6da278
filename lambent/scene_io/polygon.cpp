// Based on: meisters1975polygons, the two-ears theorem. A corner is an ear if it is convex and no
// other corner lies in its triangle; cutting it leaves a polygon with one corner less.
//
// Terms: a, b, c are the corners before, at and after a candidate; "bent" corners are those that are
// not convex, straight ones among them.
//
// We deviate: only bent corners are looked for in a candidate's triangle (if any corner lies there,
// a bent one does), and of large polygons only those in cells of a grid that it touches, so that
// polygons as they occur take n log n or so. Debian has no maintained library for this that is not
// under the GPL.
#include "lambent/scene_io/polygon.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <optional>
#include <utility>

#include <Eigen/Geometry>

namespace lambent::scene_io {
namespace {

/// Corners from which a grid is worth making.
constexpr std::size_t kGridCorners = 48;
/// Corners and cells that are looked at before the work is broken off, for a polygon of `corners`.
/// Outlines take some tens for each corner; what takes most is a comb, whose straight back has nearly
/// all corners in one row of the grid: some times the root of their number for each.
std::size_t mostWork(std::size_t corners) {
  return corners * (256 + 8 * std::size_t(std::sqrt(double(corners))));
}

/// Twice the area of a triangle. Kahan's difference of products: its sign is that of the differences
/// between the corners.
double turn(const Vec2d& a, const Vec2d& b, const Vec2d& c) {
  const Vec2d u = b - a, v = c - a;
  const double second = u.y() * v.x();
  return std::fma(u.x(), v.y(), -second) + std::fma(-u.y(), v.x(), second);
}

bool inside(const Vec2d& p, const Vec2d& a, const Vec2d& b, const Vec2d& c) {
  return turn(a, b, p) >= 0.0 && turn(b, c, p) >= 0.0 && turn(c, a, p) >= 0.0;
}

/// The corners seen along the axis that shows most of them, turning counter-clockwise: two of their
/// own coordinates, so that what is straight stays so. Empty if they have no area.
std::vector<Vec2d> flatten(std::span<const Vec3d> corners) {
  Vec3d normal = Vec3d::Zero();  // Newell's: twice the area, along the polygon's mean normal
  const Vec3d origin = corners[0];
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec3d a = corners[i] - origin;
    const Vec3d b = corners[(i + 1) % corners.size()] - origin;
    normal += a.cross(b);
  }
  const double length = normal.norm();
  if (!(length > 0.0) || !std::isfinite(length)) return {};
  int axis = 0;
  normal.cwiseAbs().maxCoeff(&axis);
  int x = (axis + 1) % 3, y = (axis + 2) % 3;
  if (normal[axis] < 0.0) std::swap(x, y);
  std::vector<Vec2d> flat;
  flat.reserve(corners.size());
  for (const Vec3d& corner : corners) flat.emplace_back(corner[x], corner[y]);
  return flat;
}

bool isConvexQuad(std::span<const Vec3d> p) {
  const Vec3d normal = (p[2] - p[0]).cross(p[3] - p[1]);
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec3d arriving = p[i] - p[(i + 3) % 4], leaving = p[(i + 1) % 4] - p[i];
    if (!(arriving.cross(leaving).dot(normal) > 0.0)) return false;
  }
  return true;
}

/// The bent corners by cells of a grid. They are bent no more once they are found to be convex.
class BentCorners {
 public:
  BentCorners(const std::vector<Vec2d>& flat, std::vector<bool> bent)
      : flat_(flat), bent_(std::move(bent)) {
    lower_ = upper_ = flat[0];
    for (const Vec2d& p : flat) lower_ = lower_.cwiseMin(p), upper_ = upper_.cwiseMax(p);
    const auto count = double(std::count(bent_.begin(), bent_.end(), true));
    side_ = flat.size() < kGridCorners ? 1 : std::clamp(int(std::sqrt(count)), 1, 1024);
    first_.assign(std::size_t(side_) * std::size_t(side_), kNone);
    next_.assign(flat.size(), kNone);
    for (std::uint32_t i = 0; i < flat.size(); ++i) {
      if (!bent_[i]) continue;
      std::uint32_t& head = first_[cellOf(flat[i])];
      next_[i] = std::exchange(head, i);
    }
  }

  bool isBent(std::uint32_t corner) const { return bent_[corner]; }
  void straighten(std::uint32_t corner) { bent_[corner] = false; }

  /// Whether one lies in the triangle, its border included, but not at its corners. `work` grows by
  /// what is looked at.
  bool anyIn(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::size_t& work) {
    const Vec2d &pa = flat_[a], &pb = flat_[b], &pc = flat_[c];
    const double lowest = std::min({pa.y(), pb.y(), pc.y()});
    const double highest = std::max({pa.y(), pb.y(), pc.y()});
    for (int y = cell(lowest, 1), last = cell(highest, 1); y <= last; ++y) {
      const auto [x0, x1] = cellsInRow(y, {pa, pb, pc});
      for (int x = x0; x <= x1; ++x) {
        ++work;
        std::uint32_t* link = &first_[std::size_t(y) * std::size_t(side_) + std::size_t(x)];
        while (*link != kNone) {
          const std::uint32_t i = *link;
          ++work;
          if (!bent_[i]) {
            *link = next_[i];  // gone for good
            continue;
          }
          link = &next_[i];
          const Vec2d& p = flat_[i];
          if (p == pa || p == pb || p == pc) continue;
          if (inside(p, pa, pb, pc)) return true;
        }
      }
    }
    return false;
  }

 private:
  static constexpr std::uint32_t kNone = 0xffffffffu;

  int cell(double place, int axis) const {
    const double extent = upper_[axis] - lower_[axis];
    const double share = extent > 0.0 ? (place - lower_[axis]) / extent : 0.0;
    return std::clamp(int(share * side_), 0, side_ - 1);
  }
  std::size_t cellOf(const Vec2d& p) const {
    return std::size_t(cell(p.y(), 1)) * std::size_t(side_) + std::size_t(cell(p.x(), 0));
  }
  /// The first and the last cell of a row that a triangle touches, and one more on either side: a
  /// sliver across the whole polygon touches few cells of each.
  std::pair<int, int> cellsInRow(int row, const std::array<Vec2d, 3>& triangle) const {
    const double height = (upper_.y() - lower_.y()) / side_;
    const double bottom = lower_.y() + height * (row - 0.5), top = bottom + 2.0 * height;
    double left = upper_.x(), right = lower_.x();
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec2d &p = triangle[i], &q = triangle[(i + 1) % 3];
      const double rise = q.y() - p.y();
      for (const double y : {p.y(), q.y(), bottom, top}) {
        if (y < std::max(bottom, std::min(p.y(), q.y())) ||
            y > std::min(top, std::max(p.y(), q.y()))) {
          continue;
        }
        const double x = rise != 0.0 ? p.x() + (q.x() - p.x()) * ((y - p.y()) / rise) : p.x();
        left = std::min({left, x, rise != 0.0 ? x : q.x()});
        right = std::max({right, x, rise != 0.0 ? x : q.x()});
      }
    }
    return {std::max(cell(left, 0) - 1, 0), std::min(cell(right, 0) + 1, side_ - 1)};
  }

  const std::vector<Vec2d>& flat_;
  std::vector<bool> bent_;
  Vec2d lower_, upper_;
  int side_ = 1;
  std::vector<std::uint32_t> first_, next_;
};

/// Cuts ears off until three corners are left.
class EarCutter {
 public:
  EarCutter(const std::vector<Vec2d>& flat, std::vector<scene::Triangle>& triangles)
      : flat_(flat),
        triangles_(triangles),
        count_(std::uint32_t(flat.size())),
        before_(count_),
        after_(count_),
        bent_(flat, bentOnes()) {
    for (std::uint32_t i = 0; i < count_; ++i) {
      before_[i] = (i + count_ - 1) % count_;
      after_[i] = (i + 1) % count_;
    }
  }

  bool cut() {
    bool clean = true;
    const std::size_t most = mostWork(count_);
    std::uint32_t at = 0;  // one that is left
    lookAgain(at);
    for (std::uint32_t left = count_; left > 3; --left) {
      std::optional<std::uint32_t> ear = nextEar(most);
      if (!ear && work_ < most) {  // what touches itself may have been overlooked
        lookAgain(at);
        ear = nextEar(most);
      }
      // What has no ear crosses itself, or is a line: any cut is as good.
      if (!ear) clean = clean && turnAt(at) == 0.0;
      const std::uint32_t b = ear.value_or(at);
      at = after_[b];
      remove(b);
    }
    triangles_.push_back({before_[at], at, after_[at]});
    return clean && turnAt(at) >= 0.0;
  }

 private:
  std::vector<bool> bentOnes() const {
    std::vector<bool> bent(flat_.size());
    for (std::size_t i = 0, n = flat_.size(); i < n; ++i) {
      bent[i] = !(turn(flat_[(i + n - 1) % n], flat_[i], flat_[(i + 1) % n]) > 0.0);
    }
    return bent;
  }
  double turnAt(std::uint32_t b) const {
    return turn(flat_[before_[b]], flat_[b], flat_[after_[b]]);
  }
  /// All that are left, from `first` on, are candidates.
  void lookAgain(std::uint32_t first) {
    std::uint32_t i = first;
    do {
      candidates_.push_back(i);
      i = after_[i];
    } while (i != first);
  }
  /// A corner that is no ear becomes one only when a neighbour is cut off.
  std::optional<std::uint32_t> nextEar(std::size_t most) {
    while (!candidates_.empty() && work_ < most) {
      const std::uint32_t b = candidates_.front();
      candidates_.pop_front();
      ++work_;
      const bool gone = after_[before_[b]] != b || before_[b] == after_[b];
      if (!gone && !bent_.isBent(b) && !bent_.anyIn(before_[b], b, after_[b], work_)) return b;
    }
    return {};
  }
  void remove(std::uint32_t b) {
    const std::uint32_t a = before_[b], c = after_[b];
    triangles_.push_back({a, b, c});
    after_[a] = c;
    before_[c] = a;
    bent_.straighten(b);
    for (const std::uint32_t neighbour : {a, c}) {
      if (bent_.isBent(neighbour) && turnAt(neighbour) > 0.0) bent_.straighten(neighbour);
      candidates_.push_back(neighbour);
    }
  }

  const std::vector<Vec2d>& flat_;
  std::vector<scene::Triangle>& triangles_;
  std::uint32_t count_ = 0;
  std::size_t work_ = 0;
  std::vector<std::uint32_t> before_, after_;
  std::deque<std::uint32_t> candidates_;
  BentCorners bent_;
};

}  // namespace

bool cutPolygon(std::span<const Vec3d> corners, std::vector<scene::Triangle>& triangles) {
  const auto count = std::uint32_t(corners.size());
  if (count <= 3) {
    if (count == 3) triangles.push_back({0, 1, 2});
    return true;
  }
  if (count == 4 && isConvexQuad(corners)) {  // nearly all
    triangles.push_back({3, 0, 1});
    triangles.push_back({1, 2, 3});
    return true;
  }
  const std::vector<Vec2d> flat = flatten(corners);
  if (flat.empty()) {  // without area, or not finite: what comes of it is kept out later
    for (std::uint32_t i = 2; i < count; ++i) triangles.push_back({0, i - 1, i});
    return true;
  }
  return EarCutter(flat, triangles).cut();
}

void noteCrossing(std::size_t count, Diagnosis& diagnosis) {
  if (count == 0) return;
  diagnosis.lose(Severity::Warning, "polygons-crossing", count,
                 "polygons cross themselves: their triangles may cover what they should not; "
                 "triangulate on export");
}

}  // namespace lambent::scene_io
