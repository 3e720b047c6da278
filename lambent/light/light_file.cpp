// LIGHT.json ⇄ harmonics. Numbers are written with nine digits, which is what a float needs to come
// back bit for bit.
#include "lambent/light/light_file.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <fstream>
#include <limits>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "lambent/file/atomic_file.h"
#include "lambent/file/json.h"

namespace lambent::light {
using report::badInput;
using report::failed;

namespace {

constexpr const char* kExample =
    R"({"lambent": "light", "bands": 1, "coefficients": [[0.5, 0.5, 0.5]]})";

/// A light of 10 bands is some 5 KB; what is much larger is some other file.
constexpr std::uintmax_t kMostBytes = 1 << 20;

Error wrong(const std::string& name, const std::string& what) {
  return badInput(fmt::format("{}: {}", name, what));
}

/// "-0" would come back as the integer 0.
std::string digits(float value) {
  return value == 0 && std::signbit(value) ? "-0.0" : fmt::format("{:.9g}", value);
}

std::string shown(const nlohmann::json& value) {
  std::string text = value.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
  if (text.size() > 40) text = text.substr(0, 37) + "...";
  return text;
}

}  // namespace

Result<sh::RgbCoefficients> parseLight(std::string_view text, const std::string& name) {
  const Result<nlohmann::json> parsed = file::parseJson(text);
  if (!parsed)
    return wrong(name, fmt::format("not JSON ({}). A light looks like {}", parsed.error().message,
                                   kExample));
  const nlohmann::json& json = *parsed;
  const auto isLight = [&] {
    return json.is_object() && json.contains("lambent") && json["lambent"] == "light";
  };
  if (!isLight())
    return wrong(name,
                 fmt::format("JSON, but not a light: \"lambent\": \"light\" is missing. A light "
                             "looks like {}",
                             kExample));
  if (!json.contains("bands") || !json["bands"].is_number_integer())
    return wrong(name, fmt::format("\"bands\" must be a whole number from 1 to {}", sh::kMaxBands));
  const double bandsGiven = json["bands"].get<double>();
  if (!(bandsGiven >= 1 && bandsGiven <= sh::kMaxBands))
    return wrong(name, fmt::format("\"bands\" is {}; it must be from 1 to {}", shown(json["bands"]),
                                   sh::kMaxBands));
  const int bands = int(bandsGiven);
  const std::size_t count = std::size_t(sh::coefficientCount(bands));
  if (!json.contains("coefficients") || !json["coefficients"].is_array())
    return wrong(name, "\"coefficients\" must be a list of [r, g, b] rows");
  const nlohmann::json& rows = json["coefficients"];
  if (rows.size() != count)
    return wrong(name, fmt::format("\"coefficients\" has {} rows; {} bands need {} (bands squared)",
                                   rows.size(), bands, count));
  sh::RgbCoefficients light(bands);
  for (std::size_t i = 0; i < count; ++i) {
    if (!rows[i].is_array() || rows[i].size() != 3)
      return wrong(name, fmt::format("\"coefficients\" row {} is {}; every row is [r, g, b]", i,
                                     shown(rows[i])));
    for (int c = 0; c < 3; ++c) {
      const nlohmann::json& value = rows[i][c];
      if (!value.is_number())
        return wrong(name, fmt::format("\"coefficients\" row {}, column {} is {}, not a number", i,
                                       c, shown(value)));
      // Nine digits of the largest float stand for a number a little above it.
      constexpr double kLargest = std::numeric_limits<float>::max();
      const double number = value.get<double>();
      if (!(std::abs(number) <= kLargest * (1 + 1e-8)))
        return wrong(name, fmt::format("\"coefficients\" row {}, column {} is {}: beyond the range "
                                       "of a 32-bit float",
                                       i, c, shown(value)));
      light.channel(c)[i] = float(std::clamp(number, -kLargest, kLargest));
    }
  }
  return light;
}

Result<sh::RgbCoefficients> readLight(const std::filesystem::path& path) {
  const std::string name = path.string();
  std::error_code sizeError;
  const std::uintmax_t size = std::filesystem::file_size(path, sizeError);
  if (!sizeError && size > kMostBytes)
    return wrong(name,
                 fmt::format("{} bytes are too many for a light; make one with 'lambent light "
                             "SOURCE -o LIGHT.json'",
                             size));
  const Result<std::vector<std::byte>> bytes = file::readWhole(path);
  if (!bytes) return bytes.error();
  return parseLight({reinterpret_cast<const char*>(bytes->data()), bytes->size()}, name);
}

Status writeLight(const sh::RgbCoefficients& light, const std::filesystem::path& path) {
  assert(light.bands >= 1 && light.bands <= sh::kMaxBands);
  for (const float value : light.values)
    if (!std::isfinite(value))
      return failed(
          fmt::format("{}: the light has a coefficient that is not finite; its source has "
                      "pixels too bright for 32-bit floats",
                      path.string()));
  std::string text = fmt::format(
      "{{\n  \"lambent\": \"light\",\n  \"bands\": {},\n  \"coefficients\": [\n", light.bands);
  const int count = sh::coefficientCount(light.bands);
  for (int i = 0; i < count; ++i)
    text += fmt::format("    [{}, {}, {}]{}\n", digits(light.channel(0)[i]),
                        digits(light.channel(1)[i]), digits(light.channel(2)[i]),
                        i + 1 < count ? "," : "");
  text += "  ]\n}\n";
  return file::writeAtomically(path, text);
}

}  // namespace lambent::light
