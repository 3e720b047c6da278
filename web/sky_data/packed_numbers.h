// Whole numbers as bytes: how the files of a page hold their arrays.
#pragma once

#include <cmath>
#include <cstdint>
#include <string>

namespace lambent::page {

/// Appends an array: each number is the difference from the one before it (the first: from 0) as a
/// varint: 2 d, or −2 d − 1 if it is negative, by 7 bits to a byte, the lowest first, the eighth bit
/// set in all but the last. Small differences take one byte.
class PackedNumbers {
 public:
  explicit PackedNumbers(std::string& out) : out_(out) {}
  /// Rounded.
  void add(double value) {
    const auto whole = std::int64_t(std::llround(value));
    const std::int64_t step = whole - before_;
    before_ = whole;
    for (auto bits = std::uint64_t(step < 0 ? -2 * step - 1 : 2 * step);; bits >>= 7) {
      out_.push_back(char((bits & 127) | (bits > 127 ? 128 : 0)));
      if (bits <= 127) return;
    }
  }

 private:
  std::string& out_;
  std::int64_t before_ = 0;
};

template <class Values>
void packNumbers(const Values& values, double scale, std::string& out) {
  PackedNumbers packed(out);
  for (const double value : values) packed.add(value * scale);
}

/// MAGIC (eight letters), the header's length (uint32, little-endian), the header (JSON), the arrays.
inline std::string packedFile(const std::string& magic, const std::string& header,
                              const std::string& arrays) {
  std::string out = magic;
  for (int byte = 0; byte < 4; ++byte) out.push_back(char((header.size() >> (8 * byte)) & 0xff));
  return out + header + arrays;
}

}  // namespace lambent::page
