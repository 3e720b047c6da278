// lambent light SOURCE -o LIGHT.json
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "apps/lambent/arguments.h"
#include "apps/lambent/describe.h"
#include "apps/lambent/help.h"
#include "apps/lambent/light_arguments.h"
#include "apps/lambent/named_files.h"
#include "apps/lambent/verbs.h"
#include "lambent/light/light_file.h"
#include "lambent/sources/source.h"

namespace lambent::tool {

namespace {

struct LightRequest {
  LightArguments light;
  std::filesystem::path output;
  int bands = 5;
  ReadingArguments reading;
};

constexpr std::string_view kLightExamples = R"(
Examples:
  lambent light sky.exr -o sky.json
      An environment image becomes 25 coefficients per channel.
  lambent light disc:30,60,0.53,40000+uniform:0.3 -o noon.json --window minimal
      A sun of the sun's size and an even sky, softened so that no direction is darker than black.
  lambent light sky.exr -o turned.json --rotate-y 90 --bands 3
)";

Status runLight(LightRequest arguments, Console& console) {
  if (Status s = console.takeInput(arguments.light.source, "SOURCE"); !s) return s;
  if (Status s = console.takeOutput(arguments.output, "-o", ".json"); !s) return s;
  NamedFiles files;
  files.writes("--output", arguments.output, {".json"});
  files.readsLight("SOURCE", arguments.light.source);
  if (Status distinct = files.check(); !distinct) return distinct;
  const auto environment = arguments.light.environment(arguments.reading, console);
  if (!environment) return environment.error();
  const auto light = arguments.light.coefficients(*environment, arguments.bands, console);
  if (!light) return light.error();
  Status status =
      written(console.stage("write", [&] { return light::writeLight(*light, arguments.output); }));
  if (!status) return status;
  const Description description = describe(*light);
  return console.finish({{"output", arguments.output.string()}, {"light", description.json}},
                        fmt::format("{}: {}", arguments.output.string(), description.text));
}

}  // namespace

Verb addLight(CLI::App& root, ConsoleOptions& common) {
  auto arguments = std::make_shared<LightRequest>();
  CLI::App* app = root.add_subcommand(
      "light", "Project a light to spherical harmonics, and write them as JSON");
  app->group("Verbs");
  app->footer(sources::sourceHelp() + std::string(kLightExamples));
  arguments->light.addTo(*app, true);
  app->add_option("-o,--output", arguments->output,
                  "The coefficients to write, a .json; - : standard output")
      ->option_text("LIGHT.json")
      ->required();
  addNumber(*app, "--bands", arguments->bands, {1, 10},
            "Bands to keep, 1 to 10: their square is how many "
            "coefficients a channel has")
      ->option_text("N")
      ->capture_default_str()
      ->group("Light");
  arguments->light.addWindowTo(*app);
  arguments->reading.addLimitTo(*app);
  addCommonOptions(*app, common);
  return {app, [arguments](Console& console) { return runLight(*arguments, console); }};
}

}  // namespace lambent::tool
