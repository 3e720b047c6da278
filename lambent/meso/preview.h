// What an RTT looks like on a flat square: the CPU's look-up of B(u, v), and pictures made with it.
#pragma once

#include "lambent/image/image.h"
#include "lambent/sh/coefficients.h"
#include "lambent/transfer/field.h"

namespace lambent::meso {

/// Exit radiance Σ_i B_i(q, v) l_i at the place q of the patch (a fraction of its period, wrapped)
/// towards the unit vector `view`: the nearest position, bilinear between views (sloan2003biscale
/// §5). Both vectors in the patch's frame; a view below the horizon counts as level. `light` has
/// the RTT's bands.
Rgb exitRadiance(const transfer::SimulatedRtt& rtt, const Vec2& q, const Vec3& view,
                 const sh::RgbCoefficients& light);

/// A light like the sun through haze: radiance such that a level white surface which faces it
/// would show 1, from a disc of `halfAngle` (radians) about the unit vector `towards`; as
/// harmonics.
sh::RgbCoefficients discLight(int bands, const Vec3& towards, double halfAngle);

struct SquarePicture {
  Vec3 view = Vec3(0, 0, 1);  ///< unit, towards the eye, z > 0; +y is up in the picture
  int pixels = 384;           ///< a side
  float periods = 2.0f;       ///< of the patch, along the picture's width
  int samples = 2;            ///< per pixel, a side
};
/// The patch on a square, seen from far away in parallel projection; black around it where the
/// square is foreshortened. Linear radiance.
image::Image pictureOf(const transfer::SimulatedRtt& rtt, const sh::RgbCoefficients& light,
                       const SquarePicture& options);

/// Six pictures: from above and from 49° off, under a small light from the upper left, the same
/// from the right, and an even sky. Linear radiance.
image::Image preview(const transfer::SimulatedRtt& rtt, int pixels = 384);

}  // namespace lambent::meso
