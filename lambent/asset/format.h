// What a file says of the format itself.
#pragma once

#include <string_view>

namespace lambent::asset {

inline constexpr std::string_view kExtensionName = "LAMBENT_radiance_transfer";
/// The format's own version, in every file. A reader takes any minor version of its major one.
inline constexpr int kFormatMajor = 1, kFormatMinor = 6;

/// Limits for readers: what no bake makes is damage.
inline constexpr int kLargestGrid = 32768;  ///< texels of a grid or an id map, each way
inline constexpr int kLargestRtt = 4096;    ///< positions of an RTT, each way
inline constexpr int kLargestViews = 64;    ///< … and views

}  // namespace lambent::asset
