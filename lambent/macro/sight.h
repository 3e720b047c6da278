// Private to this room: what points see of the sky, coarsely, and how far what is interpolated
// between three points is from what a point between them sees. Between vertices light that is
// blocked is compared, and not light that arrives: how normals turn between the corners of a smooth
// surface is no shadow.
//
// Radiance here is that of a white surface, of direct light. As a measure of a difference of two
// transfer vectors serves the radiance that it makes under skies of n bands whose radiance has a
// root mean square of 1, with as much of it in one band as in another: over all such skies the
// mean square is
//   e² = Σ_l 4π / (n (2l + 1)) Σ_m D_lm²,  D the difference of E/π.
// A small thing that hides a solid angle Ω from a point makes e = Ω cos θ / π, as it does under an
// even sky of radiance 1.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "lambent/trace/cast.h"
#include "lambent/trace/ray_scene.h"
#include "lambent/transport/direction_tables.h"

namespace lambent::macro {

/// What a point sees.
struct Sight {
  static constexpr int kDirections = 256;  ///< of each of two sets, over the whole sphere
  std::array<std::uint64_t, 2 * kDirections / 64> open{};  ///< bit by bit: above, and meets nothing
  Vec3 normal = Vec3::UnitY();
  bool buried = false;  ///< most of what lies above is the back of surfaces
};

/// The places between which a place is interpolated: up to four, with weights that sum to 1.
struct Corners {
  std::array<const Sight*, 4> seen{};
  std::array<float, 4> weights{};
  std::size_t count = 0;

  static Corners ofTriangle(const std::array<const Sight*, 3>& seen, const Vec3& weights) {
    return {{seen[0], seen[1], seen[2]}, {weights[0], weights[1], weights[2]}, 3};
  }
};

/// Without those that are buried, the others' weights scaled to the same sum: what they would have
/// is for nobody to see. As they are where all are buried.
Corners exposed(const Corners& corners);

/// What is compared: light that is blocked, which tells of shadows alone, or light that arrives,
/// which also tells how normals turn.
enum class Compared { Blocked, Arriving };

/// Where rays start and which way is up.
struct Spot {
  Vec3 origin, normal;
};

class SightTest {
 public:
  /// `rays` must outlive it. bands of the light, 1 … 10.
  SightTest(const trace::RayScene& rays, int bands, std::uint64_t seed);

  struct Scratch {
    trace::CastResult cast;
    std::vector<std::uint32_t> ids;
    std::vector<float> weights;
    std::vector<double> sums[2];
  };
  Sight at(const Spot& spot, Scratch& scratch) const;

  /// An estimate of e² (above) between what is hidden from `here` (or not hidden) and what is
  /// interpolated of its corners, over directions above the plane of its triangle: those below meet
  /// the triangle itself. Without bias, were it below 0: it is a product of what two independent
  /// sets of directions say, which have the difference in common and not the noise. Where all see
  /// the same it is exactly 0.
  double squaredError(const Sight& here, const Corners& corners, const Vec3& planeNormal,
                      Scratch& scratch, Compared compared = Compared::Blocked) const;

 private:
  const trace::RayScene& rays_;
  int bands_;
  std::array<trace::DirectionSet, 2> sets_;
  std::array<transport::DirectionTable, 2> tables_;
};

}  // namespace lambent::macro
