// A number as text, as the programs of three decades print it.
#pragma once

#include <optional>

namespace lambent::scene_io {

struct ParsedNumber {
  double value = 0.0;
  const char* end = nullptr;  ///< behind its last character
};

/// The number that begins at `first`, without blanks before it: with a plus or without, "inf",
/// "nan" and "-nan(ind)", and as old Windows runtimes print these ("1.#INF", "-1.#IND00",
/// "1.#QNAN"). Beyond double's range it is infinite or 0. Nothing if no number begins there.
std::optional<ParsedNumber> parseNumber(const char* first, const char* last);

}  // namespace lambent::scene_io
