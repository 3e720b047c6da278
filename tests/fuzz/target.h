// A fuzz target is a function that takes any bytes at all, reads them as the files that they may
// be, and does with what came out of it what the tool does next. It returns, or it is a fault: a
// crash, a broken promise of require(), a leak, too much time or memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <span>
#include <string_view>

namespace lambent::fuzz {

using Bytes = std::span<const std::byte>;
using Target = void(Bytes);

/// One for each reader, NAME_target.cpp.
Target gltf, obj, ply, asset, rtt, exr, hdr, png, jpeg, webp, light, view, source, atmosphere, uri,
    curves;

/// What reading one input may take, where the reader can be told: far below what a fuzzer's process
/// may hold, so that what is not in the account shows.
inline constexpr std::uint64_t kMemoryLimit = std::uint64_t(16) << 20;

/// A promise of the library.
inline void require(bool holds, const char* promise) {
  if (holds) return;
  std::fprintf(stderr, "broken promise: %s\n", promise);
  std::abort();
}

/// Pixels, vertices and the like that what follows the reading goes through: a fuzzer wants many
/// short runs.
inline constexpr std::size_t kMostElements = 1 << 14;

inline std::string_view textOf(Bytes bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace lambent::fuzz
