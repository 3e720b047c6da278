// LIGHT.json.
#include "lambent/light/environment.h"
#include "lambent/light/light_file.h"
#include "lambent/light/windowing.h"
#include "tests/fuzz/folder.h"

namespace lambent::fuzz {

void light(Bytes bytes) {
  const Result<sh::RgbCoefficients> light = light::parseLight(textOf(bytes), "light.json");
  if (!light) return require(light.error().kind == ErrorKind::BadInput, "a bad light is BadInput");
  const auto copy = Folder::ofProcess() / "again.json";
  const Status written = light::writeLight(*light, copy);
  if (!written) std::fprintf(stderr, "%s\n", written.error().message.c_str());
  require(bool(written), "a light that was read can be written");
  const Result<sh::RgbCoefficients> again = light::readLight(copy);
  require(again && again->bands == light->bands && again->values == light->values,
          "a light comes back as it was");

  const light::Environment environment = light::Environment::harmonics(*light);
  (void)environment.project(sh::kMaxBands);
  (void)environment.radiance(environment.sample(0.5f, 0.25f).direction);
  for (const char* window : {"minimal", "hann", "lanczos"}) {
    sh::RgbCoefficients softened = *light;
    light::soften(*light::parseWindowing(window), softened);
  }
}

}  // namespace lambent::fuzz
