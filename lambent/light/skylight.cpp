// A Skylight as a component. Directions are drawn by a grid of equal solid angles above the horizon,
// which is made when the first is asked for: what only projects and looks up never pays for it.
#include "lambent/light/skylight.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <vector>

#include "lambent/light/built_in.h"
#include "lambent/light/grid_distribution.h"
#include "lambent/sh/rotation.h"

namespace lambent::light {
namespace {

// Cells of azimuth × sine of the elevation: the lowest row is 0.9° high, where skies are steepest.
constexpr int kSkyColumns = 128, kSkyRows = 64;
// Every cell gets at least this part of the mean, so that no density is 0 where there is radiance.
constexpr double kSkyFloor = 0.05;

/// What every rotation of a skylight shares.
struct Shared {
  std::shared_ptr<const Skylight> light;
  double horizon;  ///< a sine
  double power;
  mutable std::once_flag once;
  mutable GridDistribution distribution;

  Vec3d directionAt(double u, double v) const {
    const double y = horizon + (1 - horizon) * v, angle = 2 * kPi * (u - 0.5);
    const double r = std::sqrt(std::max(0.0, 1 - y * y));
    return {r * std::cos(angle), y, r * std::sin(angle)};
  }
  double solidAngle() const { return 2 * kPi * (1 - horizon); }

  const GridDistribution& cells() const {
    std::call_once(once, [this] {
      std::vector<double> corners(std::size_t(kSkyColumns) * (kSkyRows + 1));
      for (int y = 0; y <= kSkyRows; ++y)
        for (int x = 0; x < kSkyColumns; ++x)
          corners[std::size_t(y) * kSkyColumns + x] = importance(
              light->radiance(directionAt(x / double(kSkyColumns), y / double(kSkyRows))));
      std::vector<double> weights(std::size_t(kSkyColumns) * kSkyRows);
      double sum = 0;
      for (int y = 0; y < kSkyRows; ++y)
        for (int x = 0; x < kSkyColumns; ++x) {
          const double* below = corners.data() + std::size_t(y) * kSkyColumns;
          const double* above = below + kSkyColumns;
          const int next = (x + 1) % kSkyColumns;
          sum += weights[std::size_t(y) * kSkyColumns + x] =
              std::max({below[x], below[next], above[x], above[next]});
        }
      const double least = kSkyFloor * sum / double(weights.size());
      for (double& weight : weights) weight += least;
      distribution = GridDistribution(kSkyColumns, kSkyRows, weights);
    });
    return distribution;
  }
  double density(int x, int y) const {
    if (!(cells().total() > 0)) return 1 / solidAngle();
    return cells().probability(x, y) * (kSkyColumns * kSkyRows) / solidAngle();
  }
};

class SkylightComponent final : public Component {
 public:
  SkylightComponent(std::shared_ptr<const Shared> shared, const Mat3& worldFromSky)
      : shared_(std::move(shared)), worldFromSky_(worldFromSky) {}

  double power() const override { return shared_->power; }
  Rgb radiance(const Vec3& direction) const override {
    return isAbove(direction) ? shared_->light->radiance(inSky(direction)) : Rgb(Rgb::Zero());
  }
  double pdf(const Vec3& direction) const override {
    if (!isAbove(direction)) return 0;
    const Vec3d s = inSky(direction);
    const double u = std::atan2(s.z(), s.x()) / (2 * kPi) + 0.5;
    const double v = (s.y() - shared_->horizon) / (1 - shared_->horizon);
    return shared_->density(std::clamp(int(u * kSkyColumns), 0, kSkyColumns - 1),
                            std::clamp(int(v * kSkyRows), 0, kSkyRows - 1));
  }
  Drawn draw(double u1, double u2) const override {
    GridDistribution::Cell cell{};
    if (shared_->cells().total() > 0) {
      cell = shared_->cells().draw(u1, u2);
    } else {
      cell = {int(u1 * kSkyColumns), int(u2 * kSkyRows), 0.5, 0.5};
    }
    const Vec3d s =
        shared_->directionAt((cell.x + cell.u) / kSkyColumns, (cell.y + cell.v) / kSkyRows);
    return {worldFromSky_ * s.cast<float>(), shared_->light->radiance(s),
            shared_->density(cell.x, cell.y)};
  }
  void addProjection(int bands, std::span<double> out) const override {
    const std::size_t count = std::size_t(bands) * std::size_t(bands);
    std::vector<double> sky(3 * count);
    shared_->light->addProjection(bands, sky);
    const std::vector<double> rotation = sh::rotationMatrix(bands, worldFromSky_.cast<double>());
    for (int l = 0; l < bands; ++l)  // bands do not mix
      for (int i = l * l; i < (l + 1) * (l + 1); ++i)
        for (int j = l * l; j < (l + 1) * (l + 1); ++j)
          for (std::size_t c = 0; c < 3; ++c)
            out[c * count + std::size_t(i)] +=
                rotation[std::size_t(i) * count + std::size_t(j)] * sky[c * count + std::size_t(j)];
  }
  ComponentPtr rotated(const Mat3& dstFromSrc) const override {
    return std::make_shared<SkylightComponent>(shared_, dstFromSrc * worldFromSky_);
  }
  bool addTo(Environment::Parts& parts) const override {
    if (parts.sky) return false;
    parts.sky = Environment::Parts::Sky{shared_->light, worldFromSky_, shared_->horizon};
    return true;
  }

 private:
  /// As a ground with the same horizon has it: where one ends, the other begins.
  bool isAbove(const Vec3& direction) const {
    return direction.cast<double>().dot(worldFromSky_.col(1).cast<double>()) > shared_->horizon;
  }
  Vec3d inSky(const Vec3& direction) const {
    return worldFromSky_.cast<double>().transpose() * direction.cast<double>();
  }
  std::shared_ptr<const Shared> shared_;
  Mat3 worldFromSky_;
};

}  // namespace

ComponentPtr makeSkylight(std::shared_ptr<const Skylight> light, const Mat3& worldFromSky) {
  auto shared = std::make_shared<Shared>();
  shared->horizon = std::sin(light->horizon());
  double mean[3] = {};
  light->addProjection(1, mean);  // ∫ radiance ds = √(4π) of it
  shared->power =
      std::sqrt(4 * kPi) * importance(Rgb(float(mean[0]), float(mean[1]), float(mean[2])));
  shared->light = std::move(light);
  return std::make_shared<SkylightComponent>(std::move(shared), worldFromSky);
}

}  // namespace lambent::light
