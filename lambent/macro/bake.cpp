// The passes of a bake (sloan2002precomputed §5): direct light, then bounce after bounce until the
// energy of a pass falls below a threshold or the bounces are used up.
//
// Simulate → Encode → Evaluate: this is Simulate; transfer::encode and lambent/shade go on.
//
// Results do not depend on the number of threads: passes.h says why, and what is summed here is
// summed chunk by chunk in sequence.
#include "lambent/macro/bake.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>
#include <span>
#include <string>

#include "lambent/macro/collect.h"
#include "lambent/macro/passes.h"
#include "lambent/math/random.h"
#include "lambent/transport/mend_buried.h"
#include "lambent/transport/texel_charts.h"

namespace lambent::macro {

namespace {

Status check(const BakeOptions& options, const PlacedReceivers& receivers) {
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
                  [](const PlacedReceivers::PerMesh& mesh) { return mesh.local.has_value(); });
  if (isLocal && options.glossyBands != 0 && options.glossyBands != options.bands)
    return report::badUsage("glossy bands are " + std::to_string(options.glossyBands) +
                            " and bands " + std::to_string(options.bands) +
                            ": bi-scale matrices have as many rows as columns");
  if (!(options.energyThreshold >= 0.0 && options.energyThreshold < 1.0))
    return outside("energy threshold", options.energyThreshold, 0.0, 1.0);
  return Status::ok();
}

/// Accumulators of all receivers, shaped as simulation.h says.
struct Sums {
  std::vector<float> rows, matrices;  ///< of E and M

