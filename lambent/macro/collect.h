// Private to this room: what accumulators hold after the last pass → the transfer of a mesh.
#pragma once

#include <cstdint>

#include "lambent/macro/simulation.h"

namespace lambent::macro {

/// One channel serves for R, G and B as long as nothing on the way of the light has a colour.
int channelsFor(const scene::Scene& scene, const PlacedReceivers& receivers, transfer::Kind kind);

/// Accumulators of all receivers, shaped as simulation.h says.
struct Totals {
  const float* rows;      ///< E
  const float* matrices;  ///< M
};

/// Everything that a bake says of one mesh. `shadowed`: the totals after pass 0, where they are to
/// be kept beside.
transfer::MeshTransfer<transfer::Floats> transferOf(const Simulation& simulation,
                                                    std::uint32_t mesh, const Totals& totals,
                                                    const Totals* shadowed);

}  // namespace lambent::macro
