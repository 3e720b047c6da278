// A number as text, as the programs of three decades print it.
#pragma once

#include <charconv>
#include <optional>

namespace lambent::scene_io {

struct ParsedNumber {
  double value = 0.0;
  const char* end = nullptr;  ///< behind its last character
};

/// The number that begins at `first`, without blanks before it: with a plus or without, "inf",
/// "nan" and "-nan(ind)", and as old Windows runtimes print these ("1.#INF", "-1.#IND00",
/// "1.#QNAN"). Beyond double's range it is infinite or 0. Nothing if no number begins there.
inline std::optional<ParsedNumber> parseNumber(const char* first, const char* last);

/// parseNumber() where std::from_chars is not all that there is to it: `first` has no plus.
std::optional<ParsedNumber> parseOddNumber(const char* first, const char* last);

inline std::optional<ParsedNumber> parseNumber(const char* first, const char* last) {
  if (first != last && *first == '+') ++first;
  double value = 0.0;
  const auto [stop, error] = std::from_chars(first, last, value);
  if (error == std::errc() && (stop == last || *stop != '#')) return ParsedNumber{value, stop};
  return parseOddNumber(first, last);
}

}  // namespace lambent::scene_io
