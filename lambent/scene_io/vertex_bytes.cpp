#include "lambent/scene_io/vertex_bytes.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "lambent/scene_io/gltf_component.h"

namespace lambent::scene_io {
namespace {

template <class Integer>
void store(float value, bool normalized, std::byte* to) {
  using Limits = std::numeric_limits<Integer>;
  const double scaled = normalized ? double(value) * double(Limits::max()) : double(value);
  const auto integer =
      Integer(std::clamp(std::round(scaled), double(Limits::lowest()), double(Limits::max())));
  std::memcpy(to, &integer, sizeof(integer));
}

void storeAs(Component component, float value, bool normalized, std::byte* to) {
  switch (component) {
    case Component::Byte:
      return store<std::int8_t>(value, normalized, to);
    case Component::UnsignedByte:
      return store<std::uint8_t>(value, normalized, to);
    case Component::Short:
      return store<std::int16_t>(value, normalized, to);
    case Component::UnsignedShort:
      return store<std::uint16_t>(value, normalized, to);
    case Component::UnsignedInt:
      return store<std::uint32_t>(value, normalized, to);
    case Component::Float:
      break;
  }
  std::memcpy(to, &value, sizeof(value));
}

}  // namespace

VertexBytes vertexBytes(const scene::VertexNumbers& numbers) {
  constexpr std::string_view kTypes[] = {"SCALAR", "VEC2", "VEC3", "VEC4"};
  const Component component = componentOf(numbers.component).value_or(Component::Float);
  const std::size_t size = componentSize(component), width = std::size_t(numbers.width);
  VertexBytes packed;
  packed.type = kTypes[width - 1];
  packed.elementSize = width * size;
  packed.stride = (packed.elementSize + 3) / 4 * 4;
  const std::size_t count = numbers.values.size() / width;
  packed.bytes.resize(count * packed.stride);
  for (std::size_t v = 0; v < count; ++v)
    for (std::size_t k = 0; k < width; ++k)
      storeAs(component, numbers.values[v * width + k], numbers.normalized,
              packed.bytes.data() + v * packed.stride + k * size);
  return packed;
}

}  // namespace lambent::scene_io
