// How a stage says that it failed: Result<T> at the borders where the world enters (files, devices,
// GL). A caller's mistake is an assert, not a Result.
#pragma once

#include <cassert>
#include <string>
#include <utility>
#include <variant>

namespace lambent::report {

enum class ErrorKind {
  Failed,     ///< the work failed: no memory, no device (exit code 1)
  BadUsage,   ///< the caller asked for something that makes no sense (exit code 2)
  BadInput,   ///< a file is unusable: its content, its place, a disk that is full (exit code 3)
  Cancelled,  ///< the Progress callback asked to stop
};

/// What went wrong. The message names the file, the place in it, and the remedy.
struct Error {
  ErrorKind kind = ErrorKind::Failed;
  std::string message;
};

inline Error badInput(std::string message) {
  return {ErrorKind::BadInput, std::move(message)};
}
inline Error badUsage(std::string message) {
  return {ErrorKind::BadUsage, std::move(message)};
}
inline Error failed(std::string message) {
  return {ErrorKind::Failed, std::move(message)};
}
inline Error cancelled() {
  return {ErrorKind::Cancelled, "cancelled"};
}

/// Either a value or an Error. Test with `if (!result)`; then `result.value()` or `*result`.
template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : state_(std::in_place_index<0>, std::move(value)) {}      // NOLINT: implicit
  Result(Error error) : state_(std::in_place_index<1>, std::move(error)) {}  // NOLINT: implicit

  explicit operator bool() const { return state_.index() == 0; }
  T& value() & { return *valuePtr(); }
  const T& value() const& { return *const_cast<Result*>(this)->valuePtr(); }
  T&& value() && { return std::move(*valuePtr()); }
  T& operator*() & { return value(); }
  const T& operator*() const& { return value(); }
  T&& operator*() && { return std::move(*this).value(); }
  T* operator->() { return valuePtr(); }
  const T* operator->() const { return const_cast<Result*>(this)->valuePtr(); }
  const Error& error() const {
    assert(state_.index() == 1);
    return std::get<1>(state_);
  }

 private:
  T* valuePtr() {
    assert(state_.index() == 0);
    return std::get_if<0>(&state_);
  }
  std::variant<T, Error> state_;
};

/// Success without a value, or an Error: `return Status::ok();`
class [[nodiscard]] Status {
 public:
  static Status ok() { return Status(); }
  Status(Error error) : failed_(true), error_(std::move(error)) {}  // NOLINT: implicit
  explicit operator bool() const { return !failed_; }
  const Error& error() const {
    assert(failed_);
    return error_;
  }

 private:
  Status() = default;
  bool failed_ = false;
  Error error_;
};

}  // namespace lambent::report

namespace lambent {
using report::Error;
using report::ErrorKind;
using report::Result;
using report::Status;
}  // namespace lambent
