#include "lambent/light/windowing.h"

#include <charconv>
#include <cmath>

#include <fmt/format.h>

#include "lambent/sh/window.h"

namespace lambent::light {

Result<Windowing> parseWindowing(std::string_view text) {
  using Kind = Windowing::Kind;
  const std::size_t colon = text.find(':');
  const std::string_view name = text.substr(0, colon);
  Windowing windowing;
  if (name == "hann") windowing.kind = Kind::Hann;
  if (name == "lanczos") windowing.kind = Kind::Lanczos;
  if (name == "auto") windowing.kind = Kind::Auto;
  if (name == "minimal") windowing.kind = Kind::Minimal;
  const bool hasWidth = windowing.kind == Kind::Hann || windowing.kind == Kind::Lanczos;
  const bool known = windowing.kind != Kind::None || name == "none";
  if (!known || (colon != text.npos && !hasWidth))
    return report::badUsage(fmt::format(
        "'{}' is not a window: write auto, none, minimal, hann:WIDTH or lanczos:WIDTH", text));
  if (colon == text.npos) return windowing;
  const char* end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data() + colon + 1, end, windowing.width);
  if (error != std::errc() || rest != end || !std::isfinite(windowing.width) ||
      windowing.width <= 0.0)
    return report::badUsage(fmt::format("'{}': the width must be a number above 0", text));
  return windowing;
}

bool softensLobes(std::string_view text) {
  const Result<Windowing> windowing = parseWindowing(text);
  return windowing && windowing->kind == Windowing::Kind::Auto;
}

std::vector<double> windowOf(const Windowing& windowing, const sh::RgbCoefficients& light) {
  const double width = windowing.width > 0.0 ? windowing.width : double(light.bands);
  switch (windowing.kind) {
    case Windowing::Kind::None:
    case Windowing::Kind::Auto:
      break;
    case Windowing::Kind::Hann:
      return sh::hann(light.bands, width);
    case Windowing::Kind::Lanczos:
      return sh::lanczos(light.bands, width);
    case Windowing::Kind::Minimal:
      return sh::minimalRinging(light);
  }
  return std::vector<double>(std::size_t(light.bands), 1.0);
}

void soften(const Windowing& windowing, sh::RgbCoefficients& light) {
  using Kind = Windowing::Kind;
  if (windowing.kind == Kind::None || windowing.kind == Kind::Auto) return;
  sh::applyWindow(windowOf(windowing, light), light);
}

}  // namespace lambent::light
