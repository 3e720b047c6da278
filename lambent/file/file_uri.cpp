#include "lambent/file/file_uri.h"

#include <algorithm>
#include <string>

namespace lambent::file {
namespace {

Error wrong(std::string_view uri, std::string_view what) {
  return report::badInput(std::string(uri) + ": " + std::string(what));
}

int hexadecimal(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

bool sameWord(std::string_view text, std::string_view lower) {
  if (text.size() != lower.size()) return false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i] >= 'A' && text[i] <= 'Z' ? char(text[i] - 'A' + 'a') : text[i];
    if (c != lower[i]) return false;
  }
  return true;
}

}  // namespace

Result<std::filesystem::path> pathOfUri(std::string_view uri) {
  const std::size_t colon = uri.find(':');
  if (colon == uri.npos || !sameWord(uri.substr(0, colon), "file"))
    return wrong(uri, "not a file of this machine; copy it here, and open the copy");
  std::string_view rest = uri.substr(colon + 1);
  if (rest.starts_with("//")) {
    rest.remove_prefix(2);
    const std::size_t slash = std::min(rest.find('/'), rest.size());
    const std::string_view host = rest.substr(0, slash);
    if (!host.empty() && !sameWord(host, "localhost"))
      return wrong(uri, "a file of another machine; copy it here, and open the copy");
    rest.remove_prefix(slash);
  }
  if (!rest.starts_with('/')) return wrong(uri, "the name of its file does not begin at /");
  std::string path;
  for (std::size_t i = 0; i < rest.size(); ++i) {
    char c = rest[i];
    if (c == '?' || c == '#') return wrong(uri, "holds more than the name of a file");
    if (c == '%') {
      const int high = i + 2 < rest.size() ? hexadecimal(rest[i + 1]) : -1;
      const int low = i + 2 < rest.size() ? hexadecimal(rest[i + 2]) : -1;
      if (high < 0 || low < 0) return wrong(uri, "a % without two hexadecimal digits");
      c = char(16 * high + low);
      i += 2;
    }
    if (c == '\0') return wrong(uri, "no file has the byte 0 in its name");
    path += c;
  }
  return std::filesystem::path(path);
}

}  // namespace lambent::file
