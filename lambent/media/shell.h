// Rays in the shell of air about a planet: where they are, and where they leave it.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

namespace lambent::media {

/// A spherical shell, lengths in m. A planet of 10⁹ m is flat to all purposes.
struct Shell {
  double radius;  ///< of the planet
  double height;  ///< of the top of the air above it

  /// Altitude of the point at a distance along a ray that starts at `altitude` with the cosine of
  /// its zenith angle. Of differences of squares, so that centimetres keep their digits.
  double altitudeAlong(double altitude, double cosine, double distance) const {
    const double x = altitude * (2 * radius + altitude) +
                     distance * (2 * (radius + altitude) * cosine + distance);
    return x / (radius + std::sqrt(std::max(0.0, radius * radius + x)));
  }
  /// Altitude of the point of the ray's line that is closest to the planet's centre.
  double lowestAltitude(double altitude, double cosine) const {
    const double r = radius + altitude, s2 = 1 - cosine * cosine;
    // r sin − radius, without the cancellation for small altitudes.
    return (altitude * (radius + r) - r * r * (1 - s2)) / (radius + r * std::sqrt(s2));
  }
  /// Cosine of the zenith angle of the horizon.
  double horizonCosine(double altitude) const {
    const double r = radius + altitude;
    return -std::sqrt(altitude * (2 * radius + altitude)) / r;
  }
  /// Distance to where the ray leaves the sphere at altitude `sphere` (the farther of two
  /// crossings), if it meets it.
  std::optional<double> exitAt(double sphere, double altitude, double cosine) const {
    const double r = radius + altitude;
    const double c = (sphere - altitude) * (2 * radius + sphere + altitude);  // > 0 from within
    const double d = r * r * cosine * cosine + c;
    if (d < 0) return std::nullopt;
    const double root = std::sqrt(d), b = r * cosine;
    const double far = b <= 0 ? root - b : c / (root + b);
    return far >= 0 ? std::optional(far) : std::nullopt;
  }
  /// The nearer crossing of it, in front.
  std::optional<double> entryAt(double sphere, double altitude, double cosine) const {
    const double r = radius + altitude;
    const double c = (altitude - sphere) * (2 * radius + sphere + altitude);  // > 0 from outside
    const double b = r * cosine, d = b * b - c;
    if (d < 0 || b >= 0 || c < 0) return std::nullopt;
    return c / (std::sqrt(d) - b);
  }
  /// Distance to the ground, if the ray meets it: below the horizon.
  std::optional<double> toGround(double altitude, double cosine) const {
    if (!(cosine < horizonCosine(altitude))) return std::nullopt;
    if (altitude <= 0) return 0.0;
    return entryAt(0, altitude, cosine);
  }
};

}  // namespace lambent::media
