// Light in an atmosphere, all orders of scattering: solved once for every place of the Sun, then
// looked up along any ray.
//
// What is solved for is the light that arrives at a place, already weighed by the phase functions:
// how much of it goes on into each direction. It changes smoothly with altitude and with the Sun's
// zenith angle there, while density, shadow and extinction, which do not, are left to the rays.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "lambent/report/progress.h"
#include "lambent/report/result.h"
#include "lambent/sky/air_path.h"
#include "lambent/sky/atmosphere.h"
#include "lambent/sky/march.h"
#include "lambent/sky/medium.h"
#include "lambent/sky/sun_lengths.h"

namespace lambent::sky {

/// How finely light is resolved. Refined, it converges to the light of the medium.
struct Resolution {
  double sunDensity = 1.2;        ///< of the Sun's zenith angles: 1 is 5° by day, 1° in twilight
  int altitudes = 12;             ///< ≥ 4
  int upward = 12, downward = 6;  ///< zenith angles of arriving light above and below the horizon
  int around = 8;                 ///< azimuths of it, over half a turn
  int zeniths = 21, azimuths = 11;  ///< directions of light that goes on, ≥ 4; over half a turn
  int levels = 7;                   ///< of altitude between which rays are split
  int nodes = 3;                    ///< of a ray's piece
  double depth = 2;                 ///< most optical thickness of a piece
  bool cubic = false;               ///< between places; directions always are
  /// Where an order adds less than this everywhere it is the last: those after it are added as a
  /// geometric series, cell by cell, and in the darkest twilight, where each order is some .63 of the one
  /// before, that is good to a twenty-fifth of this.
  double tolerance = 0.025;
  int orders = 40;  ///< at most
  /// Zenith angles of the Sun, rad, that are looked up: a ray sees places up to 8° on, and light has
  /// come from farther.
  double sunFrom = 0, sunTo = 4;

  bool operator==(const Resolution&) const = default;

  static Resolution fast() { return {}; }
  /// For rays that begin where the Sun has this zenith angle alone: light comes from afar, and what a
  /// Sun 25° higher lights is some three orders of scattering away.
  void lookUpAt(double sunZenith);
  /// Each step of `refine` is finer by half again.
  static Resolution exact(int refine = 0);
};

/// Where a ray begins and how it lies to the Sun.
struct RayInAir {
  double altitude = 0;    ///< m, within the air
  double cosine = 1;      ///< of its zenith angle
  double sunZenith = 0;   ///< rad, at the origin
  double towardsSun = 1;  ///< cosine of the angle between the ray and the Sun
};

/// Radiance that arrives from a ray, by wavelength, for the Sun's irradiance above the air of 1.
struct AirLight {
  std::vector<double> air, aerosol;   ///< scattered once, without the phase functions
  std::vector<double> multiple;       ///< scattered more often
  std::vector<double> ground;         ///< from the ground at its end, through the air
  std::vector<double> transmittance;  ///< of the whole ray
};

/// Irradiance of the ground, for the Sun's above the air of 1.
struct GroundLight {
  std::vector<double> diffuse, direct;
};

/// Light scattered towards a viewer from stretches of one ray that all begin at the viewer, for the
/// Sun's irradiance above the air of 1. Each array is [stretch][wavelength].
struct AirStretches {
  std::vector<double> air, aerosol;  ///< scattered once, without the phase functions
  std::vector<double> multiple;      ///< scattered more often
  std::vector<double> depth;         ///< optical thickness
};

class Scattering {
 public:
  /// Solves it for a medium.
  static Result<Scattering> solve(Medium medium, const Resolution& resolution,
                                  const Progress& progress = {});

  const Medium& medium() const;
  const Resolution& resolution() const;

  /// As bytes that begin with scatteringKey(), and back: nothing if they are of another length or
  /// another key. The atmosphere is the one that the medium is of.
  std::vector<std::byte> bytes(const Atmosphere& atmosphere) const;
  static std::optional<Scattering> fromBytes(std::span<const std::byte> bytes,
                                             const Atmosphere& atmosphere,
                                             std::span<const double> wavelengths,
                                             const Resolution& resolution);
  /// Along a ray to the ground, the top of the air, or `end` (m).
  AirLight along(const RayInAir& ray, double end) const;
  AirLight along(const RayInAir& ray) const { return along(ray, kEndless); }
  /// Along a ray up to each of the rising distances `ends` (m), with `nodes` of quadrature between
  /// two of them (1 … 8). No ground is in it: below the ground the air goes on as it is on it, so
  /// that nothing steps where a ray meets it.
  void upTo(const RayInAir& ray, std::span<const double> ends, int nodes, AirStretches& out) const;
  /// Sum of an AirLight with the phase functions in.
  std::vector<double> radiance(const RayInAir& ray) const;
  GroundLight onGround(double sunZenith) const;
  /// From a place to the Sun's centre, by wavelength; below the horizon that of the horizon.
  std::vector<double> sunTransmittance(double altitude, double sunZenith) const;
  /// Zenith angle of the horizon at an altitude, rad.
  double horizonZenith(double altitude) const;
  /// How many orders were added up.
  int orders() const;

  struct Impl;

 private:
  explicit Scattering(std::shared_ptr<const Impl> impl) : impl_(std::move(impl)) {}
  std::shared_ptr<const Impl> impl_;
};

/// All that a solution is of, and the version of how it is solved.
std::string scatteringKey(const Atmosphere& atmosphere, std::span<const double> wavelengths,
                          const Resolution& resolution);

}  // namespace lambent::sky
