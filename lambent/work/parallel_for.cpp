#include "lambent/work/parallel_for.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "lambent/work/fork_join.h"

namespace lambent::work {

void runRanges(std::size_t count, std::size_t grain,
               const std::function<void(std::size_t, std::size_t)>& body) {
  ForkJoin loop;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, grain), [&](const auto& range) {
    const ForkJoin::Part part(loop);
    body(range.begin(), range.end());
  });
}

}  // namespace lambent::work
