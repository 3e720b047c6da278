#include "apps/lambent/light_arguments.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <Eigen/Geometry>

#include "apps/lambent/arguments.h"
#include "lambent/light/source.h"
#include "lambent/sh/window.h"

namespace lambent::tool {

namespace {

struct Window {
  std::string kind;
  double width = 0.0;  ///< 0: as many as the bands
};

Result<Window> parseWindow(std::string_view text) {
  const std::size_t colon = text.find(':');
  Window window{std::string(text.substr(0, colon)), 0.0};
  const bool hasWidth = window.kind == "hann" || window.kind == "lanczos";
  const bool known = hasWidth || window.kind == "minimal" || window.kind == "none";
  if (!known || (colon != text.npos && !hasWidth))
    return badUsage(fmt::format(
        "'{}' is not a window: write none, minimal, hann:WIDTH or lanczos:WIDTH", text));
  if (colon != text.npos) {
    const Result<double> width = parseNumber(text.substr(colon + 1));
    if (!width || *width <= 0.0)
      return badUsage(fmt::format("'{}': the width must be a number above 0", text));
    window.width = *width;
  }
  return window;
}

}  // namespace

void LightArguments::addTo(CLI::App& app, bool positional) {
  const std::string text =
      "The light: an image, a LIGHT.json, uniform, disc:… or a sum (see below)";
  (positional ? app.add_option("SOURCE", source, text)
              : app.add_option("--light", source, text)->option_text("SOURCE"))
      ->required();
  app.add_option("--rotate-y", rotateY,
                 "Turn the light about the vertical, counter-clockwise seen from above")
      ->option_text("DEGREES")
      ->capture_default_str()
      ->group("Light");
}

void LightArguments::addWindowTo(CLI::App& app) {
  app.add_option("--window", window,
                 "Soften the highest bands against ringing: hann:WIDTH or lanczos:WIDTH in bands, "
                 "minimal (the least that keeps radiance from falling below zero), or none")
      ->check([](const std::string& given) -> std::string {
        const Result<Window> parsed = parseWindow(given);
        return parsed ? "" : parsed.error().message;
      })
      ->option_text("WINDOW")
      ->capture_default_str()
      ->group("Light");
}

Result<light::Environment> LightArguments::environment(Console& console) const {
  auto parsed = console.stage("light", [&] { return light::parseSource(source); });
  if (!parsed || rotateY == 0.0) return parsed;
  const float angle = float(rotateY * kPi / 180.0);
  return parsed->rotated(Eigen::AngleAxisf(angle, Vec3::UnitY()).toRotationMatrix());
}

Result<sh::RgbCoefficients> LightArguments::coefficients(const light::Environment& environment,
                                                         int bands, Console& console) const {
  const Result<Window> parsed = parseWindow(window);
  if (!parsed) return parsed.error();
  return console.stage("project", [&]() -> Result<sh::RgbCoefficients> {
    sh::RgbCoefficients light = environment.project(bands);
    const double width = parsed->width > 0.0 ? parsed->width : double(bands);
    if (parsed->kind == "hann") sh::applyWindow(sh::hann(bands, width), light);
    if (parsed->kind == "lanczos") sh::applyWindow(sh::lanczos(bands, width), light);
    if (parsed->kind == "minimal") sh::applyWindow(sh::minimalRinging(light), light);
    return light;
  });
}

}  // namespace lambent::tool
