// A file: URI, as a desktop's file dialog answers with.
#include <string>

#include "lambent/file/file_uri.h"
#include "tests/fuzz/target.h"

namespace lambent::fuzz {

void uri(Bytes bytes) {
  const auto path = file::pathOfUri(textOf(bytes));
  if (!path) {
    require(path.error().kind == ErrorKind::BadInput, "a bad URI is bad input");
    return;
  }
  const std::string name = path->string();
  require(name.starts_with('/'), "a file's name begins at /");
  require(name.find('\0') == name.npos, "no file has the byte 0 in its name");
  std::string again = "file://";
  for (const char c : name) {
    const auto byte = static_cast<unsigned char>(c);
    again += '%';
    again += "0123456789abcdef"[byte / 16];
    again += "0123456789abcdef"[byte % 16];
  }
  // All but the slash at its beginning may be written by its number.
  again.replace(7, 3, "/");
  const auto same = file::pathOfUri(again);
  require(same && same->string() == name, "a file's name written as a URI is that file's name");
}

}  // namespace lambent::fuzz
