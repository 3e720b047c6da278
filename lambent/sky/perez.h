// The all-weather sky of perez1993all, from two irradiances that weather stations measure.
#pragma once

#include "lambent/sky/sun_frame.h"

namespace lambent::sky {

/// What is measured, W m⁻², at a moment with the Sun above the horizon. Negative counts as 0.
struct MeasuredIrradiance {
  double directNormal = 0;       ///< of the Sun, on a surface that faces it
  double diffuseHorizontal = 0;  ///< of the sky, on a horizontal one
};

/// What kind of sky it is (perez1990modeling).
struct SkyCondition {
  double clearness = 1;   ///< ε, from 1 (overcast) to 12 (very clear)
  double brightness = 0;  ///< Δ, .01 … .6
};
/// ε = ((E_d + E_n) / E_d + 1.041 Z³) / (1 + 1.041 Z³), Δ = m E_d / E_0, with the zenith angle Z in
/// radians, E_0 = 1367 W m⁻² over the square of the Sun's distance (AU) and m kasten1965new's air
/// mass. Clamped to the ranges above. Without any diffuse irradiance ε is 12 where there is a Sun,
/// else 1.
SkyCondition skyCondition(const MeasuredIrradiance& irradiance, double sunElevation,
                          double sunDistance = 1);

/// Which of the eight rows, 0 … 7, of perez1993all a clearness falls in.
int clearnessBin(double clearness);

/// a, b, c, d, e of one row at a brightness and the Sun's zenith angle (rad), with the guard that
/// Delaunay's program has: in rows 1 … 4 (ε of 1.065 … 2.8) Δ counts as at least .2.
struct PerezCoefficients {
  double a, b, c, d, e;
};
PerezCoefficients perezCoefficients(int bin, double brightness, double sunZenith);

/// Luminous efficacy of the irradiance, lm/W (perez1990modeling, tables 4), of one row. ≥ 0.
struct Efficacy {
  double diffuse, direct;
};
Efficacy perezEfficacy(int bin, double brightness, double sunZenith, double precipitableWater);

struct PerezOptions {
  double precipitableWater = 2;  ///< cm, above the place
  double sunDistance = 1;        ///< AU
  /// The rows differ, so that a sky whose clearness crosses a border jumps. Skies within this ratio
  /// (as a logarithm) of a border are mixed of both; 0 leaves the steps. Below .03 no two borders
  /// meet.
  double blend = .03;
};

/// A mixture of at most two skies of the model. Luminance in cd m⁻², in the Sun's frame; below the
/// horizon what stands at the horizon above.
struct PerezSky {
  struct Part {
    Gradation gradation;
    Indicatrix indicatrix;
    double scale = 0;  ///< luminance over the product of both, cd m⁻²
  };
  Part parts[2];
  Vec3d sun{0, 1, 0};
  SkyCondition condition;
  double diffuseIlluminance = 0;       ///< lx, on a horizontal surface
  double directNormalIlluminance = 0;  ///< lx, of the Sun, on a surface that faces it
  double luminance(const Vec3d& direction) const;
};
/// A Sun below the horizon counts as on it: the irradiance that was measured sets the level.
PerezSky perezSky(const MeasuredIrradiance& irradiance, double sunElevation,
                  const PerezOptions& options = {});

}  // namespace lambent::sky
