#include "lambent/scene_io/gltf_meshopt.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <optional>

#include "lambent/scene_io/gltf_json.h"

namespace lambent::scene_io {
namespace {

using nlohmann::json;

constexpr const char* kPlain = "decompress it: npx @gltf-transform/cli copy IN.glb OUT.glb";

/// What one byte may stand for at most: a group of 16 equal bytes takes two bits, an index half a
/// byte.
constexpr std::uint64_t kBytesPerPackedByte = 64;

enum class Mode { Attributes, Triangles, Indices };
enum class Filter { None, Octahedral, Quaternion, Exponential };

struct Shape {
  Mode mode;
  Filter filter;
  std::size_t count, stride;

  std::size_t bytes() const { return count * stride; }
  /// What the library asserts, and what the extension demands.
  bool valid() const {
    if (mode != Mode::Attributes) {
      return (stride == 2 || stride == 4) && filter == Filter::None &&
             (mode == Mode::Indices || count % 3 == 0);
    }
    if (stride < 4 || stride > 256 || stride % 4 != 0) return false;
    if (filter == Filter::Octahedral) return stride == 4 || stride == 8;
    return filter != Filter::Quaternion || stride == 8;
  }
};

std::optional<Shape> shapeOf(const json& compression) {
  const std::string mode = text(&compression, "mode"), filter = text(&compression, "filter");
  const std::int64_t count = integer(compression, "count").value_or(-1);
  const std::int64_t stride = integer(compression, "byteStride").value_or(-1);
  Shape shape;
  if (mode == "ATTRIBUTES") {
    shape.mode = Mode::Attributes;
  } else if (mode == "TRIANGLES") {
    shape.mode = Mode::Triangles;
  } else if (mode == "INDICES") {
    shape.mode = Mode::Indices;
  } else {
    return {};
  }
  if (filter.empty() || filter == "NONE") {
    shape.filter = Filter::None;
  } else if (filter == "OCTAHEDRAL") {
    shape.filter = Filter::Octahedral;
  } else if (filter == "QUATERNION") {
    shape.filter = Filter::Quaternion;
  } else if (filter == "EXPONENTIAL") {
    shape.filter = Filter::Exponential;
  } else {
    return {};
  }
  if (count < 0 || stride < 0 || stride > 256 || count > std::int64_t(1) << 40) return {};
  shape.count = std::size_t(count);
  shape.stride = std::size_t(stride);
  return shape.valid() ? std::optional(shape) : std::nullopt;
}

bool decodeInto(std::byte* to, const Shape& shape, std::span<const std::byte> packed) {
  const auto* from = reinterpret_cast<const unsigned char*>(packed.data());
  switch (shape.mode) {
    case Mode::Triangles:
      return meshopt_decodeIndexBuffer(to, shape.count, shape.stride, from, packed.size()) == 0;
    case Mode::Indices:
      return meshopt_decodeIndexSequence(to, shape.count, shape.stride, from, packed.size()) == 0;
    case Mode::Attributes:
      break;
  }
  if (meshopt_decodeVertexBuffer(to, shape.count, shape.stride, from, packed.size()) != 0) {
    return false;
  }
  switch (shape.filter) {
    case Filter::Octahedral:
      meshopt_decodeFilterOct(to, shape.count, shape.stride);
      break;
    case Filter::Quaternion:
      meshopt_decodeFilterQuat(to, shape.count, shape.stride);
      break;
    case Filter::Exponential:
      meshopt_decodeFilterExp(to, shape.count, shape.stride);
      break;
    case Filter::None:
      break;
  }
  return true;
}

}  // namespace

const json* meshoptCompressionOf(const json& object) {
  const json* extensions = find(object, "extensions");
  const json* ratified = find(extensions, "KHR_meshopt_compression");
  return ratified != nullptr ? ratified : find(extensions, "EXT_meshopt_compression");
}

Result<std::vector<std::byte>> decodeMeshopt(const json& compression,
                                             std::span<const std::byte> packed,
                                             const std::string& place, file::Budget& budget) {
  const std::optional<Shape> shape = shapeOf(compression);
  if (!shape) {
    return report::badInput(
        place + " is compressed by meshoptimizer in a way that Lambent does not read; " + kPlain);
  }
  if (shape->bytes() / kBytesPerPackedByte > packed.size() + 256) {
    return report::badInput(place + ": " + std::to_string(shape->bytes()) +
                            " bytes cannot come out of the " + std::to_string(packed.size()) +
                            " that meshoptimizer is to have made of them; export the file again");
  }
  if (Status fits = budget.hold(shape->bytes(), place); !fits) return fits.error();
  std::vector<std::byte> bytes(shape->bytes());
  if (!bytes.empty() && !decodeInto(bytes.data(), *shape, packed)) {
    return report::badInput(
        place + " is compressed by meshoptimizer and damaged, or of a newer version; " + kPlain);
  }
  return bytes;
}

}  // namespace lambent::scene_io
