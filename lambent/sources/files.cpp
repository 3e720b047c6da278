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
  // Of a latitude-longitude map that was stretched the finer side counts. A cube's faces, whatever their layout, are as wide as the greatest common divisor of its sides
  // and half as high as a sphere; the other maps' sides span the sphere twice over.
  const int rows = kind == image::MapKind::Cube      ? 4 * std::gcd(map.width, map.height)
                   : kind == image::MapKind::LatLong ? std::max(map.height, map.width / 2)
                                                     : map.height;
  const int height = std::clamp(rows, 1, kMostRows);
  return image::resample(map, kind, {image::MapKind::LatLong, 2 * height, height});
}

/// What to write before the file's name for a picture that is no latitude-longitude map.
std::string remedyForShape(int width, int height) {
  const std::optional<image::MapKind> kind = image::guessKind(width, height);
  if (kind == image::MapKind::Cube) return "for a cube map write cube:FILE";
  if (kind == image::MapKind::Angular)
    return "for a light probe write angular:FILE, for a mirrored ball ball:FILE";
  return "resize it to 2:1, or write latlong:FILE if it shows all directions all the same";
}

/// Whether the picture fits the kind of map; BadInput that says which kind it may be.
Status checkKind(const image::PictureFile& picture, std::optional<image::MapKind> asked,
                 image::MapKind kind, const std::string& file) {
  const int width = picture.image.width, height = picture.image.height;
  const bool stated = asked || picture.map;
  if (!stated && width != 2 * height)
    return badInput(
        fmt::format("{}: {} x {} pixels; a latitude-longitude map is twice as wide as high: {}",
                    file, width, height, remedyForShape(width, height)));
  if (const Status status = image::checkShape({kind, width, height}); !status)
    return badInput(fmt::format("{}: {}", file, status.error().message));
  return Status::ok();
}

/// What was made for a screen has lost what is brighter than it.
void tellCodes(const std::string& file, Findings& findings) {
  findings.push_back(
      {Severity::Note, "light-not-hdr",
       fmt::format("{}: made for a screen: what is brighter than white is cut off, so "
                   "that the Sun and lamps are too dim and their shadows too soft; take "
                   "an .exr or .hdr of the place if there is one",
                   file),
       1});
}

/// `asked`: the kind by the word before the file's name; nothing: what the file says, else a
/// latitude-longitude map.
Result<Light> readMap(std::string_view name, std::optional<image::MapKind> asked,
                      const SourceOptions& options) {
  const PictureName picture = pictureNameOf(name);
  const std::string file = picture.path.string();
  Result<image::PictureFile> read = image::readPicture(
      picture.path, {.memoryLimit = options.memoryLimit, .layer = picture.layer});
  if (!read) return read.error();
  const image::MapKind kind = asked ? *asked : read->map.value_or(image::MapKind::LatLong);
  if (Status fits = checkKind(*read, asked, kind, file); !fits) return fits.error();
  Result<Findings> findings = makeLight(read->image, picture.path, options);
  if (!findings) return findings.error();
  Findings all = std::move(read->findings);
  if (read->codes) tellCodes(file, all);
  all.insert(all.end(), findings->begin(), findings->end());
  const bool ready = kind == image::MapKind::LatLong && read->image.width == 2 * read->image.height;
  if (!ready) read->image = toLatLong(read->image, kind);
  return Light{light::Environment::latLong(std::move(read->image)), std::move(all)};
}

Result<Light> mapOf(const Term& term, image::MapKind kind, std::string_view word,
                    const SourceOptions& options) {
  if (!term.rest || term.rest->empty())
    return usage(term.text, "the file is missing", fmt::format("{}:probe.exr", word));
  return readMap(*term.rest, kind, options);
}

}  // namespace

PictureName pictureNameOf(std::string_view name) {
  std::error_code ignored;
  const std::filesystem::path whole{std::string(name)};
  const std::size_t colon = name.rfind(':');
  if (colon == std::string_view::npos || colon + 1 == name.size()) return {whole, {}};
  if (name.find('+', colon) != std::string_view::npos) return {whole, {}};  // a sum of terms
  const std::filesystem::path path{std::string(name.substr(0, colon))};
  if (file::extensionOf(path) != ".exr" || std::filesystem::exists(whole, ignored))
    return {whole, {}};
  return {path, std::string(name.substr(colon + 1))};
}

Result<Light> latLongMap(const Term& term, const SourceOptions& options) {
  return mapOf(term, image::MapKind::LatLong, "latlong", options);
}

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
  const std::filesystem::path path = pictureNameOf(name).path;
  const std::string extension = file::extensionOf(path);
  if (extension == ".json") {
    Result<sh::RgbCoefficients> light = light::readLight(path);
    if (!light) return Result<Light>(light.error());
    return Result<Light>(Light{light::Environment::harmonics(std::move(*light)), {}});
  }
  for (const std::string_view known : {".exr", ".hdr", ".png", ".jpg", ".jpeg", ".webp"})
    if (extension == known) return readMap(name, std::nullopt, options);
  return std::nullopt;
}

}  // namespace lambent::sources
