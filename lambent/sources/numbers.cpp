#include "lambent/sources/numbers.h"

#include <charconv>
#include <cmath>

#include <fmt/format.h>

namespace lambent::sources {

Error usage(std::string_view term, std::string_view what, std::string_view example) {
  return report::badUsage(fmt::format("light '{}': {}; for example {}", term, what, example));
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

}  // namespace lambent::sources
