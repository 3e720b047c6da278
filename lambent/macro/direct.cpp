// Pass 0: direct light, shadowed by the scene, also by way of mirrors.
//
// This work is based on:
// - sloan2002precomputed: §5, the rules of the shadow pass
//     diffuse  (M_p)_i  += (ρ_p/π) V_p(s_d) H_N(s_d) y_i(s_d)
//     glossy   (M_p)_ij += V_p(s_d) y_j(s_d) y_i(s_d)
// - ramamoorthi2001efficient: eq. 8, the clamped cosine in closed form.
//
// Where we deviate, and why. (1) V = 1 − (1 − V): the unshadowed part is known in closed form, and
// only the blocked directions are summed and taken away. A receiver that sees the whole sky is
// exact, and one that sees nearly all of it nearly so; there are also fewer terms. Where more than
// half the hemisphere is blocked the visible directions are summed instead, so that a receiver in
// a closed room is exactly black. (2) The glossy matrix is not summed entry by entry: y_i y_j lies
// within n+N−1 bands, so visibility is projected once onto those, and the matrix is expanded from
// it by the triple-product tensor (eq. 7): the same sum, entry for entry, for a fraction of the
// work. (3) A bi-scale receiver's matrix goes on below the horizon. What it yields is multiplied by
// a response B that is zero there, but B is kept in n bands and rings: with visibility cut off at
// the horizon, B · (M L) loses what B's ringing takes from the other side, even where nothing is in
// the way. Below, visibility is set to the receiver's accessibility a (the share of the
// cosine-weighted hemisphere that is open): where a = 1 the matrix is the identity and B · L exact,
// where a = 0 no light leaks in.
#include <algorithm>
#include <cmath>

#include "lambent/macro/simulation.h"
#include "lambent/sh/basis.h"

