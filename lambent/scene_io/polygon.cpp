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
#include <cmath>
#include <utility>

#include <Eigen/Geometry>

namespace lambent::scene_io {
namespace {

using Vec2d = Eigen::Vector2d;

/// Corners from which a grid is worth making.
constexpr std::size_t kGridCorners = 48;
/// Corners that are looked at for each corner of the polygon, before the work is broken off: many
/// times what outlines of towns, combs and spirals need.
constexpr std::size_t kMostWork = 4096;

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
    const Vec2d lower = pa.cwiseMin(pb).cwiseMin(pc), upper = pa.cwiseMax(pb).cwiseMax(pc);
    const auto [x0, y0] = cell(lower);
    const auto [x1, y1] = cell(upper);
    for (int y = y0; y <= y1; ++y) {
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

  std::pair<int, int> cell(const Vec2d& p) const {
    const auto along = [&](int axis) {
      const double extent = upper_[axis] - lower_[axis];
      const double place = extent > 0.0 ? (p[axis] - lower_[axis]) / extent : 0.0;
      return std::clamp(int(place * side_), 0, side_ - 1);
    };
    return {along(0), along(1)};
  }
  std::size_t cellOf(const Vec2d& p) const {
    const auto [x, y] = cell(p);
    return std::size_t(y) * std::size_t(side_) + std::size_t(x);
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
    std::size_t work = 0;
    const std::size_t mostWork = kMostWork * count_;
    std::uint32_t at = 0, since = 0;  // candidates since the last ear
    for (std::uint32_t left = count_; left > 3;) {
      const bool entangled = since > left || work > mostWork;
      if (!entangled && !isEar(at, work)) {
        at = after_[at];
        ++since;
        continue;
      }
      // What has no ear crosses itself, or is a line: any cut is as good.
      if (entangled) clean = clean && turnAt(at) == 0.0;
      remove(at);
      at = after_[after_[at]];  // not always the same corner: slivers
      since = 0;
      --left;
      last_ = before_[at];
    }
    triangles_.push_back({before_[last_], last_, after_[last_]});
    return clean;
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
  bool isEar(std::uint32_t b, std::size_t& work) {
    ++work;
    return !bent_.isBent(b) && !bent_.anyIn(before_[b], b, after_[b], work);
  }
  void remove(std::uint32_t b) {
    const std::uint32_t a = before_[b], c = after_[b];
    triangles_.push_back({a, b, c});
    after_[a] = c;
    before_[c] = a;
    bent_.straighten(b);
    for (const std::uint32_t neighbour : {a, c}) {
      if (bent_.isBent(neighbour) && turnAt(neighbour) > 0.0) bent_.straighten(neighbour);
    }
  }

  const std::vector<Vec2d>& flat_;
  std::vector<scene::Triangle>& triangles_;
  std::uint32_t count_ = 0, last_ = 0;
  std::vector<std::uint32_t> before_, after_;
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
