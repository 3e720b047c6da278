// .glb (glTF 2.0 specification, §4.4): JSON and binary chunk are changed apart, and the lengths are
// right again. What does not begin as a .glb is the JSON of a .gltf.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "tests/fuzz/json_mutator.h"

namespace lambent::fuzz {
namespace {

std::uint32_t littleEndian(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 4; i-- > 0;) value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
  return value;
}

std::string littleEndian(std::size_t value) {
  std::string bytes;
  for (int i = 0; i < 4; ++i) bytes += static_cast<char>(value >> (8 * i));
  return bytes;
}

struct Chunks {
  std::string json, binary;
};

/// As far as the lengths can be believed.
Chunks split(std::string_view file) {
  Chunks chunks;
  if (file.size() < 20) return chunks;
  const std::size_t length = std::min<std::size_t>(littleEndian(file, 12), file.size() - 20);
  chunks.json = file.substr(20, length);
  const std::size_t next = 20 + (length + 3) / 4 * 4;
  if (next + 8 <= file.size()) chunks.binary = file.substr(next + 8);
  return chunks;
}

/// The first buffer is as long as the chunk that it lies in.
std::string withBufferLength(const std::string& json, std::size_t length) {
  auto document = nlohmann::ordered_json::parse(json, nullptr, false);
  if (!document.is_object() || !document.contains("buffers")) return json;
  auto& buffers = document["buffers"];
  if (!buffers.is_array() || buffers.empty() || !buffers[0].is_object()) return json;
  buffers[0]["byteLength"] = length;
  return document.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

std::string joined(Chunks chunks) {
  while (chunks.json.size() % 4 != 0) chunks.json += ' ';
  while (chunks.binary.size() % 4 != 0) chunks.binary += '\0';
  const std::size_t total = 28 + chunks.json.size() + chunks.binary.size();
  return "glTF" + littleEndian(2) + littleEndian(total) + littleEndian(chunks.json.size()) +
         "JSON" + chunks.json + littleEndian(chunks.binary.size()) + std::string("BIN\0", 4) +
         chunks.binary;
}

}  // namespace

std::string mutated(std::string_view file, std::size_t most, Dice& dice) {
  if (!file.starts_with("glTF")) return mutatedJson(file, dice);
  if (dice.roll(20) == 0) return mutatedBytes(file, 16);
  Chunks chunks = split(file);
  if (dice.roll(3) == 0 && !chunks.binary.empty()) {
    chunks.binary = mutatedBytes(chunks.binary, dice.roll(2) * 64);
    if (dice.roll(2)) chunks.json = withBufferLength(chunks.json, chunks.binary.size());
  } else {
    chunks.json = mutatedJson(chunks.json, dice);
  }
  std::string made = joined(chunks);
  return made.size() <= most ? made : std::string(file);
}

}  // namespace lambent::fuzz
