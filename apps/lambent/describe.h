// Scenes, transfer and lights in words and as JSON: what `info` prints and summaries quote.
#pragma once

#include <string>

#include "apps/lambent/console.h"
#include "lambent/encode/encoded_field.h"
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
Description describe(const encode::EncodedField& transfer, const scene::Scene& scene);
Description describe(const encode::EncodedRtt& rtt);
Description describe(const sh::RgbCoefficients& light);
Description describe(const image::Image& image);

Json asJson(const Rgb& rgb);
std::string_view nameOf(transport::TransferKind kind);
std::string_view nameOf(transport::Layout layout);
std::string_view nameOf(encode::Encoding encoding);

}  // namespace lambent::tool
