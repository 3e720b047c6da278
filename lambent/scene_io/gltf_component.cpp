#include "lambent/scene_io/gltf_component.h"

#include <algorithm>
#include <utility>

namespace lambent::scene_io {

std::size_t componentSize(Component component) {
  switch (component) {
    case Component::Byte:
    case Component::UnsignedByte:
      return 1;
    case Component::Short:
    case Component::UnsignedShort:
      return 2;
    default:
      return 4;
  }
}

std::optional<Component> componentOf(std::optional<std::int64_t> code) {
  for (Component c : {Component::Byte, Component::UnsignedByte, Component::Short,
                      Component::UnsignedShort, Component::UnsignedInt, Component::Float}) {
    if (code && *code == int(c)) return c;
  }
  return {};
}

int componentCountOf(std::string_view type) {
  constexpr std::pair<std::string_view, int> kTypes[] = {
      {"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT2", 4}, {"MAT3", 9}, {"MAT4", 16}};
  for (const auto& [name, count] : kTypes) {
    if (type == name) return count;
  }
  return 0;
}

float toFloat(const std::byte* p, Component component, bool normalized) {
  switch (component) {
    case Component::Byte: {
      const float v = loadComponent<std::int8_t>(p);
      return normalized ? std::max(v / 127.0f, -1.0f) : v;
    }
    case Component::UnsignedByte: {
      const float v = loadComponent<std::uint8_t>(p);
      return normalized ? v / 255.0f : v;
    }
    case Component::Short: {
      const float v = loadComponent<std::int16_t>(p);
      return normalized ? std::max(v / 32767.0f, -1.0f) : v;
    }
    case Component::UnsignedShort: {
      const float v = loadComponent<std::uint16_t>(p);
      return normalized ? v / 65535.0f : v;
    }
    case Component::UnsignedInt:
      return float(loadComponent<std::uint32_t>(p));
    case Component::Float:
      break;
  }
  return loadComponent<float>(p);
}

std::uint32_t toInteger(const std::byte* p, Component component, bool) {
  switch (componentSize(component)) {
    case 1:
      return loadComponent<std::uint8_t>(p);
    case 2:
      return loadComponent<std::uint16_t>(p);
    default:
      return loadComponent<std::uint32_t>(p);
  }
}

}  // namespace lambent::scene_io
