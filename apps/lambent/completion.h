// Scripts that let a shell complete the command line of the tool.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace lambent::tool {

enum class Shell { Bash, Zsh, Fish };

/// A script for the shell to read: verbs, options, words and files, and what they mean where the
/// shell shows it. `root`: as CommandLine makes it.
std::string completionFor(Shell shell, const CLI::App& root);

}  // namespace lambent::tool
