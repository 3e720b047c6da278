#include "apps/lambent/sky_arguments.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>

#include "lambent/file/atomic_file.h"

namespace lambent::tool {

namespace {

constexpr int kDay = 24 * 3600;
constexpr int kMostFrames = 10000, kMostWavelengths = 401;
constexpr NumberRange kAzimuths = {-360, 360}, kElevations = {-90, 90};
constexpr NumberRange kWavelengths = {340, 740};

Choices<sky::PictureMap> maps() {
  return {{"lat-long", sky::PictureMap::LatLong},
          {"fisheye", sky::PictureMap::Fisheye},
          {"cube", sky::PictureMap::Cube},
          {"camera", sky::PictureMap::Camera}};
}

Choices<sky::Quantity> quantities() {
  return {{"radiance", sky::Quantity::Radiance},
          {"luminance", sky::Quantity::Luminance},
          {"spectral", sky::Quantity::Spectral},
          {"xyzv", sky::Quantity::Xyzv}};
}

std::vector<std::string_view> parts(std::string_view text) {
  std::vector<std::string_view> all;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find(',', at), text.size());
    all.push_back(text.substr(at, end - at));
    at = end + 1;
  }
  return all;
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && std::string_view(" \t\r").find(text.front()) != text.npos)
    text.remove_prefix(1);
  while (!text.empty() && std::string_view(" \t\r").find(text.back()) != text.npos)
    text.remove_suffix(1);
  return text;
}

Result<AtArguments::Direction> parseAt(std::string_view text) {
  const auto two = parts(text);
  if (two.size() != 2)
    return badUsage(fmt::format(
        "'{}' is not AZIMUTH,ELEVATION: write two numbers in degrees, as in 90,45", text));
  const auto azimuth = parseNumber(trimmed(two[0]), kAzimuths);
  const auto elevation = parseNumber(trimmed(two[1]), kElevations);
  if (!azimuth) return badUsage(fmt::format("'{}': {}", text, azimuth.error().message));
  if (!elevation) return badUsage(fmt::format("'{}': {}", text, elevation.error().message));
  return AtArguments::Direction{*azimuth, *elevation};
}

Result<Vec2> parseLook(std::string_view text) {
  const auto direction = parseAt(text);
  if (!direction) return direction.error();
  return Vec2(float(direction->azimuth), float(direction->elevation));
}

Result<std::vector<double>> parseWavelengths(std::string_view text) {
  std::vector<double> wavelengths;
  for (const std::string_view part : parts(text)) {
    const auto value = parseNumber(part, kWavelengths);
    if (!value) return badUsage(fmt::format("'{}': {}, in nm", text, value.error().message));
    if (!wavelengths.empty() && *value <= wavelengths.back())
      return badUsage(fmt::format("'{}': wavelengths must rise, and {} does not", text, part));
    wavelengths.push_back(*value);
  }
  if (wavelengths.size() > kMostWavelengths)
    return badUsage(fmt::format("'{:.20}…' has {} wavelengths, and the most are {}", text,
                                wavelengths.size(), kMostWavelengths));
  return wavelengths;
}

Result<MapArguments::Sides> parseSides(std::string_view text) {
  const Result<Size> size = parseSize(text, 16384);
  if (!size) return size.error();
  if (text.find_first_of("xX") == text.npos) return MapArguments::Sides{size->width, std::nullopt};
  return MapArguments::Sides{size->width, size->height};
}

/// Seconds of the day, up to 24:00.
std::optional<int> parseClock(std::string_view text) {
  const auto two = [&](std::size_t at) -> std::optional<int> {
    if (at + 2 > text.size()) return std::nullopt;
    const char a = text[at], b = text[at + 1];
    if (a < '0' || a > '9' || b < '0' || b > '9') return std::nullopt;
    return 10 * (a - '0') + (b - '0');
  };
  const bool seconds = text.size() == 8;
  if ((text.size() != 5 && !seconds) || text[2] != ':' || (seconds && text[5] != ':'))
    return std::nullopt;
  const auto h = two(0), m = two(3), s = seconds ? two(6) : std::optional<int>(0);
  if (!h || !m || !s || *m > 59 || *s > 59) return std::nullopt;
  const int all = *h * 3600 + *m * 60 + *s;
  return all <= kDay ? std::optional<int>(all) : std::nullopt;
}

/// "2026-06-21" so many days later; what is no date stays as it is, for others to refuse.
std::string daysLater(const std::string& date, int days) {
  int year = 0;
  unsigned month = 0, day = 0;
  if (days == 0 || std::sscanf(date.c_str(), "%d-%u-%u", &year, &month, &day) != 3) return date;
  using namespace std::chrono;
  const year_month_day from{std::chrono::year(year), std::chrono::month(month),
                            std::chrono::day(day)};
  if (!from.ok()) return date;
  const year_month_day to = sys_days(from) + std::chrono::days(days);
  return fmt::format("{:04}-{:02}-{:02}", int(to.year()), unsigned(to.month()), unsigned(to.day()));
}

}  // namespace

