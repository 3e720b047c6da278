// Private to this room: the light that the facets of a patch send to each other.
#pragma once

#include <cstdint>
#include <vector>

#include "lambent/meso/facets.h"
#include "lambent/meso/incident_light.h"
#include "lambent/report/result.h"
#include "lambent/work/runner.h"

namespace lambent::meso {

/// Rows [facet][channel][bands²], padded to `stride` floats; one channel where the patch is grey.
struct FacetLight {
  int channels = 1;
  std::size_t stride = 0;
  /// Exit radiance ρ/π E of every facet, with one bounce less than were asked for: what final
  /// gathering picks up. Empty without bounces.
  std::vector<float> exit;
  /// Irradiance that comes from other facets, with all bounces. Empty unless asked for.
  std::vector<float> bounced;
  std::uint64_t rays = 0;

  const float* exitRow(std::uint32_t facet) const { return exit.data() + facet * stride; }
};

struct BounceOptions {
  int bands = 5;
  int bounces = 3;
  bool wantBounced = false;           ///< fill FacetLight::bounced too
  const LightRows* lights = nullptr;  ///< direct light by these instead of by the lattice
  /// Bytes for remembered hits; facets for which there is no room are cast again at every bounce.
  std::size_t hitMemory = std::size_t(1) << 30;
};

/// Direct light of all facets, then bounce after bounce. Cancelled if `runner` is stopped.
Result<FacetLight> bouncedLight(const PeriodicScene& scene, const Facets& facets,
                                const Lattice& lattice, const BounceOptions& options,
                                const work::Runner& runner);

}  // namespace lambent::meso
