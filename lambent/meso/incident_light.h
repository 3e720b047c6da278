// Private to this room: the harmonics of the light that reaches a point of a patch straight from
// outside, by a lattice of directions or by the directional lights of eq. (5).
#pragma once

#include <span>
#include <vector>

#include "lambent/meso/light_grid.h"
#include "lambent/meso/periodic_scene.h"
#include "lambent/sh/zonal.h"
#include "lambent/transport/direction_tables.h"

namespace lambent::meso {

/// An even lattice of directions with the harmonics at each.
struct Lattice {
  trace::DirectionSet directions;
  transport::DirectionTable table;

  Lattice(int count, std::uint64_t seed, int bands);
};

/// The lights of eq. (5) as rows y_i(l_k) da(l_k), in the sequence in which they are cast.
struct LightRows {
  trace::DirectionSet directions;
  std::size_t stride = 0;
  std::vector<float> values;

  LightRows(int polar, int azimuth, int bands);
  transport::Rows rows() const { return {values.data(), stride}; }
};

/// E_i = ∫ y_i(s) V(s) (n·s) ds: the irradiance that the i-th harmonic as a light gives.
class Irradiance {
 public:
  explicit Irradiance(int bands);
  /// From what a lattice's cast left. The sum is taken over what is seen or over what is blocked,
  /// whichever is less; the rest of the cosine lobe is known in closed form. That is right for
  /// tilted normals too: whatever lies below the horizon is blocked.
  /// `out` has the table's stride; overwritten.
  void fromLattice(const Lattice& lattice, const Vec3& normal, const PeriodicCast& cast,
                   double* out);
  /// From the lights that a cast of LightRows found visible.
  void fromLights(const LightRows& lights, const Vec3& normal, const PeriodicCast& cast,
                  double* out);

 private:
  sh::ZonalMoments cosine_;
  std::vector<float> weights_;
  std::vector<double> lobe_;
};

}  // namespace lambent::meso
