// lambent view [ASSET] [ENVIRONMENT…]
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "apps/lambent/arguments.h"
#include "apps/lambent/help.h"
#include "apps/lambent/named_files.h"
#include "apps/lambent/reading_arguments.h"
#include "apps/lambent/standard_streams.h"
#include "apps/lambent/verbs.h"
#include "apps/lambent/web_lights.h"
#include "apps/lambent/web_server.h"
#include "apps/viewer/captured_light.h"
#include "apps/viewer/viewer.h"
#include "lambent/capture/moving_scene.h"
#include "lambent/sources/source.h"

namespace lambent::tool {

namespace {

struct ViewRequest {
  std::filesystem::path asset, state, script, screenshot;
  std::vector<std::string> environments;
  Size size{1280, 800};
  std::string surroundings;
  int lightSamples = 8;
  bool hidden = false, noPanel = false;
  bool web = false, noBrowser = false;
  int port = 0;
  ReadingArguments reading;
};

constexpr std::string_view kViewExamples = R"(
Examples:
  lambent view bunny.glb sky.exr studio.exr
      E switches between the environments; ? shows what else keys and mouse do.
  lambent view bunny.glb --view state.json
      As it was when the state was saved (Ctrl+S).
  lambent view bunny.glb sky.exr --screenshot bunny.png --size 1024x1024
      Draws the picture, saves it and ends.
  lambent view bunny.glb sky.exr --web
      The same in a browser on this machine; nothing outside it can see the page.
  lambent view bunny.glb sky:date=2026-06-21,time=19:30,utc-offset=2,lat=46.2,lon=6.1
      Under that sky; its model, moment, place and air are in the panel's section Sky.
  lambent view bunny.glb --surroundings demo
      Lamps and a bar go about it, and light it from near: light is captured at 8 of its points.
  xvfb-run -a lambent view bunny.glb --script tour.txt
      A session without anybody: for tests and for pictures.

)";

/// A screenshot is a script of one line.
Result<viewer::Script> scriptFor(const std::filesystem::path& screenshot) {
  return viewer::parseScript(fmt::format("screenshot \"{}\"\n", screenshot.string()),
                             "--screenshot");
}

/// What a script reads and writes. A file that it has written itself is not one that it needs: it
/// may read it back, and write it anew.
void addFilesOf(const viewer::Script& script, NamedFiles& files) {
  using Use = viewer::ScriptFile::Use;
  std::set<std::filesystem::path> made;
  for (const viewer::ScriptFile& file : viewer::filesOf(script)) {
    const std::string name = fmt::format("{}:{}", script.name, file.line);
    if (file.use == Use::Written) files.writesLater(name, file.name);
    if (file.use == Use::Written) made.insert(std::filesystem::path(file.name).lexically_normal());
    if (made.contains(std::filesystem::path(file.name).lexically_normal())) continue;
    if (file.use == Use::Asset) files.readsAsset(name, file.name);
    if (file.use == Use::State) files.readsState(name, file.name);
    if (file.use == Use::Source) files.readsLight(name, file.name);
    if (file.use != Use::Any) continue;
    files.readsAsset(name, file.name);
    if (extensionOf(file.name) == ".json") files.readsState(name, file.name);
  }
}

Result<std::unique_ptr<viewer::Surroundings>> surroundingsOf(const ViewRequest& arguments,
                                                             NamedFiles& files, Console& console) {
  if (arguments.surroundings.empty()) return std::unique_ptr<viewer::Surroundings>();
  if (arguments.surroundings == "demo")
    return std::unique_ptr<viewer::Surroundings>(new viewer::CapturedLight(arguments.lightSamples));
  const ReadingArguments& reading = arguments.reading;
  auto loaded = capture::loadMovingScene(
      arguments.surroundings,
      {.allowOutside = reading.allowOutside, .memoryLimit = reading.memoryLimit});
  if (!loaded) return loaded.error();
  files.readsFilesOf("--surroundings", loaded->linkedFiles);
  if (Status whole = console.accept(loaded->findings); !whole) return whole.error();
  return std::unique_ptr<viewer::Surroundings>(
      new viewer::CapturedLight(std::move(loaded->scene), arguments.lightSamples));
}

Status runView(ViewRequest arguments, Console& console) {
  if (Status s = console.takeInput(arguments.asset, "ASSET"); !s) return s;
  if (arguments.web)
    return serveViewer(arguments.asset, arguments.environments, arguments.reading,
                       {.port = arguments.port, .openBrowser = !arguments.noBrowser}, console);
  viewer::ViewerOptions options;
  options.asset = arguments.asset;
  options.environments = arguments.environments;
  options.state = arguments.state;
  options.reading = arguments.reading.forAsset();
  options.findLights = withPageLights;
  options.window.size = {arguments.size.width, arguments.size.height};
  options.window.visible = !arguments.hidden;
  options.panel = !arguments.noPanel && arguments.screenshot.empty();
  Status told = Status::ok();
  Json lines = Json::array();
  options.print = [&](const std::string& line) {
    if (console.options().json)
      lines.push_back(line);
    else if (Status status = print(line + '\n'); !status)
      told = status;
  };
  NamedFiles files;
  files.writes("--screenshot", arguments.screenshot, {".png"});
  files.readsAsset("ASSET", arguments.asset);
  for (const std::string& source : arguments.environments) files.readsLight("ENVIRONMENT", source);
  files.readsState("--view", arguments.state);
  if (arguments.surroundings != "demo") files.reads("--surroundings", arguments.surroundings);
  files.reads("--script", arguments.script);
  if (Status distinct = files.check(); !distinct) return distinct;
  if (!arguments.screenshot.empty()) {
    auto script = scriptFor(arguments.screenshot);
    if (!script) return script.error();
    options.script = std::move(*script);
    options.window.visible = false;
  }
  if (!arguments.script.empty()) {
    auto script = viewer::readScript(arguments.script);
    if (!script) return script.error();
    addFilesOf(*script, files);
    options.script = std::move(*script);
  }
  auto surroundings = surroundingsOf(arguments, files, console);
  if (!surroundings) return surroundings.error();
  if (Status distinct = files.check(); !distinct) return distinct;
  options.surroundings = std::move(*surroundings);
  if (Status s = viewer::view(std::move(options)); !s) return s;
  if (!told) return told;
  if (!arguments.screenshot.empty())
    return console.finish(
        {{"output", arguments.screenshot.string()}},
        fmt::format("{}: {}\n", arguments.screenshot.string(), formatSize(arguments.size)));
  return console.finish({{"lines", std::move(lines)}}, "");
}

}  // namespace

