// Changes JSON as a document, not as text: libFuzzer's own changes break it nearly every time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

/// libFuzzer's own ways, on `size` bytes of room for `most`; the new size.
extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

namespace lambent::fuzz {

/// A sequence of choices, the same for the same seed.
class Dice {
 public:
  explicit Dice(unsigned seed) : state_(seed * 0x9e3779b97f4a7c15ull + 1) {}
  /// Below `sides`, or 0.
  std::size_t roll(std::size_t sides) {
    state_ = state_ * 6364136223846793005ull + 1442695040888963407ull;
    return sides == 0 ? 0 : std::size_t(state_ >> 33) % sides;
  }

 private:
  std::uint64_t state_;
};

/// `text` with one or a few of its values changed, or as text where it is no JSON.
std::string mutatedJson(std::string_view text, Dice& dice);

/// `bytes` changed by libFuzzer, with room to grow by `growth`.
std::string mutatedBytes(std::string_view bytes, std::size_t growth);

/// What a target's own mutator makes of an input, of `most` bytes at most: one *_mutator.cpp for each
/// format that has one.
std::string mutated(std::string_view file, std::size_t most, Dice& dice);

/// Copies as much of `input` as fits; the new size.
std::size_t giveBack(std::string_view input, std::uint8_t* data, std::size_t most);

}  // namespace lambent::fuzz
