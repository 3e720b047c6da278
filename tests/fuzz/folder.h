// Files for readers that take a path.
#pragma once

#include <filesystem>
#include <string_view>

#include "tests/fuzz/target.h"

namespace lambent::fuzz {

/// A folder of this process, gone when it ends. A picture tile.png of 2×1 pixels lies in it, for what
/// looks at pictures by name.
class Folder {
 public:
  static const Folder& ofProcess();
  std::filesystem::path write(std::string_view name, Bytes content) const;
  std::filesystem::path write(std::string_view name, std::string_view content) const;
  std::filesystem::path operator/(std::string_view name) const { return path_ / name; }

 private:
  Folder();
  ~Folder();
  std::filesystem::path path_;
};

}  // namespace lambent::fuzz
