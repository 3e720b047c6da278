// How much light a patch sends back, in one number per channel: what neighbours of a surface that
// wears it see of it.
#pragma once

#include "lambent/transfer/field.h"

namespace lambent::meso {

/// The share of even light from the whole hemisphere that leaves again,
/// (1/π) ∫ ⟨L(u, v)⟩_u cos θ_v dv with L the exit radiance under unit radiance: the mean over
/// positions, and over views weighted by their cosine. A flat diffuse patch: its albedo. Negative
/// values, which quantisation can leave, count as 0.
Rgb effectiveAlbedo(const transfer::SimulatedRtt& rtt);

}  // namespace lambent::meso
