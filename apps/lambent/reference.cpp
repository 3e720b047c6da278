// lambent reference SCENE --light SOURCE -o OUT.exr
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
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
#include "apps/lambent/receiver_file.h"
#include "apps/lambent/scene_arguments.h"
#include "apps/lambent/state_arguments.h"
#include "apps/lambent/transfer_arguments.h"
#include "apps/lambent/verbs.h"
#include "lambent/image/io.h"
#include "lambent/reference/path_tracer.h"
#include "lambent/sources/source.h"
#include "lambent/transport/receivers.h"

namespace lambent::tool {

namespace {

struct ReferenceRequest {
  SceneArguments scene;
  LightArguments light;
  StateArguments state;
  OutputArgument output{.extensions = {".exr", ".png", ".csv", ".ply"}};
  ViewArguments view;
  DevelopmentArguments development;
  AirArguments air;
  reference::PathTraceOptions options;
  transfer::Kind transfer = transfer::Kind::Interreflected;
  int bands = 0;
  std::optional<Vec3> eye;
  const CLI::App* app = nullptr;

  bool given(const char* option) const { return app->count(option) > 0; }
};

constexpr std::string_view kReferenceExamples = R"(
Examples:
  lambent reference bunny.obj --light sky.exr -o truth.exr --spp 256
      What a bake is measured against: radiance, and the variance of every pixel in a second layer.
  lambent reference bunny.glb --light sky.exr -o truth.exr --bands 5
      The light cut to the 5 bands that a bake of 5 bands sees: what then differs from
      'lambent render' is the error of the bake, not of the light.
  lambent reference hills.glb --light sky:sun-elevation=8 -o truth.exr --background --air
      Through the air of that sky, by the integral itself; 'render' looks it up in a table.
  lambent reference bunny.obj --view state.json -o truth.exr --bands 5
      What was set up in 'lambent view' and saved there: light and camera as the object sees them.
  lambent reference bunny.obj --light sky.exr --bands 5 -o truth.csv --spp 1024
      The truth at every vertex, to compare with what 'lambent shade' writes.
)";

/// How far the mean is from the truth, relative to it: √(Σ variance / Σ mean²), over what is
/// covered.
double estimatedError(const reference::Picture& picture) {
  double variance = 0.0, power = 0.0;
  for (std::size_t i = 0; i < picture.mean.pixels.size(); ++i) {
    if (!picture.mean.alpha.empty() && picture.mean.alpha[i] <= 0.0f) continue;
    variance += double(picture.variance.pixels[i].sum());
    power += double(picture.mean.pixels[i].square().sum());
  }
  return power > 0.0 ? std::sqrt(variance / power) : 0.0;
}

bool asksForReceivers(const std::filesystem::path& output) {
  const std::string extension = extensionOf(output);
  return extension == ".csv" || extension == ".ply";
}

/// Exit radiance at every vertex that a bake would record, in the sequence of 'lambent shade', and
/// with it what the surface emits itself, as the picture shows it.
Status traceReceivers(const ReferenceRequest& arguments, const scene::Scene& scene,
                      const trace::RayScene& rays, const light::Environment& environment,
                      Console& console) {
  // The bake's own receivers: their rays start where the bake's do.
  const auto receivers = transport::placeReceivers(scene, {}, rays.offset());
  if (!receivers) return receivers.error();
  std::vector<Rgb> emissions(receivers->size(), Rgb::Zero());
  for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
    const auto& mesh = receivers->meshes[m];
    std::fill_n(emissions.begin() + mesh.first, mesh.count,
                scene.materials[scene.meshes[m].material].emission);
  }
  std::vector<reference::Probe> probes(receivers->size());
  for (std::size_t r = 0; r < probes.size(); ++r) {
    scene::SurfacePoint& point = probes[r].point;
    point.normal = point.geometricNormal = receivers->normals[r];
    point.position = receivers->origins[r] - rays.offset() * point.normal;
    point.diffuse = receivers->diffuse[r], point.glossy = receivers->glossy[r];
    point.mirror = Rgb::Zero();
    point.lobeExponent = receivers->exponents[r];
    point.emission = emissions[r];
    probes[r].toViewer =
        arguments.eye ? Vec3((*arguments.eye - point.position).normalized()) : point.normal;
  }
  const auto estimates = reference::exitRadiance(scene, rays, environment, probes,
                                                 arguments.options, console.progress());
  if (!estimates) return estimates.error();
  ReceiverFile file;
  double variance = 0.0, power = 0.0;
  for (std::size_t i = 0; i < probes.size(); ++i) {
    const reference::Estimate& estimate = (*estimates)[i];
    file.receivers.push_back({receivers->positions[i], receivers->normals[i], estimate.mean});
    file.variances.push_back(estimate.variance);
    variance += double(estimate.variance.sum());
    power += double(estimate.mean.square().sum());
  }
  Status status =
      written(console.stage("write", [&] { return writeReceivers(file, arguments.output.path); }));
  if (!status) return status;
  const double error = power > 0.0 ? std::sqrt(variance / power) : 0.0;
  return console.finish(
      {{"output", arguments.output.path.string()},
       {"receivers", probes.size()},
       {"spp", arguments.options.samples},
       {"bounces", arguments.options.bounces},
       {"bands", arguments.bands},
       {"estimated_relative_rmse", error}},
      fmt::format("{}: {} receivers, {} paths each, {} bounces\n"
                  "estimated relative RMSE of its own noise: {:.3g}%\n",
                  arguments.output.path.string(), formatCount(probes.size()),
                  arguments.options.samples, arguments.options.bounces, 100.0 * error));
}

