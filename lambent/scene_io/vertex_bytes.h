// Numbers at vertices as the bytes that glTF stores them in.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "lambent/scene/vertex_numbers.h"

namespace lambent::scene_io {

struct VertexBytes {
  std::vector<std::byte> bytes;
  std::size_t elementSize = 4, stride = 4;  ///< the stride is a multiple of 4, as glTF wants it
  std::string_view type;                    ///< "SCALAR", "VEC2", …
};

/// What was read from such bytes comes to the same bytes.
VertexBytes vertexBytes(const scene::VertexNumbers& numbers);

}  // namespace lambent::scene_io
