// Tokens and numbers out of a text file in memory, line by line, without copies.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "lambent/scene_io/text_number.h"

namespace lambent::scene_io {

inline std::string_view asText(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

class TextCursor {
 public:
  /// Whether a backslash before a line's end joins the following line to it (OBJ does so).
  enum class Joining { None, Backslash };
  explicit TextCursor(std::string_view text, Joining joining = Joining::None)
      : next_(text.data()), end_(next_ + text.size()), joining_(joining) {}

  /// Goes to the next line; false at the end of the text.
  bool nextLine() {
    if (next_ == end_) return false;
    at_ = next_;
    line_ += joined_ + 1;
    joined_ = 0;
    const char* p = at_;
    for (;;) {
      while (p != end_ && *p != '\n' && *p != '\r') ++p;
      lineEnd_ = p;
      if (p != end_) p += (*p == '\r' && p + 1 != end_ && p[1] == '\n') ? 2 : 1;
      if (joining_ == Joining::None || lineEnd_ == at_ || lineEnd_[-1] != '\\' || p == end_) break;
      ++joined_;
    }
    next_ = p;
    return true;
  }

  /// The next word of the line, empty at its end.
  std::string_view word() {
    skipBlanks();
    const char* first = at_;
    while (at_ != lineEnd_ && !isBlank(at_)) ++at_;
    return {first, std::size_t(at_ - first)};
  }

  /// The rest of the line without blanks around it.
  std::string_view rest() {
    skipBlanks();
    const char* last = lineEnd_;
    while (last != at_ && isBlank(last - 1)) --last;
    return {at_, std::size_t(last - at_)};
  }

  /// The next word as a number; nothing at the line's end or where the word is no number. A comment
  /// may follow at once. Numbers beyond double's range become infinite or 0.
  std::optional<double> number() {
    skipBlanks();
    const std::optional<ParsedNumber> parsed = parseNumber(at_, lineEnd_);
    if (!parsed) return {};
    const char* stop = parsed->end;
    if (stop != lineEnd_ && !isBlank(stop) && *stop != '#') return {};
    at_ = stop;
    return parsed->value;
  }

  std::size_t line() const { return line_; }
  /// Where the following line begins, as an offset behind `begin`.
  std::size_t offset(const char* begin) const { return std::size_t(next_ - begin); }

 private:
  /// A joined line's backslash and end are blanks within it.
  bool isBlank(const char* p) const {
    if (*p == '\\') return p + 1 < lineEnd_ && (p[1] == '\n' || p[1] == '\r');
    return *p == ' ' || *p == '\t' || *p == '\n' || *p == '\r' || *p == '\v' || *p == '\f';
  }
  void skipBlanks() {
    while (at_ != lineEnd_ && isBlank(at_)) ++at_;
  }

  const char *next_, *end_;
  const char *at_ = next_, *lineEnd_ = next_;
  Joining joining_;
  std::size_t line_ = 0, joined_ = 0;
};

}  // namespace lambent::scene_io
