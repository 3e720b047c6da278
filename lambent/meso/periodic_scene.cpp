#include "lambent/meso/periodic_scene.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>
#include <unordered_map>

#include "lambent/math/random.h"

namespace lambent::meso {

namespace {

constexpr int kMostAcross = 15;
constexpr std::size_t kMostTileTriangles = 4'000'000;

scene::Mesh backingPlane(const Patch& patch, float height, int material) {
  scene::Mesh mesh;
  mesh.name = "backing";
  mesh.material = material;
  const float x = patch.size.x(), y = patch.size.y();
  mesh.positions = {{0, 0, height}, {x, 0, height}, {x, y, height}, {0, y, height}};
  mesh.normals.assign(4, Vec3::UnitZ());
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

/// Points whose places are the same up to whole periods, made equal to the last bit: else rays slip
/// through where two copies of the tile meet. Places are in periods (z in periods along x).
class PeriodicWeld {
 public:
  /// `place`, moved by less than kTolerance.
  Vec3d operator()(const Vec3d& place) {
    const Vec3d whole(std::floor(place.x()), std::floor(place.y()), 0.0);
    const Vec3d inside = place - whole;
    // The cells that the tolerance reaches into: one, but for points near a cell's side.
    std::array<std::array<std::int64_t, 2>, 3> reach;
    for (int a = 0; a < 3; ++a)
      reach[a] = {static_cast<std::int64_t>(std::floor((inside[a] - kTolerance) * kCells)),
                  static_cast<std::int64_t>(std::floor((inside[a] + kTolerance) * kCells))};
    for (std::int64_t i = reach[0][0]; i <= reach[0][1]; ++i)
      for (std::int64_t j = reach[1][0]; j <= reach[1][1]; ++j)
        for (std::int64_t k = reach[2][0]; k <= reach[2][1]; ++k) {
          const auto [begin, end] = known_.equal_range(keyOf(i, j, k));
          for (auto it = begin; it != end; ++it) {
            const Vec3d apart = inside - it->second;
            const Vec3d periods(std::round(apart.x()), std::round(apart.y()), 0.0);
            if ((apart - periods).cwiseAbs().maxCoeff() <= kTolerance)
              return it->second + periods + whole;
          }
        }
    // On a grid of 2⁻⁴⁰, adding whole periods is exact.
    const Vec3d rounded = (inside.array() * 0x1p40).round() * 0x1p-40;
    const auto cell = [](double x) { return static_cast<std::int64_t>(std::floor(x * kCells)); };
    known_.emplace(keyOf(cell(rounded.x()), cell(rounded.y()), cell(rounded.z())), rounded);
    return rounded + whole;
  }

 private:
  static constexpr std::int64_t kCells = 1 << 15;  ///< in a period
  static constexpr double kTolerance = 1e-6;

  static std::uint64_t keyOf(std::int64_t i, std::int64_t j, std::int64_t k) {
    const auto x = static_cast<std::uint64_t>((i + kCells) % kCells);
    const auto y = static_cast<std::uint64_t>((j + kCells) % kCells);
    return math::hashCombine(x * kCells + y, static_cast<std::uint64_t>(k));
  }
  std::unordered_multimap<std::uint64_t, Vec3d> known_;
};

/// The tile's triangles in one mesh, in periods, each moved by whole periods so that its centre
/// lies in the period: the tile then reaches over the period by less than a triangle.
struct Canonical {
  std::vector<Vec3d> places;
  std::vector<scene::Triangle> triangles;
  Vec3d lower = Vec3d::Constant(std::numeric_limits<double>::infinity());
  Vec3d upper = -lower;
};

Canonical canonicalTile(const scene::Scene& tile, const Vec2& size) {
  Canonical canonical;
  PeriodicWeld weld;
  const Vec3d period(size.x(), size.y(), size.x());
  for (const scene::Mesh& mesh : tile.meshes) {
    std::vector<Vec3d> places;
    places.reserve(mesh.positions.size());
    for (const Vec3& p : mesh.positions)
      places.push_back(weld(p.cast<double>().cwiseQuotient(period)));
    std::map<std::tuple<std::uint32_t, int, int>, std::uint32_t> moved;
    for (const scene::Triangle& t : mesh.triangles) {
      const Vec3d centre = (places[t[0]] + places[t[1]] + places[t[2]]) / 3.0;
      const int x = static_cast<int>(std::floor(centre.x()));
      const int y = static_cast<int>(std::floor(centre.y()));
      scene::Triangle out;
      for (int k = 0; k < 3; ++k) {
        const auto [at, isNew] =
            moved.emplace(std::tuple(t[k], x, y), std::uint32_t(canonical.places.size()));
        out[k] = at->second;
        if (!isNew) continue;
        const Vec3d p = places[t[k]] - Vec3d(x, y, 0.0);
        canonical.places.push_back(p);
        canonical.lower = canonical.lower.cwiseMin(p);
        canonical.upper = canonical.upper.cwiseMax(p);
      }
      canonical.triangles.push_back(out);
    }
  }
  return canonical;
}

/// Tile after tile, so that a triangle's number in the tile is its number modulo their count.
scene::Mesh blockOf(const Canonical& tile, const Vec2& size, int across) {
  scene::Mesh block;
  block.positions.reserve(tile.places.size() * across * across);
  block.triangles.reserve(tile.triangles.size() * across * across);
  const Vec3d period(size.x(), size.y(), size.x());
  for (int j = 0; j < across; ++j)
    for (int i = 0; i < across; ++i) {
      const Vec3d shift(i - across / 2, j - across / 2, 0.0);
      const auto first = static_cast<std::uint32_t>(block.positions.size());
      for (const Vec3d& p : tile.places)
        block.positions.push_back((p + shift).cwiseProduct(period).cast<float>());
      for (const scene::Triangle& t : tile.triangles)
        block.triangles.push_back({first + t[0], first + t[1], first + t[2]});
    }
  return block;
}

}  // namespace

Result<PeriodicScene> PeriodicScene::build(const Patch& patch, std::size_t blockTriangles) {
  scene::Scene tile = patch.scene;
  tile.cameras.clear();
  Extent extent = extentOf(patch);
  const float diagonal = Vec3(patch.size.x(), patch.size.y(), extent.depth()).norm();
  if (patch.backing) {
    // Just under the lowest point, so that a floor which is there already wins.
    extent.lowest -= 1e-4f * diagonal;
    scene::Material material;
    material.name = "backing";
    material.diffuse = *patch.backing;
    tile.meshes.push_back(
        backingPlane(patch, extent.lowest, static_cast<int>(tile.materials.size())));
    tile.materials.push_back(material);
  }
  std::vector<std::uint32_t> offsets = {0};
  std::size_t count = 0;
  for (const scene::Mesh& mesh : tile.meshes) {
    count += mesh.triangles.size();
    offsets.push_back(static_cast<std::uint32_t>(count));
  }
  if (count > kMostTileTriangles)
    return report::badInput(patch.name + " has " + std::to_string(count) +
                            " triangles; the most that a patch can have are " +
                            std::to_string(kMostTileTriangles) + ": simplify it");
  const Canonical canonical = canonicalTile(tile, patch.size);
  int across = 3;
  while (across + 2 <= kMostAcross &&
         static_cast<std::size_t>((across + 2) * (across + 2)) * count <= blockTriangles)
    across += 2;

  scene::Scene block;
  block.materials.emplace_back();
  block.meshes.push_back(blockOf(canonical, patch.size, across));
  // Rays that run exactly along an edge are common here: samples and heights lie on like grids.
  Result<trace::RayScene> rays = trace::RayScene::build(block, trace::Edges::Watertight);
  if (!rays) return rays.error();
  PeriodicScene out(std::move(*rays));
  out.tile_ = std::move(tile);
  out.offsets_ = std::move(offsets);
  out.size_ = patch.size;
  out.extent_ = extent;
  out.across_ = across;
  // Of the order of 100 units in the last place of the block's coordinates.
  out.offset_ = 2e-5f * diagonal;
  for (int a = 0; a < 2; ++a) {
    const double size = patch.size[a];
    const double low = -(across / 2) + std::max(0.0, canonical.upper[a] - 1.0);
    const double high = (across - across / 2) - std::max(0.0, -canonical.lower[a]);
    if (low > -0.25 || high < 1.25)
      return report::badInput(patch.name + ": a triangle is larger than the patch's period of " +
                              std::to_string(size) + " m; is the size right?");
    out.lower_[a] = static_cast<float>(low * size);
    out.upper_[a] = static_cast<float>(high * size);
  }
  return out;
}

std::uint32_t PeriodicScene::meshOf(std::uint32_t triangle) const {
  const auto after = std::upper_bound(offsets_.begin(), offsets_.end(), triangle);
  return static_cast<std::uint32_t>(after - offsets_.begin() - 1);
}

scene::SurfacePoint PeriodicScene::surfaceAt(const PeriodicHit& hit) const {
  const std::uint32_t mesh = meshOf(hit.triangle);
  return scene::surfaceAt(tile_, mesh, hit.triangle - offsets_[mesh], hit.u, hit.v);
}

Vec3 PeriodicScene::wrapped(const Vec3& point) const {
  Vec3 out = point;
  for (int a = 0; a < 2; ++a)
    if (out[a] < 0.0f || out[a] >= size_[a]) out[a] -= std::floor(out[a] / size_[a]) * size_[a];
  return out;
}

float PeriodicScene::leaves(const Vec3& origin, const Vec3& direction) const {
  float t = std::numeric_limits<float>::infinity();
  for (int a = 0; a < 2; ++a) {
    if (direction[a] > 0.0f) t = std::min(t, (upper_[a] - origin[a]) / direction[a]);
    if (direction[a] < 0.0f) t = std::min(t, (lower_[a] - origin[a]) / direction[a]);
  }
  return t;
}

RayEnd PeriodicScene::trace(const Vec3& start, const Vec3& direction, PeriodicHit& out) const {
  Vec3 origin = wrapped(start);
  float travelled = 0.0f;
  for (int block = 0; block < kMostBlocks; ++block) {
    const float end = leaves(origin, direction);
    if (const std::optional<trace::Hit> hit = rays_.closest(origin, direction, 0.0f, end)) {
      out = {hit->triangle % triangleCount(), hit->u, hit->v, travelled + hit->distance,
             hit->backFace};
      return hit->backFace ? RayEnd::Blocked : RayEnd::Lit;
    }
    const float height = direction.z() == 0.0f ? origin.z() : origin.z() + end * direction.z();
    if (direction.z() > 0.0f && height >= extent_.highest) return RayEnd::Escaped;
    if (direction.z() < 0.0f && height <= extent_.lowest) return RayEnd::Blocked;
    travelled += end;
    origin = wrapped(origin + end * direction);
  }
  return direction.z() > 0.0f ? RayEnd::Escaped : RayEnd::Blocked;
}

void PeriodicScene::castClosest(const trace::DirectionSet& directions, const Vec3& start,
                                const Vec3& normal, PeriodicCast& cast) const {
  const Vec3 origin = wrapped(start);
  trace::castClosest(rays_, directions, origin, normal, cast.block);
  cast.rays += cast.block.raysCast;
  cast.visible.clear(), cast.blocked.clear(), cast.lit.clear(), cast.hits.clear();
  const std::uint32_t count = triangleCount();
  const auto goOn = [&](std::uint32_t d) {
    PeriodicHit hit;
    switch (trace(origin, directions[d], hit)) {
      case RayEnd::Escaped:
        return cast.visible.push_back(d);
      case RayEnd::Lit:
        cast.lit.push_back(d), cast.hits.push_back(hit);
        [[fallthrough]];
      case RayEnd::Blocked:
        cast.blocked.push_back(d);
    }
  };
  for (const trace::DirectionHit& hit : cast.block.hits) {
    const Vec3& s = directions[hit.direction];
    const float x = origin.x() + hit.distance * s.x(), y = origin.y() + hit.distance * s.y();
    if (x < lower_.x() || x > upper_.x() || y < lower_.y() || y > upper_.y()) {
      goOn(hit.direction);
      continue;
    }
    cast.blocked.push_back(hit.direction);
    if (hit.backFace) continue;
    cast.lit.push_back(hit.direction);
    cast.hits.push_back({hit.globalTriangle % count, hit.u, hit.v, hit.distance, false});
  }
  for (const std::uint32_t d : cast.block.visibleDirections()) {
    const Vec3& s = directions[d];
    const float t = (extent_.highest - origin.z()) / s.z();
    const float x = origin.x() + t * s.x(), y = origin.y() + t * s.y();
    const bool up =
        s.z() > 0.0f && x > lower_.x() && x < upper_.x() && y > lower_.y() && y < upper_.y();
    if (up)
      cast.visible.push_back(d);
    else
      goOn(d);
  }
}

void PeriodicScene::castOcclusion(const trace::DirectionSet& directions, const Vec3& start,
                                  const Vec3& normal, PeriodicCast& cast) const {
  const Vec3 origin = wrapped(start);
  trace::castOcclusion(rays_, directions, origin, normal, cast.block);
  cast.rays += cast.block.raysCast;
  cast.lit.clear(), cast.hits.clear();
  const auto occluded = cast.block.occludedDirections();
  cast.blocked.assign(occluded.begin(), occluded.end());
  cast.visible.clear();
  for (const std::uint32_t d : cast.block.visibleDirections()) {
    const Vec3& s = directions[d];
    const float t = (extent_.highest - origin.z()) / s.z();
    const float x = origin.x() + t * s.x(), y = origin.y() + t * s.y();
    bool up = s.z() > 0.0f && x > lower_.x() && x < upper_.x() && y > lower_.y() && y < upper_.y();
    PeriodicHit ignored;
    if (!up) up = trace(origin, s, ignored) == RayEnd::Escaped;
    (up ? cast.visible : cast.blocked).push_back(d);
  }
}

}  // namespace lambent::meso
