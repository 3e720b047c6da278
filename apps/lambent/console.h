// How the tool speaks: progress, notes and warnings on stderr; one summary on stdout, as text or as
// JSON.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

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

/// "error: …" on stderr, with the command that teaches.
void complain(std::string_view message, std::string_view helpCommand);

class Console {
 public:
  explicit Console(const ConsoleOptions& options);

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

  /// The verb is done: prints `text`, or under --json `summary` with status, findings and stages.
  /// Failed if it cannot be said: see print().
  Status finish(Json summary, std::string_view text);
  /// What the JSON summary is to hold even if the verb fails after all.
  void keep(Json summary) { kept_ = std::move(summary); }
  /// The verb is not done: prints the error and returns the exit code.
  int fail(const Error& error);

  const ConsoleOptions& options() const { return options_; }

 private:
  Json findingsAsJson() const;

  ConsoleOptions options_;
  ProgressBar bar_;
  Findings findings_;
  Json kept_ = Json::object();
};

}  // namespace lambent::tool
