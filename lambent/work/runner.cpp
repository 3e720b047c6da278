#include "lambent/work/runner.h"

#include <atomic>
#include <chrono>
#include <mutex>

#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "lambent/work/flush_denormals.h"
#include "lambent/work/fork_join.h"

namespace lambent::work {

namespace {

/// Tells a listener how far a loop is.
class Teller {
 public:
  Teller(const Progress& progress, const Stage& stage, std::size_t items)
      : progress_(progress), stage_(stage), items_(items) {}

  bool stopped() const { return stopped_.load(std::memory_order_relaxed); }
  void begin() { tell(); }
  /// From any thread.
  void finished(std::size_t items) {
    done_ += items;
    if (!progress_) return;
    const std::unique_lock lock(telling_, std::try_to_lock);
    if (lock && !stopped() && Clock::now() - told_ >= kBetween) tell();
  }
  void end() { tell(); }

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::milliseconds kBetween{100};

  void tell() {
    if (!progress_) return;
    if (!progress_(
            {stage_.name, done_ * stage_.unitsPerItem, items_ * stage_.unitsPerItem, stage_.unit}))
      stopped_ = true;
    told_ = Clock::now();
  }

  const Progress& progress_;
  const Stage& stage_;
  std::size_t items_;
  std::atomic<std::uint64_t> done_{0};
  std::atomic<bool> stopped_{false};
  std::mutex telling_;  ///< of a call to the listener, and of told_
  Clock::time_point told_;
};

}  // namespace

struct Runner::Arena {
  mutable tbb::task_arena threads;
};

Runner::Runner(Progress progress, int threads)
    : progress_(std::move(progress)),
      arena_(new Arena{tbb::task_arena(threads > 0
                                           ? std::min(threads, tbb::info::default_concurrency())
                                           : tbb::task_arena::automatic)}) {}
Runner::~Runner() = default;
Runner::Runner(Runner&&) noexcept = default;
Runner& Runner::operator=(Runner&&) noexcept = default;

std::size_t Runner::slots() const {
  return static_cast<std::size_t>(arena_->threads.max_concurrency());
}

Status Runner::runChunks(const Stage& stage, const Chunks& chunks,
                         const std::function<void(const Chunk&, std::size_t)>& work) const {
  Teller teller(progress_, stage, chunks.items());
  teller.begin();
  if (teller.stopped()) return report::cancelled();
  ForkJoin loop(slots());
  arena_->threads.execute([&] {
    tbb::parallel_for(chunks.range().begin, chunks.range().end, [&](std::size_t index) {
      if (teller.stopped()) return;
      const auto slot = static_cast<std::size_t>(tbb::this_task_arena::current_thread_index());
      const ForkJoin::Part part(loop, slot);
      const Chunk chunk = chunks[index];
      {
        const FlushDenormals flush;
        work(chunk, slot);
      }
      teller.finished(chunk.size());
    });
  });
  if (!teller.stopped()) teller.end();
  if (teller.stopped()) return report::cancelled();
  return Status::ok();
}

}  // namespace lambent::work