namespace lambent::macro {

namespace {

/// The shorter of the blocked and the visible directions.
struct Half {
  std::span<const std::uint32_t> directions;
  bool blocked;
};
Half shorterHalf(const trace::CastResult& cast) {
  if (cast.occludedCount <= cast.visibleCount) return {cast.occludedDirections(), true};
  return {cast.visibleDirections(), false};
}

void addDiffuse(const Simulation& simulation, std::uint32_t receiver, Gathered& gathered,
                Scratch& scratch) {
  const Vec3& normal = simulation.receivers.normals[receiver];
  const trace::DirectionSet& directions = simulation.directionsOf(receiver);
  const Half half = shorterHalf(scratch.cast);
  const auto weight = static_cast<float>(simulation.weight());
  scratch.weights.resize(half.directions.size());
  for (std::size_t k = 0; k < half.directions.size(); ++k)
    scratch.weights[k] = weight * normal.dot(directions[half.directions[k]]);
  double* e = gathered.incident.data();
  addRows(simulation.tablesOf(receiver).in.rows(), half.directions, scratch.weights,
          scratch.wide.data());
  if (half.blocked) {
    sh::turnTo(simulation.cosine, Vec3d(normal.cast<double>().normalized()),
               std::span<double>(scratch.y));
    for (std::size_t i = 0; i < simulation.inCount; ++i) e[i] += scratch.y[i] - scratch.wide[i];
  } else {
    for (std::size_t i = 0; i < simulation.inCount; ++i) e[i] += scratch.wide[i];
  }
  for (int c = 1; c < simulation.channels; ++c)
    std::copy_n(e, simulation.inCount, e + c * simulation.inCount);

  for (const MirrorEscape& escape : scratch.escapes) {
    const float cosine = normal.dot(directions[escape.direction]);
    sh::evaluate(simulation.inBands, escape.outward, std::span<float>(scratch.inFloat));
    for (int c = 0; c < simulation.channels; ++c) {
      const double w = double(weight) * cosine * escape.throughput[c];
      for (std::size_t j = 0; j < simulation.inCount; ++j)
        e[c * simulation.inCount + j] += w * scratch.inFloat[j];
    }
  }
}

/// Adds a · (1 − H_N) to visibility in scratch.wide; the receiver's incident vector is known.
void addBelowHorizon(const Simulation& simulation, std::uint32_t receiver, const Gathered& gathered,
                     Scratch& scratch) {
  const double y0 = 0.5 / std::sqrt(kPi);
  const double accessibility = std::clamp(gathered.incident[0] / (kPi * y0), 0.0, 1.0);
  sh::turnTo(simulation.hemisphere,
             Vec3d(simulation.receivers.normals[receiver].cast<double>().normalized()),
             std::span<double>(scratch.y));
  scratch.wide[0] += accessibility / y0;  // the projection of 1
  for (std::size_t k = 0; k < simulation.hemisphere.size() * simulation.hemisphere.size(); ++k)
    scratch.wide[k] -= accessibility * scratch.y[k];
}

void addMatrix(const Simulation& simulation, std::uint32_t receiver, Gathered& gathered,
               Scratch& scratch) {
  const Half half = shorterHalf(scratch.cast);
  const auto weight = static_cast<float>(simulation.weight());
  scratch.weights.assign(half.directions.size(), weight);
  std::fill(scratch.wide.begin(), scratch.wide.end(), 0.0);
  addRows(simulation.tablesOf(receiver).wide->rows(), half.directions, scratch.weights,
          scratch.wide.data());
  if (half.blocked) {
    sh::turnTo(simulation.hemisphere,
               Vec3d(simulation.receivers.normals[receiver].cast<double>().normalized()),
               std::span<double>(scratch.y));
    for (std::size_t k = 0; k < simulation.hemisphere.size() * simulation.hemisphere.size(); ++k)
      scratch.wide[k] = scratch.y[k] - scratch.wide[k];
  }
  if (simulation.isLocal(receiver)) addBelowHorizon(simulation, receiver, gathered, scratch);
  const sh::TripleProductTensor& tensor = sh::tripleProductTensor(
      simulation.outBands, simulation.inBands, simulation.outBands + simulation.inBands - 1);
  float* m = gathered.matrix.data();
  for (std::size_t at = 0; at < tensor.entries.size();) {
    const std::uint16_t i = tensor.entries[at].i, j = tensor.entries[at].j;
    double sum = 0.0;
    for (; at < tensor.entries.size() && tensor.entries[at].i == i && tensor.entries[at].j == j;
         ++at)
      sum += tensor.entries[at].value * scratch.wide[tensor.entries[at].k];
    for (int c = 0; c < simulation.channels; ++c)
      m[i * simulation.rowStride + c * simulation.inCount + j] = static_cast<float>(sum);
  }
  for (const MirrorEscape& escape : scratch.escapes) {
    sh::evaluate(simulation.inBands, escape.outward, std::span<float>(scratch.inFloat));
    const float* y = simulation.tablesOf(receiver).out->row(escape.direction);
    for (std::size_t i = 0; i < simulation.outCount; ++i)
      for (int c = 0; c < simulation.channels; ++c) {
        const float w = weight * escape.throughput[c] * y[i];
        float* row = m + i * simulation.rowStride + c * simulation.inCount;
        for (std::size_t j = 0; j < simulation.inCount; ++j) row[j] += w * scratch.inFloat[j];
      }
  }
}

void clear(Gathered& gathered, Scratch& scratch, const Simulation& simulation) {
  std::fill(gathered.incident.begin(), gathered.incident.end(), 0.0);
  std::fill(gathered.matrix.begin(), gathered.matrix.end(), 0.0f);
  const std::size_t wide =
      std::max(simulation.rowStride,
               simulation.tables[0].wide ? simulation.tables[0].wide->rows().stride : 0);
  scratch.wide.assign(wide, 0.0);
  scratch.y.resize(wide);
  scratch.inFloat.resize(simulation.inCount);
}

}  // namespace

void gatherUnshadowed(const Simulation& simulation, std::uint32_t receiver, Gathered& gathered,
                      Scratch& scratch) {
  clear(gathered, scratch, simulation);
  if (simulation.isDiffuse(receiver)) {
    double* e = gathered.incident.data();
    sh::turnTo(simulation.cosine,
               Vec3d(simulation.receivers.normals[receiver].cast<double>().normalized()),
               std::span<double>(e, simulation.inCount));
    for (int c = 1; c < simulation.channels; ++c)
      std::copy_n(e, simulation.inCount, e + c * simulation.inCount);
  }
  if (simulation.hasMatrix(receiver))
    for (std::size_t i = 0; i < std::min(simulation.inCount, simulation.outCount); ++i)
      for (int c = 0; c < simulation.channels; ++c)
        gathered.matrix[i * simulation.rowStride + c * simulation.inCount + i] = 1.0f;
}

void gatherDirect(const Simulation& simulation, std::uint32_t receiver, Gathered& gathered,
                  Scratch& scratch) {
  clear(gathered, scratch, simulation);
  if (simulation.isDiffuse(receiver)) addDiffuse(simulation, receiver, gathered, scratch);
  if (simulation.hasMatrix(receiver)) addMatrix(simulation, receiver, gathered, scratch);
}

}  // namespace lambent::macro
