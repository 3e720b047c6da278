#include "lambent/scene_io/ply_body.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>

#include "lambent/scene_io/text_number.h"

namespace lambent::scene_io {

PlyBody::PlyBody(std::string_view bytes, PlyFormat format)
    : begin_(bytes.data()),
      at_(begin_),
      end_(begin_ + bytes.size()),
      ascii_(format == PlyFormat::Ascii),
      swap_((format == PlyFormat::BinaryBig) != (std::endian::native == std::endian::big)) {}

void PlyBody::skip(std::size_t size) {
  if (size > left()) {
    ok_ = false;
    at_ = end_;
  } else {
    at_ += size;
  }
}

double PlyBody::text() {
  while (at_ != end_ && static_cast<unsigned char>(*at_) <= ' ') ++at_;
  if (const auto number = parseNumber(at_, end_)) {
    at_ = number->end;
    return number->value;
  }
  if (ok_) {
    // "1,5" is read as 1, and fails at the comma.
    const char *first = at_, *last = at_;
    while (first != begin_ && static_cast<unsigned char>(first[-1]) > ' ') --first;
    while (last != end_ && static_cast<unsigned char>(*last) > ' ') ++last;
    failedAt_ = {first, std::size_t(last - first)};
  }
  ok_ = false;
  at_ = end_;
  return 0.0;
}

template <class T>
double PlyBody::raw() {
  if (left() < sizeof(T)) {
    ok_ = false;
    at_ = end_;
    return 0.0;
  }
  std::array<char, sizeof(T)> bytes;
  std::memcpy(bytes.data(), at_, sizeof(T));
  at_ += sizeof(T);
  if (swap_) std::reverse(bytes.begin(), bytes.end());
  return double(std::bit_cast<T>(bytes));
}

double PlyBody::binary(PlyType type) {
  switch (type) {
    case PlyType::Int8:
      return raw<std::int8_t>();
    case PlyType::Uint8:
      return raw<std::uint8_t>();
    case PlyType::Int16:
      return raw<std::int16_t>();
    case PlyType::Uint16:
      return raw<std::uint16_t>();
    case PlyType::Int32:
      return raw<std::int32_t>();
    case PlyType::Uint32:
      return raw<std::uint32_t>();
    case PlyType::Float32:
      return raw<float>();
    case PlyType::Float64:
      break;
  }
  return raw<double>();
}

}  // namespace lambent::scene_io
