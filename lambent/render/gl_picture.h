// A relit picture of an asset by OpenGL 4.5, headless through surfaceless EGL (software GL will
// do).
#pragma once

#include "lambent/asset/asset.h"
#include "lambent/image/image.h"
#include "lambent/light/environment.h"
#include "lambent/report/progress.h"
#include "lambent/report/result.h"
#include "lambent/scene/camera.h"
#include "lambent/shade/picture_options.h"

namespace lambent::render {

/// As reference::relitPicture, on the GPU: transfer vectors and matrices are applied there. Fails
/// with a clear message where there is no EGL device or the asset does not fit.
Result<image::Image> picture(const asset::Asset& asset, const sh::RgbCoefficients& light,
                             const light::Environment& environment, const scene::Camera& camera,
                             const shade::PictureOptions& options, const Progress& progress = {});

}  // namespace lambent::render
