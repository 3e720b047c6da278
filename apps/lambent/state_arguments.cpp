#include "apps/lambent/state_arguments.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "apps/lambent/web_lights.h"
#include "lambent/sources/source.h"
#include "lambent/view/placement.h"
#include "lambent/view/state_light.h"

namespace lambent::tool {

void StateArguments::addTo(CLI::App& app, CLI::Option* light) {
  const CLI::Option* view =
      app.add_option(
             "--view", path,
             "What was set up in a viewer and saved there: camera, light, where the object is, "
             "exposure. Options that are given besides win over it")
          ->option_text("STATE.json")
          ->group("View");
  light->required(false);
  app.parse_complete_callback([light, view] {
    if (light->count() == 0 && view->count() == 0)
      throw CLI::RequiredError("--light SOURCE (or --view STATE.json)");
  });
}

Result<view::ViewState> StateArguments::read(const CLI::App& app, const LightArguments& light,
                                             const ViewArguments& view,
                                             DevelopmentArguments& development) const {
  Result<view::ViewState> state = view::readViewState(path);
  if (!state) return state;
  state->environment = withPageLights(state->environment, path);
  if (app.count("--light")) state->environment = light.source;
  if (app.count("--rotate-y"))
    state->environmentRotation =
        view::turned({0, 0, 0, 1}, Vec3d::UnitY(), light.rotateY * kPi / 180.0);
  if (app.count("--window")) state->window = light.window;
  if (app.count("--background")) state->background = view.background;
  if (!app.count("--exposure")) development.exposure = fmt::format("{}", state->exposure);
  if (!app.count("--tone")) development.curve = state->tone;
  return state;
}

Result<Shot> shotOf(const view::ViewState& state, const scene::Scene& scene,
                    const ShotOptions& options, Console& console) {
  const ViewArguments& view = options.view;
  scene::Camera camera;
  if (view.camera.empty()) {
    camera = view::worldCamera(state, scene, float(view.size.width) / float(view.size.height));
  } else {
    const Result<scene::Camera> named = view.choose(scene);
    if (!named) return named.error();
    camera = *named;
  }
  const auto parsed = console.stage("light", [&] {
    return sources::parseSource(state.environment, options.reading.forSource(console.progress()));
  });
  if (!parsed) return parsed.error();
  if (Status whole = console.accept(parsed->findings); !whole) return whole.error();
  const light::Environment& environment = parsed->value;
  const Mat3d assetFromWorld = view::matrixOf(state.objectRotation).transpose();
  return console.stage("project", [&] {
    view::StateLight light(environment, options.bands);
    return Shot{view::assetEnvironment(state, environment),
                light.asset(state),
                view::assetCamera(state, camera),
                light.sharpSun(state),
                state.environment,
                Mat3d(assetFromWorld * view::matrixOf(state.environmentRotation)),
                -(assetFromWorld * state.objectTranslation.cast<double>()).cast<float>()};
  });
}

}  // namespace lambent::tool
