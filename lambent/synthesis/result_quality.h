// How good a patch's lay-out over a surface is, in numbers, from what an asset holds of it alone.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "lambent/synthesis/continuation.h"
#include "lambent/synthesis/worn_surface.h"
#include "lambent/transfer/rtt.h"

namespace lambent::synthesis {

struct ResultQuality {
  /// Share of steps from texel to texel of the id map over which the patch goes on as it does in
  /// itself (continuation.h).
  double continued = 1.0;
  /// Periods of tears in an area of one period: metres of tears, times the period (the geometric mean
  /// of the two), over the surface's area.
  double tearLength = 0.0;
  std::vector<Tear> tears;  ///< by falling length
  /// Of the patch's pieces (whole_pieces.h); none where it has none, or none that are not cut.
  std::optional<double> wholeByArea, whole;
  /// How unlike the surface looks from the patch laid flat (texture_statistics.h), in windows of half
  /// a period; none where the surface has no room for them.
  std::optional<double> unlikeness, misfit;
  /// Of windows of three periods; none where the surface has no room for them.
  std::optional<double> repetition;
};

/// `rtt` is the patch that is worn. Takes some seconds for a map of 2048² texels.
ResultQuality resultQualityOf(const Worn& worn, const transfer::Rtt<transfer::Floats>& rtt);

}  // namespace lambent::synthesis
