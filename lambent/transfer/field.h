// What a bake yields: how every receiver answers to light, before any light is known.
#pragma once

#include <cstdint>
#include <variant>
#include <vector>

#include "lambent/transfer/bi_scale.h"
#include "lambent/transfer/kind.h"
#include "lambent/transfer/numbers.h"
#include "lambent/transfer/rtt.h"
#include "lambent/transfer/surface.h"

namespace lambent::transfer {

/// A mirror's: it reflects what it sees, and records nothing.
struct NoTransfer {};

/// The transfer of one mesh. A new kind of transfer is one more alternative.
template <class N>
using MeshTransfer = std::variant<NoTransfer, Surface<N>, BiScale<N>>;

template <class N>
struct Field {
  Kind kind = Kind::Shadowed;  ///< the most that was simulated; every bare surface holds it
  int bands = 5;               ///< of the light that relights it
  int directions = 0;          ///< sampled over the sphere
  int bounces = 0;             ///< simulated beyond the direct light
  std::uint64_t seed = 0;
  std::vector<double> passEnergy;  ///< energy of pass 0 (direct), 1, 2, …: Σ|M|² / receivers
  std::vector<MeshTransfer<N>> meshes;  ///< one for each mesh of the scene
  std::vector<Rtt<N>> rtts;             ///< the patches that meshes carry
};

using SimulatedField = Field<Floats>;
using EncodedField = Field<Numbers>;
using EncodedMesh = MeshTransfer<Numbers>;
using SimulatedRtt = Rtt<Floats>;
using EncodedRtt = Rtt<Numbers>;

/// What is done with each kind of transfer, for std::visit: a kind that is left out does not compile.
template <class... Each>
struct ForEachKind : Each... {
  using Each::operator()...;
};
template <class... Each>
ForEachKind(Each...) -> ForEachKind<Each...>;

/// Null for a mirror.
template <class N>
const Receivers* receiversOf(const MeshTransfer<N>& mesh) {
  return std::visit(
      ForEachKind{[](const NoTransfer&) -> const Receivers* { return nullptr; },
                  [](const auto& held) -> const Receivers* { return held.receivers.get(); }},
      mesh);
}

/// Whether a mesh can be shown under a kind. Unshadowed always can: that takes its receivers'
/// normals alone.
template <class N>
bool offers(const MeshTransfer<N>& mesh, Kind kind) {
  if (kind == Kind::Unshadowed) return true;
  return std::visit(
      ForEachKind{[](const NoTransfer&) { return true; },
                  [&](const Surface<N>& surface) { return surface.responses.holds(kind); },
                  [&](const BiScale<N>& biScale) { return biScale.matrices.holds(kind); }},
      mesh);
}

}  // namespace lambent::transfer