/// What the state says where no flag does: the material's lobe, and which transport there is.
void take(const view::ViewState& state, ReferenceRequest& arguments) {
  if (!arguments.given("--lobe")) arguments.scene.lobeExponent = state.lobe;
  if (!arguments.given("--transfer") && state.transfer) arguments.transfer = *state.transfer;
  arguments.view.background = arguments.view.background || state.background;
}

/// Camera and light in the scene's own frame. With --bands, the light's radiance is that of so many
/// bands, windowed.
Result<Shot> shotOf(const ReferenceRequest& arguments, const std::optional<view::ViewState>& state,
                    const scene::Scene& scene, Console& console) {
  Result<Shot> shot = failed("");
  if (state) {
    shot = tool::shotOf(*state, scene,
                        {arguments.view, std::max(arguments.bands, 1), arguments.scene.reading},
                        console);
    if (!shot) return shot;
  } else {
    const auto environment = arguments.light.environment(arguments.scene.reading, console);
    if (!environment) return environment.error();
    sh::RgbCoefficients light;
    if (arguments.bands > 0) {
      const auto projected = arguments.light.coefficients(*environment, arguments.bands, console);
      if (!projected) return projected.error();
      light = *projected;
    }
    scene::Camera camera;
    if (!asksForReceivers(arguments.output.path)) {
      const auto chosen = arguments.view.choose(scene);
      if (!chosen) return chosen.error();
      camera = *chosen;
    }
    shot = Shot{
        *environment, light, camera, {}, arguments.light.source, arguments.light.worldFromSource()};
  }
  if (arguments.bands > 0) shot->environment = light::Environment::harmonics(shot->light);
  return shot;
}

