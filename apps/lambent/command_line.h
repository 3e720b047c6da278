// The command line as a tree: the root, its verbs, and the options that all of them have.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "apps/lambent/console.h"
#include "apps/lambent/verbs.h"

namespace lambent::tool {

struct CommandLine {
  CLI::App root;
  ConsoleOptions options;
  std::vector<Verb> verbs;

  CommandLine();
  /// The verb that the person named; null if there is none.
  const Verb* named() const;
};

/// All verbs in the sequence of the help.
std::vector<const CLI::App*> verbsOf(const CLI::App& root);
std::vector<std::string> verbNames(const CLI::App& root);

/// A command line that cannot be understood.
struct UsageError {
  std::string message;
  std::string remedy;  ///< what to try: "lambent bake --help"
};
/// What is wrong, and if a verb or an option is near to what was written, that one.
UsageError explain(const CommandLine& line, const CLI::ParseError& error);
/// The same for a word that is no verb.
UsageError noSuchVerb(const CLI::App& root, const std::string& given);

}  // namespace lambent::tool
