// Numbers and colours in the text of a SOURCE.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "lambent/math/types.h"
#include "lambent/report/result.h"

namespace lambent::sources {

/// BadUsage that shows the term, what is wrong with it, and how one is written.
Error usage(std::string_view term, std::string_view what, std::string_view example);

std::vector<std::string_view> split(std::string_view text, char separator);

/// Finite; spaces around it do not matter.
std::optional<double> number(std::string_view text);

/// One number or R/G/B, each from 0 to what a float can hold.
std::optional<Rgb> color(std::string_view text);
inline constexpr std::string_view kColorRule = "is not a number from 0 up, nor R/G/B";

}  // namespace lambent::sources
