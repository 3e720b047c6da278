// OpenEXR files in memory, as its library wants to see them. Internal to this room.
#pragma once

#include <OpenEXR/ImfIO.h>

#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <vector>

#include "lambent/image/formats.h"

namespace lambent::image::formats {

class MemoryInput : public Imf::IStream {
 public:
  MemoryInput(Bytes bytes, const char* name) : Imf::IStream(name), bytes_(bytes) {}

  bool read(char out[], int count) override {
    if (count < 0 || at_ > bytes_.size() || bytes_.size() - at_ < size_t(count)) {
      throw std::runtime_error("the file ends too early, at byte " + std::to_string(bytes_.size()));
    }
    std::memcpy(out, bytes_.data() + at_, size_t(count));
    at_ += size_t(count);
    return at_ < bytes_.size();
  }
  std::uint64_t tellg() override { return at_; }
  void seekg(std::uint64_t position) override { at_ = position; }

 private:
  Bytes bytes_;
  std::uint64_t at_ = 0;
};

class MemoryOutput : public Imf::OStream {
 public:
  explicit MemoryOutput(const char* name) : Imf::OStream(name) {}

  void write(const char data[], int count) override {
    if (bytes.size() < at_ + size_t(count)) bytes.resize(at_ + size_t(count));
    std::memcpy(bytes.data() + at_, data, size_t(count));
    at_ += size_t(count);
  }
  std::uint64_t tellp() override { return at_; }
  void seekp(std::uint64_t position) override { at_ = position; }

  std::vector<std::byte> bytes;

 private:
  std::uint64_t at_ = 0;
};

}  // namespace lambent::image::formats
