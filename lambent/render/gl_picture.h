// A relit picture of an asset by OpenGL 4.5, headless through surfaceless EGL (software GL will
// do).
#pragma once

#include "lambent/shade/picture.h"

namespace lambent::render {

/// As shade::picture, on the GPU: transfer vectors and matrices are applied there. Fails with a
/// clear message where there is no EGL device or the asset does not fit.
Result<image::Image> picture(const asset::Asset& asset, const sh::RgbCoefficients& light,
                             const light::Environment& environment, const scene::Camera& camera,
                             const shade::PictureOptions& options, const Progress& progress = {});

}  // namespace lambent::render
