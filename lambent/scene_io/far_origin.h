// Scenes far from the origin: surveys, buildings and scans in the coordinates of a country or of the
// Earth. A float has 24 bits: at five million metres it tells places apart by half a metre. So
// positions are read as doubles, and what lies far away is moved before anything becomes float.
#pragma once

#include <limits>

#include "lambent/math/types.h"
#include "lambent/scene_io/diagnosis.h"

namespace lambent::scene_io {

/// What positions a scene has, as its file says them, metres. Those that are not finite do not
/// count, nor should those that no triangle uses.
struct DoubleBox {
  Vec3d lower = Vec3d::Constant(std::numeric_limits<double>::infinity());
  Vec3d upper = -lower;
  void extend(const Vec3d& p) {
    if (!p.allFinite()) return;
    lower = lower.cwiseMin(p);
    upper = upper.cwiseMax(p);
  }
};

/// A coordinate is far if it is larger than kFarExtents times the scene's extent (the longest side
/// of its box): then floats have lost 10 of their bits. Or if it is beyond kFarMetres, where floats
/// are more than a millimetre apart, and more than kFewExtents times the extent, so that moving
/// helps.
inline constexpr double kFarExtents = 1000.0;
inline constexpr double kFarMetres = 16384.0;
inline constexpr double kFewExtents = 4.0;

/// What to subtract from every position and camera of a scene, in double: zero along the axes along
/// which it is near enough; else the middle of its box, rounded to a power of two of metres (at
/// most 1, and at most the extent) so that the subtraction of a float is exact.
Vec3d farOrigin(const DoubleBox& box);

/// The finding ("far-origin") for a scene that was moved by `origin`; nothing for zero.
void noteFarOrigin(const Vec3d& origin, Diagnosis& diagnosis);

}  // namespace lambent::scene_io
