#include "lambent/sky/analytic_dome.h"

#include <algorithm>
#include <utility>

namespace lambent::sky {
namespace {

class DaylightDome final : public Dome {
 public:
  DaylightDome(std::function<double(const Vec3d&)> luminance, double x, double y)
      : luminance_(std::move(luminance)),
        x_(x),
        y_(y),
        colorOfOne_(radiometry::daylightXyzv(x, y, 1)) {}

  radiometry::Xyzv color(const Vec3d& direction) const override {
    return colorOfOne_ * luminance_(direction);
  }
  void spectrum(const Vec3d& direction, std::span<const double> wavelengths,
                std::span<double> radiance) const override {
    std::ranges::copy(radiometry::daylightSpectrum(x_, y_, luminance_(direction), wavelengths),
                      radiance.begin());
  }

 private:
  std::function<double(const Vec3d&)> luminance_;
  double x_, y_;
  radiometry::Xyzv colorOfOne_;
};

class PreethamDome final : public Dome {
 public:
  explicit PreethamDome(const PreethamSky& sky) : sky_(sky) {}

  radiometry::Xyzv color(const Vec3d& direction) const override { return sky_.color(direction); }
  void spectrum(const Vec3d& direction, std::span<const double> wavelengths,
                std::span<double> radiance) const override {
    std::ranges::copy(sky_.spectrum(direction, wavelengths), radiance.begin());
  }

 private:
  PreethamSky sky_;
};

}  // namespace

std::shared_ptr<const Dome> daylightDome(std::function<double(const Vec3d&)> luminance, double x,
                                         double y) {
  return std::make_shared<DaylightDome>(std::move(luminance), x, y);
}

std::shared_ptr<const Dome> preethamDome(const PreethamSky& sky) {
  return std::make_shared<PreethamDome>(sky);
}

}  // namespace lambent::sky