  Totals totals() const { return {rows.data(), matrices.data()}; }
};

/// What the passes of a bake came to.
struct Simulated {
  Sums sums;                       ///< over all passes
  Sums direct;                     ///< pass 0, if it is to be kept beside
  std::vector<double> passEnergy;  ///< transfer::SimulatedField::passEnergy
  HitCounts counts;                ///< of pass 0
};

bool keepsShadowed(const Simulation& s) {
  return s.options.keepShadowed && s.options.kind == transfer::Kind::Interreflected;
}

/// to += from, number by number.
Status addTo(std::vector<float>& to, const std::vector<float>& from, const work::Runner& runner) {
  return runner.run({"sums", "numbers"}, work::Chunks(to.size(), std::size_t(1) << 15),
                    [&](const work::Chunk& chunk) {
                      for (std::size_t k = chunk.begin; k < chunk.end; ++k) to[k] += from[k];
                    });
}

/// What a pass left at all receivers but those that are set by others: sets those, E and what they
/// send on.
void setOthers(const Simulation& s, const transport::MendedReceivers* mended,
               const RowsToWrite& rows) {
  if (mended == nullptr) return;
  mended->extrapolation.fill({rows.incident.data(), s.rowStride});
  if (s.matrixCount > 0)
    mended->extrapolation.fill({rows.matrices.data(), s.matrixStride()}, s.matrixIndex);
  if (rows.exit.empty()) return;
  for (std::uint32_t r = 0; r < mended->buried.size(); ++r) {
    if (!mended->buried[r] || !s.isDiffuse(r)) continue;
    for (int c = 0; c < s.channels; ++c)
      for (std::size_t j = c * s.inCount; j < (c + 1) * s.inCount; ++j)
        rows.exit[r * s.rowStride + j] =
            static_cast<float>(s.sentDiffuse[r][c] / kPi * rows.incident[r * s.rowStride + j]);
  }
}

Result<Simulated> simulate(const Simulation& s, const transport::MendedReceivers* mended,
                           const Progress& progress) {
  const work::Runner runner(progress, s.options.threads), quiet({}, s.options.threads);
  const work::ChunkRange all = s.chunks().range();
  const auto perReceiver = [&](double energy) {
    return energy / std::max<double>(1.0, static_cast<double>(s.order.size()));
  };
  Simulated out;
  out.sums.rows.resize(s.receivers.size() * s.rowStride);
  out.sums.matrices.resize(s.matrixCount * s.matrixStride());
  PassRows last;
  if (s.isBouncing()) last.exit.resize(out.sums.rows.size());
  const RowsToWrite first{out.sums.rows, last.exit, out.sums.matrices};
  const auto direct = directPass(s, all, runner, first);
  if (!direct) return direct.error();
  setOthers(s, mended, first);
  double energy = 0.0;
  for (const DirectChunk& chunk : direct->chunks)
    energy += chunk.energy, out.counts += chunk.counts;
  out.passEnergy.push_back(perReceiver(energy));
  if (keepsShadowed(s)) out.direct = out.sums;
  if (!s.isBouncing()) return out;

  last.matrices = out.sums.matrices;
  PassRows next{std::vector<float>(last.exit.size()), std::vector<float>(last.matrices.size())};
  std::vector<float> incident(out.sums.rows.size());
  for (int number = 1; number <= s.options.bounces; ++number) {
    const RowsToWrite rows{incident, next.exit, next.matrices};
    const auto energies = bouncePass(s, all, {number, last, direct->kept}, runner, rows);
    if (!energies) return energies.error();
    setOthers(s, mended, rows);
    energy = 0.0;
    for (const double e : *energies) energy += e;
    out.passEnergy.push_back(perReceiver(energy));
    (void)addTo(out.sums.rows, incident, quiet);  // nobody listens: it is not cancelled
    (void)addTo(out.sums.matrices, next.matrices, quiet);
    std::swap(last, next);
    if (out.passEnergy.back() <= s.options.energyThreshold * out.passEnergy.front()) break;
  }
  return out;
}

transfer::SimulatedField fieldOf(const Simulation& s, const Simulated& simulated) {
  const BakeOptions& options = s.options;
  transfer::SimulatedField field;
  field.kind = options.kind;
  field.bands = options.bands;
  field.directions = options.kind == transfer::Kind::Unshadowed ? 0 : options.directions;
  field.bounces = static_cast<int>(simulated.passEnergy.size()) - 1;
  field.seed = options.seed;
  field.passEnergy = simulated.passEnergy;
  const Totals totals = simulated.sums.totals(), shadowed = simulated.direct.totals();
  for (std::uint32_t m = 0; m < s.scene.meshes.size(); ++m)
    field.meshes.push_back(transferOf(s, m, totals, keepsShadowed(s) ? &shadowed : nullptr));
  return field;
}

void tellOfInside(const HitCounts& counts, const transport::MendedReceivers* mended,
                  Findings& findings) {
  const std::uint64_t buried = mended ? mended->buriedCount : 0;
  if (buried + counts.inside == 0) return;
  std::string message;
  if (buried > 0)
    message += std::to_string(buried) +
               " receivers lie inside a body that cuts through their mesh. What they hold was "
               "extrapolated from " +
               std::to_string(mended->receivers.witnesses.size()) +
               " places traced beside it, so that no shadow bleeds out from there";
  if (counts.inside > 0)
    message += std::string(buried > 0 ? ". " : "") + std::to_string(counts.inside) +
               " receivers see mostly back faces: they lie inside a closed mesh or behind a "
               "single-sided one. They get no interreflection";
  findings.push_back({counts.inside > 0 ? Severity::Warning : Severity::Note, "receivers-inside",
                      std::move(message), buried + counts.inside});
}

void tellOfHits(const HitCounts& counts, const transport::MendedReceivers* mended,
                Findings& findings) {
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
  tellOfInside(counts, mended, findings);
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

}  // namespace

Result<WithFindings<transfer::SimulatedField>> bake(const scene::Scene& scene,
                                                    const trace::RayScene& rays,
                                                    const PlacedReceivers& receivers,
                                                    const BakeOptions& options,
                                                    const Progress& progress) {
  assert(receivers.meshes.size() == scene.meshes.size());
  if (Status sane = check(options, receivers); !sane) return sane.error();
  const DirectionSets directions(options.directions, options.seed, scene::bounds(scene));
  std::optional<transport::MendedReceivers> mended;
  if (options.kind != transfer::Kind::Unshadowed) {
    auto found =
        transport::mendBuried(scene, rays, receivers, work::Runner(progress, options.threads));
    if (!found) return found.error();
    mended = std::move(*found);
  }
  const Simulation simulation(
      scene, rays, mended ? mended->receivers : receivers, directions, options,
      channelsFor(scene, receivers, options.kind),
      mended ? std::span<const std::uint8_t>(mended->buried) : std::span<const std::uint8_t>());
  const Result<Simulated> simulated = simulate(simulation, mended ? &*mended : nullptr, progress);
  if (!simulated) return simulated.error();
  Findings findings;
  if (options.kind != transfer::Kind::Unshadowed)
    tellOfHits(simulated->counts, mended ? &*mended : nullptr, findings);
  for (Finding& finding : transport::chartFindings(scene, receivers))
    findings.push_back(std::move(finding));
  tellOfEmitters(scene, findings);
  return WithFindings<transfer::SimulatedField>{fieldOf(simulation, *simulated),
                                                std::move(findings)};
}

}  // namespace lambent::macro
