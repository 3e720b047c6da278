// Passes 1, 2, …: light that other surfaces sent on.
//
// This work is based on:
// - sloan2002precomputed: §5, the rules of the interreflection passes
//     diffuse  (M_p)^b_i  += (ρ_p/π) (1−V_p) (M_q)^{b−1}_i H_N(s_d)
//     glossy   (M_p)^b_ij += (1−V_p) (Σ_k α_k G_k (M_q)^{b−1}_kj y_k(reflect(−s_d, N_q))) y_i(s_d)
//
// Where we deviate, and why. A diffuse q sends its exit vector ρ/π E and a glossy q its lobe
// towards any p, diffuse or glossy, so that both light each other in one scene; the paper's two
// rules are the unmixed cases. reflect(v, N) = 2 (N·v) N − v with v = −s_d, the direction from q to
// p: read so, the rule looks where the mirrored ray goes. The rays are not cast again: hits are
// kept in four to six bytes each, and a bounce is a sparse product. A hit takes the light of one
// corner of the triangle, drawn by its weight (see drawReceiver), instead of blending three: a
// third of the traffic for an error far below that of the directions. Of a textured surface it
// takes the irradiance there, and the base colour of the place itself, which the hit keeps beside.
#include <algorithm>

#include "lambent/macro/simulation.h"
#include "lambent/math/directions.h"
#include "lambent/sh/basis.h"
#include "lambent/transport/packed_colour.h"

