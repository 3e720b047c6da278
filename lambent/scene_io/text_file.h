// A text file in memory: what editors put around the text taken off.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "lambent/report/result.h"

namespace lambent::scene_io {

/// The text in `bytes` without a UTF-8 byte order mark. UTF-16 is BadInput that names `file`.
Result<std::string_view> textOf(std::span<const std::byte> bytes, const std::string& file);

/// A name without the comment behind it. "Material #25" is a name.
std::string_view withoutComment(std::string_view name);

/// What the remedy is where a number was expected and `word` stands: for a decimal comma, a sentence
/// that begins with "; "; otherwise nothing.
std::string decimalCommaIn(std::string_view word);

}  // namespace lambent::scene_io
