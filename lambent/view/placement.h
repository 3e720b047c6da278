// Where the things of a state are: camera, object, environment, discs; and how all of it looks from
// the asset's own frame, in which transfer is recorded.
//
// With worldFromAsset = (R, t): a camera in the asset's frame is assetFromWorld · worldFromCamera,
// an environment there is turned by Rᵀ · worldFromEnvironment, light there is sh::rotate(Rᵀ, light
// in the world). So what draws an asset that stands still draws one that moves.
#pragma once

#include <memory>
#include <optional>

#include "lambent/light/environment.h"
#include "lambent/shade/picture_options.h"
#include "lambent/view/view_state.h"

namespace lambent::view {

using Rotation = std::array<double, 4>;  ///< unit quaternion x, y, z, w

Mat3d matrixOf(const Rotation& rotation);
/// `rotation`, and then a turn by `radians` about a unit axis of the world.
Rotation turned(const Rotation& rotation, const Vec3d& axis, double radians);

Mat4 worldFromAsset(const ViewState& state);
Mat3 worldFromEnvironment(const ViewState& state);
/// Turns the object about a point of the world, which stays where it is.
void turnObject(ViewState& state, const Vec3d& pivot, const Vec3d& axis, double radians);

/// Towards the disc, in the world.
Vec3 directionOf(const Disc& disc);
/// Sets azimuth and elevation, in degrees, from a direction that is not zero.
void aim(Disc& disc, const Vec3& direction);
light::Environment environmentOf(const Disc& disc);

scene::Camera cameraOf(const LookAt& look);
/// In the world: the state's, or the file's first as it stands in the file, or
/// scene::frameAutomatically. `aspect`: width / height.
scene::Camera worldCamera(const ViewState& state, const scene::Scene& scene, float aspect);
scene::Camera assetCamera(const ViewState& state, const scene::Camera& worldCamera);

/// Environment and discs, turned into the asset's frame: what mirrors and the background show, and
/// what a path tracer takes as its light.
light::Environment assetEnvironment(const ViewState& state, const light::Environment& environment);

/// The state's air, of this table, in the asset's frame; nothing if it has none. `environmentFromSun`
/// turns the Sun's frame as the environment stands before its own turn.
std::optional<shade::Air> assetAir(const ViewState& state,
                                   std::shared_ptr<const sky::AirTable> table,
                                   const Mat3d& environmentFromSun);

/// What a state says about how the asset is shown.
shade::Showing showingOf(const ViewState& state);
/// What else it says about a picture.
shade::PictureOptions pictureOptions(const ViewState& state, int width, int height);

/// The box around a box that is moved.
scene::Box movedBox(const Mat4& dstFromSrc, const scene::Box& box);

}  // namespace lambent::view
