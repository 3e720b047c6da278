// 2. Light: environments, what a few bands keep of them, and what windowing is for.
//
// usage: 02_project_a_light [SOURCE]     as on the command line: sky.exr, disc:30,45,20+uniform:0.2
#include <lambent/light/environment.h>
#include <lambent/light/irradiance.h>
#include <lambent/sh/basis.h>
#include <lambent/sh/window.h>
#include <lambent/sources/source.h>

#include <cstdio>

using namespace lambent;

namespace {

/// The darkest that the reconstructed light gets along a great circle through the zenith.
float darkest(const sh::RgbCoefficients& light) {
  float lowest = 1e30f;
  for (int degrees = 0; degrees < 360; ++degrees) {
    const float a = float(degrees * kPi / 180.0);
    lowest = std::min(lowest, sh::reconstruct(light, Vec3(std::cos(a), std::sin(a), 0)).mean());
  }
  return lowest;
}

}  // namespace

int main(int argc, char** argv) {
  // Whatever enters from outside comes as a Result: test it, then use it.
  const auto environment = sources::parseSource(argc > 1 ? argv[1] : "disc:0,60,20,10");
  if (!environment) {
    std::fprintf(stderr, "%s\n", environment.error().message.c_str());
    return 1;
  }

  std::printf("bands  mean radiance  darkest direction\n");
  for (const int bands : {3, 5, 7, 9}) {
    const sh::RgbCoefficients light = environment->value.project(bands);
    std::printf("%5d  %13.5f  %+.4f\n", bands, light.channel(1)[0] * 0.28209479f, darkest(light));
  }

  // A small light rings: with few bands, directions beside it come out darker than black. A window
  // fades the highest bands out; `minimalRinging` finds the least that keeps radiance positive.
  sh::RgbCoefficients light = environment->value.project(5);
  const float before = darkest(light);
  sh::applyWindow(sh::minimalRinging(light), light);
  const float after = darkest(light);
  std::printf("5 bands, darkest direction: %+.4f, windowed %+.4f\n", before, after);

  // Diffuse surfaces without shadows need nine coefficients only (Ramamoorthi and Hanrahan 2001):
  // irradiance is a quadratic polynomial in the normal, one 4×4 matrix for each channel.
  const light::IrradianceMap map = light::irradianceMap(environment->value.project(3));
  std::printf("irradiance on the ground: %.4f, on a ceiling: %.4f\n",
              map.evaluate(Vec3(0, 1, 0))[1], map.evaluate(Vec3(0, -1, 0))[1]);
  return after >= before && after > -1e-3f ? 0 : 1;
}
