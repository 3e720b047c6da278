// Pictures beside each other, for the eye.
#pragma once

#include <span>

#include "lambent/image/image.h"

namespace lambent::compare {

/// |b − a| · gain per channel, opaque; both of the same size.
image::Image difference(const image::Image& a, const image::Image& b, float gain);

/// The picture over an even backdrop where it is not covered; opaque. Colours are premultiplied by
/// alpha, as renderers yield them.
image::Image over(const image::Image& picture, const Rgb& backdrop);

/// Panels of one height side by side with a gap of `gap` pixels in `gapColor`.
image::Image strip(std::span<const image::Image> panels, int gap, const Rgb& gapColor);

}  // namespace lambent::compare
