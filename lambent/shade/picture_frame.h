// What every maker of pictures from an asset shares: the checks before, the background and the
// clamp after. So CPU and GL differ in nothing but how they see and shade the surfaces.
#pragma once

#include "lambent/image/image.h"
#include "lambent/light/environment.h"
#include "lambent/scene/camera.h"
#include "lambent/shade/picture_options.h"

namespace lambent::shade {

/// Whether a camera's matrix is a placement in space.
Status checkCamera(const scene::Camera& camera);

/// The same, and whether this camera can look through the air of the options, if there is any: what an
/// orthographic one sees has no distance.
Status checkCamera(const scene::Camera& camera, const PictureOptions& options);

/// Whether size, samples, lobe and air are in range.
Status checkOptions(const PictureOptions& options);

/// Whether the asset fits together (asset::faultOf) and holds what is to be shown, and light,
/// camera and options are in range. Bad input names the mesh.
Status checkPicture(const asset::Asset& asset, const sh::RgbCoefficients& light,
                    const scene::Camera& camera, const PictureOptions& options);

/// `image` holds the mean over the sub-samples of radiance (0 where none met a surface) and their
/// coverage in alpha. Radiance that a ringing light drove below zero is cut off here, after
/// averaging: cutting every sub-sample would brighten the antialiased borders of such places. Then
/// the background, if asked for: its mean over the pixel's sub-samples, weighted by 1 − coverage.
void finishPicture(image::Image& image, const light::Environment& environment,
                   const scene::Camera& camera, const PictureOptions& options);

}  // namespace lambent::shade
