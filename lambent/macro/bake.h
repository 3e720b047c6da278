// Macro-scale radiance transfer (sloan2002precomputed §5): Scene and receivers →
// transfer::SimulatedField.
#pragma once

#include "lambent/report/finding.h"
#include "lambent/report/progress.h"
#include "lambent/report/result.h"
#include "lambent/scene/scene.h"
#include "lambent/trace/ray_scene.h"
#include "lambent/transfer/field.h"
#include "lambent/transport/receivers.h"

namespace lambent::macro {

struct BakeOptions {
  transfer::Kind kind = transfer::Kind::Interreflected;
  int bands = 5;          ///< of the light, 1 … 10
  int glossyBands = 0;    ///< rows of glossy matrices, 1 … 10; 0: as bands
  int directions = 8192;  ///< over the whole sphere; half of them face any receiver
  int bounces = 2;        ///< at most, for Interreflected
  double energyThreshold =
      0.0;                 ///< stop when a pass has less than this fraction of pass 0's energy
  std::uint64_t seed = 0;  ///< turns the direction set; two seeds give independent errors
  int threads = 0;         ///< 0: as many as the machine has. No effect on the result's bytes
  /// Bytes for remembered hits; what does not fit is cast again in every bounce.
  std::size_t hitMemory = std::size_t(3) << 30;
  /// For Interreflected: keep the shadowed vectors and matrices beside, to switch between them.
  /// They cost memory and a larger asset, and no time.
  bool keepShadowed = false;
};

/// How all `receivers` of the scene answer to light, wherever transport::placeReceivers has put
/// them. Findings: receivers inside a mesh, rays that met back faces, light that is left out.
/// BadUsage for options out of range; Cancelled.
Result<WithFindings<transfer::SimulatedField>> bake(const scene::Scene& scene,
                                                    const trace::RayScene& rays,
                                                    const transport::PlacedReceivers& receivers,
                                                    const BakeOptions& options,
                                                    const Progress& progress);

}  // namespace lambent::macro
