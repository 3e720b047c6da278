// The ASRC-CIE sky: a mixture of four skies, weighted by how clear and how bright the sky is.
#pragma once

#include "lambent/sky/perez.h"
#include "lambent/sky/standard_skies.h"

namespace lambent::sky {

/// The intermediate sky of nakamura1985luminance, relative to its zenith: thin or broken cloud, the
/// mean of many. Below the horizon what stands at the horizon above. ≥ 0.
double intermediateRelativeLuminance(double sunElevation, const Vec3d& direction);

/// Shares that sum to 1.
struct AsrcWeights {
  double clear = 0, turbid = 0, intermediate = 0, overcast = 0;
};
/// Where one sky gives way to the next; linear in between.
struct AsrcKnots {
  double overcastUntil = 1.2;  ///< ε: overcast alone up to here,
  double intermediateAt = 3;   ///< the intermediate sky alone here,
  double cloudlessFrom = 6;    ///< cloudless skies alone from here
  double clearUntil = .1;      ///< Δ: of the cloudless ones the clear sky alone up to here,
  double turbidFrom = .3;      ///< the turbid one alone from here
};
AsrcWeights asrcWeights(const SkyCondition& condition, const AsrcKnots& knots = {});

struct AsrcSky {
  AsrcWeights weights;
  double sunElevation = 0;  ///< 0 … π/2
  /// Luminance over relative luminance of each sky, cd m⁻²: its share of the illuminance.
  double clearScale = 0, turbidScale = 0, intermediateScale = 0, overcastScale = 0;
  SkyCondition condition;
  double diffuseIlluminance = 0, directNormalIlluminance = 0;  ///< lx, as of PerezSky
  double luminance(const Vec3d& direction) const;
};
/// The level is that of perezSky(): diffuse irradiance times its luminous efficacy. A Sun below the
/// horizon counts as on it.
AsrcSky asrcSky(const MeasuredIrradiance& irradiance, double sunElevation,
                const PerezOptions& options = {}, const AsrcKnots& knots = {});

}  // namespace lambent::sky