void SkyArguments::addTo(CLI::App& app) {
  for (const sky::RequestKey& key : sky::requestKeys()) {
    const std::string name = "--" + std::string(key.key);
    app.add_option_function<std::string>(
           name,
           [this, &key, name](const std::string& text) {
             const Status set = key.set(request, text);
             if (!set) throw CLI::ValidationError(name, set.error().message);
             given.emplace_back(key.key, text);
           },
           std::string(key.help))
        ->option_text(std::string(key.syntax))
        ->group(std::string(key.group));
  }
}

std::string SkyArguments::inWords() const {
  std::string words;
  for (const auto& [key, value] : given)
    words += fmt::format("{}{}={}", words.empty() ? "" : ",", key, value);
  return words;
}

std::filesystem::path SkyArguments::file() const {
  if (sky::preset(request.atmosphere)) return {};
  return request.atmosphere;
}

void SequenceArguments::addTo(CLI::App& app) {
  addParsed(app, "--sequence", span, parseSpan,
            "Instead of --time: a picture, or a set of rows, every so many minutes of a day. "
            "OUT.png becomes OUT-0001.png, OUT-0002.png, …; an end before the beginning is on the "
            "next day. Moments of night (Sun below -18°) are left out")
      ->option_text("FROM,TO[,MINUTES]")
      ->group("Sequence");
  addNumber(app, "--frames", frames, {1, kMostFrames},
            "So many moments, evenly from FROM to TO, instead of MINUTES")
      ->option_text("N")
      ->group("Sequence");
}

Result<std::vector<sky::SkyRequest>> SequenceArguments::moments(
    const sky::SkyRequest& request) const {
  if (!span) {
    if (frames) return badUsage("--frames says how many moments --sequence has: give it as well");
    return std::vector<sky::SkyRequest>{request};
  }
  if (request.time) return badUsage("--sequence takes the place of --time: give one of them");
  if (!request.date) return badUsage("--sequence needs the day: give --date, and a place");
  if (span->step.has_value() == frames.has_value())
    return badUsage(
        "--sequence FROM,TO,MINUTES, or --sequence FROM,TO with --frames N: one of them says how "
        "many moments there are");
  const int length = span->to - span->from + (span->to <= span->from ? kDay : 0);
  const double step =
      frames ? (*frames > 1 ? double(length) / (*frames - 1) : length) : *span->step * 60;
  const double count = frames ? *frames : std::floor(length / step + 1e-9) + 1;
  if (count > kMostFrames)
    return badUsage(
        fmt::format("--sequence has {:.0f} moments, and the most are {}: take longer steps", count,
                    kMostFrames));
  std::vector<sky::SkyRequest> moments;
  for (int i = 0; i < int(count); ++i) {
    const int at = int(std::lround(span->from + i * step));
    const int second = at % kDay;
    sky::SkyRequest& moment = moments.emplace_back(request);
    moment.date = daysLater(*request.date, at / kDay);
    moment.time = fmt::format("{:02}:{:02}:{:02}", second / 3600, second / 60 % 60, second % 60);
  }
  return moments;
}

Result<SequenceArguments::Span> parseSpan(std::string_view text) {
  const auto three = parts(text);
  const auto wrong = [&](std::string_view why) {
    return badUsage(
        fmt::format("'{}' {}: write FROM,TO or FROM,TO,MINUTES, as in 04:00,22:00,10", text, why));
  };
  if (three.size() < 2 || three.size() > 3) return wrong("is no sequence");
  const auto from = parseClock(three[0]), to = parseClock(three[1]);
  if (!from || !to) return wrong("has no times of a day, 00:00 to 24:00");
  SequenceArguments::Span span{*from, *to, std::nullopt};
  if (three.size() == 3) {
    const auto step = parseNumber(three[2], {1.0 / 60, 1440});
    if (!step) return wrong("has no step: " + step.error().message);
    span.step = *step;
  }
  return span;
}

std::filesystem::path framePath(const std::filesystem::path& path, std::size_t number,
                                std::size_t count) {
  const std::size_t digits = std::max<std::size_t>(4, std::to_string(count).size());
  std::filesystem::path frame = path;
  frame.replace_filename(
      fmt::format("{}-{:0{}}{}", path.stem().string(), number, digits, path.extension().string()));
  return frame;
}

