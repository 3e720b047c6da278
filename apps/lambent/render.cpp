// lambent render ASSET --light SOURCE -o OUT.png|OUT.exr
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <filesystem>
#include <memory>

#include "apps/lambent/air_arguments.h"
#include "apps/lambent/arguments.h"
#include "apps/lambent/describe.h"
#include "apps/lambent/help.h"
#include "apps/lambent/light_arguments.h"
#include "apps/lambent/named_files.h"
#include "apps/lambent/output_argument.h"
#include "apps/lambent/picture_arguments.h"
#include "apps/lambent/showing_arguments.h"
#include "apps/lambent/state_arguments.h"
#include "apps/lambent/verbs.h"
#include "lambent/asset/asset.h"
#include "lambent/image/io.h"
#include "lambent/reference/relit_picture.h"
#include "lambent/render/gl_picture.h"
#include "lambent/sources/source.h"
#include "lambent/view/placement.h"

namespace lambent::tool {

namespace {

enum class Backend { Gl, Cpu };

Choices<Backend> backends() {
  return {{"gl", Backend::Gl}, {"cpu", Backend::Cpu}};
}

struct RenderRequest {
  std::filesystem::path asset;
  OutputArgument output{.extensions = {".png", ".exr"}};
  LightArguments light;
  StateArguments state;
  ViewArguments view;
  DevelopmentArguments development;
  Backend backend = Backend::Gl;
  int samples = 16;
  ShowingArguments showing;
  AirArguments air;
  ReadingArguments reading;
  const CLI::App* app = nullptr;

  bool given(const char* option) const { return app->count(option) > 0; }
};

constexpr std::string_view kRenderExamples = R"(
Examples:
  lambent render bunny.glb --light sky.exr -o bunny.png
  lambent render bunny.glb --light sky.exr -o bunny.png --rotate-y 120 --background --size 1920x1080
  lambent render bunny.glb --light disc:45,30,20 -o bunny.png --window minimal --exposure 1.5
  lambent render bunny.glb --light sky.exr -o bunny.exr --backend cpu
      Linear radiance, to measure or to compare.
  lambent render bunny.glb --view state.json -o bunny.png --samples 64
      What was set up in 'lambent view' and saved there, as a smoother picture.
  lambent render bunny.glb --light sky:sun-elevation=20,sun-azimuth=140 -o bunny.png --background
      The sky by day, with the Sun's own sharp shadow (bake with --keep-shadowed).
  lambent render hills.glb --light sky:sun-elevation=8,turbidity=4 -o hills.png --background --air
      The same with the air of that sky before what is far away.
  lambent render bird.glb --light sky.exr -o flat.png --macro shadowed --view-dependence off
      A surface with meso-structure, without light that its shape bounces, and pasted on.
)";

/// What the flags say about a picture.
shade::PictureOptions pictureOptions(const RenderRequest& arguments) {
  shade::PictureOptions options;
  options.width = arguments.view.size.width;
  options.height = arguments.view.size.height;
  options.samples = arguments.samples;
  options.background = arguments.view.background;
  options.showing = arguments.showing.showing();
  options.showing.softLobes = arguments.light.softensLobes();
  return options;
}

/// What a state says about it, where no flag says otherwise.
shade::PictureOptions pictureOptions(const RenderRequest& arguments, const view::ViewState& state) {
  const shade::PictureOptions told = pictureOptions(arguments);
  shade::PictureOptions options = view::pictureOptions(state, told.width, told.height);
  if (arguments.given("--samples")) options.samples = told.samples;
  options.showing = arguments.showing.showing(*arguments.app, state);
  return options;
}

Result<Shot> shotOf(const RenderRequest& arguments, const asset::Asset& asset, Console& console) {
  const auto environment = arguments.light.environment(arguments.reading, console);
  if (!environment) return environment.error();
  const auto light = arguments.light.coefficients(*environment, asset.transfer.bands, console);
  if (!light) return light.error();
  const auto camera = arguments.view.choose(asset.scene);
  if (!camera) return camera.error();
  std::optional<shade::SharpSun> sun;
  if (arguments.showing.sunShadow == shade::SunShadow::Sharp)
    sun = arguments.light.sharpSun(*environment, asset.transfer.bands);
  return Shot{*environment,
              *light,
              *camera,
              std::move(sun),
              arguments.light.source,
              arguments.light.worldFromSource()};
}

Status runRender(RenderRequest arguments, Console& console) {
  if (Status s = console.takeInput(arguments.asset, "ASSET"); !s) return s;
  if (Status s = console.takeInput(arguments.light.source, "--light"); !s) return s;
  if (Status s = arguments.output.take(console); !s) return s;
  const std::filesystem::path& output = arguments.output.path;
  NamedFiles files;
  files.writes("--output", output, arguments.output.extensions);
  files.readsAsset("ASSET", arguments.asset);
  files.readsLight("--light", arguments.light.source);
  files.reads("--view", arguments.state.path);
  if (Status distinct = files.check(); !distinct) return distinct;
  std::optional<view::ViewState> state;
  if (arguments.state.given()) {
    const auto read = arguments.state.read(*arguments.app, arguments.light, arguments.view,
                                           arguments.development);
    if (!read) return read.error();
    state = *read;
    if (arguments.given("--sun-shadow")) state->sunShadow = arguments.showing.sunShadow;
    files.readsLight("the light of --view", state->environment);
    if (Status distinct = files.check(); !distinct) return distinct;
  }
  const auto asset = console.stage(
      "load", [&] { return asset::read(arguments.asset, arguments.reading.forAsset()); });
  if (!asset) return asset.error();
  const auto shot =
      state ? tool::shotOf(*state, asset->scene,
                           {arguments.view, asset->transfer.bands, arguments.reading}, console)
            : shotOf(arguments, *asset, console);
  if (!shot) return shot.error();

  shade::PictureOptions options =
      state ? pictureOptions(arguments, *state) : pictureOptions(arguments);
  if (Status s = checkHeld(*asset, options.showing, arguments.asset); !s) return s;
  options.sun = shot->sun;
  if (options.sun) console.report(shade::sharpSunFindings(*asset, options.showing));
  auto shown = arguments.air.shown(*arguments.app, state ? state->air : std::nullopt);
  if (!shown) return shown.error();
  if (*shown) {
    auto air = makeAir(**shown,
                       {.shot = *shot,
                        .form = sky::AerialForm::Table,
                        .sun = shot->sun.has_value(),
                        .shaftsInsisted = arguments.given("--shafts")},
                       console);
    if (!air) return air.error();
    options.air = std::move(*air);
  }
  const auto backend =
      arguments.backend == Backend::Gl ? &render::picture : &reference::relitPicture;
  const auto began = std::chrono::steady_clock::now();
  auto picture =
      backend(*asset, shot->light, shot->environment, shot->camera, options, console.progress());
  if (!picture) {
    if (arguments.backend == Backend::Gl && picture.error().kind == ErrorKind::Failed)
      return failed(picture.error().message + ". --backend cpu needs no OpenGL");
    return picture.error();
  }
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();

  const bool linear = extensionOf(output) == ".exr";
  // A state's exposure is for the eye: linear radiance stays as it is, to be compared.
  const bool exposed =
      !linear || (arguments.development.exposure != "auto" && arguments.given("--exposure"));
  const float ev = exposed ? arguments.development.exposureFor(*picture) : 0.0f;
  Status status = written(console.stage("write", [&] {
    if (!linear)
      return image::write(tone::toneMap(*picture, ev, arguments.development.curve), output);
    if (exposed)
      for (Rgb& pixel : picture->pixels) pixel *= std::exp2(ev);
    return image::write(*picture, output);
  }));
  if (!status) return status;
  const std::string name = wordOf(arguments.backend, backends());
  return console.finish(
      {{"output", output.string()},
       {"backend", name},
       {"exposure", ev},
       {"sun_shadow", !options.sun ? nlohmann::json() : nlohmann::json("sharp")},
       {"metres_per_unit", options.air ? nlohmann::json(options.air->metresPerUnit) : nullptr},
       {"shafts", options.air && options.air->shafts},
       {"seconds", seconds},
       {"picture", describe(*picture).json}},
      fmt::format("{}: {}, {} backend, exposure {:+.2f} EV, {}\n", output.string(),
                  formatSize(arguments.view.size), name, ev, formatSeconds(seconds)));
}

}  // namespace