namespace lambent::macro {

namespace {

/// Adds to exit ([c][n²], doubles) what q's lobe sends along −arrival:
/// k_q Σ_i ĝ_i y_i(R) M_ij, times weight for each channel.
void addLobe(const Simulation& simulation, std::uint32_t q, const Vec3& arrival, const Rgb& weight,
             const PassRows& previous, Scratch& scratch, double* exit) {
  const PlacedReceivers& receivers = simulation.receivers;
  const Vec3 reflected = math::reflectAbout(-arrival, receivers.normals[q]);
  scratch.outFloat.resize(simulation.outCount);
  sh::evaluate(simulation.outBands, Vec3(reflected.normalized()),
               std::span<float>(scratch.outFloat));
  const float* moments = scratch.lobes.data();
  for (int l = 0; l < simulation.outBands; ++l)
    for (int m = -l; m <= l; ++m) scratch.outFloat[sh::index(l, m)] *= moments[l];
  scratch.ids.resize(simulation.outCount);
  for (std::uint32_t i = 0; i < simulation.outCount; ++i) scratch.ids[i] = i;
  scratch.y.assign(simulation.rowStride, 0.0);
  addRows({previous.matrices.data() + simulation.matrixIndex[q] * simulation.matrixStride(),
           simulation.rowStride},
          scratch.ids, scratch.outFloat, scratch.y.data());
  for (int c = 0; c < simulation.channels; ++c) {
    const double w = double(weight[c]) * simulation.sentGlossy[q][c];
    for (std::size_t j = 0; j < simulation.inCount; ++j)
      exit[c * simulation.inCount + j] += w * scratch.y[c * simulation.inCount + j];
  }
}

/// The Legendre moments of q's lobe, kept for as long as the exponent stays the same.
void prepareLobe(const Simulation& simulation, float exponent, Scratch& scratch) {
  const std::size_t count = static_cast<std::size_t>(simulation.outBands);
  if (scratch.lobes.size() == count + 1 && scratch.lobes[count] == exponent) return;
  const sh::ZonalMoments moments = sh::phongLobe(simulation.outBands, exponent);
  scratch.lobes.resize(count + 1);
  for (std::size_t l = 0; l < count; ++l) scratch.lobes[l] = static_cast<float>(moments[l]);
  scratch.lobes[count] = exponent;
}

/// All that q sends along −arrival, added to exit.
void addExit(const Simulation& simulation, std::uint32_t q, const Vec3& arrival, const Rgb& weight,
             const PassRows& previous, Scratch& scratch, double* exit) {
  if (simulation.isDiffuse(q)) {
    const float* row = previous.exit.data() + q * simulation.rowStride;
    for (int c = 0; c < simulation.channels; ++c)
      for (std::size_t j = 0; j < simulation.inCount; ++j)
        exit[c * simulation.inCount + j] += double(weight[c]) * row[c * simulation.inCount + j];
  }
  if (simulation.sendsLobe(q)) {
    prepareLobe(simulation, simulation.receivers.exponents[q], scratch);
    addLobe(simulation, q, arrival, weight, previous, scratch, exit);
  }
}

/// Adds the diffuse exits of all straight hits: weights[h] and, of textured meshes, the base colour
/// where the ray struck. Rows of receivers that are not diffuse are zero: they need no exception.
void addDiffuseExits(const Simulation& simulation, const ReceiverHits& hits,
                     const PassRows& previous, Gathered& gathered, Scratch& scratch) {
  const transport::Rows rows{previous.exit.data(), simulation.rowStride};
  if (hits.colour.empty()) {
    addRows(rows, hits.receiver, scratch.weights, gathered.incident.data());
    return;
  }
  scratch.ids.clear(), scratch.tintedIds.clear(), scratch.tintedWeights.clear();
  std::size_t plain = 0, tinted = 0;
  for (std::size_t h = 0; h < hits.receiver.size(); ++h) {
    const float w = scratch.weights[h];
    if (simulation.isTextured(hits.receiver[h])) {
      const Rgb colour = w * transport::unpackColour(hits.colour[tinted++]);
      scratch.tintedIds.push_back(hits.receiver[h]);
      scratch.tintedWeights.insert(scratch.tintedWeights.end(), {colour[0], colour[1], colour[2]});
    } else {
      scratch.ids.push_back(hits.receiver[h]);
      scratch.weights[plain++] = w;
    }
  }
  addRows(rows, scratch.ids, std::span<const float>(scratch.weights).first(plain),
          gathered.incident.data());
  addTintedRows(rows, simulation.channelMasks, scratch.tintedIds, scratch.tintedWeights,
                gathered.incident.data());
}

/// The base colour that straight hit `h` brings, one hit after the other: `textured` counts those
/// of textured meshes.
Rgb tintOf(const Simulation& simulation, const ReceiverHits& hits, std::size_t h,
           std::size_t& textured) {
  if (!simulation.isTextured(hits.receiver[h])) return Rgb::Ones();
  return transport::unpackColour(hits.colour[textured++]);
}

/// A receiver without a matrix needs no exits one by one: rows are summed where they lie.
void gatherIntoVector(const Simulation& simulation, std::uint32_t receiver,
                      const ReceiverHits& hits, const PassRows& previous, Gathered& gathered,
                      Scratch& scratch) {
  const Vec3& normal = simulation.receivers.normals[receiver];
  const trace::DirectionSet& directions = simulation.directionsOf(receiver);
  const auto weight = static_cast<float>(simulation.weight());
  const bool noLobes = !simulation.tables[0].out;
  scratch.weights.resize(hits.receiver.size());
  for (std::size_t h = 0; h < hits.receiver.size(); ++h)
    scratch.weights[h] = weight * normal.dot(directions[hits.direction[h]]);
  addDiffuseExits(simulation, hits, previous, gathered, scratch);
  if (!noLobes) {
    std::size_t textured = 0;
    for (std::size_t h = 0; h < hits.receiver.size(); ++h) {
      const std::uint32_t q = hits.receiver[h];
      const Rgb tint = tintOf(simulation, hits, h, textured);
      if (!simulation.sendsLobe(q)) continue;
      const float w = weight * normal.dot(directions[hits.direction[h]]);
      prepareLobe(simulation, simulation.receivers.exponents[q], scratch);
      addLobe(simulation, q, directions[hits.direction[h]], w * tint, previous, scratch,
              gathered.incident.data());
    }
  }
  for (const MirroredHit& hit : hits.mirrored) {
    const float w = weight * normal.dot(directions[hit.direction]);
    addExit(simulation, hit.receiver, hit.arrival, w * hit.throughput, previous, scratch,
            gathered.incident.data());
  }
}

/// A receiver with a matrix (and perhaps a vector): exits X and harmonics Y of all hits, then YᵀX.
void gatherIntoMatrix(const Simulation& simulation, std::uint32_t receiver,
                      const ReceiverHits& hits, const PassRows& previous, Gathered& gathered,
                      Scratch& scratch) {
  const Vec3& normal = simulation.receivers.normals[receiver];
  const trace::DirectionSet& directions = simulation.directionsOf(receiver);
  const Simulation::Tables& tables = simulation.tablesOf(receiver);
  const auto weight = static_cast<float>(simulation.weight());
  const bool diffuse = simulation.isDiffuse(receiver);
  constexpr std::size_t kBatch = 256;
  const std::size_t total = hits.receiver.size() + hits.mirrored.size();
  const std::size_t outStride = tables.out->rows().stride;
  scratch.exits.resize(kBatch * (simulation.rowStride + outStride));
  float* exits = scratch.exits.data();
  float* harmonics = exits + kBatch * simulation.rowStride;
  scratch.wide.resize(std::max(scratch.wide.size(), simulation.rowStride));
  std::size_t textured = 0;
  for (std::size_t begin = 0; begin < total; begin += kBatch) {
    const std::size_t count = std::min(kBatch, total - begin);
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t h = begin + k;
      const bool straight = h < hits.receiver.size();
      const MirroredHit* mirrored = straight ? nullptr : &hits.mirrored[h - hits.receiver.size()];
      const std::uint32_t direction = straight ? hits.direction[h] : mirrored->direction;
      double* exit = scratch.wide.data();
      std::fill_n(exit, simulation.rowStride, 0.0);
      if (straight)
        addExit(simulation, hits.receiver[h], directions[direction],
                tintOf(simulation, hits, h, textured), previous, scratch, exit);
      else
        addExit(simulation, mirrored->receiver, mirrored->arrival, mirrored->throughput, previous,
                scratch, exit);
      for (std::size_t j = 0; j < simulation.rowStride; ++j)
        exits[k * simulation.rowStride + j] = static_cast<float>(exit[j]);
      const float* y = tables.out->row(direction);
      for (std::size_t i = 0; i < simulation.outCount; ++i)
        harmonics[k * outStride + i] = weight * y[i];
      if (diffuse) {
        const double w = double(weight) * normal.dot(directions[direction]);
        for (std::size_t j = 0; j < simulation.rowStride; ++j) gathered.incident[j] += w * exit[j];
      }
    }
    addOuterProducts({harmonics, outStride}, simulation.outCount, {exits, simulation.rowStride},
                     count, gathered.matrix.data(), simulation.rowStride);
  }
}

}  // namespace

void gatherBounce(const Simulation& simulation, std::uint32_t receiver, const ReceiverHits& hits,
                  const PassRows& previous, Gathered& gathered, Scratch& scratch) {
  std::fill(gathered.incident.begin(), gathered.incident.end(), 0.0);
  if (simulation.hasMatrix(receiver)) {
    std::fill(gathered.matrix.begin(), gathered.matrix.end(), 0.0f);
    gatherIntoMatrix(simulation, receiver, hits, previous, gathered, scratch);
  } else {
    gatherIntoVector(simulation, receiver, hits, previous, gathered, scratch);
  }
}

}  // namespace lambent::macro
