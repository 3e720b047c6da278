// A sky over one viewer at one moment: what every model of this room comes down to, and what maps,
// lights, tables and pictures are made from.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "lambent/math/types.h"
#include "lambent/radiometry/spectra.h"

namespace lambent::sky {

/// Radiance from every direction but for the Sun's disc. Immutable, and looked up from many threads
/// at once. Directions are unit vectors in the *Sun's frame*: +y up, the Sun in the half plane
/// x ≥ 0, z = 0. Radiance is finite and never negative.
class Dome {
 public:
  virtual ~Dome() = default;
  /// X, Y, Z in cd m⁻², and scotopic luminance in scotopic cd m⁻². Below the horizon of the viewer
  /// it is what the model knows of the ground and the air before it, or what stands at the horizon.
  virtual radiometry::Xyzv color(const Vec3d& direction) const = 0;
  /// W m⁻² sr⁻¹ nm⁻¹ at each of the wavelengths (nm, 340 … 740), into `radiance`, as many.
  virtual void spectrum(const Vec3d& direction, std::span<const double> wavelengths,
                        std::span<double> radiance) const = 0;
  /// ∫ color y_i ds over what is above a horizon (elevation, rad) in 1 … 10 bands, if the dome has a
  /// table of it: X, Y and Z into `xyz` one after the other, each of bands² numbers. false: it has
  /// none, and `xyz` is as it was.
  virtual bool harmonics(double /*horizon*/, int /*bands*/, std::span<double> /*xyz*/) const {
    return false;
  }
};

/// The Sun as its own component of a sky.
struct SunDisc {
  double elevation = 0;      ///< of its centre as it is seen, rad
  double angularRadius = 0;  ///< rad, some 0.00465
  double visible = 1;        ///< how much of the disc stands above the horizon, 0 … 1
  /// On a surface that faces it, through the air, of the part that is visible. X, Y, Z in lx.
  radiometry::Xyzv irradiance = radiometry::Xyzv::Zero();
  std::vector<double> spectralIrradiance;  ///< W m⁻² nm⁻¹ at Sky::wavelengths
};

/// A dome, its Sun, and the ground that the viewer stands on.
struct Sky {
  std::shared_ptr<const Dome> dome;
  SunDisc sun;
  double horizon = 0;  ///< elevation of the horizon, rad: 0 on the ground, below it higher up
  std::vector<double> wavelengths;  ///< nm
  std::vector<double> groundRadiance;  ///< W m⁻² sr⁻¹ nm⁻¹ that leaves the ground below the viewer
  radiometry::Xyzv ground = radiometry::Xyzv::Zero();  ///< the same, cd m⁻²
  double altitude = 0;                                 ///< of the viewer, m
};

}  // namespace lambent::sky
