// What the thread sanitizer is to know of a loop whose threads are oneTBB's.
//
// oneTBB is not compiled with the sanitizer (nor are, for its headers' sake, the files of this room
// that include it), which therefore sees neither how a loop's parts come after what was before the
// loop, nor how all of them come before what is after it. These two are told here, and no more:
// parts stay unordered among each other, so that a race between them is found. CMake defines
// LAMBENT_THREAD_SANITIZER; without it nothing of this is compiled.
#pragma once

#include <cstddef>
#include <vector>

#ifdef LAMBENT_THREAD_SANITIZER
extern "C" void __tsan_acquire(void* address);
extern "C" void __tsan_release(void* address);
#endif

namespace lambent::work {

/// Stands where a loop does, from before its first part to after its last.
class ForkJoin {
 public:
#ifdef LAMBENT_THREAD_SANITIZER
  explicit ForkJoin(std::size_t slots = 0) : slots_(slots) {
    __tsan_release(&fork_);
  }
  ~ForkJoin() {
    __tsan_acquire(&join_);
  }
#else
  explicit ForkJoin(std::size_t /*slots*/ = 0) {}
  ~ForkJoin() {}
#endif
  ForkJoin(const ForkJoin&) = delete;
  ForkJoin& operator=(const ForkJoin&) = delete;

  /// Stands where one part runs.
  class Part {
   public:
#ifdef LAMBENT_THREAD_SANITIZER
    explicit Part(ForkJoin& loop) : loop_(loop) {
      __tsan_acquire(&loop_.fork_);
    }
    /// A part that uses what belongs to a slot: parts of one slot come one after the other.
    Part(ForkJoin& loop, std::size_t slot) : Part(loop) {
      slot_ = &loop.slots_[slot];
      __tsan_acquire(slot_);
    }
    ~Part() {
      if (slot_) __tsan_release(slot_);
      __tsan_release(&loop_.join_);
    }
    Part(const Part&) = delete;
    Part& operator=(const Part&) = delete;

   private:
    ForkJoin& loop_;
    char* slot_ = nullptr;
#else
    explicit Part(ForkJoin& /*loop*/) {}
    Part(ForkJoin& /*loop*/, std::size_t /*slot*/) {}
    ~Part() {}
#endif
  };

#ifdef LAMBENT_THREAD_SANITIZER
 private:
  char fork_ = 0, join_ = 0;
  std::vector<char> slots_;
#endif
};

}  // namespace lambent::work
