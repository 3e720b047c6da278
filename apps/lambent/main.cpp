// lambent: bakes how light moves over an asset, and relights it.
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <exception>
#include <new>
#include <sstream>
#include <string_view>

#include "apps/lambent/command_line.h"
#include "apps/lambent/console.h"
#include "apps/lambent/help.h"
#include "apps/lambent/interrupt.h"
#include "apps/lambent/standard_streams.h"
#include "lambent/file/atomic_file.h"
#include "lambent/file/temporary_folder.h"
#include "lambent/work/thread_limit.h"

namespace {

using namespace lambent;
using namespace lambent::tool;

Status run(const Verb& verb, const ConsoleOptions& options, Console& console) {
  // Never destroyed: oneTBB (2021.8) waits without end in there if it once got no memory to start.
  static const work::ThreadLimit* const limit =
      options.threads > 0 ? new work::ThreadLimit(options.threads) : nullptr;
  (void)limit;
  try {
    return verb.run(console);
  } catch (const std::bad_alloc&) {
    return failed(
        "out of memory. Ask for less at once: fewer --bands or --glossy-bands, a smaller "
        "--hit-memory, --size or --texels grid, or a mesh with fewer vertices");
  } catch (const std::exception& e) {
    return failed(std::string("unexpected: ") + e.what());
  }
}

/// Help and version; the exit code.
int say(std::string_view text) {
  const Status said = print(text);
  if (!said && !said.error().message.empty()) tell("error: " + said.error().message + '\n');
  return said ? kExitDone : kExitFailed;
}

/// Whether --json is on a command line, which may be one that cannot be understood.
bool asksForJson(int argc, char** argv) {
  for (int i = 1; i < argc && std::string_view(argv[i]) != "--"; ++i)
    if (std::string_view(argv[i]) == "--json") return true;
  return false;
}

/// All of the tool, except for what is thrown out of it.
int runTool(int argc, char** argv) {
  secureStandardStreams();
  installInterruptHandlers();

  CommandLine line;
  try {
    line.root.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() == 0) {
      std::ostringstream help, nothing;
      line.root.exit(e, help, nothing);
      return say(help.str());
    }
    const UsageError error = explain(line, e);
    std::string verb;  // whose JSON it would be
    for (const CLI::App* named : line.root.get_subcommands())
      if (named->get_option_no_throw("--json")) verb = named->get_name();
    return refuse(report::badUsage(error.message), verb, error.remedy, asksForJson(argc, argv));
  }

  const Verb* verb = line.named();
  if (!verb) return say(helpOf(line.root));
  Console console(line.options, verb->app->get_name());
  const Status status = run(*verb, line.options, console);
  return status ? kExitDone : console.fail(status.error());
}

/// To standard error, past all buffers.
void cry(std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = write(STDERR_FILENO, text.data(), text.size());
    if (written <= 0) return;
    text.remove_prefix(size_t(written));
  }
}

/// Says what was thrown. There may be no memory left to say it with.
int cryFor(const std::exception_ptr& thrown) {
  try {
    if (thrown) std::rethrow_exception(thrown);
    cry("error: unexpected end\n");
  } catch (const std::bad_alloc&) {
    cry("error: out of memory\n");
  } catch (const std::exception& e) {
    cry("error: unexpected: ");
    cry(e.what());
    cry("\n");
  } catch (...) {
    cry("error: unexpected exception\n");
  }
  return kExitFailed;
}

/// Destructors of libraries allocate (nlohmann-json's values, oneTBB's global_control): where they
/// get no memory nothing can be caught any more.
[[noreturn]] void onTerminate() {
  file::AtomicFile::discardAll();
  file::TemporaryFolder::discardAll();
  _exit(cryFor(std::current_exception()));
}

}  // namespace

int main(int argc, char** argv) {
  std::set_terminate(onTerminate);
  try {
    return runTool(argc, argv);
  } catch (...) {  // before a verb began, or while its failure was being told
    return cryFor(std::current_exception());
  }
}
