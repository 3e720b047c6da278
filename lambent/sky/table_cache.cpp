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

std::filesystem::path fileOf(const std::filesystem::path& folder, std::string_view kind,
                             const std::string& key) {
  return folder / fmt::format("{}-{:016x}.table", kind,
                              hashOf(std::as_bytes(std::span(key.data(), key.size()))));
}

/// The bytes of a file without their hash; nothing of a file that cannot be trusted.
std::optional<std::vector<std::byte>> readWholeFile(const std::filesystem::path& path) {
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (error || size > kMostBytes) return std::nullopt;
  Result<std::vector<std::byte>> bytes = file::readWhole(path);
  if (!bytes || bytes->size() < sizeof(std::uint64_t)) return std::nullopt;
  std::uint64_t hash = 0;
  const std::size_t body = bytes->size() - sizeof hash;
  std::memcpy(&hash, bytes->data() + body, sizeof hash);
  bytes->resize(body);
  if (hash != hashOf(*bytes)) return std::nullopt;
  return std::move(*bytes);
}

Status writeWholeFile(const std::filesystem::path& path, std::vector<std::byte> bytes) {
  std::error_code error;
  std::filesystem::create_directories(path.parent_path(), error);
  if (error)
    return report::failed(fmt::format("{}: {}", path.parent_path().string(), error.message()));
  const std::uint64_t hash = hashOf(bytes);
  const auto* tail = reinterpret_cast<const std::byte*>(&hash);
  bytes.insert(bytes.end(), tail, tail + sizeof hash);
  return file::writeAtomically(path, bytes);
}

constexpr std::string_view kOfSkies = "sky", kOfAir = "air";

}  // namespace

std::optional<SkyTable> readTable(const std::filesystem::path& folder, const Atmosphere& atmosphere,
                                  double altitude) {
  if (folder.empty()) return std::nullopt;
  const auto bytes = readWholeFile(fileOf(folder, kOfSkies, tableKey(atmosphere, altitude)));
  return bytes ? SkyTable::fromBytes(*bytes, atmosphere, altitude) : std::nullopt;
}

Status keepTable(const std::filesystem::path& folder, const Atmosphere& atmosphere,
                 const SkyTable& table) {
  if (folder.empty()) return Status::ok();
  return writeWholeFile(fileOf(folder, kOfSkies, tableKey(atmosphere, table.altitude())),
                        table.bytes());
}

std::optional<Scattering> readScattering(const std::filesystem::path& folder,
                                         const Atmosphere& atmosphere,
                                         std::span<const double> wavelengths,
                                         const Resolution& resolution) {
  if (folder.empty()) return std::nullopt;
  const auto bytes =
      readWholeFile(fileOf(folder, kOfAir, scatteringKey(atmosphere, wavelengths, resolution)));
  return bytes ? Scattering::fromBytes(*bytes, atmosphere, wavelengths, resolution) : std::nullopt;
}

Status keepScattering(const std::filesystem::path& folder, const Atmosphere& atmosphere,
                      const Scattering& scattering) {
  if (folder.empty()) return Status::ok();
  const std::string key =
      scatteringKey(atmosphere, scattering.medium().wavelengths, scattering.resolution());
  return writeWholeFile(fileOf(folder, kOfAir, key), scattering.bytes(atmosphere));
}

}  // namespace lambent::sky
