// A radiance transfer texture laid out for shading, with coarser and coarser copies of itself.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "lambent/shade/aligned_vector.h"
#include "lambent/transfer/rtt.h"

namespace lambent::shade {

/// Numbers of one position and view: three channels of bands² coefficients, filled up to whole
/// groups of four.
constexpr int rttStride(int bands) {
  return (3 * bands * bands + 3) / 4 * 4;
}

/// One level: [y][x][view y][view x][rttStride], coefficient after coefficient, each R, G, B; the
/// filling is zero.
struct RttLevel {
  int width = 0, height = 0;  ///< positions
  AlignedVector<float> values;
  /// [y][x][view y][view x]: the mean of transfer::Rtt's; or none.
  std::vector<std::uint8_t> heights;
};

/// Level 0 is the texture itself. A position of level k holds the mean response, view by view, of
/// its share of the patch: width >> k by height >> k positions (1 at least), down to one. What the
/// patch does beyond its border is the patch again, so the mean of every level is that of the
/// texture.
struct RttPyramid {
  int views = 1;  ///< a side
  int bands = 0;
  /// The patch's depth, in its periods along x and y; 0 where its heights are not known.
  Vec2 relief = Vec2::Zero();
  std::vector<RttLevel> levels;

  std::size_t viewCount() const { return std::size_t(views) * std::size_t(views); }
  int stride() const { return rttStride(bands); }
  /// The views of one position: [view y][view x][stride].
  const float* at(int level, int x, int y) const {
    const RttLevel& l = levels[level];
    return l.values.data() + (std::size_t(y) * l.width + x) * viewCount() * stride();
  }
};

/// At most `mostLevels` levels, at least the first.
RttPyramid makePyramid(const transfer::Rtt<transfer::Floats>& rtt, int mostLevels = 32);

}  // namespace lambent::shade
