// Receivers that stand where nobody sees them: inside another body that cuts through their mesh.
#pragma once

#include <cstdint>
#include <vector>

#include "lambent/report/result.h"
#include "lambent/trace/ray_scene.h"
#include "lambent/transport/receivers.h"
#include "lambent/work/runner.h"

namespace lambent::transport {

/// 1 for every receiver that is buried; empty if none is. Receivers that see backs (InsideProbe) are
/// gathered into patches of neighbours. A patch is buried if the steps that lead into it from
/// receivers beside it go through fronts, more of them than not: the mesh goes into a body there. A
/// floor under leaves that show it their backs is none, for no step leads through a leaf; nor is a
/// mesh that lies in a body as a whole, to which no step leads. Cancelled.
Result<std::vector<std::uint8_t>> findBuried(const scene::Scene& scene, const trace::RayScene& rays,
                                             const PlacedReceivers& receivers,
                                             const work::Runner& runner);

}  // namespace lambent::transport
