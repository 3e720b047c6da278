// Scenes, transfer and lights in words and as JSON: what `info` prints and summaries quote.
#pragma once

#include <string>

#include "apps/lambent/console.h"
#include "lambent/asset/summary.h"
#include "lambent/bi_scale/asset_quality.h"
#include "lambent/image/image.h"
#include "lambent/scene/scene.h"
#include "lambent/sh/coefficients.h"

namespace lambent::tool {

/// What a person reads and what a script reads, of one thing.
struct Description {
  std::string text;
  Json json;
};

Description describe(const scene::Scene& scene);
/// Of its transfer alone.
Description describe(const asset::Asset& asset);
Description describe(const asset::RttSummary& rtt);
/// How patches lie on the meshes of a scene. The longest tears are told, at most sixteen of each mesh.
Description describe(const std::vector<bi_scale::MeshQuality>& layouts, const scene::Scene& scene);
Description describe(const sh::RgbCoefficients& light);
Description describe(const image::Image& image);

Json asJson(const Rgb& rgb);
}  // namespace lambent::tool
