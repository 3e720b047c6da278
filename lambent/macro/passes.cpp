#include "lambent/macro/passes.h"

#include <algorithm>
#include <string>

namespace lambent::macro {

namespace {

/// What a thread works with.
struct Workplace {
  Scratch scratch;
  Gathered gathered;
};

bool hasMirrors(const scene::Scene& scene) {
  return std::any_of(scene.meshes.begin(), scene.meshes.end(), [&](const scene::Mesh& mesh) {
    return scene.materials[mesh.material].isMirror();
  });
}

void castAndSort(const Simulation& s, std::uint32_t receiver, Scratch& scratch) {
  const trace::DirectionSet& directions = s.directionsOf(receiver);
  trace::castClosest(s.rays, directions, s.receivers.origins[receiver],
                     s.receivers.normals[receiver], scratch.cast);
  transport::sortHits(s.scene, s.rays, s.veils, s.receivers, directions, receiver, scratch.cast,
                      scratch.hits, scratch.escapes, scratch.counts);
}

/// Writes a receiver's rows, and returns their energy |ρ/π E|² (+ |M|² for a matrix).
double write(const Simulation& s, std::uint32_t receiver, const Gathered& gathered,
             const RowsToWrite& rows) {
  double energy = 0.0;
  const bool diffuse = s.isDiffuse(receiver);
  float* incident = rows.incident.data() + receiver * s.rowStride;
  float* exits = rows.exit.empty() ? nullptr : rows.exit.data() + receiver * s.rowStride;
  for (int c = 0; c < s.channels; ++c) {
    const double factor = diffuse ? s.receivers.diffuse[receiver][c] / kPi : 0.0;
    const double sent = diffuse ? s.sentDiffuse[receiver][c] / kPi : 0.0;
    for (std::size_t j = c * s.inCount; j < (c + 1) * s.inCount; ++j) {
      const double exit = factor * gathered.incident[j];
      energy += exit * exit;
      // Closed forms yield −0 as well, and sums over passes, which begin at 0, do not.
      incident[j] = 0.0f + (diffuse ? static_cast<float>(gathered.incident[j]) : 0.0f);
      if (exits) exits[j] = static_cast<float>(sent * gathered.incident[j]);
    }
  }
  if (s.hasMatrix(receiver)) {
    float* matrix = rows.matrices.data() + s.matrixIndex[receiver] * s.matrixStride();
    for (std::size_t k = 0; k < s.matrixStride(); ++k) {
      const float value = gathered.matrix[k];
      energy += double(value) * value;
      matrix[k] = value;
    }
  }
  return energy;
}

}  // namespace

Result<DirectPass> directPass(const Simulation& s, work::ChunkRange range,
                              const work::Runner& runner, const RowsToWrite& rows) {
  const bool unshadowed = s.options.kind == transfer::Kind::Unshadowed;
  const bool bouncing = s.isBouncing();
  const bool closest = bouncing || hasMirrors(s.scene) || s.veils.any();
  const work::Stage stage{unshadowed ? "unshadowed transfer"
                          : bouncing ? "shadows and hits"
                          : closest
                              ? hasMirrors(s.scene) ? "shadows and mirrors" : "shadows and veils"
                              : "shadows",
                          unshadowed ? "receivers" : "rays",
                          unshadowed ? 1 : static_cast<std::uint64_t>(s.options.directions) / 2};
  DirectPass pass{{}, KeptHits(bouncing ? range : work::ChunkRange{}, s.options.hitMemory)};
  const auto gather = [&](const work::Chunk& chunk, Workplace& place) {
    auto& [scratch, gathered] = place;
    scratch.counts = {};
    DirectChunk out;
    transport::PackedHits hits;
    for (std::size_t k = chunk.begin; k < chunk.end; ++k) {
      const std::uint32_t r = s.order[k];
      if (unshadowed) {
        gatherUnshadowed(s, r, gathered, scratch);
      } else {
        if (closest) {
          castAndSort(s, r, scratch);
        } else {
          trace::castOcclusion(s.rays, s.directionsOf(r), s.receivers.origins[r],
                               s.receivers.normals[r], scratch.cast);
          scratch.escapes.clear();
          scratch.counts.rays += scratch.cast.raysCast;
        }
        gatherDirect(s, r, gathered, scratch);
        if (bouncing) hits.add(scratch.hits, s.directionCount());
      }
      out.energy += write(s, r, gathered, rows);
    }
    if (bouncing) pass.kept.keep(chunk.index, std::move(hits));
    out.counts = scratch.counts;
    return out;
  };
  auto chunks = runner.map(stage, s.chunks().within(range), Workplace{{}, Gathered(s)}, gather);
  if (!chunks) return chunks.error();
  pass.chunks = std::move(*chunks);
  return pass;
}

Result<std::vector<double>> bouncePass(const Simulation& s, work::ChunkRange range,
                                       const Bounce& bounce, const work::Runner& runner,
                                       const RowsToWrite& rows) {
  const std::string name = "bounce " + std::to_string(bounce.number);
  const auto gather = [&](const work::Chunk& chunk, Workplace& place) {
    auto& [scratch, gathered] = place;
    const transport::PackedHits* hits = bounce.kept.of(chunk.index);
    double energy = 0.0;
    for (std::size_t k = chunk.begin; k < chunk.end; ++k) {
      const std::uint32_t r = s.order[k];
      if (hits)
        hits->get(k - chunk.begin, s.directionCount(), scratch.hits);
      else
        castAndSort(s, r, scratch);
      gatherBounce(s, r, scratch.hits, bounce.previous, gathered, scratch);
      energy += write(s, r, gathered, rows);
    }
    return energy;
  };
  return runner.map({name, "receivers"}, s.chunks().within(range), Workplace{{}, Gathered(s)},
                    gather);
}

}  // namespace lambent::macro
