// What to do about receivers inside other bodies, where nobody sees them but everybody what is
// interpolated from them: black there, they would bleed out along every contact as dark teeth.
//
// Their rows are extrapolated from what is seen of the surface around them. In every triangle (or
// cell of four texels) that has a buried corner, places are tried out; at some of those that are not
// inside, receivers of their own, the witnesses, are simulated like all others; and the buried
// corner is set, after every pass, so that what is interpolated there is what the witness has
// (Extrapolation). Light that bounces off such a triangle is then right as well.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "lambent/report/result.h"
#include "lambent/trace/ray_scene.h"
#include "lambent/transport/extrapolation.h"
#include "lambent/transport/receivers.h"
#include "lambent/work/runner.h"

namespace lambent::transport {

struct MendedReceivers {
  PlacedReceivers receivers;         ///< those given and, behind them, witnesses
  std::vector<std::uint8_t> buried;  ///< 1: extrapolated, not to be simulated. One of each of those
  Extrapolation extrapolation;
  std::size_t buriedCount = 0;
};

/// Nothing, where no receiver is buried (findBuried). Cancelled.
Result<std::optional<MendedReceivers>> mendBuried(const scene::Scene& scene,
                                                  const trace::RayScene& rays,
                                                  const PlacedReceivers& receivers,
                                                  const work::Runner& runner);

}  // namespace lambent::transport
