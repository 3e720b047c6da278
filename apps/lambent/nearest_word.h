// "Did you mean …?"
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace lambent::tool {

/// How many letters must be put in, left out, replaced, or swapped with their neighbour to make `b`
/// of `a` (Damerau and Levenshtein, no letter touched twice).
std::size_t editDistance(std::string_view a, std::string_view b);

/// The word that a person may have meant: the first of those with the least distance, if no more
/// than a third of the letters (at least one) are wrong; else empty.
std::string nearestWord(std::string_view given, std::span<const std::string> words);

}  // namespace lambent::tool
