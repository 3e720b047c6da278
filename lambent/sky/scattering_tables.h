// What Scattering is made of, shared by the files that solve it and look it up. Internal to the room.
#pragma once

#include <cmath>
#include <span>
#include <vector>

#include "lambent/sky/interpolation.h"
#include "lambent/sky/scattering.h"

namespace lambent::sky {

/// The kernels of this machine.
MarchKernels marchKernels();

/// Distances, m, where a ray enters and leaves the planet's shadow, a cylinder.
std::vector<double> shadowEdges(const media::Shell& shell, const RayInAir& ray);

/// The nodes of the tables: *cells*, pairs of the Sun's zenith angle and an altitude, with
/// directions in each.
struct Grid {
  double height = 0;   ///< of the top of the air, m
  double density = 1;  ///< of the Sun's zenith angles, see Resolution
  double first = 0;    ///< coordinate of the first of them
  int suns = 0, altitudes = 0, zeniths = 0, azimuths = 0;
  double twilight = 1;  ///< how many of the Sun's to a degree in twilight, at density 1

  /// 5° between nodes by day, less in twilight, with a smooth change about 78°.
  double sunCoordinate(double zenith) const {
    const double degrees = zenith * (180 / kPi), past = degrees - 78;
    const double more = (twilight - 0.2) / 2;
    return density * (degrees * 0.2 + more * (past + std::sqrt(past * past + 64))) - first;
  }
  double sunZenith(int node) const;
  double altitude(int node) const;

  int cells() const { return suns * altitudes; }
  int cell(int sun, int altitude) const { return sun * altitudes + altitude; }
  // Directions have a border of one on each side, so that four neighbours lie side by side.
  int azimuthStride() const { return azimuths + 2; }
  int directions() const { return (zeniths + 2) * azimuthStride(); }
};

/// What every cell holds, for kLanes wavelengths (see MarchTables).
struct Held {
  std::vector<float> logScale, moments, aerosol;
  explicit Held(const Grid& grid);
};

/// kLanes wavelengths of a medium, and the light in it.
struct Block {
  float extinction[3][kLanes] = {}, scattering[2][kLanes] = {};
  float albedo[kLanes] = {};
  Held held;
  std::vector<float> logGround;  ///< log of the ground's diffuse irradiance, [sun][lane]

  explicit Block(const Grid& grid);
  MarchTables tables(const Held& with, const Grid& grid) const;
  /// e^(−τ) of optical lengths.
  void transmit(const float (&lengths)[kParts], float (&out)[kLanes]) const;
};

/// Smaller than any radiance that is told apart from none; its logarithm is finite.
inline constexpr float kNothing = 1e-34f;

struct Scattering::Impl {
  Medium medium;
  Resolution resolution;
  Grid grid;
  SunLengths sunLengths;
  PathSplit split;
  std::vector<Block> blocks;
  int orders = 1;

  /// Of the right size everywhere, without any light yet.
  static std::shared_ptr<Impl> empty(Medium medium, const Resolution& resolution);
  /// All that addOrders() finds out, but for their number.
  template <class Self, class Each>
  static void forEachStored(Self& self, Each each) {
    for (auto& block : self.blocks)
      for (auto* part :
           {&block.held.logScale, &block.held.moments, &block.held.aerosol, &block.logGround})
        each(*part);
  }

  enum class Shadow {
    Sharp,  ///< of a point: paths are split at its edge
    Soft,   ///< of the Sun's disc, for paths that are not
  };
  /// What is known of a node whatever the Sun and the azimuth from it.
  struct Place {
    double cosine, sine;  ///< of the path's zenith angle there
    Taps rows;            ///< of altitudes
    int direction;        ///< its zenith angle's part of MarchNode::direction
  };
  /// Nodes of a path for the kernel, `cosine` of whose zenith angle is at its origin: all that does not
  /// depend on the Sun; then for one ray of it what it needs to scatter light once (from the Sun), and
  /// again (what the tables hold).
  std::vector<Place> prepareAlong(const AirPath& path, double cosine,
                                  std::vector<MarchNode>& nodes) const;
  void prepareOnce(const AirPath& path, const RayInAir& ray, Shadow shadow,
                   std::vector<MarchNode>& nodes) const;
  void prepareAgain(const AirPath& path, const RayInAir& ray, std::span<const Place> places,
                    std::vector<MarchNode>& nodes) const;
  /// Between places of the Sun, and between altitudes.
  Taps placeTaps(double coordinate, int count) const {
    return resolution.cubic ? cubicTaps(coordinate, count) : linearTaps(coordinate, count);
  }

  /// The Sun's zenith angle at the end of a path.
  double sunZenithAtEnd(const AirPath& path, const RayInAir& ray) const;
  /// The Sun's irradiance on the ground, for 1 above the air.
  void direct(const Block& block, double sunZenith, float (&out)[kLanes]) const;
  /// What a table of logarithms, [sun][lane], has for a place of the Sun.
  void fromLogs(const std::vector<float>& logs, double sunZenith, float (&out)[kLanes]) const;

  /// Fills the blocks (successive_orders.cpp).
  Status addOrders(const Progress& progress);
};

}  // namespace lambent::sky
