// -o OUT, which may be - for standard output, and --format.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/lambent/console.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace lambent::tool {

/// Where a verb writes what it makes, for those that can write it in several formats.
struct OutputArgument {
  std::filesystem::path path = {};
  std::vector<std::string> extensions;  ///< with dots; the first is what - gets
  std::string word = {};                ///< of --format; empty: not given

  /// -o and --format. `label`: what stands for the value in the help.
  CLI::Option* addTo(CLI::App& app, const std::string& label, const std::string& description,
                     const char* group = "Options");
  /// What - stands for becomes a file: see Console::takeOutput(). BadUsage: a --format that nothing
  /// asks for.
  Status take(Console& console);
  /// Of what - stands for, as an extension.
  std::string format() const { return word.empty() ? extensions.front() : "." + word; }
};

}  // namespace lambent::tool
