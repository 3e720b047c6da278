// Whether a point of a surface lies inside another body, by what it sees.
#pragma once

#include "lambent/math/types.h"
#include "lambent/trace/cast.h"

namespace lambent::transport {

/// A point that sees the backs of surfaces in more than a third of its hemisphere: it lies inside a
/// body, or behind a sheet. A body need not be closed: who stands under a box without a bottom sees
/// its backs too. From the outside, backs are seen of open sheets alone.
class InsideProbe {
 public:
  /// `rays` must outlive it.
  explicit InsideProbe(const trace::RayScene& rays);

  /// By four rays; by some 12 where one of those meets a back, and by some 256 where that leaves doubt.
  /// work::FlushDenormals must be held.
  bool seesBacks(const Vec3& origin, const Vec3& normal, trace::CastResult& scratch) const;

 private:
  bool meetsBack(const Vec3& origin, const Vec3& normal) const;
  double shareOfBacks(const trace::DirectionSet& directions, const Vec3& origin, const Vec3& normal,
                      trace::CastResult& scratch) const;

  const trace::RayScene& rays_;
  trace::DirectionSet few_, many_;
};

}  // namespace lambent::transport
