// A file a table: its name a hash of what it is of, in it that in full, and a hash of its bytes.
#include "lambent/sky/table_cache.h"

#include <cstdint>
#include <cstring>

#include <fmt/format.h>

#include "lambent/file/atomic_file.h"

namespace lambent::sky {
namespace {

constexpr std::uintmax_t kMostBytes = 64 << 20;

/// fnv: 64 bits of Fowler, Noll and Vo's hash 1a.
std::uint64_t hashOf(std::span<const std::byte> bytes) {
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const std::byte byte : bytes) hash = (hash ^ std::uint64_t(byte)) * 0x100000001b3;
  return hash;
}

std::filesystem::path fileOf(const std::filesystem::path& folder, const Atmosphere& atmosphere,
                             double altitude) {
  const std::string key = tableKey(atmosphere, altitude);
  return folder /
         fmt::format("sky-{:016x}.table", hashOf(std::as_bytes(std::span(key.data(), key.size()))));
}

}  // namespace

std::optional<SkyTable> readTable(const std::filesystem::path& folder, const Atmosphere& atmosphere,
                                  double altitude) {
  if (folder.empty()) return std::nullopt;
  const std::filesystem::path path = fileOf(folder, atmosphere, altitude);
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (error || size > kMostBytes) return std::nullopt;
  const Result<std::vector<std::byte>> bytes = file::readWhole(path);
  if (!bytes || bytes->size() < sizeof(std::uint64_t)) return std::nullopt;
  const std::span<const std::byte> body =
      std::span(*bytes).first(bytes->size() - sizeof(std::uint64_t));
  std::uint64_t hash = 0;
  std::memcpy(&hash, body.data() + body.size(), sizeof hash);
  if (hash != hashOf(body)) return std::nullopt;
  return SkyTable::fromBytes(body, atmosphere, altitude);
}

Status keepTable(const std::filesystem::path& folder, const Atmosphere& atmosphere,
                 const SkyTable& table) {
  if (folder.empty()) return Status::ok();
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) return report::failed(fmt::format("{}: {}", folder.string(), error.message()));
  std::vector<std::byte> bytes = table.bytes();
  const std::uint64_t hash = hashOf(bytes);
  const auto* tail = reinterpret_cast<const std::byte*>(&hash);
  bytes.insert(bytes.end(), tail, tail + sizeof hash);
  return file::writeAtomically(fileOf(folder, atmosphere, table.altitude()), bytes);
}

}  // namespace lambent::sky
