// The words for what the operating system answered.
#pragma once

#include <filesystem>
#include <string_view>

#include "lambent/report/result.h"

namespace lambent::file {

/// "PATH: cannot VERB: REASON; REMEDY" for an errno value. `action` is an infinitive: "read",
/// "write". Always BadInput: the path that the caller named is what has to change.
Error cannot(std::string_view action, const std::filesystem::path& path, int errnoValue);

}  // namespace lambent::file
