// What the figures of bi-scale transfer have in common: patches, RTTs, surfaces that wear them,
// lights of five bands.
#pragma once

#include <string>

#include "figures/studio.h"
#include "lambent/bi_scale/spread_patch.h"
#include "lambent/meso/build_rtt.h"
#include "lambent/shade/showing.h"

namespace lambent::figures {

/// A patch's RTT and what it cost.
struct BuiltRtt {
  transfer::SimulatedRtt rtt;
  meso::RttCost cost;
  double seconds = 0.0;
};
BuiltRtt build(const meso::Patch& patch, const meso::RttOptions& options);
/// 64×64 positions, 8×8 views.
meso::RttOptions rttOptions(const Studio& studio);
/// That of a generator with its defaults, built once. As in the paper: plaster, stucco and flower
/// have 128×128 positions and no dependence on the view.
transfer::SimulatedRtt rttNamed(const Studio& studio, const std::string& name);

/// The surface wears the patch, whose numbers are kept in 32 bits; those of matrices as the options
/// say. What others see of it is the RTT's own effective albedo.
bi_scale::Spread spread(const scene::Scene& scene, const transfer::SimulatedRtt& rtt,
                        bi_scale::SpreadOptions options);

struct Shot {
  scene::Camera camera;
  int width = 400, height = 400, samples = 16;
};
/// Linear radiance, by OpenGL.
image::Image photograph(const asset::Asset& asset, const sh::RgbCoefficients& light,
                        const shade::Showing& showing, const Shot& shot);

/// The light's five bands, windowed until no direction is negative: what both a path tracer and a
/// bake can be asked to see.
sh::RgbCoefficients fiveBands(const light::Environment& environment);

/// The smallest light that five bands can hold in a direction: those of a single direction, with
/// `irradiance` on what faces it.
sh::RgbCoefficients smallestLight(const Vec3& direction, const Rgb& irradiance);

/// A disc as large as given with `irradiance` on what faces it.
light::Environment discLight(const Vec3& direction, double diameterDegrees, const Rgb& irradiance);

/// Unit, degrees: azimuth from +x towards +z, elevation from the ground.
Vec3 towards(float azimuth, float elevation);

}  // namespace lambent::figures
