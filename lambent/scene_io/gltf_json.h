// Looking into JSON that may hold anything: nothing here throws, whatever the file says.
#pragma once

#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "lambent/math/types.h"

namespace lambent::scene_io {

/// The member `key` of an object, or null.
inline const nlohmann::json* find(const nlohmann::json* object, std::string_view key) {
  if (object == nullptr || !object->is_object()) return nullptr;
  const auto it = object->find(key);
  return it == object->end() ? nullptr : &*it;
}
inline const nlohmann::json* find(const nlohmann::json& object, std::string_view key) {
  return find(&object, key);
}

/// Element `index` of the array `key`, or null.
inline const nlohmann::json* element(const nlohmann::json& object, std::string_view key,
                                     std::int64_t index) {
  const nlohmann::json* array = find(object, key);
  if (array == nullptr || !array->is_array() || index < 0 ||
      std::uint64_t(index) >= array->size()) {
    return nullptr;
  }
  return &(*array)[std::size_t(index)];
}

inline std::size_t arraySize(const nlohmann::json* array) {
  return array != nullptr && array->is_array() ? array->size() : 0;
}

/// A whole number that fits 2⁵³, or nothing.
inline std::optional<std::int64_t> asInteger(const nlohmann::json* value) {
  if (value == nullptr || !value->is_number()) return {};
  const double d = value->get<double>();
  if (!(std::abs(d) < 9007199254740992.0) || d != std::floor(d)) return {};
  return std::int64_t(d);
}
inline std::optional<std::int64_t> integer(const nlohmann::json* object, std::string_view key) {
  return asInteger(find(object, key));
}
inline std::optional<std::int64_t> integer(const nlohmann::json& object, std::string_view key) {
  return integer(&object, key);
}

inline double number(const nlohmann::json* object, std::string_view key, double otherwise) {
  const nlohmann::json* value = find(object, key);
  if (value == nullptr || !value->is_number()) return otherwise;
  const double d = value->get<double>();
  return std::isfinite(d) ? d : otherwise;
}

inline bool flag(const nlohmann::json* object, std::string_view key) {
  const nlohmann::json* value = find(object, key);
  return value != nullptr && value->is_boolean() && value->get<bool>();
}

inline std::string text(const nlohmann::json* object, std::string_view key) {
  const nlohmann::json* value = find(object, key);
  return value != nullptr && value->is_string() ? value->get<std::string>() : std::string();
}

/// At least `count` finite numbers, or nothing.
inline std::optional<std::vector<double>> numbers(const nlohmann::json* object,
                                                  std::string_view key, std::size_t count) {
  const nlohmann::json* array = find(object, key);
  if (arraySize(array) < count) return {};
  std::vector<double> values(count);
  for (std::size_t i = 0; i < count; ++i) {
    const nlohmann::json& value = (*array)[i];
    if (!value.is_number()) return {};
    values[i] = value.get<double>();
    if (!std::isfinite(values[i])) return {};
  }
  return values;
}

inline std::optional<Rgb> rgb(const nlohmann::json* object, std::string_view key) {
  const auto values = numbers(object, key, 3);
  if (!values) return {};
  return Rgb(float((*values)[0]), float((*values)[1]), float((*values)[2]));
}

}  // namespace lambent::scene_io
