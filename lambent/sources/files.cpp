// Lights that lie in files: environment maps of every kind, and LIGHT.json.
#include <algorithm>
#include <filesystem>
#include <numeric>

#include <fmt/format.h>

#include "lambent/file/extension.h"
#include "lambent/image/io.h"
#include "lambent/image/maps.h"
#include "lambent/image/repair.h"
#include "lambent/light/light_file.h"
#include "lambent/sources/kinds.h"
#include "lambent/sources/numbers.h"

namespace lambent::sources {
using report::badInput;

namespace {

/// An image becomes light: every pixel a radiance.
Result<Findings> makeLight(image::Image& image, const std::filesystem::path& path,
                           const SourceOptions& options) {
  Findings findings;
  std::optional<std::size_t> first;
  for (std::size_t i = 0; i < image.pixels.size() && !first; ++i)
    if (!image.pixels[i].isFinite().all()) first = i;
  const Rgb before = first ? image.pixels[*first] : Rgb(Rgb::Zero());
  const image::Repairs repairs = image::makeRadiance(image);
  if (first) {
    const std::string where = fmt::format(
        "{}: {} NaN and {} infinite channels, the first at column {}, row {} ({}, {}, {})",
        path.string(), repairs.notANumber, repairs.infinite, *first % std::size_t(image.width),
        *first / std::size_t(image.width), before[0], before[1], before[2]);
    if (options.notFinite == SourceOptions::NotFinite::Refuse)
      return badInput(where +
                      ": replace them, or write the map with 32-bit floats if they "
                      "overflowed a 16-bit file");
    findings.push_back({Severity::Warning, "light-pixels-repaired",
                        where + ": NaN became 0, infinities the largest value of the map",
                        repairs.notANumber + repairs.infinite});
  }
  if (repairs.negative > 0)
    findings.push_back(
        {Severity::Note, "light-pixels-negative",
         fmt::format("{}: {} negative channels became 0", path.string(), repairs.negative),
         repairs.negative});
  return findings;
}

/// Another kind of map becomes one in latitude and longitude, at twice its resolution so that the
/// change of grid costs nothing that can be seen.
image::Image toLatLong(const image::Image& map, image::MapKind kind) {
  constexpr int kMostRows = 4096;
  // A cube's faces, whatever their layout, are as wide as the greatest common divisor of its sides
  // and half as high as a sphere; the other maps' sides span the sphere twice over.
  const int rows = kind == image::MapKind::Cube ? 4 * std::gcd(map.width, map.height) : map.height;
  const int height = std::clamp(rows, 1, kMostRows);
  return image::resample(map, kind, {image::MapKind::LatLong, 2 * height, height});
}

/// What to write before the file's name for a picture that is no latitude-longitude map.
std::string remedyForShape(int width, int height) {
  const std::optional<image::MapKind> kind = image::guessKind(width, height);
  if (kind == image::MapKind::Cube) return "for a cube map write cube:FILE";
  if (kind == image::MapKind::Angular)
    return "for a light probe write angular:FILE, for a mirrored ball ball:FILE";
  return "resize or crop it to 2:1";
}

Result<Light> readMap(const std::filesystem::path& path, image::MapKind kind,
                      const SourceOptions& options) {
  Result<image::Image> image = image::read(path, {.memoryLimit = options.memoryLimit});
  if (!image) return image.error();
  if (kind == image::MapKind::LatLong && image->width != 2 * image->height)
    return badInput(fmt::format(
        "{}: {} x {} pixels; a latitude-longitude map is twice as wide as high: {}", path.string(),
        image->width, image->height, remedyForShape(image->width, image->height)));
  if (const Status status = image::checkShape({kind, image->width, image->height}); !status)
    return badInput(fmt::format("{}: {}", path.string(), status.error().message));
  Result<Findings> findings = makeLight(*image, path, options);
  if (!findings) return findings.error();
  if (kind != image::MapKind::LatLong) *image = toLatLong(*image, kind);
  return Light{light::Environment::latLong(std::move(*image)), std::move(*findings)};
}

Result<Light> mapOf(const Term& term, image::MapKind kind, std::string_view word,
                    const SourceOptions& options) {
  if (!term.rest || term.rest->empty())
    return usage(term.text, "the file is missing", fmt::format("{}:probe.exr", word));
  return readMap(std::string(*term.rest), kind, options);
}

}  // namespace

Result<Light> cubeMap(const Term& term, const SourceOptions& options) {
  return mapOf(term, image::MapKind::Cube, "cube", options);
}

Result<Light> angularMap(const Term& term, const SourceOptions& options) {
  return mapOf(term, image::MapKind::Angular, "angular", options);
}

Result<Light> mirrorBall(const Term& term, const SourceOptions& options) {
  return mapOf(term, image::MapKind::MirrorBall, "ball", options);
}

std::optional<Result<Light>> lightFromFile(std::string_view name, const SourceOptions& options) {
  const std::filesystem::path path{std::string(name)};
  const std::string extension = file::extensionOf(path);
  if (extension == ".json") {
    Result<sh::RgbCoefficients> light = light::readLight(path);
    if (!light) return Result<Light>(light.error());
    return Result<Light>(Light{light::Environment::harmonics(std::move(*light)), {}});
  }
  for (const std::string_view known : {".exr", ".hdr", ".png", ".jpg", ".jpeg", ".webp"})
    if (extension == known) return readMap(path, image::MapKind::LatLong, options);
  return std::nullopt;
}

}  // namespace lambent::sources
