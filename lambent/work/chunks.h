// Work cut into chunks: what one thread takes at a time.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>

namespace lambent::work {

/// Chunks begin … end − 1 of a whole.
struct ChunkRange {
  std::size_t begin = 0, end = 0;

  std::size_t size() const { return end - begin; }
  bool has(std::size_t chunk) const { return begin <= chunk && chunk < end; }
};

/// One chunk: items begin … end − 1.
struct Chunk {
  std::size_t index = 0;
  std::size_t begin = 0, end = 0;

  std::size_t size() const { return end - begin; }
};

/// Items 0 … items − 1 in chunks of `size`, of which the last may be shorter; all of them, or a
/// range. How items are cut does not depend on the range.
class Chunks {
 public:
  explicit Chunks(std::size_t items, std::size_t size = 1)
      : items_(items), size_(size), range_{0, (items + size - 1) / size} {}

  Chunks within(ChunkRange range) const {
    assert(range.begin <= range.end && range.end <= range_.end);
    Chunks part = *this;
    part.range_ = range;
    return part;
  }
  ChunkRange range() const { return range_; }
  /// In the range.
  std::size_t items() const {
    return std::min(range_.end * size_, items_) - std::min(range_.begin * size_, items_);
  }
  Chunk operator[](std::size_t index) const {
    return {index, index * size_, std::min((index + 1) * size_, items_)};
  }

 private:
  std::size_t items_, size_;
  ChunkRange range_;
};

}  // namespace lambent::work
