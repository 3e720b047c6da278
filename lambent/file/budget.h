// How much memory and work the reading of one file may cost: one account for all that the file asks
// for, asked before anything is allocated. A file of some kilobytes can claim gigabytes, in its
// header, or by naming one thing many times over.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "lambent/report/result.h"

namespace lambent::file {

/// Bytes that reading one file may hold at a time. Without a limit of the caller's it is the
/// smaller of two: kMostBytes, and kFloorBytes with kBytesPerByte more for each byte that was read.
/// What is sound stays far below both; a picture of one colour packs about a thousand to one.
inline constexpr std::uint64_t kMostBytes = std::uint64_t(6) << 30;
inline constexpr std::uint64_t kFloorBytes = std::uint64_t(512) << 20;
inline constexpr std::uint64_t kBytesPerByte = 1000;
/// Bytes that may pass through memory in all: as many as above without kMostBytes, or this multiple
/// of a limit of the caller's.
inline constexpr std::uint64_t kWorkPerByte = 8;

class Budget {
 public:
  Budget() = default;
  /// `limit`: bytes; nothing: as above.
  explicit Budget(std::optional<std::uint64_t> limit) : given_(limit) {}

  /// The bytes of the file itself, or of one that it names, which was read.
  void addFile(std::uint64_t bytes) { read_ += bytes; }
  /// `what` ("scene.glb: image 0 (64×64 pixels)") takes that much from now on, or BadInput that
  /// says how much, over what limit, and the remedy.
  Status hold(std::uint64_t bytes, std::string_view what);
  /// What was held is held no more.
  void release(std::uint64_t bytes) { held_ -= bytes < held_ ? bytes : held_; }
  /// As hold(), for what passes through.
  Status work(std::uint64_t bytes, std::string_view what);

  std::uint64_t limit() const;

 private:
  std::optional<std::uint64_t> given_;
  std::uint64_t read_ = 0, held_ = 0, worked_ = 0;
};

/// "2.1 GiB"
std::string inBinaryUnits(std::uint64_t bytes);

}  // namespace lambent::file
