#include "apps/lambent/console.h"

#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdlib>

#include "apps/lambent/numbers.h"
#include "apps/lambent/standard_streams.h"

namespace lambent::tool {

namespace {

ProgressBar::Style styleFor(const ConsoleOptions& options) {
  if (options.quiet) return ProgressBar::Style::Silent;
  const char* terminal = std::getenv("TERM");
  const bool dumb = terminal && std::string_view(terminal) == "dumb";
  return isatty(STDERR_FILENO) && !dumb ? ProgressBar::Style::Bar : ProgressBar::Style::Lines;
}

int exitCodeOf(ErrorKind kind) {
  switch (kind) {
    case ErrorKind::Failed:
      return kExitFailed;
    case ErrorKind::BadUsage:
      return kExitUsage;
    case ErrorKind::BadInput:
      return kExitBadInput;
    case ErrorKind::Cancelled:
      return 130;
  }
  return kExitFailed;
}

std::string textOf(const Json& whole) {
  return whole.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

}  // namespace

void addCommonOptions(CLI::App& app, ConsoleOptions& options) {
  app.add_flag("--json", options.json, "Print the summary as JSON on stdout")->group("Output");
  app.add_flag("--strict", options.strict,
               "What is left out of a file that is read is an error, not a note or a warning")
      ->group("Output");
  app.add_flag("-q,--quiet", options.quiet, "No progress, no notes; warnings and errors stay")
      ->group("Output");
  addNumber(app, "--threads", options.threads, {0, 4096},
            "Threads to use; 0: all. The result has the same bytes with any number")
      ->default_str("")  // the text says it
      ->option_text("N")
      ->group("Output");
}

void complain(std::string_view message, std::string_view helpCommand) {
  tell(fmt::format("error: {}\nTry '{}'.\n", message, helpCommand));
}

Console::Console(const ConsoleOptions& options) : options_(options), bar_(styleFor(options)) {}

Progress Console::progress() {
  return [this](const ProgressUpdate& update) {
    bar_.update(update);
    return true;
  };
}

const std::vector<StageTime>& Console::stages() {
  bar_.finish();
  return bar_.stages();
}

void Console::report(const Findings& findings) {
  bar_.finish();
  for (const Finding& finding : findings) {
    const bool warning = finding.severity == Severity::Warning;
    if (warning || !options_.quiet || (finding.loss && options_.strict))
      tell(fmt::format("{}: {}\n", warning ? "warning" : "note", finding.message));
    findings_.push_back(finding);
  }
}

Status Console::accept(const Findings& findings) {
  report(findings);
  std::string lost;
  for (const Finding& finding : findings)
    if (finding.loss) lost += (lost.empty() ? "" : ", ") + finding.code;
  if (!options_.strict || lost.empty()) return Status::ok();
  return badInput(
      fmt::format("not all that the file says can be taken ({}), and --strict asks for all of it; "
                  "see the notes above, mend the file, or do without --strict",
                  lost));
}

void Console::note(std::string code, std::string message) {
  report({{Severity::Note, std::move(code), std::move(message), 0}});
}

void Console::warn(std::string code, std::string message) {
  report({{Severity::Warning, std::move(code), std::move(message), 0}});
}

Json Console::findingsAsJson() const {
  Json list = Json::array();
  for (const Finding& finding : findings_)
    list.push_back({{"severity", finding.severity == Severity::Warning ? "warning" : "note"},
                    {"code", finding.code},
                    {"message", finding.message},
                    {"count", finding.count},
                    {"loss", finding.loss}});
  return list;
}

Status Console::finish(Json summary, std::string_view text) {
  bar_.finish();
  if (!options_.json) return print(text);
  Json whole = {{"status", "done"}};
  whole.update(summary);
  whole["findings"] = findingsAsJson();
  Json& stages = whole["stages"] = Json::array();
  for (const StageTime& stage : bar_.stages()) {
    Json entry = {{"name", stage.name}, {"seconds", stage.seconds}};
    if (stage.units > 0) entry.update({{"units", stage.units}, {"unit", stage.unit}});
    stages.push_back(entry);
  }
  return print(textOf(whole));
}

int Console::fail(const Error& error) {
  bar_.finish();
  const int code = exitCodeOf(error.kind);
  tell(fmt::format("error: {}\n", error.message));
  if (options_.json) {
    Json whole = {{"status", "failed"}, {"exit_code", code}, {"error", error.message}};
    whole.update(kept_);
    whole["findings"] = findingsAsJson();
    if (const Status said = print(textOf(whole)); !said)
      tell(fmt::format("error: {}\n", said.error().message));
  }
  return code;
}

}  // namespace lambent::tool
