// How many threads all loops together may have.
#pragma once

#include <memory>

namespace lambent::work {

/// While one of these lives, loops of the whole process run on `threads` threads at most. Of
/// several, the least counts.
class ThreadLimit {
 public:
  /// threads: 1 or more.
  explicit ThreadLimit(int threads);
  ~ThreadLimit();
  ThreadLimit(ThreadLimit&&) noexcept;
  ThreadLimit& operator=(ThreadLimit&&) noexcept;

 private:
  struct Held;
  std::unique_ptr<Held> held_;
};

}  // namespace lambent::work
