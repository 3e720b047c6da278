// A grid of directions that crowds at the horizon: where tables of skies have their nodes.
#pragma once

#include <algorithm>
#include <cmath>

#include "lambent/math/types.h"

namespace lambent::sky {

/// Rows of elevation above the horizon, then rows below it, each piece from the horizon on; columns
/// of azimuth from the Sun over half a turn.
struct ViewGrid {
  double horizon = 0;  ///< elevation, rad
  int above = 24, below = 12, azimuths = 19;

  int rows() const { return above + below; }
  int nodes() const { return rows() * azimuths; }
  double elevation(int row) const {
    // The first row of each piece lies beside the horizon, not on it.
    constexpr double kBeside = 1e-6;
    if (row < above) {
      const double t = double(row) / (above - 1);
      return horizon + kBeside + (kPi / 2 - horizon - kBeside) * t * t;
    }
    const double t = double(row - above) / (below - 1);
    return horizon - kBeside - (kPi / 2 + horizon - kBeside) * t * t;
  }
  double azimuth(int column) const { return kPi * column / (azimuths - 1); }

  /// Of an elevation, within its piece: 0 at the horizon.
  struct Row {
    bool above;
    double coordinate;
  };
  Row rowOf(double elevation) const {
    if (elevation >= horizon)
      return {true, (above - 1) * std::sqrt(std::clamp((elevation - horizon) / (kPi / 2 - horizon),
                                                       0.0, 1.0))};
    return {false, (below - 1) * std::sqrt(std::clamp((horizon - elevation) / (kPi / 2 + horizon),
                                                      0.0, 1.0))};
  }
  double columnOf(double azimuth) const { return azimuth / kPi * (azimuths - 1); }

  /// The same with each interval cut in `parts`.
  ViewGrid refined(int parts) const {
    return {horizon, (above - 1) * parts + 1, (below - 1) * parts + 1, (azimuths - 1) * parts + 1};
  }
};

}  // namespace lambent::sky
