// The attributes of OpenEXR headers (OpenEXR File Layout, "Header"): name, type, size, value.
// Nothing is read out of them here: it is only seen to that their sizes can be true. The library
// reads a value as its type has it, whatever size the file says: where the two differ it takes the
// middle of something for the next attribute, with any size.
#include <cstring>
#include <utility>

#include "lambent/image/formats.h"

namespace lambent::image::formats {
namespace {

constexpr size_t kLongestName = 255;
constexpr std::uint32_t kManyParts = 0x1000;

/// Bytes of the types that always take as many.
constexpr std::pair<std::string_view, size_t> kFixedSizes[] = {{"box2f", 16},
                                                               {"box2i", 16},
                                                               {"chromaticities", 32},
                                                               {"compression", 1},
                                                               {"deepImageState", 1},
                                                               {"double", 8},
                                                               {"envmap", 1},
                                                               {"float", 4},
                                                               {"int", 4},
                                                               {"keycode", 28},
                                                               {"lineOrder", 1},
                                                               {"m33d", 72},
                                                               {"m33f", 36},
                                                               {"m44d", 128},
                                                               {"m44f", 64},
                                                               {"rational", 8},
                                                               {"tiledesc", 9},
                                                               {"timecode", 8},
                                                               {"v2d", 16},
                                                               {"v2f", 8},
                                                               {"v2i", 8},
                                                               {"v3d", 24},
                                                               {"v3f", 12},
                                                               {"v3i", 12}};

/// Bytes of a channel behind its name: type, linearity, samplings.
constexpr size_t kChannelBytes = 16;

class Walker {
 public:
  Walker(Bytes bytes, std::string_view name) : bytes_(bytes), name_(name) {}

  Status walk() {
    const std::uint32_t version = bytes_.size() < 8 ? 0 : littleEndian(4);
    for (;;) {
      bool empty = true;
      if (Status status = walkHeader(empty); !status) return status;
      // Several headers end with an empty one.
      if (empty || !(version & kManyParts)) return Status::ok();
    }
  }

 private:
  std::uint32_t littleEndian(size_t at) const {
    std::uint32_t value = 0;
    for (size_t i = 4; i-- > 0;)
      value = value << 8 | std::to_integer<std::uint32_t>(bytes_[at + i]);
    return value;
  }
  size_t left() const { return bytes_.size() - std::min(at_, bytes_.size()); }

  /// A zero-terminated name; nothing if it does not end.
  bool nextName(std::string_view& text) {
    const auto* const first = reinterpret_cast<const char*>(bytes_.data()) + at_;
    const size_t window = std::min(left(), kLongestName + 1);
    const void* const end = window ? std::memchr(first, 0, window) : nullptr;
    if (!end) return false;
    text = {first, static_cast<size_t>(static_cast<const char*>(end) - first)};
    at_ += text.size() + 1;
    return true;
  }

  Status walkHeader(bool& empty) {
    for (;; empty = false) {
      std::string_view name, type;
      const size_t begin = at_;
      if (!nextName(name)) return damaged(name_, "the header does not end", begin);
      if (name.empty()) return Status::ok();
      if (!nextName(type) || left() < 4) {
        return damaged(name_, "an attribute of the header has no type", begin);
      }
      const std::uint32_t size = littleEndian(at_);
      at_ += 4;
      if (size > left()) {
        return damaged(name_,
                       "an attribute of the header says " + std::to_string(size) + " bytes where " +
                           std::to_string(left()) + " follow,",
                       begin);
      }
      if (!innerSizesFit(type, size)) {
        return damaged(name_, "an attribute of the header does not fit its size", begin);
      }
      at_ += size;
    }
  }

  /// Whether a list of channels ends where its size says.
  bool channelsFit(size_t size) const {
    const Bytes list = bytes_.subspan(at_, size);
    for (size_t used = 0; used < size;) {
      const void* const end = std::memchr(list.data() + used, 0, size - used);
      if (!end) return false;
      const size_t length =
          static_cast<size_t>(static_cast<const std::byte*>(end) - (list.data() + used));
      if (length == 0) return used + 1 == size;
      used += length + 1;
      if (size - used < kChannelBytes) return false;
      used += kChannelBytes;
    }
    return false;
  }

  /// Whether a value takes as much as its size says, and the sizes within it lie inside of it.
  bool innerSizesFit(std::string_view type, size_t size) const {
    for (const auto& [fixed, bytes] : kFixedSizes) {
      if (type == fixed) return size == bytes;
    }
    if (type == "chlist") return channelsFit(size);
    if (type == "floatvector") return size % 4 == 0;
    if (type == "preview") {
      if (size < 8) return false;
      const std::uint64_t width = littleEndian(at_), height = littleEndian(at_ + 4);
      return width * height <= size && 4 * width * height == size - 8;
    }
    if (type != "stringvector") return true;
    for (size_t used = 0; used < size;) {
      if (size - used < 4) return false;
      const std::uint32_t length = littleEndian(at_ + used);
      used += 4;
      if (length > size - used) return false;
      used += length;
    }
    return true;
  }

  Bytes bytes_;
  std::string_view name_;
  size_t at_ = 8;  // behind magic number and version
};

}  // namespace

Status checkExrHeader(Bytes bytes, std::string_view name) {
  return Walker(bytes, name).walk();
}

}  // namespace lambent::image::formats
