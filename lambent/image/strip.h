// Pictures beside each other, for the eye.
#pragma once

#include <span>

#include "lambent/image/image.h"

namespace lambent::image {

/// The picture over an even backdrop where it is not covered; opaque. Colours are premultiplied by
/// alpha, as renderers yield them.
Image over(const Image& picture, const Rgb& backdrop);

/// Panels of one height side by side with a gap of `gap` pixels in `gapColor`.
Image strip(std::span<const Image> panels, int gap, const Rgb& gapColor);

}  // namespace lambent::image
