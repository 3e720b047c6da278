#include "lambent/asset/names.h"

#include <array>
#include <utility>

namespace lambent::asset {

namespace {

using encode::Encoding;
using transport::Albedo;
using transport::Layout;
using transport::TransferKind;

template <class T, std::size_t N>
using Table = std::array<std::pair<T, std::string_view>, N>;

constexpr Table<TransferKind, 3> kKinds{{{TransferKind::Unshadowed, "unshadowed"},
                                         {TransferKind::Shadowed, "shadowed"},
                                         {TransferKind::Interreflected, "interreflected"}}};
constexpr Table<Layout, 3> kLayouts{
    {{Layout::None, "none"}, {Layout::Vertices, "vertices"}, {Layout::Texels, "texels"}}};
constexpr Table<Albedo, 2> kAlbedos{
    {{Albedo::Included, "included"}, {Albedo::BaseColor, "baseColor"}}};
constexpr Table<Encoding, 3> kEncodings{
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

std::string_view nameOf(TransferKind kind) {
  return find(kKinds, kind);
}
std::string_view nameOf(Layout layout) {
  return find(kLayouts, layout);
}
std::string_view nameOf(Albedo albedo) {
  return find(kAlbedos, albedo);
}
std::string_view nameOf(Encoding encoding) {
  return find(kEncodings, encoding);
}
std::optional<TransferKind> transferKindNamed(std::string_view name) {
  return find(kKinds, name);
}
std::optional<Layout> layoutNamed(std::string_view name) {
  return find(kLayouts, name);
}
std::optional<Albedo> albedoNamed(std::string_view name) {
  return find(kAlbedos, name);
}
std::optional<Encoding> encodingNamed(std::string_view name) {
  return find(kEncodings, name);
}

}  // namespace lambent::asset
