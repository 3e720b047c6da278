// Shafts of light: what aerial perspective loses where things stand between the air and the Sun.
//
// Of light scattered once, AirBetween::fromSun, only the stretches of a ray that see the Sun are left;
// light scattered more than once comes from all around and is not shadowed. Three ways, each for any
// form of the air but the second:
//   shaftsByMarch         the truth: edges of shadows are looked for along each ray
//   shaftsByPlanes        dobashi2000interactive: virtual planes across the view, a sum over them
//   shaftsBySplitPlanes   dobashi2002interactive: visibility at the planes, times light between them
//                         that was integrated beforehand
// shaders/shafts.glsl is the third.
#pragma once

#include <functional>

#include "lambent/math/types.h"
#include "lambent/sky/aerial_table.h"

namespace lambent::sky {

/// Whether the Sun's centre is seen from a point: m, in the Sun's frame (see dome.h) about any origin.
using SunVisible = std::function<bool(const Vec3d& point)>;

/// From the viewer, who is the one of the air, to what is seen.
struct ShaftRay {
  Vec3d origin = Vec3d::Zero();       ///< m, in the frame of SunVisible
  Vec3d direction = -Vec3d::UnitZ();  ///< unit, in the Sun's frame
  double length = 0;                  ///< m
};

/// All three: W m⁻² sr⁻¹ of light scattered once, in place of AirBetween::fromSun.
struct ShaftMarch {
  int steps = 64;      ///< a shadow or a gap that is shorter than a step may be missed
  double edge = 1e-3;  ///< how closely edges are found, m
};
Eigen::Array3d shaftsByMarch(const AerialPerspective& air, const ShaftRay& ray,
                             const SunVisible& visible, const ShaftMarch& march = {});

/// Intervals of depth along the view's axis, with a plane in the middle of each. Air before the first
/// and beyond the last counts as lit.
struct SamplingPlanes {
  Vec3d axis = -Vec3d::UnitZ();   ///< of the view, unit
  double first = 0, last = 1000;  ///< m along the axis
  int count = 64;
  /// 1/m: 0 spaces borders evenly; the mean coefficient of extinction so that each interval of air of
  /// constant density scatters as much, and all steps are as small as they can be.
  double rate = 0;
  /// Of visibility in an interval, at sub-planes: of the split form alone.
  int samples = 1;

  /// Depth of a border, 0 … count.
  double border(int k) const;
};

Eigen::Array3d shaftsByPlanes(const ConstantAir& air, const ShaftRay& ray,
                              const SunVisible& visible, const SamplingPlanes& planes);
Eigen::Array3d shaftsBySplitPlanes(const AerialPerspective& air, const ShaftRay& ray,
                                   const SunVisible& visible, const SamplingPlanes& planes);

/// The most that the split form can change by where one sample of visibility does, by channel: how
/// visible the planes may become as bands. In thin air even planes have (all light of the ray) /
/// (count · samples).
Eigen::Array3d largestStep(const AerialPerspective& air, const ShaftRay& ray,
                           const SamplingPlanes& planes);

}  // namespace lambent::sky
