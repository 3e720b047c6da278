// The body of a PLY file: numbers one after another, as text or binary.
#pragma once

#include <cstddef>
#include <string_view>

#include "lambent/scene_io/ply_header.h"

namespace lambent::scene_io {

/// Every read is checked against the end; after the first failure all reads yield 0 and ok() is
/// false.
class PlyBody {
 public:
  PlyBody(std::string_view bytes, PlyFormat format);

  bool ok() const { return ok_; }
  bool ascii() const { return ascii_; }
  std::size_t left() const { return std::size_t(end_ - at_); }
  /// Of a body that is not ok: the word at which it failed, if it is text.
  std::string_view failedAt() const { return failedAt_; }

  double number(PlyType type) { return ascii_ ? text() : binary(type); }
  /// Skips `size` bytes of a binary body.
  void skip(std::size_t size);

 private:
  double text();
  double binary(PlyType type);
  template <class T>
  double raw();

  const char *begin_, *at_, *end_;
  bool ascii_, swap_, ok_ = true;
  std::string_view failedAt_;
};

}  // namespace lambent::scene_io
