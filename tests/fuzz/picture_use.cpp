#include "tests/fuzz/picture_use.h"

#include <cmath>
#include <cstring>

#include "lambent/image/io.h"
#include "lambent/image/maps.h"
#include "lambent/image/project.h"
#include "lambent/image/repair.h"
#include "lambent/light/environment.h"
#include "tests/fuzz/folder.h"

namespace lambent::fuzz {

std::optional<image::Image> pictureIn(Bytes bytes, image::Format format) {
  if (image::formatOf(bytes) != format) return std::nullopt;
  image::ReadOptions options;
  options.memoryLimit = kMemoryLimit;
  Result<image::Image> picture = image::decode(bytes, "input", options);
  if (!picture) {
    require(picture.error().kind == ErrorKind::BadInput, "a bad picture is BadInput");
    require(picture.error().message.starts_with("input"), "the message names the picture");
    return std::nullopt;
  }
  require(picture->width > 0 && picture->height > 0, "a picture has pixels");
  const std::size_t pixels = std::size_t(picture->width) * std::size_t(picture->height);
  require(picture->pixels.size() == pixels, "a picture has as many pixels as it says");
  require(picture->alpha.empty() || picture->alpha.size() == pixels, "coverage is per pixel");
  return std::move(*picture);
}

void useAsLight(image::Image picture) {
  if (picture.pixels.size() > kMostElements) return;
  (void)image::makeRadiance(picture);
  for (const Rgb& pixel : picture.pixels) {
    require(pixel.isFinite().all() && (pixel >= 0.0f).all(), "radiance is finite and above 0");
  }
  const auto kind = image::guessKind(picture.width, picture.height);
  if (!kind || !image::checkShape({*kind, picture.width, picture.height})) return;
  (void)image::project(picture, *kind, 3);
  const image::Image map = *kind == image::MapKind::LatLong
                               ? std::move(picture)
                               : image::resample(picture, *kind, {image::MapKind::LatLong, 8, 4});
  const light::Environment environment = light::Environment::latLong(map);
  (void)environment.project(3);
  const light::Environment::Sample sample = environment.sample(0.25f, 0.75f);
  require(std::abs(sample.direction.norm() - 1.0f) < 1e-3f, "a direction that is drawn is unit");
  (void)environment.radiance(sample.direction);
}

image::Image writtenAndRead(const image::Image& picture, std::string_view name) {
  const std::filesystem::path path = Folder::ofProcess() / name;
  const Status written = image::write(picture, path);
  if (!written) std::fprintf(stderr, "%s\n", written.error().message.c_str());
  require(bool(written), "a picture that was read can be written");
  Result<image::Image> again = image::read(path);
  if (!again) std::fprintf(stderr, "%s\n", again.error().message.c_str());
  require(bool(again), "a picture that was written can be read");
  return std::move(*again);
}

bool same(const image::Image& a, const image::Image& b) {
  const auto bits = [](const auto& x, const auto& y) {
    return x.size() == y.size() && (x.empty() || std::memcmp(static_cast<const void*>(x.data()),
                                                             static_cast<const void*>(y.data()),
                                                             x.size() * sizeof(x[0])) == 0);
  };
  return a.width == b.width && a.height == b.height && bits(a.pixels, b.pixels) &&
         bits(a.alpha, b.alpha);
}

void useAsTexture(Bytes bytes, bool readable) {
  file::Budget budget{kMemoryLimit};
  const Result<image::Pixels8> texels = image::decode8(bytes, "input", budget);
  // Wide pixels may be over the limit where eight bits are not.
  require(texels || !readable, "what is a picture is a texture");
  if (!texels) return;
  require(texels->rgba.size() == 4 * std::size_t(texels->width) * std::size_t(texels->height),
          "a texture has its texels");
}

}  // namespace lambent::fuzz
