// The passes of a bake (Sloan 2002 §5): direct light, then bounce after bounce until the energy of
// a pass falls below a threshold or the bounces are used up.
//
// Simulate → Encode → Evaluate: this is Simulate; lambent/encode and lambent/shade go on.
//
// Results do not depend on the number of threads: a receiver is the work of one thread, and sums
// over receivers are taken chunk by chunk in sequence.
#include "lambent/macro/bake.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <cassert>
#include <chrono>
#include <cmath>
#include <mutex>
#include <string>

#include "lambent/macro/collect.h"
#include "lambent/macro/simulation.h"
#include "lambent/math/random.h"
#include "lambent/transport/kept_hits.h"
#include "lambent/transport/packed_hits.h"
#include "lambent/work/flush_denormals.h"

namespace lambent::macro {

namespace {

constexpr std::size_t kChunk = 64;  ///< receivers that a thread takes at a time

bool hasMirrors(const scene::Scene& scene) {
  return std::any_of(scene.meshes.begin(), scene.meshes.end(), [&](const scene::Mesh& mesh) {
    return scene.materials[mesh.material].isMirror();
  });
}

Status check(const BakeOptions& options, const Receivers& receivers) {
  const auto outside = [](const char* name, auto value, auto low, auto high) {
    return report::badUsage(std::string(name) + " is " + std::to_string(value) + ", not " +
                            std::to_string(low) + " to " + std::to_string(high));
  };
  if (options.bands < 1 || options.bands > sh::kMaxBands)
    return outside("bands", options.bands, 1, sh::kMaxBands);
  if (options.glossyBands < 0 || options.glossyBands > sh::kMaxBands)
    return outside("glossy bands", options.glossyBands, 1, sh::kMaxBands);
  if (options.directions < 16 || options.directions > 65536)
    return outside("directions", options.directions, 16, 65536);
  if (options.bounces < 0 || options.bounces > 1000)
    return outside("bounces", options.bounces, 0, 1000);
  const bool isLocal =
      std::any_of(receivers.meshes.begin(), receivers.meshes.end(),
                  [](const Receivers::PerMesh& mesh) { return mesh.local.has_value(); });
  if (isLocal && options.glossyBands != 0 && options.glossyBands != options.bands)
    return report::badUsage("glossy bands are " + std::to_string(options.glossyBands) +
                            " and bands " + std::to_string(options.bands) +
                            ": bi-scale matrices have as many rows as columns");
  if (!(options.energyThreshold >= 0.0 && options.energyThreshold < 1.0))
    return outside("energy threshold", options.energyThreshold, 0.0, 1.0);
  return Status::ok();
}

/// Runs a function over chunks of receivers in parallel, says how far it is, and can be stopped.
class PassRunner {
 public:
  PassRunner(const Progress& progress, int threads)
      : progress_(progress),
        arena_(threads > 0 ? std::min(threads, tbb::info::default_concurrency())
                           : tbb::task_arena::automatic) {}

  /// work(chunk, begin, end, thread's scratch): receivers order[begin] … order[end − 1]. False:
  /// cancelled.
  template <class Work>
  bool run(std::string_view stage, std::size_t receivers, std::uint64_t unitsPerReceiver,
           std::string_view unit, const Work& work) {
    std::atomic<std::uint64_t> done{0};
    std::atomic<bool> stop{false};
    std::mutex telling;
    auto lastTold = std::chrono::steady_clock::now() - std::chrono::hours(1);
    const auto tell = [&](bool last) {
      if (!progress_) return;
      const auto now = std::chrono::steady_clock::now();
      if (!last && now - lastTold < std::chrono::milliseconds(100)) return;
      lastTold = now;
      if (!progress_({stage, done * unitsPerReceiver, receivers * unitsPerReceiver, unit}))
        stop = true;
    };
    const std::size_t chunks = (receivers + kChunk - 1) / kChunk;
    arena_.execute([&] {
      tbb::parallel_for(std::size_t(0), chunks, [&](std::size_t chunk) {
        if (stop) return;
        const work::FlushDenormals flush;
        const std::size_t begin = chunk * kChunk, end = std::min(begin + kChunk, receivers);
        work(chunk, static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end),
             scratches_.local());
        done += end - begin;
        if (const std::unique_lock lock(telling, std::try_to_lock); lock) tell(false);
      });
    });
    if (!stop) tell(true);
    return !stop;
  }

