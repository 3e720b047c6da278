// What an Environment is a sum of: one light that can be looked up, projected, sampled and turned.
// Other rooms make lights of their own as classes that derive from Component (Environment::of).
#pragma once

#include <cmath>
#include <memory>
#include <span>

#include "lambent/light/environment.h"
#include "lambent/math/types.h"

namespace lambent::light {

/// What a colour counts for when directions are drawn: the luminance (Rec. 709) of its absolute
/// values, so that negative lobes of band-limited lights are drawn too, and nothing that has any
/// radiance is left out.
inline double importance(const Rgb& radiance) {
  return 0.2126 * std::abs(double(radiance[0])) + 0.7152 * std::abs(double(radiance[1])) +
         0.0722 * std::abs(double(radiance[2]));
}

class Component;
using ComponentPtr = std::shared_ptr<const Component>;

/// Immutable, and looked up from many threads at once. Directions are unit vectors in world space
/// that point away from the scene; radiance in W m⁻² sr⁻¹ per channel, and finite.
class Component {
 public:
  struct Drawn {
    Vec3 direction;
    Rgb radiance;  ///< there, as radiance() has it; for a directional light its irradiance
    double pdf;    ///< sr⁻¹, as pdf() has it; infinite for a directional light
  };

  virtual ~Component() = default;
  /// ∫ importance(radiance) ds, ≥ 0: how often the component is drawn among others. An estimate
  /// will do (it costs variance, not bias), but it must not be 0 where there is radiance.
  virtual double power() const = 0;
  /// From one direction; 0 everywhere for a directional light, which only draws and projects.
  virtual Rgb radiance(const Vec3& direction) const = 0;
  /// The density that draw() draws with, of a component that is black too. It integrates to 1 over
  /// the sphere and is above 0 wherever there is radiance; 0 everywhere for a directional light.
  virtual double pdf(const Vec3& direction) const = 0;
  /// A direction for two uniform numbers in [0, 1): where radiance() and pdf() are asked for it
  /// again they say what stands in Drawn, but for rounding.
  virtual Drawn draw(double u1, double u2) const = 0;
  /// Adds ∫ radiance y_i ds of what radiance() returns, in 1 … 10 bands, to `out`: 3·bands²
  /// doubles, channel after channel, each in the sequence of sh::index.
  virtual void addProjection(int bands, std::span<double> out) const = 0;
  /// The light whose radiance in direction dstFromSrc·s is this one's in s (a proper rotation).
  virtual ComponentPtr rotated(const Mat3& dstFromSrc) const = 0;
  /// Adds all of what radiance() returns to the part that has a place for it, and returns true; or
  /// returns false, and becomes one of Environment::Parts::others.
  virtual bool addTo(Environment::Parts&) const { return false; }
};

}  // namespace lambent::light
