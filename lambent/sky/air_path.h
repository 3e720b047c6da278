// A straight path through the air, split for quadrature. It is the same for every wavelength, and
// for every place of the Sun.
#pragma once

#include <vector>

#include "lambent/sky/medium.h"

namespace lambent::sky {

/// Where an altitude lies between the ground (0) and the top (1) on an axis that crowds at the
/// ground: the nodes of tables are even on it.
double altitudeRise(double altitude, double height);
double altitudeOfRise(double rise, double height);

/// Farther than any path goes, m.
inline constexpr double kEndless = 1e12;

struct AirPath {
  struct Node {
    double distance, altitude, weight;  ///< m
    double horizon;                     ///< zenith angle of it, rad
    double rise;                        ///< altitudeRise() of the altitude
    float density[kParts];
    float length[kParts];  ///< optical lengths from the origin to here, m
  };
  std::vector<Node> nodes;
  double altitude = 0, cosine = 1;  ///< of its origin; of the angle there from the zenith
  double end = 0;                   ///< m
  bool hitsGround = false;          ///< at `end`
  float length[kParts] = {};        ///< all of it
};

/// How finely a path is split: a few nodes of Gauss and Legendre between levels of altitude, and
/// more pieces where the air is thick.
struct PathSplit {
  std::vector<double> levels;  ///< altitudes, m
  int nodes = 4;               ///< in a piece, 2 … 8
  double depth = 1;            ///< most optical thickness of a piece, at the thickest wavelength
  double opaque = 16;          ///< where the path is thicker than this at every wavelength it ends
};

/// From `altitude` towards a zenith angle to the ground, to the top, or for `end`, whichever is
/// first. `breaks`: further distances where what is integrated may step. The path of an origin above
/// the top begins there.
AirPath airPath(const Medium& medium, const PathSplit& split, double altitude, double cosine,
                double end, const std::vector<double>& breaks = {});

}  // namespace lambent::sky
