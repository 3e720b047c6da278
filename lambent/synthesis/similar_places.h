// The patch as one level of synthesis sees it: without detail finer than the level's vertices, and
// with a list, for every place, of the places that look most like it.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "lambent/math/types.h"
#include "lambent/synthesis/appearance.h"

namespace lambent::synthesis {

/// `x` − its nearest integer, in [−½, ½]: the way on a torus of period 1.
inline Vec2 wrapped(const Vec2& x) {
  return Vec2(x.x() - std::round(x.x()), x.y() - std::round(x.y()));
}
/// Into [0, 1)².
Vec2 intoPatch(const Vec2& q);

class PatchLevel {
 public:
  static constexpr int kMaximumDimensions = 16;
  using Descriptor = std::array<float, kMaximumDimensions>;

  /// `spacing`: between the level's vertices, metres; `size`: of the patch. `candidates` places are
  /// listed for each; they keep a distance of `spacing` and more from it and from each other.
  /// Descriptors of more than 16 dimensions lose those beyond.
  PatchLevel(const Appearance& appearance, const Vec2& size, float spacing, int candidates);

  int dimensions() const { return dimensions_; }
  /// Mean squared distance of a descriptor from the mean one.
  float variance() const { return variance_; }
  /// Mean squared distance of a neighbourhood from the mean one.
  float windowVariance() const { return windowVariance_; }
  /// Bilinear; the patch goes on for ever.
  void descriptor(const Vec2& q, Descriptor& out) const;
  /// Squared distance of the descriptor at q from another; stops adding beyond `enough`.
  float distance(const Vec2& q, const Descriptor& other) const;
  /// The k-th (from 0) most similar place to q, with q's own offset from its grid point.
  Vec2 similar(const Vec2& q, int k) const;
  int similarCount() const { return candidates_; }
  struct Place {
    Vec2 q;
    float distance;  ///< squared, between the neighbourhoods
  };
  /// Up to `count` places most similar to q, no two of them (nor q) nearer than `separation` of the
  /// period along both axes; best first.
  std::vector<Place> mostSimilar(const Vec2& q, int count, float separation) const;

 private:
  void prefilter(const Vec2& sigma);
  void findWindows(const Vec2& step);
  std::uint32_t gridPoint(const Vec2& q) const;
  Vec2 place(std::uint32_t point) const;
  struct Found {
    std::uint32_t point;
    float distance;
  };
  std::vector<Found> search(std::uint32_t point, int count, const Vec2& separation,
                            std::vector<float>& distances) const;

  int width_, height_, dimensions_, stride_;
  std::vector<float> values_;  ///< [y][x][stride]
  float variance_ = 0.0f;
  int gridWidth_ = 0, gridHeight_ = 0;  ///< places that are listed and compared
  int windowDimensions_ = 0;
  float windowVariance_ = 0.0f;
  Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic> windows_;  ///< dimension × grid point
  int candidates_ = 0;
  std::vector<std::uint32_t> similar_;  ///< [grid point][candidate]
};

}  // namespace lambent::synthesis
