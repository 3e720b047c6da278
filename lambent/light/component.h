// What an Environment is a sum of: one light that can be looked up, projected, sampled and turned.
// Internal to this room.
#pragma once

#include <limits>
#include <memory>
#include <span>

#include "lambent/image/image.h"
#include "lambent/light/environment.h"
#include "lambent/math/types.h"
#include "lambent/sh/coefficients.h"

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

class Component {
 public:
  struct Drawn {
    Vec3 direction;
    Rgb radiance;  ///< there; for a directional light its irradiance
    double pdf;    ///< sr⁻¹; infinite for a directional light
  };

  virtual ~Component() = default;
  /// ∫ importance(radiance) ds: how often the component is drawn among others.
  virtual double power() const = 0;
  virtual Rgb radiance(const Vec3& direction) const = 0;
  /// The density that draw() draws with. It integrates to 1, or is 0 for a directional light.
  virtual double pdf(const Vec3& direction) const = 0;
  virtual Drawn draw(double u1, double u2) const = 0;
  /// Adds the projection to `out`: 3·bands² doubles, channel after channel.
  virtual void addProjection(int bands, std::span<double> out) const = 0;
  virtual ComponentPtr rotated(const Mat3& dstFromSrc) const = 0;
  /// Adds itself to what Environment::Parts has a place for; false: it has none.
  virtual bool addTo(Environment::Parts&) const { return false; }
};

ComponentPtr makeUniform(const Rgb& radiance);
ComponentPtr makeDisc(const Vec3d& axis, double angularDiameter, const Rgb& radiance);
ComponentPtr makeDirectional(const Vec3d& direction, const Rgb& irradiance);
ComponentPtr makeClampedCosine(const Vec3d& axis, const Rgb& radiance);
ComponentPtr makeHarmonics(sh::RgbCoefficients coefficients);
/// Pixels that are not finite count as black.
ComponentPtr makeLatLong(image::Image image);

}  // namespace lambent::light
