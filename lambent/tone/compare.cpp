#include "lambent/tone/compare.h"

#include <span>
#include <string>

#include "lambent/image/code_difference.h"
#include "lambent/image/flip.h"

namespace lambent::tone {

Result<image::Comparison> compare(const image::Image& test, const image::Image& reference,
                                  const CompareOptions& options) {
  const auto sizeOf = [](const image::Image& picture) {
    return std::to_string(picture.width) + "×" + std::to_string(picture.height);
  };
  if (test.width != reference.width || test.height != reference.height) {
    return report::badInput("pictures of different sizes cannot be compared: " + sizeOf(test) +
                            " and " + sizeOf(reference) + "; render them at one size");
  }
  if (test.pixels.empty()) return report::badInput("pictures without pixels cannot be compared");

  Result<image::Comparison> measured =
      image::compare(std::span<const Rgb>(test.pixels), std::span<const Rgb>(reference.pixels));
  if (!measured) return measured;
  image::Comparison& result = *measured;
  if (options.displayReferred) {
    result.psnr = image::psnrOf(image::codeDifference(test, reference));
    result.psnrPeak = 255.0;
    result.flip = image::meanOf(image::flip(test, reference, options.pixelsPerDegree));
  } else {
    result.flip = image::meanOf(image::flip(toneMap(test, options.exposureEv, options.curve),
                                            toneMap(reference, options.exposureEv, options.curve),
                                            options.pixelsPerDegree));
  }
  return result;
}

}  // namespace lambent::tone
