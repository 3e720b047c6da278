// Private to this room: work row by row on several threads, with progress, that can be stopped.
#pragma once

#include <tbb/enumerable_thread_specific.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <mutex>
#include <string_view>

#include "lambent/report/progress.h"
#include "lambent/trace/ray_scene.h"

namespace lambent::meso {

/// Runs a function over rows. A row is the work of one thread, so that results do not depend on
/// how many there are.
class ParallelRows {
 public:
  /// threads 0: as many as the machine has.
  ParallelRows(const Progress& progress, int threads)
      : progress_(progress),
        arena_(threads > 0 ? std::min(threads, tbb::info::default_concurrency())
                           : tbb::task_arena::automatic) {}

  /// work(row, scratch) for every row, with a Scratch for each thread, copied from `scratch`.
  /// Progress counts `unitsPerRow` for each. False: cancelled.
  template <class Scratch, class Work>
  bool run(std::string_view stage, std::size_t rows, std::uint64_t unitsPerRow,
           std::string_view unit, const Scratch& scratch, const Work& work) {
    tbb::enumerable_thread_specific<Scratch> scratches(scratch);
    std::atomic<std::uint64_t> done{0};
    std::atomic<bool> stop{false};
    std::mutex telling;
    auto lastTold = std::chrono::steady_clock::now() - std::chrono::hours(1);
    const auto tell = [&](bool last) {
      if (!progress_) return;
      const auto now = std::chrono::steady_clock::now();
      if (!last && now - lastTold < std::chrono::milliseconds(100)) return;
      lastTold = now;
      if (!progress_({stage, done * unitsPerRow, rows * unitsPerRow, unit})) stop = true;
    };
    arena_.execute([&] {
      tbb::parallel_for(std::size_t(0), rows, [&](std::size_t row) {
        if (stop) return;
        const trace::FlushDenormals flush;
        work(row, scratches.local());
        ++done;
        if (const std::unique_lock lock(telling, std::try_to_lock); lock) tell(false);
      });
    });
    if (!stop) tell(true);
    return !stop;
  }

 private:
  const Progress& progress_;
  tbb::task_arena arena_;
};

}  // namespace lambent::meso
