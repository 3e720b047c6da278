#include "apps/lambent/picture_arguments.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>

#include "lambent/radiometry/luminance.h"
#include "lambent/scene/camera.h"

namespace lambent::tool {

void ViewArguments::addTo(CLI::App& app, int mostPixels) {
  addParsed(app, "--size", size, sizesUpTo(mostPixels),
            "Size of the picture in pixels (default: 1024x1024)")
      ->option_text("WIDTHxHEIGHT")
      ->group("Picture");
  app.add_option("--camera", camera,
                 "A camera of the file, by name or number; auto frames the whole scene. Without "
                 "it: the file's first camera, or auto")
      ->option_text("NAME")
      ->group("Picture");
  app.add_flag("--background", background, "Show the environment behind the object")
      ->group("Picture");
}

Result<scene::Camera> ViewArguments::choose(const scene::Scene& scene) const {
  const float aspect = float(size.width) / float(size.height);
  if (camera == "auto" || (camera.empty() && scene.cameras.empty()))
    return scene::frameAutomatically(scene, aspect);
  if (camera.empty()) return scene.cameras.front();
  for (const scene::Camera& each : scene.cameras)
    if (each.name == camera) return each;
  const Result<double> number = parseNumber(
      camera, {.least = 0.0, .most = double(scene.cameras.size()) - 1.0, .whole = true});
  if (number) return scene.cameras[size_t(*number)];
  std::vector<std::string> names = {"auto"};
  for (const scene::Camera& each : scene.cameras)
    names.push_back(each.name.empty() ? std::to_string(&each - scene.cameras.data()) : each.name);
  return noSuch("--camera", camera, "camera", names);
}

void DevelopmentArguments::addTo(CLI::App& app) {
  app.add_option("--exposure", exposure,
                 "Exposure in EV, each step twice as bright, or auto. EXR pictures stay linear and "
                 "take an exposure only when one is given as a number")
      ->check([](const std::string& text) -> std::string {
        if (text == "auto") return "";
        const Result<double> number = parseNumber(text, kExposures);
        return number ? "" : number.error().message + ", nor auto";
      })
      ->option_text("EV|auto")
      ->capture_default_str()
      ->group("Development");
  addChoice(app, "--tone", curve,
            {{"filmic", tone::Curve::Filmic}, {"linear", tone::Curve::Linear}},
            "Tone curve of PNG pictures: filmic or linear")
      ->option_text("CURVE")
      ->group("Development");
}

float DevelopmentArguments::exposureFor(const image::Image& picture) const {
  const Result<double> number = parseNumber(exposure, kExposures);
  return number ? float(*number) : automaticExposure(picture);
}

namespace {
constexpr double kKey =
    0.25;  // brighter than the usual 0.18: an object fills the picture, not a view
}

float automaticExposure(const image::Image& picture) {
  double sum = 0.0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
    const float y = radiometry::luminance(picture.pixels[i]);
    const bool covered = picture.alpha.empty() || picture.alpha[i] > 0.0f;
    if (!covered || !(y > 0.0f) || !std::isfinite(y)) continue;
    sum += std::log2(double(y));
    ++count;
  }
  if (count == 0) return 0.0f;
  return float(std::log2(kKey) - sum / double(count));
}

}  // namespace lambent::tool