void MapArguments::addTo(CLI::App& app) {
  addChoice(app, "--map", map, maps(),
            "lat-long (as environment images are: north at a quarter of the width, east in the "
            "middle), fisheye (zenith in the centre, north up, EAST TO THE LEFT, as one sees the "
            "sky from below), cube (OpenGL's faces in a cross, row or column), or camera (see "
            "--look)")
      ->option_text("NAME")
      ->group("Picture");
  addParsed(app, "--size", size, parseSides,
            "Size of the picture in pixels; a width alone gets the height of its map (default: "
            "2048x1024, of a fisheye 1024x1024, of a cube 1024x768, of a camera 1280x720)")
      ->option_text("WIDTHxHEIGHT")
      ->group("Picture");
  addParsed(app, "--look", look, parseLook,
            "Where the camera looks, in degrees: compass bearing (north 0, east 90) and elevation "
            "(default: to the Sun's bearing, 15 above the horizon)")
      ->option_text("BEARING,ELEVATION")
      ->group("Picture");
  addNumber(app, "--fov", fov, {0.01, 170}, "Vertical field of view of the camera (default: 60)")
      ->option_text("DEGREES")
      ->group("Picture");
  addChoice(app, "--quantity", quantity, quantities(),
            "radiance (R, G, B in W/m²/sr: 683.002 (.2126 R + .7152 G + .0722 B) is cd/m²), "
            "luminance (Y, cd/m²), spectral (a channel for each of --wavelengths, W/m²/sr/nm), or "
            "xyzv (X, Y, Z in cd/m² and scotopic V)")
      ->option_text("KIND")
      ->group("Picture");
  app.add_option_function<std::string>(
         "--sun", [this](const std::string& word) { sun = word == "on"; },
         "Whether the Sun's disc is drawn, at its exact energy (default: on in a camera's picture "
         "and in every .png; off in other maps, whose light 'sky:' adds to a Sun of its own, and "
         "off for --at)")
      ->check(CLI::IsMember({"on", "off"}))
      ->option_text("on|off")
      ->group("Picture");
}

Result<sky::PictureShape> MapArguments::shape() const {
  using sky::PictureMap;
  sky::PictureShape shape;
  shape.map = map;
  if (map != PictureMap::Camera && (look || fov))
    return badUsage(fmt::format("{} is of --map camera: a {} shows all of the sky",
                                look ? "--look" : "--fov", nameOf(map)));
  const int defaults[] = {2048, 1024, 1024, 1280};
  shape.width = size ? size->width : defaults[std::size_t(map)];
  const int w = shape.width;
  const int heights[] = {w / 2, w, w / 4 * 3, int(std::lround(w * 9.0 / 16))};
  shape.height = size && size->height ? *size->height : heights[std::size_t(map)];
  const double degree = kPi / 180;
  if (fov) shape.verticalFov = *fov * degree;
  if (look) {
    shape.lookBearing = double(look->x()) * degree;
    shape.lookElevation = double(look->y()) * degree;
  }
  if (const Status fits = sky::checkShape(shape); !fits)
    return badUsage("--size: " + fits.error().message);
  return shape;
}

std::string nameOf(sky::PictureMap map) {
  return wordOf(map, maps());
}

std::string nameOf(sky::Quantity quantity) {
  return wordOf(quantity, quantities());
}

void AtArguments::addTo(CLI::App& app) {
  app.add_option_function<std::vector<std::string>>(
         "--at",
         [this](const std::vector<std::string>& texts) {
           for (const std::string& text : texts) {
             const auto direction = parseAt(text);
             if (!direction) throw CLI::ValidationError("--at", direction.error().message);
             at.push_back(*direction);
           }
         },
         "What stands in a direction, as a row of CSV: degrees, the azimuth FROM THE SUN'S, "
         "clockwise seen from above. May be repeated")
      ->allow_extra_args(false)
      ->option_text("AZIMUTH,ELEVATION")
      ->group("Numbers");
  app.add_option("--at-file", file,
                 "The same for every line of a file: azimuth,elevation; # begins a comment")
      ->option_text("FILE.csv")
      ->group("Numbers");
  addParsed(app, "--wavelengths", wavelengths, parseWavelengths,
            "Rows have spectral radiance in W/m²/sr/nm at these, 340 to 740, rising, besides "
            "luminance in cd/m². With --quantity spectral: the channels (default: every 10)")
      ->option_text("NM,NM")
      ->group("Numbers");
  app.add_flag("--magnitudes", magnitudes,
               "Luminance also in magnitudes per square arcsecond, as observers of the night sky "
               "have it; by itself where the Sun is below -6°")
      ->group("Numbers");
}

Result<std::vector<AtArguments::Direction>> AtArguments::directions() const {
  std::vector<Direction> all = at;
  if (file.empty()) return all;
  const auto bytes = file::readWhole(file);
  if (!bytes) return bytes.error();
  const std::string_view text(reinterpret_cast<const char*>(bytes->data()), bytes->size());
  std::size_t number = 0;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string_view whole = text.substr(begin, end - begin);
    const std::string_view line = trimmed(whole.substr(0, whole.find('#')));
    begin = end + 1;
    ++number;
    if (line.empty() || (all.size() == at.size() && line == "azimuth,elevation")) continue;
    const auto direction = parseAt(line);
    if (!direction)
      return badInput(
          fmt::format("{}: line {}: {}", file.string(), number, direction.error().message));
    all.push_back(*direction);
  }
  if (all.size() == at.size())
    return badInput(fmt::format("{}: has no line azimuth,elevation", file.string()));
  return all;
}

}  // namespace lambent::tool
