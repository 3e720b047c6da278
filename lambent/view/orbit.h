// A camera under the hand: what a drag, a wheel and a key do to it. Pure functions.
#pragma once

#include "lambent/math/types.h"
#include "lambent/scene/scene.h"
#include "lambent/view/view_state.h"

namespace lambent::view {

/// A scene's camera as somebody would hold it: its target is the point of its line of sight that is
/// nearest to the middle of `box`, and up is +y unless the camera is rolled.
LookAt lookAtOf(const scene::Camera& camera, const scene::Box& box);

/// Walks around the target at the same distance: `azimuth` to the right about `up`, then
/// `elevation` upwards, in radians. Stops 1° before it looks along `up`, so that nothing flips.
LookAt orbited(const LookAt& look, double azimuth, double elevation);

/// Moves camera and target in the view plane, so that what is at the target's distance moves by
/// `shift` in the picture: x to the right, y upwards, in heights of the picture.
LookAt panned(const LookAt& look, const Vec2& shift);

/// Scales the distance (or an orthographic camera's height) by `factor` > 0, so that the point of
/// the target's plane under the pointer stays where it is. `pointer`: from the middle of the
/// picture, x to the right, y upwards, in heights of the picture. The distance stays between
/// `nearest` and `farthest` metres.
LookAt zoomed(const LookAt& look, double factor, const Vec2& pointer, double nearest,
              double farthest);

/// From the same side, so near that the whole box just fits into a picture of this aspect (width /
/// height). An empty box changes nothing.
LookAt framed(const LookAt& look, const scene::Box& box, double aspect);

}  // namespace lambent::view