Verb addView(CLI::App& root, ConsoleOptions& common) {
  auto arguments = std::make_shared<ViewRequest>();
  CLI::App* app =
      root.add_subcommand("view", "Relight an asset in a window, while everything moves");
  app->group("Verbs");
  app->footer(sources::sourceHelp() + std::string(kViewExamples) +
              std::string(viewer::kScriptHelp));
  app->add_option("ASSET", arguments->asset,
                  "A .glb that 'lambent bake' or 'lambent synthesize' wrote; others can be opened "
                  "in the window (O), or dropped on it");
  app->add_option("ENVIRONMENT", arguments->environments,
                  "SOURCEs of light to switch between (see below). None: a plain white sky");
  app->add_option("--view", arguments->state,
                  "A state that was saved in a viewer. Lights of it that are not in the current "
                  "folder are sought beside it, and among those of the page")
      ->option_text("STATE.json")
      ->group("View");
  addParsed(*app, "--size", arguments->size, sizesUpTo(16384),
            "Size of the window (default: 1280x800)")
      ->option_text("WIDTHxHEIGHT")
      ->group("View");
  app->add_flag("--no-panel", arguments->noPanel,
                "Begin with the picture alone; Tab shows the panel")
      ->group("View");
  CLI::Option* surroundings =
      app->add_option(
             "--surroundings", arguments->surroundings,
             "Lamps (what emits) and occluders (what does not) near the asset, whose light "
             "is captured in every frame: a scene's file, or demo for some that move")
          ->option_text("SCENE|demo")
          ->group("View");
  addNumber(*app, "--light-samples", arguments->lightSamples, {1, 64},
            "At how many points of the asset that light is captured")
      ->option_text("N")
      ->capture_default_str()
      ->needs(surroundings)
      ->group("View");
  CLI::Option* screenshot = app->add_option("--screenshot", arguments->screenshot,
                                            "Draw the picture, of --size, save it and end")
                                ->option_text("OUT.png")
                                ->group("Without anybody");
  CLI::Option* script = app->add_option("--script", arguments->script,
                                        "Run the commands of a file, and end (see below)")
                            ->option_text("FILE")
                            ->group("Without anybody");
  app->add_flag("--hidden", arguments->hidden, "Do not show the window; it still takes a display")
      ->group("Without anybody");
  script->excludes(screenshot);
  CLI::Option* web =
      app->add_flag("--web", arguments->web, "Serve a page on this machine instead of a window")
          ->group("Page");
  addNumber(*app, "--port", arguments->port, {0, 65535}, "Of the page; 0: any that is free")
      ->option_text("N")
      ->capture_default_str()
      ->needs(web)
      ->group("Page");
  app->add_flag("--no-browser", arguments->noBrowser, "Print the page's address and open nothing")
      ->needs(web)
      ->group("Page");
  web->excludes(script)->excludes(screenshot)->excludes(surroundings);
  arguments->reading.addTo(*app);
  addCommonOptions(*app, common);
  return {app, [arguments](Console& console) { return runView(*arguments, console); }};
}

}  // namespace lambent::tool
