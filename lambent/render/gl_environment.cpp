#include "lambent/render/gl_environment.h"

#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>

namespace lambent::render {

// Twice the usual size of such pictures, so that resampling one costs no sharpness that a curved
// mirror could show.
constexpr int kWidth = 2048, kHeight = 1024;

Result<GlEnvironment> GlEnvironment::make(const light::Environment& environment,
                                          int largestTexture) {
  const int width = std::min(kWidth, largestTexture), height = std::min(kHeight, largestTexture);
  std::vector<float> texels(std::size_t(width) * height * 4, 1.0f);
  tbb::parallel_for(0, height, [&](int y) {
    const double elevation = kPi * (0.5 - (y + 0.5) / height);
    for (int x = 0; x < width; ++x) {
      const double azimuth = 2.0 * kPi * ((x + 0.5) / width - 0.5);
      const Vec3d direction(std::cos(elevation) * std::cos(azimuth), std::sin(elevation),
                            std::cos(elevation) * std::sin(azimuth));
      const Rgb radiance = environment.radiance(direction.cast<float>());
      for (int c = 0; c < 3; ++c) texels[(std::size_t(y) * width + x) * 4 + c] = radiance[c];
    }
  });
  GlEnvironment made;
  made.picture_ = makeTexture(GL_RGBA32F, width, height);
  glTextureSubImage2D(made.picture_.name(), 0, 0, 0, width, height, GL_RGBA, GL_FLOAT,
                      texels.data());
  if (Status s = checkGl("uploading the environment"); !s) return s.error();
  return made;
}

void GlEnvironment::bind(const Program& program, const Mat3& environmentFromWorld) const {
  program.setMatrix("environmentFromWorld", environmentFromWorld);
  glBindTextureUnit(1, picture_.name());
}

}  // namespace lambent::render
