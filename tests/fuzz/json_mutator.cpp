#include "tests/fuzz/json_mutator.h"

#include <algorithm>
#include <cstring>
#include <nlohmann/json.hpp>
#include <vector>

namespace lambent::fuzz {
namespace {

// In the sequence of the file: what a mutation leaves alone should look as before.
using Json = nlohmann::ordered_json;

/// A value and what holds it.
struct Place {
  Json* value;
  Json* parent;
};

void collect(Json& value, Json* parent, std::vector<Place>& places) {
  places.push_back({&value, parent});
  if (value.is_structured()) {
    for (Json& child : value) collect(child, &value, places);
  }
}

std::string textOf(const Json& value) {
  return value.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Json someNumber(const Json& before, Dice& dice) {
  const double old = before.is_number() ? before.get<double>() : 1.0;
  switch (dice.roll(14)) {
    case 0:
      return 0;
    case 1:
      return -1;
    case 2:
      return 1;
    case 3:
      return old + 1;
    case 4:
      return old - 1;
    case 5:
      return old * 2;
    case 6:
      return -old;
    case 7:
      return std::int64_t(dice.roll(16));
    case 8:
      return std::int64_t(1) << dice.roll(63);
    case 9:
      return (std::int64_t(1) << dice.roll(63)) - 1;
    case 10:
      return 1e308;
    case 11:
      return 1e-320;
    case 12:
      return 0.5;
    default:
      return 5120 + std::int64_t(dice.roll(7));  // glTF's componentType
  }
}

void change(const Place& place, const std::vector<Place>& places, Dice& dice) {
  Json& value = *place.value;
  const std::size_t way = dice.roll(8);
  // A value from elsewhere, of a kind that the reader expects somewhere.
  if (way == 0) {
    const Json other = *places[dice.roll(places.size())].value;
    if (textOf(other).size() < 4096) value = other;
    return;
  }
  if (way == 1 && place.parent != nullptr) {
    Json& parent = *place.parent;
    if (parent.is_array()) {
      parent.erase(dice.roll(parent.size()));
    } else if (!parent.empty()) {
      auto at = parent.begin();
      std::advance(at, std::ptrdiff_t(dice.roll(parent.size())));
      parent.erase(at);
    }
    return;
  }
  if (value.is_number()) {
    value = someNumber(value, dice);
  } else if (value.is_string()) {
    const std::string text = value.get<std::string>();
    value = mutatedBytes(text, 32);
  } else if (value.is_boolean()) {
    value = !value.get<bool>();
  } else if (value.is_array() && !value.empty()) {
    const Json copy = value[dice.roll(value.size())];
    const std::size_t copies = dice.roll(20) == 0 ? 64 : 1;
    if (textOf(copy).size() * copies < 4096) {
      for (std::size_t i = 0; i < copies; ++i) value.push_back(copy);
    }
  } else if (value.is_object()) {
    // A member of another object under its own name.
    const Json& other = *places[dice.roll(places.size())].value;
    if (!other.is_object() || other.empty() || &other == &value) return;
    auto at = other.begin();
    std::advance(at, std::ptrdiff_t(dice.roll(other.size())));
    const std::string key = at.key();
    const Json copy = *at;
    if (textOf(copy).size() < 4096) value[key] = copy;
  } else {
    value = someNumber(value, dice);
  }
}

}  // namespace

std::string mutatedBytes(std::string_view bytes, std::size_t growth) {
  std::string text(bytes);
  text.resize(bytes.size() + growth);
  const std::size_t size =
      LLVMFuzzerMutate(reinterpret_cast<std::uint8_t*>(text.data()), bytes.size(), text.size());
  text.resize(size);
  return text;
}

std::string mutatedJson(std::string_view text, Dice& dice) {
  if (dice.roll(8) == 0) return mutatedBytes(text, 64);
  Json document = Json::parse(text, nullptr, false);
  if (document.is_discarded()) return mutatedBytes(text, 64);
  for (std::size_t changes = 1 + dice.roll(3); changes > 0; --changes) {
    std::vector<Place> places;
    collect(document, nullptr, places);
    change(places[dice.roll(places.size())], places, dice);
  }
  return textOf(document);
}

std::size_t giveBack(std::string_view input, std::uint8_t* data, std::size_t most) {
  const std::size_t size = std::min(input.size(), most);
  if (size > 0) std::memcpy(data, input.data(), size);
  return size;
}

}  // namespace lambent::fuzz
