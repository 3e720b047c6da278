#include "lambent/transfer/names.h"

#include <array>
#include <utility>

namespace lambent::transfer {

namespace {

template <class T, std::size_t N>
using Table = std::array<std::pair<T, std::string_view>, N>;

constexpr Table<Kind, 3> kKindNames{{{Kind::Unshadowed, "unshadowed"},
                                     {Kind::Shadowed, "shadowed"},
                                     {Kind::Interreflected, "interreflected"}}};
constexpr Table<Albedo, 2> kAlbedoNames{
    {{Albedo::Included, "included"}, {Albedo::BaseColor, "baseColor"}}};
constexpr Table<Encoding, 3> kEncodingNames{
    {{Encoding::Float16, "float16"}, {Encoding::Float32, "float32"}, {Encoding::Snorm8, "snorm8"}}};

template <class T, std::size_t N>
std::string_view find(const Table<T, N>& table, T value) {
  for (const auto& [entry, name] : table)
    if (entry == value) return name;
  return "unknown";
}

template <class T, std::size_t N>
std::optional<T> find(const Table<T, N>& table, std::string_view name) {
  for (const auto& [entry, entryName] : table)
    if (entryName == name) return entry;
  return std::nullopt;
}

}  // namespace

std::string_view nameOf(Kind kind) {
  return find(kKindNames, kind);
}
std::string_view nameOf(Albedo albedo) {
  return find(kAlbedoNames, albedo);
}
std::string_view nameOf(Encoding encoding) {
  return find(kEncodingNames, encoding);
}
std::optional<Kind> kindNamed(std::string_view name) {
  return find(kKindNames, name);
}
std::optional<Albedo> albedoNamed(std::string_view name) {
  return find(kAlbedoNames, name);
}
std::optional<Encoding> encodingNamed(std::string_view name) {
  return find(kEncodingNames, name);
}

std::string_view layoutOf(const Receivers& receivers) {
  return receivers.texels() ? "texels" : "vertices";
}

}  // namespace lambent::transfer
