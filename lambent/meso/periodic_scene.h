// Rays in a patch that goes on without end.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "lambent/meso/patch.h"
#include "lambent/report/result.h"
#include "lambent/trace/cast.h"
#include "lambent/trace/direction_set.h"
#include "lambent/trace/ray_scene.h"

namespace lambent::meso {

/// A triangle of the tile that a ray met.
struct PeriodicHit {
  std::uint32_t triangle = 0;  ///< numbered through the tile's meshes
  float u = 0.0f, v = 0.0f;    ///< barycentric coordinates of its second and third vertex
  float distance = 0.0f;
  bool backFace = false;
};

/// What a ray came to. Blocked: it met a back face, or slipped between triangles below the lowest
/// point; it brings no light, and neither does it leave.
enum class RayEnd { Escaped, Lit, Blocked };

/// The answer of a cast, and room to work in. Keep one per thread.
struct PeriodicCast {
  std::vector<std::uint32_t> visible;  ///< indices of directions that left the patch
  std::vector<std::uint32_t> blocked;  ///< indices of all others of the hemisphere
  std::vector<std::uint32_t> lit;      ///< of these, the ones that met a front face …
  std::vector<PeriodicHit> hits;       ///< … and where, one for each of `lit`
  std::uint64_t rays = 0;              ///< cast so far
  trace::CastResult block;             ///< scratch
};

/// The infinite tiling of a patch. Copies of the tile stand side by side in one acceleration
/// structure (a block, as large as a budget of triangles allows), and rays that leave it sideways
/// under the patch's top go on, one by one, from the same place in the middle of the block, for at
/// most kMostBlocks blocks. That cap is the only thing that is not exact: a ray so nearly level
/// that it is still under way then counts as escaped if it rises and as blocked if it does not.
class PeriodicScene {
 public:
  static constexpr int kMostBlocks = 64;

  /// `blockTriangles`: at most so many triangles in the block, but never less than 3×3 tiles.
  /// Asserts what check(patch) tests. BadInput where one triangle reaches over more than a period,
  /// or nine tiles are too many triangles.
  static Result<PeriodicScene> build(const Patch& patch, std::size_t blockTriangles = std::size_t(2)
                                                                                      << 20);

  /// The patch's meshes, and the backing plane, if any, as the last.
  const scene::Scene& tile() const { return tile_; }
  std::uint32_t triangleCount() const { return offsets_.back(); }
  std::uint32_t meshOf(std::uint32_t triangle) const;
  /// A point of the tile, with its material.
  scene::SurfacePoint surfaceAt(const PeriodicHit& hit) const;
  const Extent& extent() const { return extent_; }
  /// How far a ray's origin is lifted off its surface, metres.
  float offset() const { return offset_; }
  int tilesAcross() const { return across_; }

  /// One ray, from any origin, along a unit direction. `hit` is set unless it escaped.
  RayEnd trace(const Vec3& origin, const Vec3& direction, PeriodicHit& hit) const;
  /// All directions with s·normal > 0, and what they met. work::FlushDenormals must be held.
  void castClosest(const trace::DirectionSet& directions, const Vec3& origin, const Vec3& normal,
                   PeriodicCast& cast) const;
  /// The same, without `lit` and `hits`; somewhat faster.
  void castOcclusion(const trace::DirectionSet& directions, const Vec3& origin, const Vec3& normal,
                     PeriodicCast& cast) const;

 private:
  explicit PeriodicScene(trace::RayScene rays) : rays_(std::move(rays)) {}
  Vec3 wrapped(const Vec3& point) const;
  /// The distance at which a ray leaves the box in which the block is complete.
  float leaves(const Vec3& origin, const Vec3& direction) const;

  trace::RayScene rays_;
  scene::Scene tile_;
  std::vector<std::uint32_t> offsets_;  ///< first triangle of each mesh, and their number
  Vec2 size_;
  Extent extent_;
  Vec2 lower_, upper_;  ///< where the block has everything that the tiling has
  float offset_ = 0.0f;
  int across_ = 3;
};

}  // namespace lambent::meso
