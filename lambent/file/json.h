// JSON that may come from anywhere: what nests too deep is refused before it becomes a value.
// Values are copied, written and compared by functions that call themselves.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string_view>

#include "lambent/report/result.h"

namespace lambent::file {

/// Brackets within brackets. glTF needs about ten, what applications put in its extras a few more.
inline constexpr int kDeepestJson = 200;

/// BadInput says what is wrong and at which place, without the file's name.
Result<nlohmann::json> parseJson(std::string_view text);

}  // namespace lambent::file
