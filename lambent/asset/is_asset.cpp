#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "lambent/asset/format.h"
#include "lambent/asset/read.h"
#include "lambent/file/failure.h"
#include "lambent/file/json.h"
#include "lambent/scene_io/linked_files.h"

namespace lambent::asset {

namespace {

constexpr std::size_t kChunk = std::size_t(1) << 20;

using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

/// Up to `most` bytes; a file that claims more than it has costs no more than what it has.
std::string readUpTo(std::FILE* file, std::size_t most) {
  std::string text;
  while (text.size() < most) {
    const std::size_t before = text.size(), want = std::min(kChunk, most - before);
    text.resize(before + want);
    const std::size_t got = std::fread(text.data() + before, 1, want, file);
    text.resize(before + got);
    if (got < want) break;
  }
  return text;
}

std::uint32_t littleEndian(const unsigned char* bytes) {
  return bytes[0] | bytes[1] << 8 | bytes[2] << 16 | std::uint32_t(bytes[3]) << 24;
}

/// The text of a .glb's or .gltf's JSON; empty if it is neither.
Result<std::string> jsonText(const std::filesystem::path& path) {
  errno = 0;
  const File file(std::fopen(path.c_str(), "rb"), &std::fclose);
  if (!file) return file::cannot("read", path, errno);
  std::array<unsigned char, 20> head{};  // magic, version, length; chunk length, chunk type
  const std::size_t got = std::fread(head.data(), 1, head.size(), file.get());
  if (std::ferror(file.get())) return file::cannot("read", path, errno);

  std::string text;
  if (got == head.size() && std::memcmp(head.data(), "glTF", 4) == 0) {
    if (std::memcmp(head.data() + 16, "JSON", 4) == 0)
      text = readUpTo(file.get(), littleEndian(head.data() + 12));
  } else if (path.extension() == ".gltf") {
    std::rewind(file.get());
    text = readUpTo(file.get(), std::size_t(1) << 32);
  }
  return text;
}

}  // namespace

Result<bool> isAsset(const std::filesystem::path& path) {
  const Result<std::string> text = jsonText(path);
  if (!text) return text.error();
  if (text->find(kExtensionName) == std::string::npos) return false;  // cheaper than to parse
  const Result<nlohmann::json> document = file::parseJson(*text);
  if (!document || !document->is_object()) return false;
  const auto extensions = document->find("extensions");
  return extensions != document->end() && extensions->is_object() &&
         extensions->contains(kExtensionName);
}

Result<std::vector<std::filesystem::path>> linkedFiles(const std::filesystem::path& path) {
  const Result<std::string> text = jsonText(path);
  if (!text) return text.error();
  const Result<nlohmann::json> document = file::parseJson(*text);
  scene_io::LinkedFiles files(path, {});
  if (document) files.noteGltf(*document);
  return files.noted();
}

}  // namespace lambent::asset
