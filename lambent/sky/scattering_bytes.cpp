// What was solved, to be kept and read back.
#include <cstring>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "lambent/sky/atmosphere.h"
#include "lambent/sky/scattering_tables.h"

namespace lambent::sky {
namespace {

void append(std::vector<std::byte>& out, const void* data, std::size_t size) {
  const std::size_t at = out.size();
  out.resize(at + size);
  std::memcpy(out.data() + at, data, size);
}

}  // namespace

std::string scatteringKey(const Atmosphere& atmosphere, std::span<const double> wavelengths,
                          const Resolution& r) {
  Atmosphere nameless = atmosphere;
  nameless.name.clear();
  return fmt::format(
      "lambent scattering 1\n{}\nwavelengths {:a}\nresolution {:a} {} {} {} {} {} {} {} {} {:a} {} "
      "{:a} {} {:a} {:a}\n",
      toJson(nameless), fmt::join(wavelengths, " "), r.sunDensity, r.altitudes, r.upward,
      r.downward, r.around, r.zeniths, r.azimuths, r.levels, r.nodes, r.depth, r.cubic, r.tolerance,
      r.orders, r.sunFrom, r.sunTo);
}

std::vector<std::byte> Scattering::bytes(const Atmosphere& atmosphere) const {
  const std::string key = scatteringKey(atmosphere, medium().wavelengths, resolution());
  std::vector<std::byte> out;
  append(out, key.data(), key.size());
  append(out, &impl_->orders, sizeof impl_->orders);
  Impl::forEachStored(*impl_, [&](const std::vector<float>& part) {
    append(out, part.data(), part.size() * sizeof(float));
  });
  return out;
}

std::optional<Scattering> Scattering::fromBytes(std::span<const std::byte> bytes,
                                                const Atmosphere& atmosphere,
                                                std::span<const double> wavelengths,
                                                const Resolution& resolution) {
  const std::string key = scatteringKey(atmosphere, wavelengths, resolution);
  if (bytes.size() < key.size() || std::memcmp(bytes.data(), key.data(), key.size()) != 0)
    return std::nullopt;
  bytes = bytes.subspan(key.size());
  const auto impl = Impl::empty(mediumOf(atmosphere, wavelengths), resolution);
  bool whole = true;
  const auto take = [&](void* to, std::size_t size) {
    whole = whole && bytes.size() >= size;
    if (!whole) return;
    std::memcpy(to, bytes.data(), size);
    bytes = bytes.subspan(size);
  };
  take(&impl->orders, sizeof impl->orders);
  Impl::forEachStored(
      *impl, [&](std::vector<float>& part) { take(part.data(), part.size() * sizeof(float)); });
  if (!whole || !bytes.empty()) return std::nullopt;
  return Scattering(impl);
}

}  // namespace lambent::sky
