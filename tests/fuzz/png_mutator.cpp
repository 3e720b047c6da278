// PNG (ISO/IEC 15948, §5): one chunk is changed at a time, and its length and checksum are right
// again. Image data are changed behind Deflate: packed anew, or their codes as they are.
#include <zlib.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "tests/fuzz/json_mutator.h"

namespace lambent::fuzz {
namespace {

constexpr std::size_t kMagic = 8;
constexpr std::size_t kMostRaw = 1 << 16;  ///< bytes of image data, unpacked

struct Chunk {
  std::string type, data;
};

std::uint32_t bigEndian(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i)
    value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
  return value;
}

std::string bigEndian(std::size_t value) {
  return {static_cast<char>(value >> 24), static_cast<char>(value >> 16),
          static_cast<char>(value >> 8), static_cast<char>(value)};
}

std::vector<Chunk> split(std::string_view file) {
  std::vector<Chunk> chunks;
  for (std::size_t at = kMagic; at + 12 <= file.size();) {
    const std::size_t length = std::min<std::size_t>(bigEndian(file, at), file.size() - at - 12);
    chunks.push_back(
        {std::string(file.substr(at + 4, 4)), std::string(file.substr(at + 8, length))});
    at += 12 + length;
  }
  return chunks;
}

std::string joined(std::string_view magic, const std::vector<Chunk>& chunks) {
  std::string file(magic);
  for (const Chunk& chunk : chunks) {
    const std::string body = chunk.type + chunk.data;
    const auto* bytes = reinterpret_cast<const unsigned char*>(body.data());
    file += bigEndian(chunk.data.size()) + body +
            bigEndian(crc32(0, bytes, static_cast<unsigned>(body.size())));
  }
  return file;
}

void changeUnpacked(std::string& data) {
  std::string raw(kMostRaw, '\0');
  uLongf size = raw.size();
  const int code = uncompress(reinterpret_cast<Bytef*>(raw.data()), &size,
                              reinterpret_cast<const Bytef*>(data.data()), data.size());
  if (code != Z_OK) return void(data = mutatedBytes(data, 32));
  raw.resize(size);
  raw = mutatedBytes(raw, 64);
  std::string packed(compressBound(raw.size()), '\0');
  size = packed.size();
  compress(reinterpret_cast<Bytef*>(packed.data()), &size,
           reinterpret_cast<const Bytef*>(raw.data()), raw.size());
  packed.resize(size);
  data = packed;
}

}  // namespace

std::string mutated(std::string_view file, std::size_t most, Dice& dice) {
  std::vector<Chunk> chunks = file.size() < kMagic ? std::vector<Chunk>() : split(file);
  if (chunks.empty() || dice.roll(20) == 0) return mutatedBytes(file, 16);
  const std::size_t index = dice.roll(chunks.size());
  Chunk& chunk = chunks[index];
  switch (dice.roll(8)) {
    case 0:
      chunks.push_back(chunk);
      std::swap(chunks[dice.roll(chunks.size())], chunks.back());
      break;
    case 1:
      chunks.erase(chunks.begin() + std::ptrdiff_t(index));
      break;
    case 2:
      chunk.type = chunks[dice.roll(chunks.size())].type;
      break;
    case 3:
      if (chunk.type == "IHDR" && chunk.data.size() == 13) {
        constexpr char kTypes[] = {0, 2, 3, 4, 6}, kDepths[] = {1, 2, 4, 8, 16};
        chunk.data[8] = kDepths[dice.roll(5)];
        chunk.data[9] = kTypes[dice.roll(5)];
        chunk.data[12] = char(dice.roll(2));
        break;
      }
      [[fallthrough]];
    default:
      if (chunk.type == "IDAT" && dice.roll(3) != 0) {
        changeUnpacked(chunk.data);
      } else {
        chunk.data = mutatedBytes(chunk.data, 16);
      }
  }
  std::string made = joined(file.substr(0, kMagic), chunks);
  return made.size() <= most ? made : std::string(file);
}

}  // namespace lambent::fuzz
