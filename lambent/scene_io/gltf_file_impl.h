// What a GltfFile holds: shared by the files that open it and that look into its accessors.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "lambent/scene_io/gltf_json.h"
#include "lambent/scene_io/gltf_read.h"

namespace lambent::scene_io {

struct GltfFile::Impl {
  using Bytes = std::span<const std::byte>;

  Impl(const std::filesystem::path& where, const LoadOptions& options)
      : path(where), files(where, options) {}

  std::filesystem::path path;
  LinkedFiles files;
  nlohmann::json document;
  std::vector<std::byte> file;                                  ///< the .glb, which BIN points into
  std::map<std::string, std::vector<std::byte>> linked;         ///< by place, or data URI
  std::vector<Bytes> buffers;                                   ///< empty: one that is not needed
  std::map<std::int64_t, std::vector<std::byte>> decompressed;  ///< by buffer view

  Error bad(const std::string& message) const {
    return report::badInput(path.string() + ": " + message);
  }
  Result<Bytes> splitGlb(Bytes& binary) const;
  Status readBuffers(std::optional<Bytes> binary);
  /// The part of a buffer that `object` names, called `name` in messages.
  Result<Bytes> part(const nlohmann::json* object, const std::string& name) const;
  /// The bytes of a buffer view, decompressed if need be.
  Result<Bytes> view(std::int64_t index);
  /// Fills `view` with what an accessor-like object says; `offsetOwner` holds byteOffset.
  Status locate(const std::string& name, std::int64_t bufferView, std::int64_t offset,
                AccessorView& view);
  Result<AccessorView> describe(std::int64_t index, const nlohmann::json*& object) const;
  /// An accessor's numbers, sparse ones filled in, each made a T by `convert`.
  template <class T>
  Result<std::vector<T>> elements(std::int64_t index, int componentCount, Component own,
                                  T (*convert)(const std::byte*, Component, bool));
};

}  // namespace lambent::scene_io
