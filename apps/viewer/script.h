// A session written down: one command a line, for tests, for pictures and for soaks. Counted in
// frames, not in seconds, so that it does the same on every machine.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "lambent/report/result.h"

namespace lambent::viewer {

/// What the commands are, for people.
extern const std::string_view kScriptHelp;

struct ScriptCommand {
  int line = 0;
  std::vector<std::string> words;  ///< the command and its arguments
  std::size_t jump = 0;            ///< of `repeat`: its `end`; of `end`: its `repeat`
};

struct Script {
  std::string name;  ///< stands in messages for the file
  std::vector<ScriptCommand> commands;
};

/// BadInput with the line, before anything is run: commands that are not known, arguments that are
/// too few or too many, a `repeat` without `end`.
Result<Script> parseScript(std::string_view text, const std::string& name);
/// A file of a script. `drop` takes what a person might drop: an asset, a state or a SOURCE.
struct ScriptFile {
  enum class Use { Asset, Source, State, Any, Written };
  int line = 0;
  Use use = Use::Any;
  std::string name;
};
/// All that a script names, in the sequence of its lines.
std::vector<ScriptFile> filesOf(const Script& script);

Result<Script> readScript(const std::filesystem::path& path);

}  // namespace lambent::viewer
