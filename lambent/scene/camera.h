// Rays of a camera, a camera for a scene that brings none, and the places inside a pixel that
// every renderer samples, so that CPU, GL and the path tracer see the same picture.
#pragma once

#include <vector>

#include "lambent/scene/scene.h"

namespace lambent::scene {

struct Ray {
  Vec3 origin, direction;  ///< world space, direction unit
};

/// The ray through image point (x, y) in pixels from the upper left corner of a width×height image.
Ray cameraRay(const Camera& camera, int width, int height, float x, float y);

/// Projection and view for GL: clip space as OpenGL's (z in −1 … 1), near and far fitted to `box`.
Mat4 clipFromWorld(const Camera& camera, int width, int height, const Box& box);

/// A three-quarter view from slightly above that frames the whole scene at the given aspect
/// (width / height).
Camera frameAutomatically(const Scene& scene, float aspect);

/// `count` low-discrepancy positions in the unit square, the first at the centre if count = 1.
std::vector<Vec2> subpixelPositions(int count);

}  // namespace lambent::scene