  HitCounts takeCounts() {
    HitCounts sum;
    for (Scratch& scratch : scratches_) {
      sum.rays += scratch.counts.rays, sum.met += scratch.counts.met;
      sum.backFaces += scratch.counts.backFaces, sum.inside += scratch.counts.inside;
      scratch.counts = {};
    }
    return sum;
  }

 private:
  const Progress& progress_;
  tbb::task_arena arena_;
  tbb::enumerable_thread_specific<Scratch> scratches_;
};

/// The whole of a bake's state: sums over passes, and the pass before.
class Bake {
 public:
  Bake(const Simulation& simulation, const Progress& progress)
      : s_(simulation),
        runner_(progress, simulation.options.threads),
        order_(transport::spatialOrder(simulation.receivers)),
        kept_({0, (order_.size() + kChunk - 1) / kChunk}, simulation.options.hitMemory),
        total_(s_.receivers.size() * s_.rowStride),
        totalMatrices_(s_.matrixCount * s_.matrixStride()) {}

  Status run(Findings& findings) {
    const bool bouncing = s_.options.kind == TransferKind::Interreflected && s_.options.bounces > 0;
    if (bouncing) {
      exitRows_.resize(total_.size());
      matrices_.resize(totalMatrices_.size());
    }
    if (!runDirect(bouncing)) return report::cancelled();
    if (s_.options.kind != TransferKind::Unshadowed) tell(runner_.takeCounts(), findings);
    if (!bouncing) return Status::ok();
    for (int bounce = 1; bounce <= s_.options.bounces; ++bounce) {
      if (!runBounce(bounce)) return report::cancelled();
      if (passEnergy_.back() <= s_.options.energyThreshold * passEnergy_.front()) break;
    }
    return Status::ok();
  }

  TransferField finish() const;

 private:
  bool keepsShadowed() const {
    return s_.options.keepShadowed && s_.options.kind == TransferKind::Interreflected;
  }
  bool runDirect(bool bouncing);
  bool runBounce(int bounce);
  void castAndSort(std::uint32_t receiver, Scratch& scratch) const;
  double store(std::uint32_t receiver, const Gathered& gathered, float* exitRows, float* matrices);
  void sumEnergy(const std::vector<double>& chunks) {
    double sum = 0.0;
    for (double e : chunks) sum += e;
    passEnergy_.push_back(sum / std::max<double>(1.0, static_cast<double>(s_.receivers.size())));
  }
  static void tell(const HitCounts& counts, Findings& findings);

