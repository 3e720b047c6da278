// Chunks of work on threads, with progress, that can be stopped.
//
// A chunk is the work of one thread from its beginning to its end, and what chunks return comes in
// their sequence: results do not depend on how many threads there are.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "lambent/report/progress.h"
#include "lambent/report/result.h"
#include "lambent/work/chunks.h"

namespace lambent::work {

/// What Progress hears while a loop runs.
struct Stage {
  std::string_view name;  ///< ProgressUpdate::stage
  std::string_view unit;  ///< ProgressUpdate::unit
  std::uint64_t unitsPerItem = 1;
};

/// Runs loops. Progress hears of each of them before its first chunk, then at most ten times a
/// second, and once more when all is done; always from one thread at a time. Denormals are flushed
/// while a chunk is worked on (FlushDenormals).
class Runner {
 public:
  /// threads 0, or more than the machine has: as many as it has.
  explicit Runner(Progress progress = {}, int threads = 0);
  ~Runner();
  Runner(Runner&&) noexcept;
  Runner& operator=(Runner&&) noexcept;

  /// work(chunk, scratch) for every chunk, with a Scratch for each thread, copied from `prototype`
  /// when the thread takes its first chunk. Cancelled if Progress asks to stop: chunks that were
  /// begun are finished, and no more are begun.
  template <class Scratch, class Work>
  Status run(const Stage& stage, const Chunks& chunks, const Scratch& prototype,
             const Work& work) const {
    std::vector<std::optional<Scratch>> scratches(slots());
    return runChunks(stage, chunks, [&](const Chunk& chunk, std::size_t slot) {
      std::optional<Scratch>& scratch = scratches[slot];
      if (!scratch) scratch.emplace(prototype);
      work(chunk, *scratch);
    });
  }
  /// work(chunk), without a scratch.
  template <class Work>
  Status run(const Stage& stage, const Chunks& chunks, const Work& work) const {
    return runChunks(stage, chunks, [&](const Chunk& chunk, std::size_t) { work(chunk); });
  }

  /// What work(chunk, scratch) returns for every chunk, in the sequence of the chunks: a sum over
  /// it is the same at any number of threads.
  template <class Scratch, class Work>
  auto map(const Stage& stage, const Chunks& chunks, const Scratch& prototype,
           const Work& work) const {
    using Value = std::invoke_result_t<const Work&, const Chunk&, Scratch&>;
    static_assert(!std::is_same_v<Value, bool>, "neighbours in a vector<bool> share their bytes");
    std::vector<Value> values(chunks.range().size());
    const Status done = run(stage, chunks, prototype, [&](const Chunk& chunk, Scratch& scratch) {
      values[chunk.index - chunks.range().begin] = work(chunk, scratch);
    });
    return done ? Result<std::vector<Value>>(std::move(values))
                : Result<std::vector<Value>>(done.error());
  }

 private:
  /// Numbers of the threads of a loop are below this.
  std::size_t slots() const;
  Status runChunks(const Stage& stage, const Chunks& chunks,
                   const std::function<void(const Chunk&, std::size_t slot)>& work) const;

  struct Arena;
  Progress progress_;
  std::unique_ptr<Arena> arena_;
};

}  // namespace lambent::work
