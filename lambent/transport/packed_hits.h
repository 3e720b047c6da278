// The hits of several receivers in four to six bytes each; four more where they have a colour.
#pragma once

#include <bit>
#include <cstdint>
#include <vector>

#include "lambent/transport/hits.h"

namespace lambent::transport {

/// The hits of a chunk's receivers. Directions are kept as a list or, where that is shorter, as one
/// bit for each direction of the set.
class PackedHits {
 public:
  void add(const ReceiverHits& hits, std::size_t directionCount) {
    begin_.push_back(static_cast<std::uint32_t>(receiver_.size()));
    directionBegin_.push_back(static_cast<std::uint32_t>(directions_.size()));
    colourBegin_.push_back(static_cast<std::uint32_t>(colour_.size()));
    mirroredBegin_.push_back(static_cast<std::uint32_t>(mirrored_.size()));
    colour_.insert(colour_.end(), hits.colour.begin(), hits.colour.end());
    receiver_.insert(receiver_.end(), hits.receiver.begin(), hits.receiver.end());
    mirrored_.insert(mirrored_.end(), hits.mirrored.begin(), hits.mirrored.end());
    const std::size_t words = wordsFor(directionCount);
    if (hits.direction.size() <= words) {
      directions_.insert(directions_.end(), hits.direction.begin(), hits.direction.end());
      return;
    }
    const std::size_t first = directions_.size();
    directions_.resize(first + words);
    for (const std::uint16_t d : hits.direction)
      directions_[first + d / 16] |= static_cast<std::uint16_t>(1u << (d % 16));
  }

  /// Gives back what add() number `which` took: hits are in the sequence of their directions.
  void get(std::size_t which, std::size_t directionCount, ReceiverHits& hits) const {
    const auto slice = [which](const auto& from, const auto& starts, auto& to) {
      const std::size_t last = which + 1 < starts.size() ? starts[which + 1] : from.size();
      to.assign(from.begin() + starts[which], from.begin() + static_cast<std::ptrdiff_t>(last));
    };
    slice(receiver_, begin_, hits.receiver);
    slice(colour_, colourBegin_, hits.colour);
    slice(mirrored_, mirroredBegin_, hits.mirrored);
    const std::size_t words = wordsFor(directionCount);
    if (hits.receiver.size() <= words) return slice(directions_, directionBegin_, hits.direction);
    hits.direction.clear();
    for (std::size_t w = 0; w < words; ++w)
      for (unsigned bits = directions_[directionBegin_[which] + w]; bits != 0; bits &= bits - 1)
        hits.direction.push_back(static_cast<std::uint16_t>(16 * w + std::countr_zero(bits)));
  }

  std::size_t bytes() const {
    return receiver_.size() * 4 + directions_.size() * 2 + colour_.size() * 4 +
           mirrored_.size() * sizeof(MirroredHit);
  }
  void shrink() {
    receiver_.shrink_to_fit(), directions_.shrink_to_fit();
    colour_.shrink_to_fit(), mirrored_.shrink_to_fit();
  }

 private:
  static std::size_t wordsFor(std::size_t directionCount) { return (directionCount + 15) / 16; }

  std::vector<std::uint32_t> begin_, directionBegin_, colourBegin_, mirroredBegin_;  ///< of each
  std::vector<std::uint32_t> receiver_, colour_;
  std::vector<std::uint16_t> directions_;
  std::vector<MirroredHit> mirrored_;
};

}  // namespace lambent::transport
