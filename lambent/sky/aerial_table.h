// Aerial perspective as a table: what a frame looks up at every pixel.
#pragma once

#include <array>
#include <span>
#include <variant>
#include <vector>

#include "lambent/sky/aerial_perspective.h"

namespace lambent::sky {

/// Nodes of the table. The default's sources as 16-bit floats and its extinction as 32-bit floats are
/// 189 KB.
struct AirTableSize {
  int elevations = 48;  ///< half of them below the horizon, half above; even, ≥ 4
  int azimuths = 13;    ///< from the Sun's, over half a turn; ≥ 2
  int distances = 16;   ///< ≥ 2
  int nodes = 2;        ///< of quadrature between two distances, 1 … 8
};

/// Where a direction and a distance lie in a table, each place in 0 … 1.
///
/// Below the horizon rays end on the ground, above it at the top of the air; the two halves share no
/// node. Elevations, from the horizon, and distances go as a power of their place.
struct AirTableAxes {
  double radius = 0;    ///< of the planet, m
  double height = 0;    ///< of the air above it, m
  double altitude = 0;  ///< of the viewer, m
  double horizon = 0;   ///< its elevation, rad

  static constexpr double kElevationPower = 3, kDistancePower = 2.5;
  /// How far rays are tabulated that meet the ground close by, m: in valleys the air goes on.
  static constexpr double kLeastReach = 2000;

  bool isAbove(double elevation) const { return elevation >= horizon; }
  double placeOfElevation(double elevation) const;  ///< within its half: 0 is the horizon
  double elevationOf(bool above, double place) const;
  /// Distance of a ray below the horizon to the ground, m.
  double toGround(double elevation) const { return toGround(elevation, altitude); }
  /// The same of a ray from another place, `above` the ground, m; beyond that one's own horizon, the
  /// distance of the horizon.
  double toGround(double elevation, double above) const;
  /// Distance to the end of a ray, m.
  double reach(bool above, double elevation) const;
};

/// Aerial perspective for one viewer and one place of the Sun. What is tabulated changes slowly, and
/// is linear between nodes:
///   extinction  log of −ln f / distance: the mean coefficient of extinction
///   sources     L_in / (1 − f) of air and aerosol (each without its phase function, so that the
///               halo of the Sun stays sharp) and of light scattered more than once
/// shaders/aerial_perspective.glsl is the same look-up.
class AirTable {
 public:
  enum Source { Air = 0, Aerosol = 1, Multiple = 2 };

  AirTable(const Scattering& scattering, const Atmosphere& atmosphere, const ViewerInAir& viewer,
           const AirTableSize& size = {});
  AirBetween at(const Vec3d& direction, double distance) const;

  const AirTableSize& size() const { return size_; }
  const AirTableAxes& axes() const { return axes_; }
  const Vec3d& sun() const { return sun_; }
  const media::PhaseFunction& aerosolPhase() const { return aerosolPhase_; }
  /// What every source is a multiple of, W m⁻² sr⁻¹: keeps them in the range of 16-bit floats.
  float scale() const { return scale_; }
  /// [distance][elevation][azimuth][3]: elevations from the horizon down, then from it up; azimuths
  /// from 0 to π.
  std::span<const float> source(Source source) const { return sources_[source]; }
  /// [distance][elevation][3]
  std::span<const float> extinction() const { return extinction_; }

 private:
  void fillRay(const Scattering& scattering, const AirColors& colors, int elevation, int azimuth,
               AirStretches& stretches);

  AirTableSize size_;
  AirTableAxes axes_;
  Vec3d sun_;
  media::PhaseFunction aerosolPhase_;
  float scale_ = 1;
  std::array<std::vector<float>, 3> sources_;
  std::vector<float> extinction_;
};

/// Any of the three forms.
using AerialPerspective = std::variant<ExactAir, AirTable, ConstantAir>;
AirBetween airBetween(const AerialPerspective& air, const Vec3d& direction, double distance);

}  // namespace lambent::sky
