// Private to this room: a pass of a bake as a function.
//
// Receivers are cut into chunks along a curve through space (Simulation::chunks). A pass over a
// range of chunks is a function of that range and of the rows that the pass before left at all
// receivers. It makes the rows of the receivers of its chunks, and returns what it came to at each
// chunk, in sequence. So that no row is copied, it is handed the place to write them: it writes all
// rows of its own receivers, whatever lay there before, and touches no others. Nothing depends on
// how many threads there are, how much memory for hits, or which other ranges are run before,
// after, or elsewhere: put together, the passes over the parts of a range are the pass over it.
#pragma once

#include <span>
#include <vector>

#include "lambent/macro/simulation.h"
#include "lambent/report/result.h"
#include "lambent/transport/kept_hits.h"
#include "lambent/transport/packed_hits.h"
#include "lambent/work/runner.h"

namespace lambent::macro {

using KeptHits = transport::KeptHits<transport::PackedHits>;

/// Where a pass over any range writes: rows of all receivers, shaped as simulation.h says.
struct RowsToWrite {
  std::span<float> incident;  ///< [receiver][rowStride]: E
  std::span<float> exit;  ///< [receiver][rowStride]: ρ/π E (Simulation::sentDiffuse); empty: no
                          ///< pass follows
  std::span<float> matrices;  ///< [matrix][matrixStride()]: M
};

/// What pass 0 came to at one chunk.
struct DirectChunk {
  double energy = 0.0;  ///< Σ |ρ/π E|² + |M|² over its receivers
  HitCounts counts;
};

struct DirectPass {
  std::vector<DirectChunk> chunks;
  KeptHits kept;  ///< for the bounces of the same chunks, within BakeOptions::hitMemory
};

/// Pass 0: light that comes straight from outside, or by way of mirrors. Cancelled.
Result<DirectPass> directPass(const Simulation& simulation, work::ChunkRange range,
                              const work::Runner& runner, const RowsToWrite& rows);

/// Pass `number` ≥ 1.
struct Bounce {
  int number;
  const PassRows& previous;  ///< what pass number − 1 left at all receivers
  const KeptHits& kept;      ///< what pass 0 met; chunks that it has not are cast again
};

/// Light that other surfaces sent on. Returns the energy of every chunk. Cancelled.
Result<std::vector<double>> bouncePass(const Simulation& simulation, work::ChunkRange range,
                                       const Bounce& bounce, const work::Runner& runner,
                                       const RowsToWrite& rows);

}  // namespace lambent::macro
