// Aerial perspective put into a picture that was made without: of its colours and its depths.
#pragma once

#include "lambent/image/image.h"
#include "lambent/math/types.h"
#include "lambent/report/progress.h"
#include "lambent/report/result.h"
#include "lambent/sky/aerial_table.h"
#include "lambent/sky/dome.h"
#include "lambent/sky/picture_shape.h"
#include "lambent/sky/sight.h"

namespace lambent::sky {

/// What the depth of a pixel is measured along.
enum class DepthAlong {
  Ray,   ///< the distance from the camera
  Axis,  ///< the distance from the camera's plane (z), of PictureMap::Camera
};

struct HazeOptions {
  PictureShape shape;                      ///< where the pixels look; its size is the pictures'
  Mat3d worldFromSun = Mat3d::Identity();  ///< turns the Sun's frame
  DepthAlong depth = DepthAlong::Ray;
  double metres = 1;  ///< of one unit of depth
  /// What is seen where nothing stands; null: such pixels are left as they are.
  const Sky* backdrop = nullptr;
  BelowHorizon below = BelowHorizon::Dome;  ///< of the backdrop
};

/// BadUsage: pictures of another size than the shape's, depth along the axis of another map than a
/// camera's, a unit that is not above 0.
Status checkHaze(const image::Image& color, const image::Image& depth, const HazeOptions& options);

/// L_s = f L_0 + L_in for every pixel. `depth` has the depth in its first channel; where that is not
/// above 0, not finite or 10⁹ m or more, nothing stands. A pixel that something covers in part (alpha)
/// gets as much of the air; the backdrop covers the rest. A sum outside of Rec. 709 is brought into it
/// (withinGamut()).
///
/// BadUsage: see checkHaze(); Cancelled.
Result<image::Image> haze(const image::Image& color, const image::Image& depth,
                          const AerialPerspective& air, const HazeOptions& options,
                          const Progress& progress = {});

}  // namespace lambent::sky
