// A folder of our own for files that outlive nobody.
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "lambent/report/result.h"

namespace lambent::file {

/// Goes with all that is in it when its owner goes. Nobody else can read what lies there, and no name in
/// it leads elsewhere already. discardAll() removes every one, for a signal handler.
class TemporaryFolder {
 public:
  /// In the folder for temporary files: TMPDIR, else /tmp. BadInput, with what to do, where none can
  /// be made there.
  static Result<TemporaryFolder> create();
  TemporaryFolder(TemporaryFolder&& other) noexcept;
  TemporaryFolder& operator=(TemporaryFolder&&) = delete;
  ~TemporaryFolder();

  const std::filesystem::path& path() const { return path_; }
  /// Where a file of that name is to be written: discardAll() removes those alone that were placed.
  std::filesystem::path place(std::string_view name);

  static void discardAll() noexcept;  ///< async-signal-safe

 private:
  TemporaryFolder() = default;
  std::filesystem::path path_;  ///< empty: moved from
  std::vector<int> slots_;      ///< of what discardAll() knows of it
};

}  // namespace lambent::file
