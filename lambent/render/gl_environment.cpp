#include "lambent/render/gl_environment.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "lambent/light/skylight.h"
#include "lambent/math/directions.h"
#include "lambent/render/shader_sources.h"
#include "lambent/work/parallel_for.h"

namespace lambent::render {
namespace {

using light::Environment;

// Twice the usual size of such pictures, so that resampling one costs no sharpness that a curved
// mirror could show.
constexpr int kSharpWidth = 2048;
// Harmonics of ten bands and cosines: what is bilinear between 0.7° is theirs to 1/1000.
constexpr int kSmoothWidth = 512;

Texture pictureOf(const Environment& environment, int width) {
  const int height = std::max(width / 2, 1);
  std::vector<Rgb> texels(std::size_t(width) * height);
  work::parallelFor(height, [&](int y) {
    const double elevation = kPi * (0.5 - (y + 0.5) / height);
    for (int x = 0; x < width; ++x) {
      const double azimuth = 2.0 * kPi * ((x + 0.5) / width - 0.5);
      const Vec3d direction = math::directionFromAzimuthElevation(azimuth, elevation);
      texels[std::size_t(y) * width + x] = environment.radiance(direction.cast<float>());
    }
  });
  Texture texture = makeTexture(GL_RGB32F, width, height);
  glTextureSubImage2D(texture.name(), 0, 0, 0, width, height, GL_RGB, GL_FLOAT, texels.data());
  return texture;
}

/// Laid out as sampleSkylight (shaders/environment.glsl) looks it up.
void uploadSky(const light::Skylight& sky, Texture& texture) {
  constexpr int kWidth = kSmoothWidth, kHeight = kSmoothWidth / 2;
  std::vector<Rgb> texels(std::size_t(kWidth) * kHeight);
  const double horizon = sky.horizon();
  work::parallelFor(kHeight, [&](int y) {
    const double v = 1 - double(y) / (kHeight - 1);
    const double elevation = horizon + (kPi / 2 - horizon) * v * v;
    for (int x = 0; x < kWidth; ++x)
      texels[std::size_t(y) * kWidth + x] = sky.radiance(
          math::directionFromAzimuthElevation(2.0 * kPi * ((x + 0.5) / kWidth - 0.5), elevation));
  });
  // A sky that changes from frame to frame keeps its texture.
  if (!texture.name()) texture = makeTexture(GL_RGB32F, kWidth, kHeight);
  glTextureSubImage2D(texture.name(), 0, 0, 0, kWidth, kHeight, GL_RGB, GL_FLOAT, texels.data());
}

}  // namespace

std::string environmentSource() {
  return std::string(shaderSource("environment.glsl")) +
         std::string(shaderSource("environment_maps.glsl"));
}

Status GlEnvironment::set(const Environment& environment, int largestTexture) {
  Environment::Parts parts = environment.parts();
  Environment rest;
  bool sharp = false;
  const bool any = !parts.others.empty();
  for (const Environment& other : parts.others) rest = rest + other;
  for (std::size_t k = 0; k < parts.images.size();) {
    const Environment::Parts::LatLong& part = parts.images[k];
    const bool fits = part.image->width <= largestTexture && part.image->height <= largestTexture;
    if (k == 0 && fits) {
      ++k;
      continue;
    }
    rest = rest + Environment::latLong(*part.image).rotated(part.worldFromImage);
    sharp = true;
    parts.images.erase(parts.images.begin() + std::ptrdiff_t(k));
  }
  for (; parts.discs.size() > kMostDiscs; sharp = true) {
    rest = rest + Environment::disc(parts.discs.back());
    parts.discs.pop_back();
  }

  Texture made;
  if (any || sharp)
    made = pictureOf(rest, std::min(sharp ? kSharpWidth : kSmoothWidth, largestTexture));
  rest_ = std::move(made);
  if (parts.images.empty()) {
    picture_ = Texture();
    uploaded_.reset();
  } else if (const auto& image = parts.images.front().image; image != uploaded_) {
    picture_ = makeTexture(GL_RGB32F, image->width, image->height);
    glTextureSubImage2D(picture_.name(), 0, 0, 0, image->width, image->height, GL_RGB, GL_FLOAT,
                        image->pixels.data());
    uploaded_ = image;
  }
  if (!parts.sky) {
    sky_ = Texture();
    skyUploaded_.reset();
  } else if (const auto& light = parts.sky->light; light != skyUploaded_) {
    uploadSky(*light, sky_);
    skyUploaded_ = light;
  }
  parts.others.clear();
  parts_ = std::move(parts);
  return checkGl("uploading the environment");
}

void GlEnvironment::bind(const Program& program, const Mat3& environmentFromWorld) const {
  program.setMatrix("environmentFromWorld", environmentFromWorld);
  program.set("everywhere", parts_.uniform[0], parts_.uniform[1], parts_.uniform[2]);
  program.set("hasPicture", int(!parts_.images.empty()));
  program.set("hasRest", int(rest_.name() != 0));
  if (!parts_.images.empty())
    program.setMatrix("pictureFromEnvironment",
                      Mat3(parts_.images.front().worldFromImage.transpose()));
  program.set("hasSky", int(parts_.sky.has_value()));
  if (parts_.sky) {
    const Vec3 up = parts_.sky->worldFromSky.col(1);
    program.setMatrix("skylightFromEnvironment", Mat3(parts_.sky->worldFromSky.transpose()));
    program.set("skylightHorizon", up.x(), up.y(), up.z(), float(parts_.sky->horizon));
  }
  program.set("discCount", int(parts_.discs.size()));
  for (std::size_t k = 0; k < parts_.discs.size(); ++k) {
    const auto& disc = parts_.discs[k];
    program.set(fmt::format("discs[{}]", k).c_str(), disc.axis.x(), disc.axis.y(), disc.axis.z(),
                float(disc.versine));
    program.set(fmt::format("discRadiances[{}]", k).c_str(), disc.radiance[0], disc.radiance[1],
                disc.radiance[2]);
    program.set(fmt::format("discDarkenings[{}]", k).c_str(), disc.darkening[0], disc.darkening[1],
                disc.darkening[2]);
    program.set(fmt::format("discHorizons[{}]", k).c_str(), disc.up.x(), disc.up.y(), disc.up.z(),
                float(disc.horizon));
  }
  glBindTextureUnit(1, picture_.name());
  glBindTextureUnit(2, rest_.name());
  glBindTextureUnit(3, sky_.name());
}

}  // namespace lambent::render
