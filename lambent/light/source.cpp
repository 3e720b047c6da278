// The grammar of SOURCE. Syntax errors are BadUsage and come with an example; what is wrong with a
// file is BadInput and names it.
#include "lambent/light/source.h"

#include <array>
#include <charconv>
#include <cmath>
#include <numeric>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "lambent/image/io.h"
#include "lambent/image/maps.h"
#include "lambent/image/repair.h"

namespace lambent::light {
using report::badInput;
using report::badUsage;

namespace {

constexpr std::string_view kForms =
    "A light is FILE.exr, FILE.hdr or FILE.png (a latitude-longitude map), cube:FILE, angular:FILE "
    "or ball:FILE (other maps), LIGHT.json, uniform[:RADIANCE], "
    "disc:AZIMUTH,ELEVATION,ANGULAR_DIAMETER[,RADIANCE] (degrees) or "
    "directional:AZIMUTH,ELEVATION[,IRRADIANCE], and several joined by '+' add up";

Error usage(std::string_view term, std::string_view what, std::string_view example) {
  return badUsage(fmt::format("light '{}': {}; for example {}", term, what, example));
}

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (std::size_t at = 0;;) {
    const std::size_t next = text.find(separator, at);
    parts.push_back(text.substr(at, next - at));
    if (next == std::string_view::npos) return parts;
    at = next + 1;
  }
}

std::optional<double> number(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
    return std::nullopt;
  return value;
}

/// One number or R/G/B, each from 0 to what a float can hold.
std::optional<Rgb> color(std::string_view text) {
  const std::vector<std::string_view> parts = split(text, '/');
  if (parts.size() != 1 && parts.size() != 3) return std::nullopt;
  Rgb out;
  for (std::size_t c = 0; c < 3; ++c) {
    const std::optional<double> value = number(parts[parts.size() == 1 ? 0 : c]);
    if (!value || *value < 0 || *value > 1e30) return std::nullopt;
    out[Eigen::Index(c)] = float(*value);
  }
  return out;
}

Vec3 towards(double azimuth, double elevation) {
  const double a = azimuth * kPi / 180, e = elevation * kPi / 180;
  return Vec3d(std::cos(e) * std::cos(a), std::sin(e), std::cos(e) * std::sin(a)).cast<float>();
}

constexpr std::string_view kColorRule = "is not a number from 0 up, nor R/G/B";

Result<Environment> parseUniform(std::string_view term, std::optional<std::string_view> arguments) {
  constexpr std::string_view example = "uniform:1 or uniform:0.2/0.3/0.5";
  if (!arguments) return Environment::uniform(Rgb::Ones());
  const std::optional<Rgb> radiance = color(*arguments);
  if (!radiance)
    return usage(term, fmt::format("radiance '{}' {}", *arguments, kColorRule), example);
  return Environment::uniform(*radiance);
}

/// AZIMUTH,ELEVATION[,more…] with an optional colour at the end.
struct Aimed {
  Vec3 direction;
  double diameter = 0;  ///< degrees
  Rgb color = Rgb::Ones();
};

Result<Aimed> parseAimed(std::string_view term, std::string_view arguments, bool hasDiameter,
                         std::string_view colorName, std::string_view example) {
  constexpr std::array<std::string_view, 3> names = {"azimuth", "elevation", "angular diameter"};
  const std::size_t needed = hasDiameter ? 3 : 2;
  const std::vector<std::string_view> parts = split(arguments, ',');
  if (parts.size() < needed || parts.size() > needed + 1)
    return usage(term,
                 fmt::format("it takes AZIMUTH,ELEVATION{}[,{}], and has {} value{}",
                             hasDiameter ? ",ANGULAR_DIAMETER" : "", colorName,
                             arguments.empty() ? 0 : parts.size(), parts.size() == 1 ? "" : "s"),
                 example);
  std::array<double, 3> values = {};
  for (std::size_t i = 0; i < needed; ++i) {
    const std::optional<double> value = number(parts[i]);
    if (!value)
      return usage(term, fmt::format("{} '{}' is not a number", names[i], parts[i]), example);
    values[i] = *value;
  }
  if (std::abs(values[1]) > 90)
    return usage(term, fmt::format("elevation {} is not within -90 to 90 degrees", parts[1]),
                 example);
  if (hasDiameter && !(values[2] > 0 && values[2] <= 360))
    return usage(
        term,
        fmt::format("angular diameter {} is not above 0 and up to 360 degrees (for a light "
                    "without extent write directional:AZIMUTH,ELEVATION,IRRADIANCE)",
                    parts[2]),
        example);
  Aimed aimed{.direction = towards(values[0], values[1]), .diameter = values[2]};
  if (parts.size() > needed) {
    const std::optional<Rgb> given = color(parts[needed]);
    if (!given)
      return usage(term, fmt::format("{} '{}' {}", colorName, parts[needed], kColorRule), example);
    aimed.color = *given;
  }
  return aimed;
}

Result<Environment> parseDisc(std::string_view term, std::string_view arguments) {
  const Result<Aimed> aimed = parseAimed(term, arguments, true, "RADIANCE",
                                         "disc:45,60,30 or disc:45,60,0.53,2e4/1.9e4/1.7e4");
  if (!aimed) return aimed.error();
  return Environment::disc(aimed->direction, aimed->diameter * kPi / 180, aimed->color);
}

Result<Environment> parseDirectional(std::string_view term, std::string_view arguments) {
  const Result<Aimed> aimed = parseAimed(term, arguments, false, "IRRADIANCE",
                                         "directional:45,60 or directional:45,60,3.1");
  if (!aimed) return aimed.error();
  return Environment::directional(aimed->direction, aimed->color);
}

/// An image becomes light: every pixel a radiance.
Status makeLight(image::Image& image, const std::filesystem::path& path, Findings* findings) {
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
    if (!findings)
      return badInput(where +
                      ": replace them, or write the map with 32-bit floats if they "
                      "overflowed a 16-bit file");
    findings->push_back({Severity::Warning, "light-pixels-repaired",
                         where + ": NaN became 0, infinities the largest value of the map",
                         repairs.notANumber + repairs.infinite});
  }
  if (findings && repairs.negative > 0)
    findings->push_back(
        {Severity::Note, "light-pixels-negative",
         fmt::format("{}: {} negative channels became 0", path.string(), repairs.negative),
         repairs.negative});
  return Status::ok();
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

Result<Environment> readMap(const std::filesystem::path& path, image::MapKind kind,
                            Findings* findings) {
  Result<image::Image> image = image::read(path);
  if (!image) return image.error();
  if (kind == image::MapKind::LatLong && image->width != 2 * image->height)
    return badInput(fmt::format(
        "{}: {} x {} pixels; a latitude-longitude map is twice as wide as high: {}", path.string(),
        image->width, image->height, remedyForShape(image->width, image->height)));
  if (const Status status = image::checkShape({kind, image->width, image->height}); !status)
    return badInput(fmt::format("{}: {}", path.string(), status.error().message));
  if (const Status status = makeLight(*image, path, findings); !status) return status.error();
  if (kind != image::MapKind::LatLong) *image = toLatLong(*image, kind);
  return Environment::latLong(std::move(*image));
}

struct MapPrefix {
  std::string_view text;
  image::MapKind kind;
};
constexpr MapPrefix kMapPrefixes[] = {{"cube:", image::MapKind::Cube},
                                      {"angular:", image::MapKind::Angular},
                                      {"ball:", image::MapKind::MirrorBall}};

Result<Environment> parseFile(std::string_view term, Findings* findings) {
  for (const MapPrefix& prefix : kMapPrefixes)
    if (term.starts_with(prefix.text)) {
      if (term == prefix.text)
        return usage(term, "the file is missing", fmt::format("{}probe.exr", prefix.text));
      return readMap(std::string(term.substr(prefix.text.size())), prefix.kind, findings);
    }
  const std::filesystem::path path{std::string(term)};
  std::string extension = path.extension().string();
  for (char& c : extension)
    if (c >= 'A' && c <= 'Z') c = char(c - 'A' + 'a');
  if (extension == ".json") {
    Result<sh::RgbCoefficients> light = readLight(path);
    if (!light) return light.error();
    return Environment::harmonics(std::move(*light));
  }
  for (const std::string_view known : {".exr", ".hdr", ".png", ".jpg", ".jpeg"})
    if (extension == known) return readMap(path, image::MapKind::LatLong, findings);
  return badUsage(fmt::format("light '{}': neither a kind of light nor a file that can be one. {}",
                              term, kForms));
}

Result<Environment> parseTerm(std::string_view term, Findings* findings) {
  const std::size_t colon = term.find(':');
  const std::string_view kind = term.substr(0, colon);
  std::optional<std::string_view> arguments;
  if (colon != std::string_view::npos) arguments = term.substr(colon + 1);
  if (kind == "uniform") return parseUniform(term, arguments);
  if (kind == "disc") return parseDisc(term, arguments.value_or(""));
  if (kind == "directional") return parseDirectional(term, arguments.value_or(""));
  return parseFile(term, findings);
}

/// Where the term that starts at `at` ends. A '+' may belong to an exponent (1e+3) or to a file's
/// name: the longest run of parts that names a file is one term.
std::size_t endOfTerm(std::string_view text, std::size_t at) {
  const std::string_view rest = text.substr(at);
  const bool analytic =
      rest.starts_with("uniform") || rest.starts_with("disc:") || rest.starts_with("directional:");
  std::size_t name = at;  // where the file's name begins
  for (const MapPrefix& prefix : kMapPrefixes)
    if (rest.starts_with(prefix.text)) name += prefix.text.size();
  std::size_t firstPlus = text.size(), asFile = 0;
  for (std::size_t i = name; i <= text.size(); ++i) {
    if (i < text.size() && text[i] != '+') continue;
    const bool exponent = analytic && i < text.size() && i >= at + 2 &&
                          (text[i - 1] == 'e' || text[i - 1] == 'E') &&
                          (text[i - 2] == '.' || (text[i - 2] >= '0' && text[i - 2] <= '9'));
    if (exponent) continue;
    firstPlus = std::min(firstPlus, i);
    std::error_code ignored;
    if (std::filesystem::is_regular_file(std::string(text.substr(name, i - name)), ignored))
      asFile = i;
  }
  return asFile ? asFile : firstPlus;
}

}  // namespace

std::vector<std::string_view> sourceTerms(std::string_view text) {
  std::vector<std::string_view> terms;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = endOfTerm(text, at);
    terms.push_back(text.substr(at, end - at));
    at = end + 1;
  }
  return terms;
}

Result<Environment> parseSource(std::string_view text, Findings* findings) {
  if (text.empty()) return badUsage(fmt::format("the light is empty. {}", kForms));
  std::optional<Environment> sum;
  for (const std::string_view term : sourceTerms(text)) {
    if (term.empty())
      return badUsage(
          fmt::format("light '{}': nothing stands on one side of a '+'. {}", text, kForms));
    const Result<Environment> light = parseTerm(term, findings);
    if (!light) return light.error();
    sum = sum ? *sum + *light : *light;
  }
  return *sum;
}

}  // namespace lambent::light
