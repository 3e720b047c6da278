// Shapes turned on a lathe, and tubes: what the page's own assets are made of.
#pragma once

#include <vector>

#include "lambent/scene/scene.h"

namespace lambent::page {

/// A point of a profile: distance from the axis, and height, metres.
struct ProfilePoint {
  float radius, height;
};

/// The smooth curve through `points` (centripetal Catmull-Rom), as `count` + 1 points.
std::vector<ProfilePoint> smoothProfile(const std::vector<ProfilePoint>& points, int count);

/// A profile turned about +Y: from top to bottom with the outside in front. Corners of the profile
/// that are to stay sharp are given twice. UVs: u once around, v along the profile.
scene::Mesh turned(const std::vector<ProfilePoint>& profile, int segments);

/// A round plinth whose top is at height 0: `radius` wide, with a rounded edge; its vertices are
/// close together within half of the radius, where things stand on it.
scene::Mesh plinth(float radius, float height, int segments, int rings);

/// A tube along a torus knot that winds `around` times about the axis and `through` times through
/// the hole; centred, standing upright. UVs: u along the tube, v around it, both 0 … 1.
struct KnotOptions {
  int around = 2, through = 3;
  float major = 0.62f, minor = 0.30f;  ///< radii of the torus that it lies on, metres
  float tube = 0.17f;                  ///< radius of the tube, metres
  int along = 180, across = 20;        ///< quads
};
scene::Mesh knot(const KnotOptions& options);
/// The length of the knot's middle line, metres.
float lengthOf(const KnotOptions& options);

}  // namespace lambent::page