Verb addRender(CLI::App& root, ConsoleOptions& common) {
  auto arguments = std::make_shared<RenderRequest>();
  CLI::App* app = root.add_subcommand("render", "Relight an asset and draw a picture");
  arguments->app = app;
  app->group("Verbs");
  app->footer(sources::sourceHelp() + std::string(kRenderExamples));
  app->add_option("ASSET", arguments->asset,
                  "A .glb that 'lambent bake' or 'lambent synthesize' wrote; - : standard input")
      ->required();
  CLI::Option* light = arguments->light.addTo(*app, false);
  arguments->state.addTo(*app, light);
  arguments->output
      .addTo(*app, "OUT.png|OUT.exr", "The picture: .png for the eye, .exr for linear radiance")
      ->required();
  arguments->view.addTo(*app, 16384);
  addChoice(*app, "--backend", arguments->backend, backends(),
            "gl (OpenGL 4.5, without a window) or cpu")
      ->option_text("NAME")
      ->group("Picture");
  addNumber(*app, "--samples", arguments->samples, {1, 4096},
            "Samples per pixel against jagged edges")
      ->option_text("N")
      ->capture_default_str()
      ->group("Picture");
  arguments->showing.addLobeTo(*app, "Picture");
  arguments->showing.addTo(*app);
  arguments->showing.addFilterTo(*app);
  arguments->showing.addSunTo(*app);
  arguments->air.addTo(*app);
  arguments->development.addTo(*app);
  arguments->light.addWindowOfAssetsTo(*app);
  arguments->reading.addTo(*app);
  addCommonOptions(*app, common);
  return {app, [arguments](Console& console) { return runRender(*arguments, console); }};
}

}  // namespace lambent::tool
