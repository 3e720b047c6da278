// Primitives compressed by Draco (KHR_draco_mesh_compression).
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "lambent/file/budget.h"
#include "lambent/report/result.h"
#include "lambent/scene/scene.h"

namespace lambent::scene_io {

class DracoPrimitive {
 public:
  /// Decodes triangles and attributes, whose memory is asked of `budget` before it is taken, and
  /// which hold it no longer than this object lives. `place` begins messages.
  static Result<DracoPrimitive> decode(std::span<const std::byte> bytes, const std::string& place,
                                       file::Budget& budget);
  DracoPrimitive(DracoPrimitive&&) noexcept;
  DracoPrimitive& operator=(DracoPrimitive&&) noexcept;
  ~DracoPrimitive();

  std::size_t vertices() const;
  /// Indices of vertices(), all in range.
  std::vector<scene::Triangle> triangles() const;
  /// vertices() × width numbers of the attribute with that unique id, its integers scaled to
  /// [0, 1] or [−1, 1] if `normalized`.
  Result<std::vector<float>> floats(std::int64_t id, int width, bool normalized) const;

 private:
  struct Impl;
  explicit DracoPrimitive(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace lambent::scene_io
