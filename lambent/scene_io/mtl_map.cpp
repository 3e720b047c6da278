#include "lambent/scene_io/mtl_map.h"

#include <cmath>
#include <optional>
#include <vector>

#include "lambent/scene_io/text_cursor.h"

namespace lambent::scene_io {
namespace {

/// How many words follow an option at most; numbers, or words as "on".
struct MapOption {
  std::string_view name;
  int arguments;
  bool numbers;
};
constexpr MapOption kMapOptions[] = {
    {"-s", 3, true},       {"-o", 3, true},          {"-t", 3, true},       {"-mm", 2, true},
    {"-bm", 1, true},      {"-boost", 1, true},      {"-texres", 1, false}, {"-clamp", 1, false},
    {"-blendu", 1, false}, {"-blendv", 1, false},    {"-cc", 1, false},     {"-imfchan", 1, false},
    {"-type", 1, false},   {"-colorspace", 1, false}};

const MapOption* mapOptionNamed(std::string_view name) {
  for (const MapOption& option : kMapOptions) {
    if (option.name == name) return &option;
  }
  return nullptr;
}

/// A word of the statement: where it stands, and whether a number.
struct MapWord {
  std::string_view text;
  std::optional<double> number;
};

std::vector<MapWord> mapWordsOf(std::string_view text) {
  std::vector<MapWord> words;
  TextCursor cursor(text);
  if (!cursor.nextLine()) return words;
  for (std::string_view word = cursor.word(); !word.empty(); word = cursor.word()) {
    const auto parsed = parseNumber(word.data(), word.data() + word.size());
    const bool whole = parsed && parsed->end == word.data() + word.size();
    words.push_back({word, whole ? std::optional(parsed->value) : std::nullopt});
  }
  return words;
}

/// Applies an option to `map`; what leaves everything as it is is not worth a word.
void applyMapOption(std::string_view name, const std::vector<MapWord>& arguments, MtlMap& map) {
  const auto number = [&](std::size_t i, double otherwise) {
    const double value = i < arguments.size() ? arguments[i].number.value_or(otherwise) : otherwise;
    return std::isfinite(value) ? value : otherwise;
  };
  const auto is = [&](std::string_view word) {
    return !arguments.empty() && arguments[0].text == word;
  };
  bool ignored = false;
  if (name == "-s") {
    map.uv.scale = Vec2(float(number(0, 1.0)), float(number(1, 1.0)));
  } else if (name == "-o") {
    map.uv.offset = Vec2(float(number(0, 0.0)), float(number(1, 0.0)));
  } else if (name == "-clamp") {
    map.clamp = is("on");
  } else if (name == "-t") {
    ignored = number(0, 0.0) != 0.0 || number(1, 0.0) != 0.0;
  } else if (name == "-mm") {
    ignored = number(0, 0.0) != 0.0 || number(1, 1.0) != 1.0;
  } else if (name == "-cc") {
    ignored = is("on");
  } else if (name == "-imfchan" || name == "-colorspace") {
    ignored = true;
  }
  if (ignored) map.ignored += (map.ignored.empty() ? "" : " ") + std::string(name);
}

}  // namespace

Vec2 UvTransform::apply(const Vec2& uv) const {
  if (isIdentity()) return uv;  // to the bit
  return {uv.x() * scale.x() + offset.x(), 1.0f - ((1.0f - uv.y()) * scale.y() + offset.y())};
}

MtlMap readMtlMap(std::string_view text) {
  MtlMap map;
  const std::vector<MapWord> words = mapWordsOf(text);
  const char *first = nullptr, *last = nullptr;  // of the name
  bool behind = false;                           // options are, and then nothing is part of it
  for (std::size_t i = 0; i < words.size();) {
    const MapOption* option = mapOptionNamed(words[i].text);
    if (option == nullptr) {
      if (behind) break;
      if (first == nullptr) first = words[i].text.data();
      last = words[i].text.data() + words[i].text.size();
      ++i;
      continue;
    }
    std::vector<MapWord> arguments;
    for (++i; i < words.size() && int(arguments.size()) < option->arguments; ++i) {
      if (option->numbers && !words[i].number) break;
      // A name may be all that is left.
      if (!option->numbers && first == nullptr && i + 1 == words.size()) break;
      arguments.push_back(words[i]);
    }
    applyMapOption(option->name, arguments, map);
    behind = first != nullptr;
  }
  if (first != nullptr) map.name.assign(first, last);
  return map;
}

}  // namespace lambent::scene_io
