// lambent: bakes how light moves over an asset, and relights it.

#include <CLI/CLI.hpp>
#include <array>
#include <new>
#include <optional>
#include <sstream>

#include "apps/lambent/console.h"
#include "apps/lambent/help.h"
#include "apps/lambent/interrupt.h"
#include "apps/lambent/standard_streams.h"
#include "apps/lambent/verbs.h"
#include "lambent/work/thread_limit.h"

namespace {

using namespace lambent;
using namespace lambent::tool;

Status run(const Verb& verb, const ConsoleOptions& options, Console& console) {
  std::optional<work::ThreadLimit> limit;
  if (options.threads > 0) limit.emplace(options.threads);
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
  if (!said) tell("error: " + said.error().message + '\n');
  return said ? kExitDone : kExitFailed;
}

}  // namespace

int main(int argc, char** argv) {
  secureStandardStreams();
  installInterruptHandlers();

  CLI::App root{std::string(kOverview), "lambent"};
  root.formatter(std::make_shared<HelpFormatter>());
  root.set_version_flag("--version", "lambent " LAMBENT_VERSION, "Print the version");
  root.require_subcommand(0, 1);
  root.footer(std::string(kOverviewFooter));

  ConsoleOptions options;
  const std::array verbs = {addBake(root, options),      addLight(root, options),
                            addShade(root, options),     addRender(root, options),
                            addReference(root, options), addCompare(root, options),
                            addRtt(root, options),       addSynthesize(root, options),
                            addView(root, options),      addInfo(root, options)};
  try {
    root.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() == 0) {
      std::ostringstream help, nothing;
      root.exit(e, help, nothing);
      return say(help.str());
    }
    const auto named = root.get_subcommands();
    complain(e.what(),
             named.empty() ? "lambent --help" : "lambent " + named.front()->get_name() + " --help");
    return kExitUsage;
  }

  for (const Verb& verb : verbs) {
    if (!verb.app->parsed()) continue;
    Console console(options);
    const Status status = run(verb, options, console);
    return status ? kExitDone : console.fail(status.error());
  }
  return say(root.help());
}
