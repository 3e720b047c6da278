#include "lambent/scene_io/linked_files.h"

#include <algorithm>
#include <array>
#include <cctype>

#include "lambent/file/atomic_file.h"
#include "lambent/scene_io/gltf_json.h"

namespace lambent::scene_io {
namespace {

int hexDigit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  const char lower = char(std::tolower(static_cast<unsigned char>(c)));
  return lower >= 'a' && lower <= 'f' ? lower - 'a' + 10 : -1;
}

std::string percentDecoded(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '%' && i + 2 < text.size()) {
      const int high = hexDigit(text[i + 1]), low = hexDigit(text[i + 2]);
      if (high >= 0 && low >= 0) {
        out.push_back(char(16 * high + low));
        i += 2;
        continue;
      }
    }
    out.push_back(text[i]);
  }
  return out;
}

/// Links and ".." followed as far as there are files, from the root on.
std::filesystem::path resolved(const std::filesystem::path& path, std::error_code& error) {
  // What is relative and not there would stay relative.
  const std::filesystem::path whole = std::filesystem::absolute(path, error);
  return error ? whole : std::filesystem::weakly_canonical(whole, error);
}

}  // namespace

std::optional<std::vector<std::byte>> decodeBase64(std::string_view text) {
  static const std::array<std::int8_t, 256> digits = [] {
    std::array<std::int8_t, 256> table;
    table.fill(-1);
    const std::string_view alphabet =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (int i = 0; i < 64; ++i) table[static_cast<unsigned char>(alphabet[i])] = std::int8_t(i);
    return table;
  }();
  std::vector<std::byte> out;
  out.reserve(text.size() / 4 * 3 + 3);
  unsigned bits = 0;
  int held = 0;
  bool ended = false;
  for (const char c : text) {
    if (std::isspace(static_cast<unsigned char>(c))) continue;
    if (c == '=') {
      ended = true;
      continue;
    }
    const int digit = digits[static_cast<unsigned char>(c)];
    if (digit < 0 || ended) return {};
    bits = bits << 6 | unsigned(digit);
    held += 6;
    if (held >= 8) {
      held -= 8;
      out.push_back(std::byte(bits >> held & 0xff));
    }
  }
  return out;
}

bool isDataUri(std::string_view uri) {
  return uri.starts_with("data:");
}

Result<std::vector<std::byte>> LinkedFiles::readScene() {
  Result<std::vector<std::byte>> bytes = file::readWhole(scene_);
  if (bytes) budget_.addFile(bytes->size());
  return bytes;
}

bool LinkedFiles::mayRead(const std::filesystem::path& path) const {
  if (options_.allowOutside) return true;
  std::error_code error;
  std::filesystem::path folder = scene_.parent_path();
  if (folder.empty()) folder = ".";
  folder = resolved(folder, error);
  if (error) return false;
  const std::filesystem::path target = resolved(path, error);
  if (error) return false;
  return std::mismatch(folder.begin(), folder.end(), target.begin(), target.end()).first ==
         folder.end();
}

Error LinkedFiles::outside(const std::string& what, const std::string& name) const {
  return report::badInput(scene_.string() + ": " + what + " is the file " + name.substr(0, 200) +
                          ", which lies outside of the scene's folder; put it there, or allow it "
                          "with --allow-outside if you trust the scene");
}

std::filesystem::path LinkedFiles::placeOf(const std::string& uri) const {
  std::error_code error;
  const std::filesystem::path path = scene_.parent_path() / percentDecoded(uri);
  const std::filesystem::path whole = resolved(path, error);
  return error ? path : whole;
}

bool LinkedFiles::mayReadUri(const std::string& uri) const {
  if (isDataUri(uri) || uri.find("://") != std::string::npos) return true;
  return mayRead(scene_.parent_path() / percentDecoded(uri));
}

void LinkedFiles::noteGltf(const nlohmann::json& document) {
  for (const char* kind : {"buffers", "images"}) {
    const nlohmann::json* all = find(document, kind);
    for (std::size_t i = 0; i < arraySize(all); ++i) {
      const std::string uri = text(&(*all)[i], "uri");
      if (!uri.empty() && !isDataUri(uri) && uri.find("://") == std::string::npos) {
        note(scene_.parent_path() / percentDecoded(uri));
      }
    }
  }
}

Result<std::vector<std::byte>> LinkedFiles::read(const std::filesystem::path& path) {
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (!error) {
    budget_.addFile(size);
    if (Status fits = budget_.hold(size, path.string()); !fits) return fits.error();
  }
  return file::readWhole(path);
}

Result<std::vector<std::byte>> LinkedFiles::readUri(const std::string& uri,
                                                    const std::string& what) {
  const std::string file = scene_.string();
  if (isDataUri(uri)) {
    const std::size_t comma = uri.find(',');
    const std::string_view head = std::string_view(uri).substr(0, std::min(comma, uri.size()));
    if (comma == std::string::npos || !head.ends_with(";base64")) {
      return report::badInput(file + ": the data URI of " + what +
                              " is not base64; export the file again");
    }
    auto bytes = decodeBase64(std::string_view(uri).substr(comma + 1));
    if (!bytes) {
      return report::badInput(file + ": the data URI of " + what +
                              " has a character that base64 does not know; export the file again");
    }
    return std::move(*bytes);
  }
  if (uri.find("://") != std::string::npos) {
    return report::badInput(file + ": " + what + " is at " + uri.substr(0, 200) +
                            "; Lambent reads no network: download it beside the file");
  }
  if (!mayReadUri(uri)) return outside(what, uri);
  const std::filesystem::path path = scene_.parent_path() / percentDecoded(uri);
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (error || !std::filesystem::exists(status)) {
    return report::badInput(file + ": " + what + " is the file " + path.string() +
                            ", which does not exist; put it there, or export as one .glb");
  }
  // Anything but a regular file (a pipe, a device) could keep us waiting for ever.
  if (!std::filesystem::is_regular_file(status)) {
    return report::badInput(file + ": " + what + " is " + path.string() +
                            ", which is not a regular file");
  }
  return read(path);
}

}  // namespace lambent::scene_io
