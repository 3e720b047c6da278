#include "tests/fuzz/folder.h"

#include <unistd.h>

#include <array>
#include <fstream>
#include <string>

#include "lambent/image/decode.h"

namespace lambent::fuzz {

const Folder& Folder::ofProcess() {
  static const Folder folder;
  return folder;
}

Folder::Folder()
    : path_(std::filesystem::temp_directory_path() / ("lambent-fuzz-" + std::to_string(getpid()))) {
  std::filesystem::create_directories(path_);
  constexpr std::array<std::uint8_t, 6> kPixels{255, 0, 0, 0, 255, 0};
  write("tile.png", image::encodePng(2, 1, 3, kPixels));
}

Folder::~Folder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

std::filesystem::path Folder::write(std::string_view name, Bytes content) const {
  return write(name, textOf(content));
}

std::filesystem::path Folder::write(std::string_view name, std::string_view content) const {
  const std::filesystem::path path = path_ / name;
  std::ofstream file(path, std::ios::binary);
  file.write(content.data(), std::streamsize(content.size()));
  file.close();
  require(bool(file), "the input can be written to a temporary file");
  return path;
}

}  // namespace lambent::fuzz
