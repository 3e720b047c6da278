// What a scene says about other files: percent-encoded relative names and data URIs. They lie in
// its folder and below: a scene from somewhere else must not carry away what else is on this
// machine.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "lambent/file/budget.h"
#include "lambent/report/result.h"
#include "lambent/scene_io/load.h"

namespace lambent::scene_io {

/// RFC 4648, whitespace skipped; nothing if there is a foreign character.
std::optional<std::vector<std::byte>> decodeBase64(std::string_view text);

bool isDataUri(std::string_view uri);

class LinkedFiles {
 public:
  LinkedFiles(const std::filesystem::path& scene, const LoadOptions& options)
      : scene_(scene), options_(options), budget_(options.memoryLimit) {}

  const LoadOptions& options() const { return options_; }
  /// What reading the scene costs, with all the files that it names.
  file::Budget& budget() { return budget_; }

  /// The scene's own file.
  Result<std::vector<std::byte>> readScene();

  /// Whether `path` lies in the scene's folder or below, once links and ".." are followed, or may
  /// lie anywhere.
  bool mayRead(const std::filesystem::path& path) const;
  /// BadInput that names `what` ("buffer 0"), the name that the scene has for it, and the remedy.
  Error outside(const std::string& what, const std::string& name) const;

  /// The bytes behind a URI: a data URI's own, or a regular file's. `what` names the thing in
  /// messages.
  Result<std::vector<std::byte>> readUri(const std::string& uri, const std::string& what);
  /// Where a URI that is no data URI leads: the same place for every spelling of it. It may not
  /// exist.
  std::filesystem::path placeOf(const std::string& uri) const;
  /// Whether mayRead() is true of the place of a URI, or it is none.
  bool mayReadUri(const std::string& uri) const;
  /// Remembers that the scene names a file, or all that the buffers and images of a glTF document
  /// name.
  void note(const std::filesystem::path& path) { noted_.insert(path); }
  void noteGltf(const nlohmann::json& document);
  std::vector<std::filesystem::path> noted() const { return {noted_.begin(), noted_.end()}; }
  /// A whole file, its size in the budget.
  Result<std::vector<std::byte>> read(const std::filesystem::path& path);

 private:
  /// The file that a URI means, which may not exist: as it says, or as FileFinder finds it where
  /// its writer thought of another machine.
  std::filesystem::path pathOf(const std::string& uri) const;

  std::filesystem::path scene_;
  LoadOptions options_;
  file::Budget budget_;
  std::set<std::filesystem::path> noted_;
  mutable std::map<std::string, std::filesystem::path> found_;  ///< what was looked for, by URI
};

}  // namespace lambent::scene_io
