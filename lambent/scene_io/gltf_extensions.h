// The extensions of glTF that a file may require.
#pragma once

#include <string>
#include <string_view>

namespace lambent::scene_io {

/// Those that Lambent reads, or can leave out without a wrong shape.
bool isKnownExtension(std::string_view name);

/// What to do about a file that requires another one.
std::string remedyFor(const std::string& extension);

}  // namespace lambent::scene_io
