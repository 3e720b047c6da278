// What the name of a layer or a part says about its channels: light, a share of it, or none.
// Internal to this room.
#pragma once

#include <string_view>

namespace lambent::image::formats {

/// From the most to the least likely to be what a camera saw.
enum class Pass {
  Picture,  ///< "Combined", "beauty", "rgba"
  Unnamed,  ///< nothing but words that say nothing: "", "ViewLayer", "left"
  Unknown,  ///< words that are not in the lists here
  Share,    ///< a share of the light: "diffuse", "Emit", "GI"
  Other     ///< no light: "AO", "depth", "albedo", "N", "cryptomatte"
};

/// `name` is a layer's, parts of it divided by dots: "ViewLayer.Denoising Albedo". The last part
/// decides if it is in the lists here, else the others do.
Pass passOf(std::string_view name);

/// Whether two names are the same but for case.
bool sameName(std::string_view a, std::string_view b);

}  // namespace lambent::image::formats
