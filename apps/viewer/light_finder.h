// Where the light of a saved state is sought.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

namespace lambent::viewer {

/// The SOURCE of a saved state, with its files where they lie on this machine: they may be named as
/// the page names its own lights, or as they lie beside the state.
using LightFinder =
    std::function<std::string(const std::string& source, const std::filesystem::path& state)>;

}  // namespace lambent::viewer
