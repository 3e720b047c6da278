// A relit picture of an asset by one ray for each sub-sample: the oracle for lambent/render.
#pragma once

#include "lambent/asset/asset.h"
#include "lambent/image/image.h"
#include "lambent/light/environment.h"
#include "lambent/report/progress.h"
#include "lambent/report/result.h"
#include "lambent/scene/camera.h"
#include "lambent/shade/picture_options.h"

namespace lambent::reference {

/// `light` holds the harmonics that relight; `environment` is the background, and what mirrors show
/// where nothing of the asset is.
Result<image::Image> relitPicture(const asset::Asset& asset, const sh::RgbCoefficients& light,
                                  const light::Environment& environment,
                                  const scene::Camera& camera, const shade::PictureOptions& options,
                                  const Progress& progress = {});

}  // namespace lambent::reference
