// The files that OBJ, MTL and PLY name, as their writers spell them: with backslashes, in quotes,
// with the capitals of a file system that does not tell them apart, by the absolute path that they
// had on another machine, with a comment behind.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>

#include "lambent/scene_io/linked_files.h"

namespace lambent::scene_io {

class FileFinder {
 public:
  explicit FileFinder(const LinkedFiles& files) : files_(files) {}

  struct Found {
    std::filesystem::path path;  ///< what exists, or what the name says if nothing does
    bool exists = false;
    bool elsewhere = false;  ///< it lies beside, and not where the name says
  };
  /// The file that `name` means in `folder`, tried in this sequence: the name; with other capitals;
  /// its last parts ("textures/wood.png", "wood.png") in `folder`, then in `beside`. Outside of the scene's folder only the first
  /// is tried.
  Found find(const std::filesystem::path& folder, std::string_view name,
             const std::filesystem::path& beside);

 private:
  /// The entry of `folder` that is `name` but for capitals; empty if there is none.
  std::string entryOf(const std::filesystem::path& folder, const std::string& name);
  bool mayLookInto(const std::filesystem::path& folder);
  std::filesystem::path withOtherCapitals(const std::filesystem::path& folder,
                                          const std::filesystem::path& name);

  const LinkedFiles& files_;
  /// Of every folder looked into: lower case → as it is spelled.
  std::map<std::filesystem::path, std::map<std::string, std::string>> entries_;
  std::map<std::filesystem::path, bool> inBounds_;
};

}  // namespace lambent::scene_io
