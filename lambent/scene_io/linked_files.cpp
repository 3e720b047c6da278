#include "lambent/scene_io/linked_files.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <span>

#include "lambent/file/atomic_file.h"
#include "lambent/scene_io/file_finder.h"
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

constexpr std::string_view kFileUri = "file://";

bool isFileUri(std::string_view uri) {
  return uri.starts_with(kFileUri);
}

bool isRemote(std::string_view uri) {
  return uri.find("://") != std::string_view::npos && !isFileUri(uri);
}

bool equalInLowerCase(std::string_view text, std::string_view lower) {
  return std::equal(text.begin(), text.end(), lower.begin(), lower.end(), [](char a, char b) {
    return std::tolower(static_cast<unsigned char>(a)) == b;
  });
}

/// "data:image/png;charset=utf-8;base64", in any capitals.
bool endsWithBase64(std::string_view head) {
  constexpr std::string_view kEnd = ";base64";
  if (head.size() < kEnd.size()) return false;
  return equalInLowerCase(head.substr(head.size() - kEnd.size()), kEnd);
}

/// A scene may name as many files that are not there as it likes; looking for one reads a folder.
constexpr std::size_t kMostSearches = 1000;

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
  constexpr std::string_view kScheme = "data:";
  return uri.size() >= kScheme.size() && equalInLowerCase(uri.substr(0, kScheme.size()), kScheme);
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

std::filesystem::path LinkedFiles::pathOf(const std::string& uri) const {
  const auto known = found_.find(uri);
  if (known != found_.end()) return known->second;
  const std::filesystem::path folder = scene_.parent_path();
  const std::string local = isFileUri(uri) ? uri.substr(kFileUri.size()) : uri;
  std::error_code error;
  std::filesystem::path path = folder / percentDecoded(local);
  if (!std::filesystem::exists(path, error) && found_.size() < kMostSearches) {
    FileFinder finder(*this);
    for (const std::string& name : {percentDecoded(local), local}) {
      const FileFinder::Found found = finder.find(folder, name, folder);
      if (!found.exists) continue;
      path = found.path;
      break;
    }
    found_.emplace(uri, path);
  }
  return path;
}

std::filesystem::path LinkedFiles::placeOf(const std::string& uri) const {
  std::error_code error;
  const std::filesystem::path path = pathOf(uri);
  const std::filesystem::path whole = resolved(path, error);
  return error ? path : whole;
}

bool LinkedFiles::mayReadUri(const std::string& uri) const {
  return isDataUri(uri) || isRemote(uri) || mayRead(pathOf(uri));
}

void LinkedFiles::noteGltf(const nlohmann::json& document) {
  for (const char* kind : {"buffers", "images"}) {
    const nlohmann::json* all = find(document, kind);
    for (std::size_t i = 0; i < arraySize(all); ++i) {
      const std::string uri = text(&(*all)[i], "uri");
      if (!uri.empty() && !isDataUri(uri) && !isRemote(uri)) note(pathOf(uri));
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
    if (comma == std::string::npos) {
      return report::badInput(file + ": the data URI of " + what +
                              " holds no data; export the file again");
    }
    if (!endsWithBase64(std::string_view(uri).substr(0, comma))) {
      const std::string plain = percentDecoded(std::string_view(uri).substr(comma + 1));
      const auto bytes = std::as_bytes(std::span(plain.data(), plain.size()));
      return std::vector<std::byte>(bytes.begin(), bytes.end());
    }
    auto bytes = decodeBase64(std::string_view(uri).substr(comma + 1));
    if (!bytes) {
      return report::badInput(file + ": the data URI of " + what +
                              " has a character that base64 does not know; export the file again");
    }
    return std::move(*bytes);
  }
  if (isRemote(uri)) {
    return report::badInput(file + ": " + what + " is at " + uri.substr(0, 200) +
                            "; Lambent reads no network: download it beside the file");
  }
  if (!mayReadUri(uri)) return outside(what, uri);
  const std::filesystem::path path = pathOf(uri);
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