  const Simulation& s_;
  PassRunner runner_;
  std::vector<std::uint32_t> order_;  ///< neighbours after each other: caches stay warm
  transport::KeptHits<transport::PackedHits> kept_;
  std::vector<float> total_, totalMatrices_;        ///< sums over passes of E and M
  std::vector<float> shadowed_, shadowedMatrices_;  ///< those of pass 0, if they are to be kept
  std::vector<float> exitRows_, matrices_;          ///< the pass before: ρ/π E, M
  std::vector<float> nextRows_, nextMatrices_;
  std::vector<double> passEnergy_;
};

void Bake::castAndSort(std::uint32_t receiver, Scratch& scratch) const {
  trace::castClosest(s_.rays, s_.directions, s_.receivers.origins[receiver],
                     s_.receivers.normals[receiver], scratch.cast);
  transport::sortHits(s_.scene, s_.rays, s_.receivers, s_.directions, receiver, scratch.cast,
                      scratch.hits, scratch.escapes, scratch.counts);
}

/// Adds a receiver's share of a pass to the totals, leaves it for the next pass, and returns its
/// energy |ρ/π E|² (+ |M|² for a matrix).
double Bake::store(std::uint32_t receiver, const Gathered& gathered, float* exitRows,
                   float* matrices) {
  float* total = total_.data() + receiver * s_.rowStride;
  double energy = 0.0;
  const bool diffuse = s_.isDiffuse(receiver);
  for (int c = 0; c < s_.channels; ++c) {
    const double factor = diffuse ? s_.receivers.diffuse[receiver][c] / kPi : 0.0;
    for (std::size_t j = c * s_.inCount; j < (c + 1) * s_.inCount; ++j) {
      const double exit = factor * gathered.incident[j];
      energy += exit * exit;
      if (diffuse) total[j] += static_cast<float>(gathered.incident[j]);
      if (exitRows) exitRows[receiver * s_.rowStride + j] = static_cast<float>(exit);
    }
  }
  if (s_.hasMatrix(receiver)) {
    const std::size_t first = s_.matrixIndex[receiver] * s_.matrixStride();
    for (std::size_t k = 0; k < s_.matrixStride(); ++k) {
      const float value = gathered.matrix[k];
      energy += double(value) * value;
      totalMatrices_[first + k] += value;
      if (matrices) matrices[first + k] = value;
    }
  }
  return energy;
}

bool Bake::runDirect(bool bouncing) {
  const bool unshadowed = s_.options.kind == TransferKind::Unshadowed;
  const bool closest = bouncing || hasMirrors(s_.scene);
  const std::size_t receivers = s_.receivers.size();
  std::vector<double> energy((receivers + kChunk - 1) / kChunk);
  const char* stage = unshadowed ? "unshadowed transfer"
                      : bouncing ? "shadows and hits"
                      : closest  ? "shadows and mirrors"
                                 : "shadows";
  const bool finished = runner_.run(
      stage, receivers, unshadowed ? 1 : static_cast<std::uint64_t>(s_.options.directions) / 2,
      unshadowed ? "receivers" : "rays",
      [&](std::size_t chunk, std::uint32_t begin, std::uint32_t end, Scratch& scratch) {
        Gathered gathered(s_);
        transport::PackedHits hits;
        for (std::uint32_t k = begin; k < end; ++k) {
          const std::uint32_t r = order_[k];
          if (unshadowed) {
            gatherUnshadowed(s_, r, gathered, scratch);
          } else {
            if (closest) {
              castAndSort(r, scratch);
            } else {
              trace::castOcclusion(s_.rays, s_.directions, s_.receivers.origins[r],
                                   s_.receivers.normals[r], scratch.cast);
              scratch.escapes.clear();
              scratch.counts.rays += scratch.cast.raysCast;
            }
            gatherDirect(s_, r, gathered, scratch);
            if (bouncing) hits.add(scratch.hits, s_.directions.size());
          }
          energy[chunk] += store(r, gathered, bouncing ? exitRows_.data() : nullptr,
                                 bouncing ? matrices_.data() : nullptr);
        }
        if (bouncing) kept_.keep(chunk, std::move(hits));
      });
  sumEnergy(energy);
  if (keepsShadowed()) shadowed_ = total_, shadowedMatrices_ = totalMatrices_;
  return finished;
}

bool Bake::runBounce(int bounce) {
  nextRows_.resize(exitRows_.size());
  nextMatrices_.resize(matrices_.size());
  const PreviousPass previous{exitRows_.data(), matrices_.data()};
  std::vector<double> energy((order_.size() + kChunk - 1) / kChunk);
  const bool finished =
      runner_.run("bounce " + std::to_string(bounce), s_.receivers.size(), 1, "receivers",
                  [&](std::size_t chunk, std::uint32_t begin, std::uint32_t end, Scratch& scratch) {
                    Gathered gathered(s_);
                    const transport::PackedHits* hits = kept_.of(chunk);
                    for (std::uint32_t k = begin; k < end; ++k) {
                      const std::uint32_t r = order_[k];
                      if (hits)
                        hits->get(k - begin, s_.directions.size(), scratch.hits);
                      else
                        castAndSort(r, scratch);
                      gatherBounce(s_, r, scratch.hits, previous, gathered, scratch);
                      energy[chunk] += store(r, gathered, nextRows_.data(), nextMatrices_.data());
                    }
                  });
  exitRows_.swap(nextRows_);
  matrices_.swap(nextMatrices_);
  sumEnergy(energy);
  return finished;
}

void Bake::tell(const HitCounts& counts, Findings& findings) {
  const auto percent = [](std::uint64_t part, std::uint64_t whole) {
    return std::to_string(std::lround(1000.0 * static_cast<double>(part) /
                                      static_cast<double>(std::max<std::uint64_t>(whole, 1))) /
                          10.0)
        .substr(0, 4);
  };
  if (counts.backFaces * 100 > counts.met)
    findings.push_back(
        {Severity::Note, "back-faces",
         percent(counts.backFaces, counts.met) +
             "% of the rays that met a surface met it from behind. Back faces block light and give "
             "none: if parts look too dark, the mesh may be open or turned inside out",
         counts.backFaces});
  if (counts.inside > 0)
    findings.push_back({Severity::Warning, "receivers-inside",
                        std::to_string(counts.inside) +
                            " receivers see mostly back faces: they lie inside a closed mesh or "
                            "behind a single-sided one. They get no interreflection",
                        counts.inside});
}

void tellOfEmitters(const scene::Scene& scene, Findings& findings) {
  const auto emitters = std::count_if(
      scene.meshes.begin(), scene.meshes.end(),
      [&](const scene::Mesh& mesh) { return scene.materials[mesh.material].isEmitter(); });
  if (emitters > 0)
    findings.push_back({Severity::Warning, "emission-left-out",
                        std::to_string(emitters) +
                            " meshes emit light. A bake holds how surfaces answer to light from "
                            "far away, so what they emit is left out; they still block and reflect",
                        std::uint64_t(emitters)});
}

TransferField Bake::finish() const {
  const BakeOptions& options = s_.options;
  TransferField field;
  field.kind = options.kind;
  field.bands = options.bands;
  field.directions = options.kind == TransferKind::Unshadowed ? 0 : options.directions;
  field.bounces = static_cast<int>(passEnergy_.size()) - 1;
  field.seed = options.seed;
  field.passEnergy = passEnergy_;
  const Totals totals{total_.data(), totalMatrices_.data()};
  const Totals shadowed{shadowed_.data(), shadowedMatrices_.data()};
  for (std::uint32_t m = 0; m < s_.scene.meshes.size(); ++m)
    field.meshes.push_back(transferOf(s_, m, totals, keepsShadowed() ? &shadowed : nullptr));
  return field;
}

}  // namespace

