// How the tool speaks: progress, notes and warnings on stderr; one summary on stdout, as text or as
// JSON (spec/json).
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "apps/lambent/piped_files.h"
#include "apps/lambent/progress_bar.h"
#include "lambent/report/finding.h"
#include "lambent/report/progress.h"
#include "lambent/report/result.h"

namespace CLI {
class App;
}

namespace lambent::tool {

using Json = nlohmann::ordered_json;
using report::badInput, report::badUsage, report::failed;

inline constexpr int kExitDone = 0, kExitFailed = 1, kExitUsage = 2, kExitBadInput = 3;

/// The options that every verb has.
struct ConsoleOptions {
  bool json = false;
  bool quiet = false;
  bool strict = false;  ///< what is left out of a file is an error
  int threads = 0;      ///< 0: all
};

void addCommonOptions(CLI::App& app, ConsoleOptions& options);

/// A command that is not begun: "error: …" on stderr, with the command that teaches; as JSON on
/// stdout as well. `verb`: "bake", or nothing. Returns the exit code.
int refuse(const Error& error, std::string_view verb, std::string_view helpCommand, bool asJson);

class Console {
 public:
  /// `verb`: "bake".
  Console(const ConsoleOptions& options, std::string verb);

  /// To hand to a stage of the library.
  Progress progress();
  /// Runs `work` as a named stage of unknown length, so that it is timed like the others.
  template <class F>
  auto stage(std::string_view name, F&& work) {
    bar_.update({name, 0, 0, ""});
    auto result = work();
    bar_.update({name, 0, 0, ""});
    bar_.finish();
    return result;
  }
  /// What every stage so far took.
  const std::vector<StageTime>& stages();

  /// "note: …" and "warning: …" on stderr; also kept for the JSON summary.
  void report(const Findings& findings);
  /// report() of what was found in a file that was read: BadInput if any of it is a loss and
  /// --strict asks for all.
  Status accept(const Findings& findings);
  void note(std::string code, std::string message);
  void warn(std::string code, std::string message);

  /// An argument that may be "-": then it becomes a file with all of standard input. `name`: which
  /// it is, such as "SCENE".
  Status takeInput(std::filesystem::path& path, std::string_view name);
  Status takeInput(std::string& path, std::string_view name);
  /// An output that may be "-": then it becomes a file, with `extension`, that finish() sends to
  /// standard output.
  Status takeOutput(std::filesystem::path& path, std::string_view name, std::string_view extension);

  /// The verb is done: prints `text`, or under --json `summary` with status, findings and stages.
  /// Where standard output takes an output, `text` is for stderr. Failed if it cannot be said: see
  /// print().
  Status finish(Json summary, std::string_view text);
  /// What the JSON summary is to hold even if the verb fails after all.
  void keep(Json summary) { kept_ = std::move(summary); }
  /// The verb is not done: prints the error and returns the exit code.
  int fail(const Error& error);

  const ConsoleOptions& options() const { return options_; }

 private:
  Json findingsAsJson() const;

  ConsoleOptions options_;
  std::string verb_;
  PipedFiles piped_;
  ProgressBar bar_;
  Findings findings_;
  Json kept_ = Json::object();
};

}  // namespace lambent::tool
