#include "apps/lambent/output_argument.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>

namespace lambent::tool {

CLI::Option* OutputArgument::addTo(CLI::App& app, const std::string& label,
                                   const std::string& description, const char* group) {
  std::vector<std::string> words;
  for (const std::string& extension : extensions) words.push_back(extension.substr(1));
  CLI::Option* option = app.add_option("-o,--output", path, description + "; - : standard output")
                            ->option_text(label)
                            ->group(group);
  app.add_option("--format", word,
                 fmt::format("Of what -o - writes: {} (default: {})", fmt::join(words, ", "),
                             words.front()))
      ->option_text("FORMAT")
      ->check(CLI::IsMember(words))
      ->group("Output");
  return option;
}

Status OutputArgument::take(Console& console) {
  if (!word.empty() && path != "-")
    return badUsage("--format is of -o -: a file's name ends in its format");
  return console.takeOutput(path, "-o", format());
}

}  // namespace lambent::tool
