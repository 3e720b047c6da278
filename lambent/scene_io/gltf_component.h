// The components of glTF's accessors.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string_view>

#include "lambent/scene_io/gltf_write.h"

namespace lambent::scene_io {

std::size_t componentSize(Component component);

/// By the number that stands for it in a file; nothing if there is none such.
std::optional<Component> componentOf(std::optional<std::int64_t> code);

/// Of "SCALAR", "VEC2", …; 0 for any other word.
int componentCountOf(std::string_view type);

template <class T>
T loadComponent(const std::byte* p) {
  T value;
  std::memcpy(&value, p, sizeof(T));
  return value;
}

/// One component as glTF reads it (§3.11 for normalized integers).
float toFloat(const std::byte* p, Component component, bool normalized);
/// One unsigned component as it is; signed ones and floats are taken by their bits.
std::uint32_t toInteger(const std::byte* p, Component component, bool normalized);

}  // namespace lambent::scene_io
