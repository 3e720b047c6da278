// What an asset takes, part by part.
#pragma once

#include <cstdint>

namespace lambent::asset {

/// Bytes that each part takes in the file's binary chunk, without the JSON and without padding.
struct PartBytes {
  std::uint64_t geometry = 0;   ///< positions, normals, UVs, colours (as floats), 32-bit indices
  std::uint64_t textures = 0;   ///< as encoded in the file
  std::uint64_t vectors = 0;    ///< those kept beside included
  std::uint64_t matrices = 0;   ///< the same
  std::uint64_t receivers = 0;  ///< texel receivers' positions, normals and coverage; tangents
  std::uint64_t rtts = 0;
  std::uint64_t idMaps = 0;
  std::uint64_t total() const {
    return geometry + textures + vectors + matrices + receivers + rtts + idMaps;
  }
};

}  // namespace lambent::asset
