// Private to this room: what every pass of a bake looks at, and the shapes of its accumulators.
//
// Accumulators. Let n = bands of the light, N = bands of glossy rows, c = channels.
//  - E, "incident vector" of a diffuse receiver: [c][n²], the transfer vector without ρ/π;
//    exit radiance is ρ/π E · L.
//  - M, matrix of a receiver that has one (a glossy surface, or one that carries meso-structure):
//    N² rows of [c][n²] each, so that one row is shaped like an E.
// Both row lengths are padded to rowStride floats.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "lambent/macro/bake.h"
#include "lambent/macro/direction_sets.h"
#include "lambent/sh/product.h"
#include "lambent/sh/zonal.h"
#include "lambent/transport/direction_tables.h"
#include "lambent/transport/hits.h"
#include "lambent/transport/receivers.h"
#include "lambent/work/chunks.h"

namespace lambent::macro {

using transfer::Kind;
using transfer::SimulatedField;
using transport::addOuterProducts;
using transport::addRows;
using transport::addTintedRows;
using transport::DirectionTable;
using transport::HitCounts;
using transport::Layout;
using transport::MirroredHit;
using transport::MirrorEscape;
using transport::PlacedReceivers;
using transport::ReceiverHits;

struct Simulation {
  const scene::Scene& scene;
  const trace::RayScene& rays;
  const PlacedReceivers& receivers;
  const DirectionSets& directions;
  trace::Veils veils;
  BakeOptions options;
  std::vector<std::uint32_t> order;  ///< receivers that are simulated, neighbours after each other:
                                     ///< caches stay warm

  int channels = 1;
  int inBands = 5, outBands = 5;
  std::size_t inCount = 25, outCount = 25;  ///< n², N²
  std::size_t rowStride = 32;

  /// Harmonics of one set of directions.
  struct Tables {
    DirectionTable in;                     ///< y of n bands
    std::unique_ptr<DirectionTable> out;   ///< y of N bands, if anything has a matrix
    std::unique_ptr<DirectionTable> wide;  ///< y of n+N−1 bands, if anything has a matrix
  };
  std::vector<Tables> tables;   ///< of every set
  sh::ZonalMoments cosine;      ///< n bands
  sh::ZonalMoments hemisphere;  ///< n+N−1 bands

  /// What of a receiver's reflectances its exits are made with: all, but for the base colour of
  /// textured meshes, which a hit brings (transport::ReceiverHits::colour).
  std::vector<Rgb> sentDiffuse, sentGlossy;
  std::vector<float> channelMasks;  ///< [3][rowStride]: 1 where a row's entry is of the channel

  std::vector<std::uint32_t> matrixIndex;  ///< receiver → its matrix, or kNoMatrix
  std::size_t matrixCount = 0;

  static constexpr std::uint32_t kNoMatrix = 0xffffffffu;

  /// `set`: 1 for receivers that are set by others after every pass, and not simulated; or empty.
  Simulation(const scene::Scene& scene, const trace::RayScene& rays,
             const PlacedReceivers& receivers, const DirectionSets& directions,
             const BakeOptions& options, int channels, std::span<const std::uint8_t> set = {});

  /// Receivers in the sequence of `order` that a thread takes at a time.
  static constexpr std::size_t kChunk = 64;
  work::Chunks chunks() const { return work::Chunks(order.size(), kChunk); }
  /// Whether passes follow pass 0.
  bool isBouncing() const {
    return options.kind == transfer::Kind::Interreflected && options.bounces > 0;
  }
  std::size_t matrixStride() const { return outCount * rowStride; }
  const trace::DirectionSet& directionsOf(std::uint32_t receiver) const {
    return directions[setOfReceiver_[receiver]];
  }
  const Tables& tablesOf(std::uint32_t receiver) const { return tables[setOfReceiver_[receiver]]; }
  std::size_t directionCount() const { return directions[0].size(); }
  double weight() const { return directions[0].weight(); }  ///< of a direction, steradians
  bool hasMatrix(std::uint32_t receiver) const { return matrixIndex[receiver] != kNoMatrix; }
  /// Whether it sends light on by a lobe: glossy surfaces alone, whose matrices are before the
  /// lobe.
  bool sendsLobe(std::uint32_t receiver) const { return lobeReceiver_[receiver] != 0; }
  bool isLocal(std::uint32_t receiver) const { return hasMatrix(receiver) && !sendsLobe(receiver); }
  bool isDiffuse(std::uint32_t receiver) const { return diffuseReceiver_[receiver] != 0; }
  bool isTextured(std::uint32_t receiver) const { return texturedReceiver_[receiver] != 0; }

 private:
  std::vector<std::uint8_t> diffuseReceiver_, lobeReceiver_, texturedReceiver_, setOfReceiver_;
};

/// What one receiver gathers in one pass. `incident` is E; `matrix` is M. Sized by the simulation.
struct Gathered {
  std::vector<double> incident;
  std::vector<float> matrix;
  explicit Gathered(const Simulation& simulation)
      : incident(simulation.rowStride), matrix(simulation.matrixStride()) {}
};

/// Room to work in, one for each thread.
struct Scratch {
  trace::CastResult cast;
  ReceiverHits hits;
  std::vector<MirrorEscape> escapes;
  std::vector<std::uint32_t> ids, tintedIds;
  std::vector<float> weights, tintedWeights;  ///< tinted: one for each channel
  std::vector<double> wide, y;
  std::vector<float> exits, lobes, outFloat, inFloat;
  HitCounts counts;
};

/// Unshadowed transfer in closed form: E_i = Â_l y_i(N); M = identity, for T_GU knows no horizon.
void gatherUnshadowed(const Simulation& simulation, std::uint32_t receiver, Gathered& gathered,
                      Scratch& scratch);

/// Pass 0 from scratch.cast (and scratch.escapes, where there are mirrors).
void gatherDirect(const Simulation& simulation, std::uint32_t receiver, Gathered& gathered,
                  Scratch& scratch);

/// The matrices of a bi-scale mesh with their rows turned into the receivers' tangent frames:
/// [receiver][channel][N²][n²] for the first `channels` channels of `matrices`, which holds one
/// matrix of matrixStride() floats for each of the mesh's receivers.
std::vector<float> inTangentFrames(const Simulation& simulation,
                                   const PlacedReceivers::PerMesh& place, const float* matrices,
                                   int channels);

/// What a pass left at all receivers, for the next one.
struct PassRows {
  std::vector<float> exit;  ///< [receiver][rowStride]: ρ/π E, what a diffuse one sends on, but
                            ///< for a texture's colour
  std::vector<float> matrices;  ///< [matrix][matrixStride()]: M
};

/// Pass b ≥ 1 from `hits`.
void gatherBounce(const Simulation& simulation, std::uint32_t receiver, const ReceiverHits& hits,
                  const PassRows& previous, Gathered& gathered, Scratch& scratch);

}  // namespace lambent::macro
