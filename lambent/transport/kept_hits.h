// What the rays of a first pass met, kept for the passes after it as far as memory allows.
#pragma once

#include <atomic>
#include <cstddef>
#include <utility>
#include <vector>

#include "lambent/work/chunks.h"

namespace lambent::transport {

/// Hits of chunks of receivers, within a budget of bytes. A chunk for whose hits there was no room
/// has none here and is cast again: rays that are cast again meet the same, so what is computed
/// does not depend on the budget, nor on which chunks came first. Hits: what a chunk met, with
/// bytes(), what it takes, and shrink(), which gives back what it reserved beyond that.
template <class Hits>
class KeptHits {
 public:
  /// Of the chunks of a range, in at most so many bytes.
  KeptHits(work::ChunkRange chunks, std::size_t bytes)
      : chunks_(chunks), budget_(bytes), kept_(chunks.size()) {}
  /// Not while chunks are being kept.
  KeptHits(KeptHits&& other) noexcept
      : chunks_(other.chunks_),
        budget_(other.budget_),
        used_(other.used_.load()),
        kept_(std::move(other.kept_)) {}

  /// Keeps what a chunk met, if there is room. Once for each chunk of the range, from any thread.
  void keep(std::size_t chunk, Hits&& hits) {
    const std::size_t bytes = hits.bytes();
    if (used_.fetch_add(bytes) + bytes > budget_) {
      used_ -= bytes;
      return;
    }
    hits.shrink();
    Kept& place = kept_[chunk - chunks_.begin];
    place.hits = std::move(hits);
    place.here = true;
  }

  /// What a chunk met; null: cast it again.
  const Hits* of(std::size_t chunk) const {
    if (!chunks_.has(chunk) || !kept_[chunk - chunks_.begin].here) return nullptr;
    return &kept_[chunk - chunks_.begin].hits;
  }
  std::size_t bytes() const { return used_; }

 private:
  struct Kept {
    Hits hits;
    bool here = false;
  };

  work::ChunkRange chunks_;
  std::size_t budget_;
  std::atomic<std::size_t> used_{0};
  std::vector<Kept> kept_;
};

}  // namespace lambent::transport
