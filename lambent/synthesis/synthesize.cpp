// This work is based on:
// - sloan2003biscale (§4.3): a place of the patch is synthesised for each vertex of a meso-mesh.
// - turk2001texture (§5): from coarse to fine over nested levels of vertices on the surface.
// - tong2002synthesis (§4): k-coherence, which makes it fast (correction.cpp, similar_places.cpp).
// - lefebvre2005parallel, lefebvre2006appearance: coordinates are what is synthesised, upsampled by
//   continuation and corrected in parallel; randomness enters at the coarse end (scatter.cpp).
//
// Where we deviate: levels whose vertices lie further apart than a quarter of the patch cannot tell
// its places apart, so synthesis begins at the first that can. Patches carry no detail coarser than
// themselves that would be lost by that.
#include "lambent/synthesis/synthesize.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <string>

#include "lambent/math/random.h"
#include "lambent/synthesis/coarse_layout.h"
#include "lambent/synthesis/correction.h"
#include "lambent/synthesis/meso_offsets.h"
#include "lambent/synthesis/scatter.h"
#include "lambent/synthesis/similar_places.h"
#include "lambent/work/parallel_for.h"

namespace lambent::synthesis {
namespace {

constexpr float kVerticesAcross = 4.0f;       ///< least number along a period
constexpr std::uint32_t kNextInACut = 6;      ///< neighbours of a vertex there
constexpr float kVerticesAcrossACut = 20.0f;  ///< along a period, where pieces are cut

/// New vertices of a level continue what their nearest vertex of the coarser level has.
void inherit(const MesoMesh& mesh, std::size_t level, std::span<const Vec2> offsets,
             const SynthesisOptions& options, std::vector<Vec2>& q) {
  const std::uint32_t first = mesh.levelEnd[level - 1], end = mesh.levelEnd[level];
  const MesoMesh::Level& l = mesh.levels[level];
  const Vec2 meets = 0.25f * mesh.spacing(level - 1) * options.patchSize.cwiseInverse();
  q.resize(end);
  std::vector<std::uint8_t> without(end - first, 0);
  work::parallelFor(end - first, [&](std::uint32_t k) {
    const std::uint32_t v = first + k;
    bool found = false;
    Vec2 sum = Vec2::Zero(), nearest = Vec2::Zero();
    float count = 0.0f;
    for (std::uint32_t e = l.begin[v]; e < l.begin[v + 1]; ++e) {
      if (l.neighbours[e] >= first) continue;
      const Vec2 expected = q[l.neighbours[e]] - offsets[e];
      if (!found) nearest = expected, found = true;
      const Vec2 d = wrapped(expected - nearest);
      if ((d.cwiseAbs().array() > meets.array()).any()) continue;
      sum += d, count += 1.0f;
    }
    q[v] = found ? intoPatch(nearest + sum / count) : Vec2(Vec2::Zero());
    without[v - first] = !found;
  });
  // A small component may have its first vertices here.
  for (std::uint32_t v = first; v < end; ++v) {
    if (!without[v - first]) continue;
    q[v] = math::Random(options.seed, v, 0x50feu).uniform2();
    for (std::uint32_t e = l.begin[v]; e < l.begin[v + 1]; ++e) {
      const std::uint32_t j = l.neighbours[e];
      if (j >= first && without[j - first]) continue;
      q[v] = intoPatch(q[j] - offsets[e]);
      break;
    }
    without[v - first] = 0;
  }
}

std::string number(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", x);
  return text;
}

}  // namespace

Result<std::vector<Vec2>> synthesize(const MesoMesh& mesh, const Appearance& appearance,
                                     const SynthesisOptions& options, const Progress& progress) {
  if (!(options.patchSize.minCoeff() > 0.0f) || !options.patchSize.allFinite()) {
    return report::badUsage("the patch's size must be positive along both axes");
  }
  if (options.candidates < 0 || options.candidates > 64 || options.passes < 0) {
    return report::badUsage("synthesis takes 0 to 64 candidates and a number of passes from 0 on");
  }
  if (!(options.randomness >= 0.0f && options.randomness <= 1.0f)) {
    return report::badUsage("randomness must lie within 0 and 1");
  }
  if (appearance.width < 1 || appearance.height < 1 || appearance.dimensions < 1) {
    return report::badUsage("the patch has no places");
  }
  if (mesh.levels.empty()) return report::badUsage("the meso-mesh has no vertices");
  const float coarsestSpacing = options.patchSize.minCoeff() / kVerticesAcross;
  std::size_t start = 0;
  while (start < mesh.levels.size() && mesh.spacing(start) > coarsestSpacing) ++start;
  if (start == mesh.levels.size()) {
    const double vertices = std::ceil(2.0 / std::sqrt(3.0) * double(mesh.area) /
                                      (double(coarsestSpacing) * double(coarsestSpacing)));
    const double largest = double(mesh.spacing(start - 1)) * double(kVerticesAcross);
    return report::badUsage("the patch repeats every " + number(options.patchSize.minCoeff()) +
                            " m, but meso-vertices lie " + number(mesh.spacing(start - 1)) +
                            " m apart, too far to follow it: take at least " +
                            number(1.02 * vertices) + " meso-vertices, or a patch of at least " +
                            number(1.01 * largest) + " m");
  }

  std::vector<Vec2> offsets = offsetsOf(mesh, start, options.patchSize);
  std::vector<Vec2> q = coarseLayout(MesoGraph(mesh, start, offsets), options.seed);
  std::size_t level = start;
  const auto patchAt = [&](std::size_t l) {
    return PatchLevel(appearance, options.patchSize, mesh.spacing(l), options.candidates);
  };
  std::optional<PatchLevel> patch(patchAt(level));
  const bool goesRound = options.pieces && options.pieces->leaveRoom();
  if (options.randomness > 0.0f || goesRound) {
    // Pieces are cut where their outlines can be seen.
    while (level + 1 < mesh.levels.size() &&
           mesh.spacing(level) > options.patchSize.minCoeff() / kVerticesAcrossACut) {
      offsets = offsetsOf(mesh, ++level, options.patchSize);
      inherit(mesh, level, offsets, options, q);
    }
    const PatchLevel coarse = std::move(*patch);
    patch.emplace(patchAt(level));
    const Status scattered =
        scatter(mesh, level, MesoGraph(mesh, level, offsets, kNextInACut), *patch, coarse,
                {options.patchSize, options.randomness, options.seed, options.pieces}, progress, q);
    if (!scattered) return scattered.error();
  }
  for (Vec2& place : q) place = intoPatch(place);
  const std::size_t first = level;
  for (;; ++level) {
    if (level > first) {
      offsets = offsetsOf(mesh, level, options.patchSize);
      patch.emplace(patchAt(level));
      inherit(mesh, level, offsets, options, q);
    }
    const Correction correction(mesh, level, offsets, *patch, options.patchSize);
    // What the coarsest levels leave torn, finer ones can only trim; and passes there cost little.
    // Cuts that go round pieces are as they should be: finer levels trim them alone.
    const int often =
        goesRound ? int(level > first) : std::max(1, 4 >> std::min(level - first, std::size_t(2)));
    const int passes = options.passes * often;
    for (int pass = 0; pass < passes; ++pass) {
      if (progress &&
          !progress({"texture synthesis", level - start, mesh.levels.size() - start, "levels"})) {
        return report::cancelled();
      }
      correction.pass(q);
    }
    if (level + 1 == mesh.levels.size()) break;
  }
  return q;
}

}  // namespace lambent::synthesis
