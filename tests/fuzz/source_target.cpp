// The text of a SOURCE. Names of files lead to a folder that has tile.png (latitude and longitude),
// cube.png, ball.png, light.json and air.json.
#include <array>
#include <cmath>
#include <vector>

#include "lambent/image/decode.h"
#include "lambent/sky/sky_request.h"
#include "lambent/sources/source.h"
#include "tests/fuzz/folder.h"

namespace lambent::fuzz {
namespace {

bool enterFolder() {
  const Folder& folder = Folder::ofProcess();
  const std::vector<std::uint8_t> grey(6 * 3, 128);
  folder.write("cube.png", image::encodePng(6, 1, 3, grey));
  folder.write("ball.png", image::encodePng(1, 1, 3, std::span(grey).first(3)));
  folder.write("light.json", std::string_view(R"({"lambent": "light", "bands": 1,
    "coefficients": [[0.5, 0.5, 0.5]]})"));
  folder.write("air.json", std::string_view(R"({"lambent": "atmosphere", "ozone_dobson": 250})"));
  std::filesystem::current_path(folder / "");
  return true;
}

}  // namespace

void source(Bytes bytes) {
  const std::string_view text = textOf(bytes);
  // A fuzzer must not read the machine's devices.
  if (text.find('/') != text.npos && text.find("..") != text.npos) return;
  for (const std::string_view root : {"/dev", "/proc", "/sys"}) {
    if (text.find(root) != text.npos) return;
  }
  static const bool entered = enterFolder();
  (void)entered;
  for (const std::string_view term : sources::sourceTerms(text)) {
    if (!term.starts_with("sky:")) continue;
    // Simulated skies and their tables take seconds: of these the words alone.
    const auto request = sky::parseRequest(term.substr(4));
    if (!request) continue;
    const auto resolved = sky::resolve(*request);
    require(!resolved || resolved->value.worldFromSun.allFinite(), "a Sun stands somewhere");
    if (request->model == sky::Model::Exact || request->model == sky::Model::Fast) return;
  }
  sources::SourceOptions options;
  options.notFinite = sources::SourceOptions::NotFinite::Repair;
  const auto light = sources::parseSource(text, options);
  if (!light) {
    require(light.error().kind == ErrorKind::BadInput || light.error().kind == ErrorKind::BadUsage,
            "a bad SOURCE is bad usage or bad input");
    return;
  }
  require(!sources::sourceTerms(text).empty(), "a light has terms");
  const light::Environment& environment = light->value;
  const sh::RgbCoefficients harmonics = environment.project(3);
  for (const float value : harmonics.values) {
    require(!std::isnan(value), "harmonics are numbers");
  }
  for (const float u : {0.0f, 0.4f, 0.999f}) {
    const light::Environment::Sample sample = environment.sample(u, 1.0f - u - 1e-4f);
    (void)environment.radiance(sample.direction);
    (void)environment.pdf(sample.direction);
  }
  (void)environment.parts();
}

}  // namespace lambent::fuzz
