// What the name of a file says about its kind.
#pragma once

#include <filesystem>
#include <string>

namespace lambent::file {

/// The last extension with its dot, A-Z in lower case whatever the locale; empty if there is none.
std::string extensionOf(const std::filesystem::path& path);

}  // namespace lambent::file
