#include "lambent/scene_io/mtl_entry.h"

#include <algorithm>
#include <cctype>
#include <iterator>

#include "lambent/scene_io/text_cursor.h"

namespace lambent::scene_io {
namespace {

/// Three numbers, or one for all; none where a spectrum or a curve stands.
std::optional<Rgb> colorOf(TextCursor& cursor) {
  const auto r = cursor.number();
  if (!r) return {};
  const auto g = cursor.number(), b = cursor.number();
  const Rgb c = g && b ? Rgb(float(*r), float(*g), float(*b)) : Rgb(Rgb::Constant(float(*r)));
  return c.isFinite().all() ? std::optional(c) : std::nullopt;
}

template <class Names>
bool isOneOf(std::string_view key, const Names& names) {
  return std::find(std::begin(names), std::end(names), key) != std::end(names);
}

/// What changes nothing here: ambient light, the filter and index of what is transparent anyway (d,
/// Tr and illum say so), sharpness of reflection maps.
constexpr std::string_view kWithoutMeaning[] = {"Ka", "Tf", "Ni", "sharpness", "map_aat", "Km"};
/// Layers over the surface: sheen, clearcoat, anisotropy.
constexpr std::string_view kLayers[] = {"Ps", "Pc", "Pcr", "aniso", "anisor"};
constexpr std::string_view kOtherMaps[] = {"bump", "norm", "disp", "decal", "refl"};

void readStatement(std::string_view key, TextCursor& cursor, MtlEntry& entry) {
  const auto set = [&](std::optional<double>& value) {
    // "d -halo 0.5": a factor that depends on the angle.
    if (cursor.rest().starts_with("-halo")) cursor.word();
    if (const auto number = cursor.number(); number && *number == *number) value = *number;
  };
  const auto setColor = [&](std::optional<Rgb>& value) {
    value = colorOf(cursor);
    if (!value) entry.unknown.push_back(std::string(key) + " of another kind");
  };
  if (key == "Kd") return setColor(entry.diffuse);
  if (key == "Ks") return setColor(entry.specular);
  if (key == "Ke") return setColor(entry.emission);
  if (key == "Ns") return set(entry.exponent);
  if (key == "Pm") return set(entry.metallic);
  if (key == "Pr") return set(entry.roughness);
  if (key == "d") return set(entry.opacity);
  if (key == "Tr") return set(entry.transparency);
  if (key == "illum") {
    const double value = cursor.number().value_or(2.0);
    entry.illumination = value >= 0.0 && value <= 10.0 ? int(value) : 2;
  } else if (key == "map_Kd") {
    entry.diffuseMap = readMtlMap(cursor.rest());
  } else if (key == "map_d" || key == "map_D" || key == "map_opacity") {
    entry.opacityMap = readMtlMap(cursor.rest());
  } else if (isOneOf(key, kWithoutMeaning)) {
    return;
  } else if (key.starts_with("map_") || isOneOf(key, kOtherMaps)) {
    entry.otherMaps.emplace_back(key, readMtlMap(cursor.rest()).name);
  } else if (isOneOf(key, kLayers)) {
    if (cursor.number().value_or(0.0) != 0.0) entry.layers.emplace_back(key);
  } else {
    entry.unknown.emplace_back(key);
  }
}

}  // namespace

std::vector<MtlEntry> readMtlEntries(std::string_view text) {
  std::vector<MtlEntry> entries;
  TextCursor cursor(text, TextCursor::Joining::Backslash);
  while (cursor.nextLine()) {
    const std::string_view key = cursor.word();
    // A lone control character is the end of a file of CP/M's descendants.
    if (key.empty() || key[0] == '#' || key[0] < ' ') continue;
    if (key == "newmtl") {
      entries.emplace_back();
      entries.back().name = cursor.rest();
    } else if (!entries.empty()) {
      readStatement(key, cursor, entries.back());
    }
  }
  return entries;
}

}  // namespace lambent::scene_io
