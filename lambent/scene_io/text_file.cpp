#include "lambent/scene_io/text_file.h"

#include <cctype>

#include "lambent/scene_io/text_cursor.h"

namespace lambent::scene_io {
namespace {

/// By its mark, or by zeros in every other one of the first bytes, which ASCII in UTF-16 has.
bool isUtf16(std::string_view text) {
  if (text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff")) return true;
  if (text.size() < 4) return false;
  const bool odd = text[1] == '\0' && text[3] == '\0' && text[0] != '\0' && text[2] != '\0';
  const bool even = text[0] == '\0' && text[2] == '\0' && text[1] != '\0' && text[3] != '\0';
  return odd || even;
}

}  // namespace

Result<std::string_view> textOf(std::span<const std::byte> bytes, const std::string& file) {
  std::string_view text = asText(bytes);
  if (isUtf16(text)) {
    return report::badInput(file +
                            ": is text in UTF-16, which is not read; save it as UTF-8 or ASCII");
  }
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
  return text;
}

std::string_view withoutComment(std::string_view name) {
  const auto blank = [&](std::size_t i) { return name[i] == ' ' || name[i] == '\t'; };
  for (std::size_t i = 1; i < name.size(); ++i) {
    const bool number =
        i + 1 < name.size() && std::isdigit(static_cast<unsigned char>(name[i + 1])) != 0;
    if (name[i] != '#' || !blank(i - 1) || number) continue;
    while (i > 0 && blank(i - 1)) --i;
    return name.substr(0, i);
  }
  return name;
}

std::string decimalCommaIn(std::string_view word) {
  const std::size_t comma = word.find(',');
  const auto digit = [&](std::size_t i) {
    return i < word.size() && std::isdigit(static_cast<unsigned char>(word[i])) != 0;
  };
  if (comma == std::string_view::npos || comma == 0 || !digit(comma - 1) || !digit(comma + 1)) {
    return {};
  }
  return "; its numbers have decimal commas: export it again with decimal points (English numbers)";
}

}  // namespace lambent::scene_io
