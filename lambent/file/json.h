// JSON that may come from anywhere: what nests too deep is refused before it becomes a value.
// Values are copied, written and compared by functions that call themselves.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "lambent/report/result.h"

namespace lambent::file {

/// Brackets within brackets. glTF needs about ten, what applications put in its extras a few more.
inline constexpr int kDeepestJson = 200;

/// BadInput says what is wrong and at which place, without the file's name.
Result<nlohmann::json> parseJson(std::string_view text);

/// The first key that stands twice in one object; of two values parseJson() keeps the last. `text` is
/// what parseJson() took.
std::optional<std::string> repeatedKey(std::string_view text);

/// What stands in an object at `key`; if nothing does, an empty array or object that is put there.
/// operator[] and push_back would make them of null, too, but where they get no memory they leave
/// half a value, whose destructor crashes (nlohmann-json 3.11.2).
nlohmann::json& arrayAt(nlohmann::json& object, const char* key);
nlohmann::json& objectAt(nlohmann::json& object, const char* key);

}  // namespace lambent::file