Status runReference(ReferenceRequest arguments, Console& console) {
  if (Status s = console.takeInput(arguments.scene.path, "SCENE"); !s) return s;
  if (Status s = console.takeInput(arguments.light.source, "--light"); !s) return s;
  if (Status s = arguments.output.take(console); !s) return s;
  const std::filesystem::path& output = arguments.output.path;
  NamedFiles files;
  files.writes("--output", output, arguments.output.extensions);
  files.reads("SCENE", arguments.scene.path);
  files.readsLight("--light", arguments.light.source);
  files.reads("--view", arguments.state.path);
  if (Status distinct = files.check(); !distinct) return distinct;
  std::optional<view::ViewState> state;
  if (arguments.state.given()) {
    const auto read = arguments.state.read(*arguments.app, arguments.light, arguments.view,
                                           arguments.development);
    if (!read) return read.error();
    take(*(state = *read), arguments);
    files.readsLight("the light of --view", state->environment);
    if (Status distinct = files.check(); !distinct) return distinct;
  }
  if (arguments.bands == 0 && arguments.light.window != "none")
    return badUsage("--window softens the bands of a light: give --bands too");
  const auto scene = arguments.scene.load(console, files);
  if (!scene) return scene.error();
  const auto shot = shotOf(arguments, state, *scene, console);
  if (!shot) return shot.error();
  const auto rays = console.stage("ray structure", [&] { return trace::RayScene::build(*scene); });
  if (!rays) return rays.error();

  reference::PathTraceOptions& options = arguments.options;
  options.shadows = arguments.transfer != transfer::Kind::Unshadowed;
  if (arguments.transfer != transfer::Kind::Interreflected) options.bounces = 0;
  options.background = arguments.view.background;
  options.threads = console.options().threads;
  const auto air =
      arguments.air.shown(*arguments.app, state ? state->air : std::optional<view::AirShown>());
  if (!air) return air.error();
  if (asksForReceivers(output)) {
    if (arguments.air.wanted) return badUsage("--air is of pictures: vertices have no viewer");
    return traceReceivers(arguments, *scene, *rays, shot->environment, console);
  }
  if (*air) {
    auto made = makeAir(**air,
                        {.shot = *shot,
                         .form = sky::AerialForm::Exact,
                         .sun = light::sunOf(shot->environment).has_value(),
                         .shaftsInsisted = arguments.given("--shafts")},
                        console);
    if (!made) return made.error();
    options.air = std::move(*made);
  }
  const auto began = std::chrono::steady_clock::now();
  auto picture =
      reference::picture(*scene, *rays, shot->environment, shot->camera, arguments.view.size.width,
                         arguments.view.size.height, options, console.progress());
  if (!picture) return picture.error();
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();

  const bool linear = extensionOf(output) == ".exr";
  const float ev = linear ? 0.0f : arguments.development.exposureFor(picture->mean);
  Status status = written(console.stage("write", [&] {
    if (linear)
      return image::write(picture->mean, output,
                          {.halfFloat = false, .layers = {{"variance", &picture->variance}}});
    return image::write(tone::toneMap(picture->mean, ev, arguments.development.curve), output);
  }));
  if (!status) return status;
  const double error = estimatedError(*picture);
  return console.finish(
      {{"output", output.string()},
       {"spp", options.samples},
       {"bounces", options.bounces},
       {"bands", arguments.bands},
       {"metres_per_unit", options.air ? nlohmann::json(options.air->metresPerUnit) : nullptr},
       {"shafts", options.air && options.air->shafts},
       {"estimated_relative_rmse", error},
       {"exposure", ev},
       {"seconds", seconds},
       {"picture", describe(picture->mean).json}},
      fmt::format("{}: {}, {} paths per pixel, {} bounces, {}\n"
                  "estimated relative RMSE of its own noise: {:.3g}%\n",
                  output.string(), formatSize(arguments.view.size), options.samples,
                  options.bounces, formatSeconds(seconds), 100.0 * error));
}

}  // namespace

Verb addReference(CLI::App& root, ConsoleOptions& common) {
  auto arguments = std::make_shared<ReferenceRequest>();
  CLI::App* app =
      root.add_subcommand("reference", "Path-trace the scene: the truth to compare with");
  arguments->app = app;
  app->group("Verbs");
  app->footer(sources::sourceHelp() + std::string(kReferenceExamples));
  arguments->scene.addTo(*app);
  arguments->scene.addSidesTo(*app);
  arguments->state.addTo(*app, arguments->light.addTo(*app, false));
  arguments->output
      .addTo(*app, "OUT.exr|.png|.csv|.ply",
             "The picture: .exr for linear radiance with a layer of variance, or .png; or .csv or "
             ".ply for the radiance of every vertex (what it emits included), with its variance")
      ->required();
  addNumber(*app, "--spp", arguments->options.samples, {1, 1 << 20},
            "Paths per pixel. Four times as many: half the noise")
      ->option_text("N")
      ->capture_default_str()
      ->group("Simulation");
  addNumber(*app, "--bounces", arguments->options.bounces, {0, 1000},
            "Bounces beyond the direct light, as in a bake")
      ->option_text("N")
      ->capture_default_str()
      ->group("Simulation");
  addChoice(*app, "--transfer", arguments->transfer, transferKinds(),
            "unshadowed, shadowed, or interreflected, as in a bake")
      ->option_text("KIND")
      ->group("Simulation");
  addNumber(*app, "--seed", arguments->options.seed, kSeeds, "Two seeds have independent noise")
      ->option_text("N")
      ->capture_default_str()
      ->group("Simulation");
  addNumber(*app, "--bands", arguments->bands, {0, 10},
            "Cut the light to this many bands, as a bake sees it; 0: the whole light")
      ->option_text("N")
      ->capture_default_str()
      ->group("Light");
  arguments->light.addWindowTo(*app);
  addParsed(*app, "--eye", arguments->eye, parsePoint,
            "With .csv and .ply: where the viewer stands. Without it every vertex is seen along "
            "its normal")
      ->option_text("X,Y,Z")
      ->group("View");
  arguments->view.addTo(*app, 32768);
  arguments->air.addTo(*app);
  arguments->development.addTo(*app);
  addCommonOptions(*app, common);
  return {app, [arguments](Console& console) { return runReference(*arguments, console); }};
}

}  // namespace lambent::tool
