// A relit picture of an asset on the CPU: the oracle for lambent/render.
#pragma once

#include <optional>

#include "lambent/asset/asset.h"
#include "lambent/image/image.h"
#include "lambent/light/environment.h"
#include "lambent/report/progress.h"
#include "lambent/scene/camera.h"
#include "lambent/shade/bi_scale_options.h"
#include "lambent/shade/transfer_choice.h"

namespace lambent::shade {

struct PictureOptions {
  int width = 1024, height = 1024;
  int samples = 16;         ///< per pixel, at scene::subpixelPositions
  bool background = false;  ///< the environment behind the object; otherwise black, alpha 0
  std::optional<float> lobeExponent;
  TransferChoice transfer = TransferChoice::Best;  ///< of what the asset holds
  BiScaleOptions biScale;  ///< of meshes with meso-structure; its `macro` wins over `transfer`
  int threads = 0;         ///< for shade::picture; 0: all. No effect on the result's bytes
};

/// Linear radiance, never negative (what a ringing light drives below zero is cut off per pixel,
/// after averaging), with coverage in alpha: what covers half a pixel has half its radiance there.
/// With a background there is no alpha. Surfaces seen from behind are black. Only the front of a
/// material is lit, and a mirror shows the environment alone. `light` holds the harmonics that
/// relight; `environment` is what mirrors and the background show.
Result<image::Image> picture(const asset::Asset& asset, const sh::RgbCoefficients& light,
                             const light::Environment& environment, const scene::Camera& camera,
                             const PictureOptions& options, const Progress& progress = {});

}  // namespace lambent::shade
