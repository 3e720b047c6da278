#include "lambent/scene_io/text_number.h"

#include <charconv>
#include <cmath>
#include <limits>
#include <string_view>

namespace lambent::scene_io {
namespace {

double beyondRange(const char* first, const char* last) {
  const char* digits = *first == '-' ? first + 1 : first;
  if (digits != last && (*digits == '0' || *digits == '.')) return 0.0;
  for (const char* p = first; p + 1 < last; ++p) {
    if ((*p == 'e' || *p == 'E') && p[1] == '-') return 0.0;
  }
  const double infinity = std::numeric_limits<double>::infinity();
  return *first == '-' ? -infinity : infinity;
}

/// What stands behind "1." of a number that is none: the digits after it only fill up a width.
std::optional<ParsedNumber> windowsNumber(const char* mark, const char* last, bool negative) {
  const std::string_view text(mark, std::size_t(last - mark));
  for (const std::string_view name : {"#INF", "#IND", "#QNAN", "#SNAN"}) {
    if (!text.starts_with(name)) continue;
    const double infinity = std::numeric_limits<double>::infinity();
    ParsedNumber number{name == "#INF" ? (negative ? -infinity : infinity)
                                       : std::numeric_limits<double>::quiet_NaN(),
                        mark + name.size()};
    while (number.end != last && *number.end >= '0' && *number.end <= '9') ++number.end;
    return number;
  }
  return {};
}

}  // namespace

std::optional<ParsedNumber> parseOddNumber(const char* first, const char* last) {
  ParsedNumber number;
  const auto [stop, error] = std::from_chars(first, last, number.value);
  if (error == std::errc::invalid_argument) return {};
  number.end = stop;
  if (error == std::errc::result_out_of_range) number.value = beyondRange(first, stop);
  if (stop != last && *stop == '#') {
    if (const auto windows = windowsNumber(stop, last, *first == '-')) return windows;
  }
  return number;
}

}  // namespace lambent::scene_io