Simulation::Simulation(const scene::Scene& scene_, const trace::RayScene& rays_,
                       const Receivers& receivers_, const trace::DirectionSet& directions_,
                       const BakeOptions& options_, int channels_)
    : scene(scene_),
      rays(rays_),
      receivers(receivers_),
      directions(directions_),
      options(options_),
      channels(channels_),
      inBands(options_.bands),
      outBands(options_.glossyBands > 0 ? options_.glossyBands : options_.bands),
      inCount(sh::coefficientCount(inBands)),
      outCount(sh::coefficientCount(outBands)),
      rowStride(transport::paddedRow(channels_ * inCount)),
      inTable(directions_, inBands),
      cosine(sh::clampedCosine(inBands)),
      hemisphere(sh::hemisphere(inBands + outBands - 1)) {
  matrixIndex.assign(receivers.size(), kNoMatrix);
  diffuseReceiver_.assign(receivers.size(), 0);
  lobeReceiver_.assign(receivers.size(), 0);
  for (const Receivers::PerMesh& mesh : receivers.meshes)
    for (std::uint32_t r = mesh.first; r < mesh.first + mesh.count; ++r) {
      diffuseReceiver_[r] = mesh.isDiffuse;
      lobeReceiver_[r] = mesh.isGlossy;
      const bool local = mesh.local && options.kind != TransferKind::Unshadowed;
      if (mesh.isGlossy || local) matrixIndex[r] = static_cast<std::uint32_t>(matrixCount++);
    }
  if (matrixCount == 0) {
    outCount = 0;  // no matrices to hold
    return;
  }
  outTable = std::make_unique<DirectionTable>(directions, outBands);
  wideTable = std::make_unique<DirectionTable>(directions, inBands + outBands - 1);
}

Result<WithFindings<TransferField>> bake(const scene::Scene& scene, const trace::RayScene& rays,
                                         const Receivers& receivers, const BakeOptions& options,
                                         const Progress& progress) {
  assert(receivers.meshes.size() == scene.meshes.size());
  if (Status sane = check(options, receivers); !sane) return sane.error();
  const trace::DirectionSet directions(options.directions, math::randomRotation(options.seed));
  const Simulation simulation(scene, rays, receivers, directions, options,
                              channelsFor(scene, receivers, options.kind));
  Bake bake(simulation, progress);
  Findings findings;
  if (Status done = bake.run(findings); !done) return done.error();
  tellOfEmitters(scene, findings);
  return WithFindings<TransferField>{bake.finish(), std::move(findings)};
}

}  // namespace lambent::macro
