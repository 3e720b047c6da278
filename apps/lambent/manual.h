// Manual pages, of the texts that --help shows.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>

#include "lambent/report/result.h"

namespace lambent::tool {

/// lambent(1), or lambent-VERB(1), in the macros of man(7). `root`: as CommandLine makes it;
/// `verb`: one of its verbs, or null.
std::string manualPage(const CLI::App& root, const CLI::App* verb);

/// lambent.1 and one page for each verb into a folder that is there; a page whole or not at all.
Status writeManual(const CLI::App& root, const std::filesystem::path& folder);

}  // namespace lambent::tool
