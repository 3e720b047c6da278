// Numbers on their way into and out of a glTF file's buffers. Only for .cpp files: it brings in
// nlohmann/json.
#pragma once

#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <span>
#include <string_view>
#include <vector>

#include "lambent/asset/json_fields.h"
#include "lambent/math/types.h"
#include "lambent/scene_io/gltf_read.h"
#include "lambent/scene_io/gltf_write.h"
#include "lambent/transfer/numbers.h"

namespace lambent::asset {

using scene_io::Component;

template <class T>
std::span<const std::byte> bytesOf(const std::vector<T>& values) {
  return std::as_bytes(std::span(values));
}

/// Accessors of transfer, copied out. Keeps the sum of what was copied below the file's buffers, and
/// in the file's budget: accessors that overlap, or buffers of the same bytes, could otherwise ask
/// for any amount of memory.
class AccessorReader {
 public:
  explicit AccessorReader(const scene_io::GltfFile& file);

  /// The member `key` names an accessor of so many components of that type; else the fault is
  /// recorded and nothing comes back.
  template <class T>
  std::vector<T> read(JsonFields& fields, std::string_view key, Component component,
                      int componentCount) {
    static_assert(std::is_trivially_copyable_v<T> || std::is_same_v<T, Vec3>);
    const std::optional<scene_io::AccessorView> view =
        open(fields, key, component, componentCount, sizeof(T));
    if (!view) return {};
    std::vector<T> values(view->count);
    if (values.empty()) return values;
    auto* out = reinterpret_cast<std::byte*>(values.data());
    if (view->packed()) {
      std::memcpy(out, view->bytes.data(), view->count * sizeof(T));
    } else {
      for (std::size_t i = 0; i < view->count; ++i)
        std::memcpy(out + i * sizeof(T), view->bytes.data() + i * view->stride, sizeof(T));
    }
    return values;
  }

 private:
  std::optional<scene_io::AccessorView> open(JsonFields& fields, std::string_view key,
                                             Component component, int componentCount,
                                             std::size_t bytesEach);

  const scene_io::GltfFile& file_;
  double budget_ = 0.0;  ///< bytes
  std::set<std::int64_t> read_;
};

/// {"accessor", "encoding"} and, for snorm8, "scales", beside `members`.
nlohmann::json toJson(const transfer::Numbers& numbers, scene_io::GltfBuilder& gltf,
                      nlohmann::json members = nlohmann::json::object());
enum class Snorm8 { Refused, Allowed };
transfer::Numbers numbersFrom(JsonFields& fields, AccessorReader& accessors, Snorm8 snorm8);

/// 1 or 3: the member "channels".
int channelsFrom(JsonFields& fields);
/// Two numbers.
Vec2 pairFrom(JsonFields& fields, std::string_view key);

}  // namespace lambent::asset
