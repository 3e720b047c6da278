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

constexpr int kSchema = 1;  ///< grows when a script that reads the JSON has to change

/// What every JSON begins with. `verb`: whose schema it has; that of failures if there is none.
Json begun(std::string_view verb, std::string_view status) {
  return {{"lambent",
           {{"version", LAMBENT_VERSION},
            {"schema", fmt::format("{}/{}", verb.empty() ? "failure" : verb, kSchema)}}},
          {"status", status}};
}

constexpr std::string_view kindInWords(ErrorKind kind) {
  switch (kind) {
    case ErrorKind::Failed:
      return "failed";
    case ErrorKind::BadUsage:
      return "bad-usage";
    case ErrorKind::BadInput:
      return "bad-input";
    case ErrorKind::Cancelled:
      return "cancelled";
  }
  return "failed";
}

/// `remedy`: beside what the message says; may be empty.
Json failure(std::string_view verb, const Error& error, const std::string& remedy) {
  Json whole = begun(verb, "failed");
  whole["exit_code"] = exitCodeOf(error.kind);
  whole["error"] = {{"kind", kindInWords(error.kind)}, {"message", error.message}};
  if (!remedy.empty()) whole["error"]["remedy"] = remedy;
  return whole;
}

std::string tryInstead(std::string_view helpCommand) {
  return fmt::format("Try '{}'.", helpCommand);
}

/// Of a failure that has been told. That this cannot be said either is told as well, once.
void sayJson(const Json& whole, const Error& told) {
  const Status said = print(textOf(whole));
  if (!said && !said.error().message.empty() && said.error().message != told.message)
    tell(fmt::format("error: {}\n", said.error().message));
}

/// Names of piped files as the person knows them.
void nameAsArguments(Json& json, const PipedFiles& piped) {
  if (json.is_string()) json = piped.asArgument(json.get<std::string>());
  if (json.is_structured())
    for (Json& each : json) nameAsArguments(each, piped);
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

int refuse(const Error& error, std::string_view verb, std::string_view helpCommand, bool asJson) {
  tell(fmt::format("error: {}\n{}\n", error.message, tryInstead(helpCommand)));
  if (asJson) {
    Json whole = failure(verb, error, tryInstead(helpCommand));
    whole["findings"] = Json::array();
    sayJson(whole, error);
  }
  return exitCodeOf(error.kind);
}

Console::Console(const ConsoleOptions& options, std::string verb)
    : options_(options), verb_(std::move(verb)), bar_(styleFor(options)) {}

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
  for (Finding finding : findings) {
    finding.message = piped_.inWords(std::move(finding.message));
    const bool warning = finding.severity == Severity::Warning;
    if (warning || !options_.quiet || (finding.loss && options_.strict))
      tell(fmt::format("{}: {}\n", warning ? "warning" : "note", finding.message));
    findings_.push_back(std::move(finding));
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

Status Console::takeInput(std::filesystem::path& path, std::string_view name) {
  if (path != "-") return Status::ok();
  auto taken = stage("standard input", [&] { return piped_.input(name); });
  if (!taken) return taken.error();
  path = std::move(*taken);
  return Status::ok();
}

Status Console::takeInput(std::string& path, std::string_view name) {
  std::filesystem::path file = path;
  if (Status taken = takeInput(file, name); !taken) return taken;
  path = file.string();
  return Status::ok();
}

Status Console::takeOutput(std::filesystem::path& path, std::string_view name,
                           std::string_view extension) {
  if (path != "-") return Status::ok();
  if (options_.json)
    return badUsage(fmt::format(
        "{} - and --json both write to standard output: give one of them a file", name));
  auto taken = piped_.output(name, extension);
  if (!taken) return taken.error();
  path = std::move(*taken);
  return Status::ok();
}

Status Console::finish(Json summary, std::string_view text) {
  bar_.finish();
  const std::string words = piped_.inWords(std::string(text));
  if (piped_.hasOutput()) {
    if (!options_.quiet) tell(words);
    return piped_.deliver();
  }
  if (!options_.json) return print(words);
  Json whole = begun(verb_, "done");
  whole.update(summary);
  whole["findings"] = findingsAsJson();
  Json& stages = whole["stages"] = Json::array();
  for (const StageTime& stage : bar_.stages()) {
    Json entry = {{"name", stage.name}, {"seconds", stage.seconds}};
    if (stage.units > 0) entry.update({{"units", stage.units}, {"unit", stage.unit}});
    stages.push_back(entry);
  }
  nameAsArguments(whole, piped_);
  return print(textOf(whole));
}

int Console::fail(const Error& failed) {
  bar_.finish();
  const Error error{failed.kind, piped_.inWords(failed.message)};
  if (!error.message.empty()) tell(fmt::format("error: {}\n", error.message));
  if (options_.json) {
    const bool usage = error.kind == ErrorKind::BadUsage;
    Json whole = failure(verb_, error, usage ? tryInstead("lambent " + verb_ + " --help") : "");
    nameAsArguments(kept_, piped_);
    whole.update(kept_);
    whole["findings"] = findingsAsJson();
    sayJson(whole, error);
  }
  return exitCodeOf(error.kind);
}

}  // namespace lambent::tool
