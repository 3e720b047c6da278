// The verbs of the tool: each file adds its options to the command line and says what to run.
#pragma once

#include <functional>

#include "apps/lambent/console.h"
#include "lambent/report/result.h"

namespace CLI {
class App;
}

namespace lambent::tool {

/// A verb: `app` parsed its arguments if the person named it; `run` then does the work.
struct Verb {
  CLI::App* app = nullptr;
  std::function<Status(Console&)> run;
};

Verb addBake(CLI::App& root, ConsoleOptions& common);
Verb addLight(CLI::App& root, ConsoleOptions& common);
Verb addShade(CLI::App& root, ConsoleOptions& common);
Verb addRender(CLI::App& root, ConsoleOptions& common);
Verb addReference(CLI::App& root, ConsoleOptions& common);
Verb addCompare(CLI::App& root, ConsoleOptions& common);
Verb addRtt(CLI::App& root, ConsoleOptions& common);
Verb addSynthesize(CLI::App& root, ConsoleOptions& common);
Verb addView(CLI::App& root, ConsoleOptions& common);
Verb addSky(CLI::App& root, ConsoleOptions& common);
Verb addInfo(CLI::App& root, ConsoleOptions& common);
/// After all others, whose names it offers.
Verb addHelp(CLI::App& root, ConsoleOptions& common);
Verb addCompletion(CLI::App& root, ConsoleOptions& common);

}  // namespace lambent::tool
