#include "lambent/texel_layout/beyond_borders.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include <Eigen/Geometry>

#include "lambent/scene/texel_map.h"

namespace lambent::texel_layout {

namespace {

using atlas::kNoTriangle;
using atlas::WeldedSurface;

/// Shading normals this close belong to one smooth surface (cosine).
constexpr float kSmooth = 0.995f;
constexpr float kSameColor = 1.0f / 256.0f;
/// Bilinear look-ups on a border reach texels whose centres are nearer than this, each way.
constexpr double kReach = 1.0;
/// How far before a crease the last place lies, in texels: on it rays could slip through.
constexpr double kBefore = 0.05;
constexpr int kMostSteps = 64;

double cross(const Vec2d& a, const Vec2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// A triangle and a place in it by the weights of its corners.
struct Place {
  std::uint32_t triangle;
  Vec3d weights;
};

/// The border that lies nearest to a texel.
struct Nearest {
  double squared = std::numeric_limits<double>::infinity();
  std::uint32_t triangle = kNoTriangle;
  int edge = 0;
};

struct SharedEdge {
  std::uint32_t triangle;
  int edge;
  std::uint32_t across;
};
/// Whether the vertices that both sides have at either end of an edge are the same in some respect.
template <class Same>
bool agreeAcross(const scene::Mesh& mesh, const WeldedSurface& surface, const SharedEdge& shared,
                 const Same& same) {
  const auto& other = surface.triangles[shared.across];
  for (const std::size_t end : {std::size_t(shared.edge), (std::size_t(shared.edge) + 1) % 3}) {
    const std::uint32_t welded = surface.triangles[shared.triangle][end];
    const std::size_t k = other[0] == welded ? 0 : other[1] == welded ? 1 : 2;
    if (!same(mesh.triangles[shared.triangle][end], mesh.triangles[shared.across][k])) return false;
  }
  return true;
}

class Beyond {
 public:
  Beyond(const scene::Scene& scene, std::uint32_t mesh, const WeldedSurface& surface, int size)
      : scene_(scene),
        number_(mesh),
        mesh_(scene.meshes[mesh]),
        surface_(surface),
        size_(size),
        nearest_(std::size_t(size) * size) {}

  std::vector<transport::TexelBeyond> find() {
    const scene::TexelMap map = scene::texelMap(mesh_, size_, size_);
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t)
      for (int k = 0; k < 3; ++k)
        if (surface_.hasArea(t) && isBorder(t, k)) reach(map, t, k);
    std::vector<transport::TexelBeyond> all;
    for (std::uint32_t texel = 0; texel < nearest_.size(); ++texel) {
      const Nearest& near = nearest_[texel];
      if (near.triangle == kNoTriangle) continue;
      const Place place = beyond(near, centreOf(texel));
      all.push_back({texel, scene::surfaceAt(scene_, number_, place.triangle,
                                             static_cast<float>(place.weights.y()),
                                             static_cast<float>(place.weights.z()))});
    }
    return all;
  }

 private:
  Vec2d centreOf(std::uint32_t texel) const {
    const auto width = static_cast<std::uint32_t>(size_);
    return Vec2d(texel % width + 0.5, texel / width + 0.5);
  }
  std::uint32_t corner(std::uint32_t t, int k) const {
    return mesh_.triangles[t][std::size_t(k) % 3];
  }
  /// In texels.
  Vec2d uvOf(std::uint32_t t, int k) const {
    return scene::texelUvsOf(mesh_)[corner(t, k)].cast<double>() * size_;
  }
  Vec3d positionOf(std::uint32_t t, int k) const {
    return mesh_.positions[corner(t, k)].cast<double>();
  }
  std::uint32_t weldedOf(std::uint32_t t, int k) const {
    return surface_.triangles[t][std::size_t(k) % 3];
  }
  std::uint32_t across(std::uint32_t t, int k) const {
    const std::uint32_t n = surface_.neighbours[t][std::size_t(k)];
    return n != kNoTriangle && surface_.hasArea(n) ? n : kNoTriangle;
  }

  bool isBorder(std::uint32_t t, int k) const {
    const std::uint32_t n = across(t, k);
    const std::vector<Vec2>& uvs = scene::texelUvsOf(mesh_);
    return n == kNoTriangle ||
           !agreeAcross(mesh_, surface_, {t, k, n},
                        [&](std::uint32_t a, std::uint32_t b) { return uvs[a] == uvs[b]; });
  }

  void reach(const scene::TexelMap& map, std::uint32_t t, int k) {
    const Vec2d a = uvOf(t, k), b = uvOf(t, k + 1);
    const auto first = [&](int axis) {
      return std::max(0, static_cast<int>(std::ceil(std::min(a[axis], b[axis]) - kReach - 0.5)));
    };
    const auto last = [&](int axis) {
      return std::min(size_ - 1,
                      static_cast<int>(std::floor(std::max(a[axis], b[axis]) + kReach - 0.5)));
    };
    for (int y = first(1); y <= last(1); ++y)
      for (int x = first(0); x <= last(0); ++x) {
        const auto texel = static_cast<std::uint32_t>(y * size_ + x);
        if (map.covered(texel)) continue;
        const Vec2d away = centreOf(texel) - nearestOn(a, b, centreOf(texel));
        if (away.cwiseAbs().maxCoeff() > kReach) continue;
        if (away.squaredNorm() < nearest_[texel].squared)
          nearest_[texel] = {away.squaredNorm(), t, k};
      }
  }

  static Vec2d nearestOn(const Vec2d& a, const Vec2d& b, const Vec2d& p) {
    const Vec2d along = b - a;
    const double square = along.squaredNorm();
    return a + (square > 0.0 ? std::clamp((p - a).dot(along) / square, 0.0, 1.0) : 0.0) * along;
  }

  /// Weights of the corners for a place in the square, which may lie outside; nothing for a
  /// triangle without area there.
  std::optional<Vec3d> weightsAt(std::uint32_t t, const Vec2d& p) const {
    const Vec2d a = uvOf(t, 0), e = uvOf(t, 1) - a, f = uvOf(t, 2) - a;
    const double area = cross(e, f);
    if (!(std::abs(area) > 1e-12)) return std::nullopt;
    const double u = cross(p - a, f) / area, v = cross(e, p - a) / area;
    return Vec3d(1.0 - u - v, u, v);
  }
  Vec3d pointAt(std::uint32_t t, const Vec3d& w) const {
    return w.x() * positionOf(t, 0) + w.y() * positionOf(t, 1) + w.z() * positionOf(t, 2);
  }
  static Place within(std::uint32_t t, const Vec3d& w) {
    const Vec3d inside = w.cwiseMax(0.0);
    return {t, inside / inside.sum()};
  }

  Place beyond(const Nearest& near, const Vec2d& texel) const {
    const auto [squared, t, k] = near;
    const Vec2d a = uvOf(t, k), b = uvOf(t, k + 1), at = nearestOn(a, b, texel);
    const std::optional<Vec3d> edge = weightsAt(t, at), outside = weightsAt(t, texel);
    if (!edge || !outside) return {t, Vec3d::Constant(1.0 / 3.0)};
    const std::uint32_t n = across(t, k);
    if (n != kNoTriangle)
      return walk(t, k, pointAt(t, *edge), pointAt(t, *outside) - pointAt(t, *edge));
    const Vec2d along = (b - a).normalized();
    Vec2d inward(-along.y(), along.x());
    if (cross(b - a, uvOf(t, k + 2) - a) < 0.0) inward = -inward;
    return within(t, weightsAt(t, at + kBefore * inward).value_or(*edge));
  }

  /// The unit vector in the plane of t, at right angles to edge k, that points into t.
  Vec3d inwardOf(std::uint32_t t, int k) const {
    const Vec3d along = (positionOf(t, k + 1) - positionOf(t, k)).normalized();
    const Vec3d to = positionOf(t, k + 2) - positionOf(t, k);
    return (to - to.dot(along) * along).normalized();
  }

  /// Leaves t across edge k at `from` by `way`, a vector in the plane of t, and goes straight on
  /// over the surface.
  Place walk(std::uint32_t t, int k, Vec3d from, Vec3d way) const {
    Place here{t, weightsOf(t, from)};
    for (int step = 0; step < kMostSteps; ++step) {
      const std::uint32_t n = across(t, k);
      if (n == kNoTriangle) break;
      const std::uint32_t a = weldedOf(t, k), b = weldedOf(t, k + 1);
      const int entered = edgeBetween(n, a, b);
      const Vec3d along = (positionOf(t, k + 1) - positionOf(t, k)).normalized();
      const double sideways = way.dot(along), onwards = -way.dot(inwardOf(t, k));
      way = sideways * along + onwards * inwardOf(n, entered);
      t = n;
      // Weights are linear along the way: the first that reaches zero is where it leaves.
      const Vec3d start = weightsOf(t, from), change = weightsOf(t, from + way) - start;
      double share = 1.0;
      int leaves = -1;
      for (int edge = 0; edge < 3; ++edge) {
        if (edge == entered) continue;
        const int opposite = (edge + 2) % 3;
        const double before = std::max(0.0, start[opposite]);
        if (before + change[opposite] < 0.0 && before / -change[opposite] < share)
          share = before / -change[opposite], leaves = edge;
      }
      here = within(t, start + share * change);
      if (leaves < 0) break;
      from += share * way, way *= 1.0 - share, k = leaves;
    }
    return within(here.triangle, here.weights);
  }
  int edgeBetween(std::uint32_t t, std::uint32_t a, std::uint32_t b) const {
    for (int k = 0; k < 3; ++k)
      if (weldedOf(t, k) != a && weldedOf(t, k) != b) return (k + 1) % 3;
    return 0;
  }
  Vec3d weightsOf(std::uint32_t t, const Vec3d& p) const {
    const Vec3d a = positionOf(t, 0), e = positionOf(t, 1) - a, f = positionOf(t, 2) - a;
    const Vec3d whole = e.cross(f);
    const double square = whole.squaredNorm();
    const double u = (p - a).cross(f).dot(whole) / square, v = e.cross(p - a).dot(whole) / square;
    return Vec3d(1.0 - u - v, u, v);
  }

  const scene::Scene& scene_;
  std::uint32_t number_;
  const scene::Mesh& mesh_;
  const WeldedSurface& surface_;
  int size_;
  std::vector<Nearest> nearest_;
};

}  // namespace

WeldedSurface smoothSurface(const scene::Mesh& mesh) {
  WeldedSurface surface = atlas::weldedSurface(mesh);
  const auto goesOn = [&](std::uint32_t a, std::uint32_t b) {
    return mesh.normals[a].dot(mesh.normals[b]) > kSmooth &&
           (mesh.colors.empty() || (mesh.colors[a] - mesh.colors[b]).abs().maxCoeff() < kSameColor);
  };
  const auto before = surface.neighbours;
  for (std::uint32_t t = 0; t < before.size(); ++t)
    for (int k = 0; k < 3; ++k)
      if (const std::uint32_t n = before[t][std::size_t(k)];
          n != kNoTriangle && !agreeAcross(mesh, surface, {t, k, n}, goesOn))
        surface.neighbours[t][std::size_t(k)] = kNoTriangle;
  return surface;
}

std::vector<transport::TexelBeyond> beyondBorders(const scene::Scene& scene, std::uint32_t mesh,
                                                  const WeldedSurface& surface, int size) {
  return Beyond(scene, mesh, surface, size).find();
}

}  // namespace lambent::texel_layout
