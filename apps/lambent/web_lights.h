// Views that were saved on the page name the lights that it ships with: assets/studio.hdr.
#pragma once

#include <filesystem>
#include <string>

namespace lambent::tool {

/// A SOURCE of a saved view whose files are found: one that is not there from the current folder,
/// as views name their files, is sought beside the view itself, and then where the page of
/// `lambent view --web` has its own. What is found nowhere stays, for the reader to complain of.
std::string withPageLights(const std::string& source, const std::filesystem::path& view);

}  // namespace lambent::tool
