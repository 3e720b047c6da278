#include "apps/lambent/light_arguments.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <Eigen/Geometry>

#include "apps/lambent/numbers.h"
#include "lambent/light/windowing.h"
#include "lambent/sources/source.h"

namespace lambent::tool {

CLI::Option* LightArguments::addTo(CLI::App& app, bool positional) {
  const std::string text = "The light: any SOURCE (see below), or - for a file on standard input";
  CLI::Option* option = positional ? app.add_option("SOURCE", source, text)
                                   : app.add_option("--light", source, text)->option_text("SOURCE");
  option->required();
  // What a float tells apart after the turn, to a tenth of a degree.
  addNumber(app, "--rotate-y", rotateY, {-1e6, 1e6},
            "Turn the light about the vertical, counter-clockwise seen from above")
      ->option_text("DEGREES")
      ->group("Light");
  return option;
}

namespace {

void addWindow(CLI::App& app, std::string& window, const std::string& text, bool knowsLobes) {
  app.add_option("--window", window, text)
      ->check([knowsLobes](const std::string& given) -> std::string {
        const auto parsed = light::parseWindowing(given);
        if (!parsed) return parsed.error().message;
        if (!knowsLobes && light::softensLobes(given))
          return "auto is of 'lambent render' and 'lambent shade': it softens how glossy surfaces "
                 "show a light, not the light";
        return "";
      })
      ->option_text("WINDOW")
      ->capture_default_str()
      ->group("Light");
}

const std::string kWindows =
    "hann:WIDTH or lanczos:WIDTH in bands, minimal (the least that keeps radiance from falling "
    "below zero), or none";

}  // namespace

void LightArguments::addWindowOfAssetsTo(CLI::App& app) {
  window = "auto";
  addWindow(
      app, window,
      "Against ringing. auto: glossy surfaces, and how they see the light, are softened by the "
      "least that leaves no dark rings; diffuse ones see it whole. Or soften the light's highest "
      "bands for all: " +
          kWindows + " (to compare with other renderers)",
      true);
}

void LightArguments::addWindowTo(CLI::App& app) {
  addWindow(app, window, "Soften the highest bands against ringing: " + kWindows, false);
}

bool LightArguments::softensLobes() const {
  return light::softensLobes(window);
}

Mat3d LightArguments::worldFromSource() const {
  return Eigen::AngleAxisd(rotateY * kPi / 180.0, Vec3d::UnitY()).toRotationMatrix();
}

Result<light::Environment> LightArguments::environment(const ReadingArguments& reading,
                                                       Console& console) const {
  auto parsed = console.stage(
      "light", [&] { return sources::parseSource(source, reading.forSource(console.progress())); });
  if (!parsed) return parsed.error();
  if (Status whole = console.accept(parsed->findings); !whole) return whole.error();
  if (rotateY == 0.0) return std::move(parsed->value);
  return parsed->value.rotated(worldFromSource().cast<float>());
}

Result<sh::RgbCoefficients> LightArguments::coefficients(const light::Environment& environment,
                                                         int bands, Console& console) const {
  const auto parsed = light::parseWindowing(window);
  if (!parsed) return parsed.error();
  return console.stage("project", [&]() -> Result<sh::RgbCoefficients> {
    sh::RgbCoefficients light = environment.project(bands);
    light::soften(*parsed, light);
    return light;
  });
}

std::optional<shade::SharpSun> LightArguments::sharpSun(const light::Environment& environment,
                                                        int bands) const {
  const auto parsed = light::parseWindowing(window);
  if (!parsed || !light::sunOf(environment)) return std::nullopt;
  return shade::sharpSunOf(environment, light::windowOf(*parsed, environment.project(bands)));
}

}  // namespace lambent::tool
