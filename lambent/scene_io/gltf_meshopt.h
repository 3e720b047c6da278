// Buffer views compressed by meshoptimizer: EXT_meshopt_compression, and KHR_meshopt_compression as
// far as the library knows it.
#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <vector>

#include "lambent/file/budget.h"
#include "lambent/report/result.h"

namespace lambent::scene_io {

/// The extension's object of a buffer view or a buffer, or null.
const nlohmann::json* meshoptCompressionOf(const nlohmann::json& object);

/// The bytes that `packed` stands for: count × byteStride of what the extension's object says, held
/// in `budget`. `place` begins messages.
Result<std::vector<std::byte>> decodeMeshopt(const nlohmann::json& compression,
                                             std::span<const std::byte> packed,
                                             const std::string& place, file::Budget& budget);

}  // namespace lambent::scene_io
