#include "lambent/work/thread_limit.h"

#include <cstddef>

#include <tbb/global_control.h>

namespace lambent::work {

struct ThreadLimit::Held {
  tbb::global_control control;
};

ThreadLimit::ThreadLimit(int threads)
    : held_(new Held{
          {tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads)}}) {}
ThreadLimit::~ThreadLimit() = default;
ThreadLimit::ThreadLimit(ThreadLimit&&) noexcept = default;
ThreadLimit& ThreadLimit::operator=(ThreadLimit&&) noexcept = default;

}  // namespace lambent::work
