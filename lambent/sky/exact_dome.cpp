#include "lambent/sky/exact_dome.h"

#include <algorithm>
#include <cmath>

#include "lambent/math/types.h"
#include "lambent/sky/spectral_weights.h"

namespace lambent::sky {
namespace {

class ExactDome final : public Dome {
 public:
  ExactDome(Scattering scattering, const Atmosphere& atmosphere, double altitude,
            double sunElevation, double nearness)
      : scattering_(std::move(scattering)),
        atmosphere_(atmosphere),
        color_(scattering_.medium().wavelengths, atmosphere),
        altitude_(altitude),
        sunZenith_(kPi / 2 - sunElevation),
        sun_(std::cos(sunElevation), std::sin(sunElevation), 0),
        nearness_(nearness) {}

  radiometry::Xyzv color(const Vec3d& direction) const override {
    return (nearness_ * color_(logsTowards(direction).data())).max(0.0);
  }

  void spectrum(const Vec3d& direction, std::span<const double> wavelengths,
                std::span<double> radiance) const override {
    const std::vector<float> logs = logsTowards(direction);
    for (std::size_t i = 0; i < wavelengths.size(); ++i) {
      const SpectralTaps taps(scattering_.medium().wavelengths, wavelengths[i]);
      radiance[i] = nearness_ * solarIrradianceOf(atmosphere_, wavelengths[i]) *
                    std::exp(double(taps(logs.data())));
    }
  }

 private:
  std::vector<float> logsTowards(const Vec3d& direction) const {
    const RayInAir ray{altitude_, std::clamp(direction.y(), -1.0, 1.0), sunZenith_,
                       std::clamp(direction.dot(sun_), -1.0, 1.0)};
    const std::vector<double> radiance = scattering_.radiance(ray);
    std::vector<float> logs(radiance.size());
    std::transform(radiance.begin(), radiance.end(), logs.begin(),
                   [](double value) { return float(std::log(std::max(value, 1e-30))); });
    return logs;
  }

  Scattering scattering_;
  Atmosphere atmosphere_;
  ColorUnderSun color_;
  double altitude_, sunZenith_;
  Vec3d sun_;
  double nearness_;
};

}  // namespace

std::shared_ptr<const Dome> exactDome(Scattering scattering, const Atmosphere& atmosphere,
                                      double altitude, double sunElevation, double nearness) {
  return std::make_shared<ExactDome>(std::move(scattering), atmosphere, altitude, sunElevation,
                                     nearness);
}

}  // namespace lambent::sky
