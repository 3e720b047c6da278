// Files that appear whole or not at all: written beside their place, synced, then renamed.
#pragma once

#include <cstdio>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lambent/report/result.h"

namespace lambent::file {

/// A temporary file beside `path`; commit() renames it there, destruction without commit removes
/// it. discardAll() removes every open one, for a signal handler.
class AtomicFile {
 public:
  static Result<AtomicFile> create(const std::filesystem::path& path);
  AtomicFile(AtomicFile&& other) noexcept;
  AtomicFile& operator=(AtomicFile&&) = delete;
  ~AtomicFile();

  Status write(std::span<const std::byte> bytes);
  Status write(std::string_view text);
  /// Where the bytes go meanwhile, for libraries that want a name instead of bytes.
  const std::filesystem::path& temporaryPath() const { return temporary_; }
  Status commit();

  static void discardAll() noexcept;  ///< async-signal-safe

 private:
  AtomicFile() = default;
  std::filesystem::path path_, temporary_;
  int descriptor_ = -1;
  int slot_ = -1;
};

Status writeAtomically(const std::filesystem::path& path, std::span<const std::byte> bytes);
Status writeAtomically(const std::filesystem::path& path, std::string_view text);
/// Whether a file can be created at `path`: asked before long work, so that an hour of baking does
/// not end at a missing folder.
Status checkWritable(const std::filesystem::path& path);
Result<std::vector<std::byte>> readWhole(const std::filesystem::path& path);

}  // namespace lambent::file
