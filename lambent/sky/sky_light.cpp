// A light has one coefficient u of limb darkening a channel, of the law 1 − u (1 − μ), where pictures
// of the sky have a power of μ for every wavelength: its mean over the disc is the same.
#include "lambent/sky/sky_light.h"

#include <array>
#include <cmath>

#include "lambent/light/skylight.h"
#include "lambent/math/quadrature.h"
#include "lambent/sh/basis.h"
#include "lambent/sh/rotation.h"
#include "lambent/sky/sight.h"
#include "lambent/sky/sun_coverage.h"

namespace lambent::sky {
namespace {

constexpr int kElevations = 64, kAzimuths = 64;

/// A dome above the horizon.
class DomeLight final : public light::Skylight {
 public:
  DomeLight(std::shared_ptr<const Dome> dome, double horizon)
      : dome_(std::move(dome)), horizon_(horizon) {
    const std::size_t count = std::size_t(sh::coefficientCount(sh::kMaxBands));
    coefficients_ = projectDome(*dome_, horizon, sh::kMaxBands);
    for (std::size_t i = 0; i < count; ++i) {
      const Eigen::Array3d rgb = radiometry::linearRgbOf(radiometry::Xyzv(
          coefficients_[i], coefficients_[count + i], coefficients_[2 * count + i], 0));
      for (std::size_t c = 0; c < 3; ++c) coefficients_[c * count + i] = rgb[Eigen::Index(c)];
    }
  }
  double horizon() const override { return horizon_; }
  Rgb radiance(const Vec3d& direction) const override {
    return radianceRgb(dome_->color(direction));
  }
  void addProjection(int bands, std::span<double> out) const override {
    const std::size_t count = std::size_t(sh::coefficientCount(bands));
    const std::size_t all = coefficients_.size() / 3;
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t i = 0; i < count; ++i) out[c * count + i] += coefficients_[c * all + i];
  }

 private:
  std::shared_ptr<const Dome> dome_;
  double horizon_;
  std::vector<double> coefficients_;  ///< R, G and B one after the other
};

/// The u of 1 − u (1 − μ) whose mean over the disc is that of μ^α: 1 − u/3 = 2/(α + 2).
double linearLimbDarkening(double nanometres) {
  const double exponent = limbDarkening(nanometres);
  return 3 * exponent / (exponent + 2);
}

}  // namespace

Rgb solarLimbDarkening() {
  return Rgb(float(linearLimbDarkening(610)), float(linearLimbDarkening(550)),
             float(linearLimbDarkening(465)));
}

std::vector<double> projectDome(const Dome& dome, double horizon, int bands) {
  const int count = sh::coefficientCount(bands);
  std::vector<double> out(3 * std::size_t(count));
  if (dome.harmonics(horizon, bands, out)) return out;
  // Sums along azimuth, then along elevation, in a frame whose +z is up: (x, −z, y). Elevations lie
  // closer to each other towards the horizon, where skies are steepest; both halves are the same.
  const math::Quadrature rise = math::gaussLegendre(kElevations, 0, 1);
  const math::Quadrature turn = math::gaussLegendre(kAzimuths, 0, kPi);
  std::vector<double> cosines(std::size_t(bands) * kAzimuths), basis(count);
  for (int m = 0; m < bands; ++m)
    for (int i = 0; i < kAzimuths; ++i)
      cosines[std::size_t(m) * kAzimuths + i] = 2 * turn.weights[i] * std::cos(m * turn.nodes[i]);
  std::vector<double> polar(out.size());
  std::array<Eigen::Array3d, kAzimuths> row;
  for (int j = 0; j < kElevations; ++j) {
    const double w = rise.nodes[j], elevation = horizon + (kPi / 2 - horizon) * w * w;
    const double sine = std::sin(elevation), cosine = std::cos(elevation);
    const double weight = rise.weights[j] * 2 * w * (kPi / 2 - horizon) * cosine;
    for (int i = 0; i < kAzimuths; ++i)
      row[std::size_t(i)] = dome.color(Vec3d(cosine * std::cos(turn.nodes[i]), sine,
                                             cosine * std::sin(turn.nodes[i])))
                                .head<3>();
    sh::evaluate(bands, Vec3d(cosine, 0, sine), std::span<double>(basis));
    for (int m = 0; m < bands; ++m) {
      Eigen::Array3d sum = Eigen::Array3d::Zero();
      for (int i = 0; i < kAzimuths; ++i)
        sum += cosines[std::size_t(m) * kAzimuths + i] * row[std::size_t(i)];
      for (int l = m; l < bands; ++l)
        for (int c = 0; c < 3; ++c)
          polar[std::size_t(c * count + sh::index(l, m))] +=
              weight * basis[sh::index(l, m)] * sum[c];
    }
  }
  Mat3d sunFromPolar;
  sunFromPolar << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  const std::vector<double> rotation = sh::rotationMatrix(bands, sunFromPolar);
  for (int l = 0; l < bands; ++l)
    for (int i = l * l; i < (l + 1) * (l + 1); ++i)
      for (int j = l * l; j < (l + 1) * (l + 1); ++j)
        for (int c = 0; c < 3; ++c)
          out[std::size_t(c * count + i)] +=
              rotation[std::size_t(i * count + j)] * polar[std::size_t(c * count + j)];
  return out;
}

light::Environment environmentOf(const Sky& sky, const Mat3d& worldFromSun) {
  const Vec3 up = worldFromSun.col(1).cast<float>();
  light::Environment sum =
      light::Environment::skylight(std::make_shared<DomeLight>(sky.dome, sky.horizon),
                                   worldFromSun.cast<float>()) +
      light::Environment::ground(up, sky.horizon, radianceRgb(sky.ground));
  if (!(sky.sun.visible > 0) || !(sky.sun.angularRadius > 0)) return sum;
  const Vec3d sun(std::cos(sky.sun.elevation), std::sin(sky.sun.elevation), 0);
  return sum + light::Environment::disc({.direction = (worldFromSun * sun).cast<float>(),
                                         .angularDiameter = 2 * sky.sun.angularRadius,
                                         .irradiance = radianceRgb(sky.sun.irradiance),
                                         .darkening = solarLimbDarkening(),
                                         .up = up,
                                         .horizon = sky.horizon});
}

}  // namespace lambent::sky
