#include "apps/lambent/numbers.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

namespace lambent::tool {

namespace {

/// All of `text`, with a plus perhaps.
template <class T>
std::optional<T> whole(std::string_view text) {
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  T value = 0;
  const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || rest != text.data() + text.size()) return {};
  return value;
}

}  // namespace

std::string numbers::inShort(double value) {
  // Whole numbers in full: 65536 and not 6.5536e+04.
  if (value == std::floor(value) && std::abs(value) < 1e10) return fmt::format("{:.0f}", value);
  return fmt::format("{:g}", value);
}

bool NumberRange::holds(double value) const {
  return std::isfinite(value) && value >= least && value <= most;
}

std::string NumberRange::inWords() const {
  const char* kind = whole ? "whole number" : "number";
  return fmt::format("a {} from {} to {}", kind, numbers::inShort(least), numbers::inShort(most));
}

Result<double> parseNumber(std::string_view text, const NumberRange& range) {
  std::optional<double> value;
  if (!range.whole) {
    value = whole<double>(text);
  } else if (const auto integer = whole<std::int64_t>(text)) {
    value = double(*integer);  // exact wherever a range ends: at 32 bits, say
  }
  if (value && range.holds(*value)) return *value;
  return report::badUsage(fmt::format("'{}' is not {}", text, range.inWords()));
}

Result<std::uint64_t> parseBytes(std::string_view text) {
  std::size_t digits = 0;
  while (digits < text.size() && text[digits] >= '0' && text[digits] <= '9') ++digits;
  const auto count = whole<std::uint64_t>(text.substr(0, digits));
  std::string unit;
  for (const char c : text.substr(digits))
    if (c != ' ') unit += c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c;
  constexpr std::string_view kSteps = "kmgtpe";
  int steps = unit.empty() || unit == "b" ? 0 : -1;
  for (std::size_t i = 0; i < kSteps.size(); ++i) {
    const std::string letter(1, kSteps[i]);
    if (unit == letter || unit == letter + "b" || unit == letter + "ib") steps = int(i) + 1;
  }
  const int shift = 10 * steps;
  if (count && steps >= 0 && (*count << shift) >> shift == *count) return *count << shift;
  return report::badUsage(fmt::format(
      "'{}' is not a size of memory: write a whole number of bytes below 16 EiB, or one with a "
      "unit, as in 500MiB or 16GiB",
      text));
}

}  // namespace lambent::tool
