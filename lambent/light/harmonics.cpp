// A light given by its harmonics. Its radiance can be negative (ringing): the sign is kept, and
// directions are drawn by the absolute value, tabulated on a grid of equal solid angles.
#include <algorithm>
#include <cmath>
#include <vector>

#include "lambent/light/built_in.h"
#include "lambent/light/grid_distribution.h"
#include "lambent/sh/basis.h"
#include "lambent/sh/rotation.h"

namespace lambent::light {
namespace {

// Cells of azimuth × y: a light of 10 bands has features some 18° wide, cells are 5.6°.
constexpr int kColumns = 64, kRows = 32;
// Every cell gets at least this part of the mean, so that the density is not 0 where a zero of
// the radiance crosses a cell between the points that are tabulated.
constexpr double kFloor = 0.05;

Vec3 directionAt(double u, double v) {
  const double y = 1 - 2 * v, angle = 2 * kPi * (u - 0.5);
  const double r = std::sqrt(std::max(0.0, 1 - y * y));
  return Vec3(float(r * std::cos(angle)), float(y), float(r * std::sin(angle)));
}

class Harmonics final : public Component {
 public:
  explicit Harmonics(sh::RgbCoefficients f) : f_(std::move(f)) {
    // Each cell by its largest value on 3×3 points; corners are shared with its neighbours.
    const int w = 2 * kColumns, h = 2 * kRows + 1;
    std::vector<double> fine(std::size_t(w) * h);
    for (int y = 0; y < h; ++y)
      for (int x = 0; x < w; ++x)
        fine[std::size_t(y) * w + x] =
            importance(radiance(directionAt(x / double(w), y / (h - 1.0))));
    std::vector<double> weights(std::size_t(kColumns) * kRows);
    double sum = 0;
    for (int y = 0; y < kRows; ++y)
      for (int x = 0; x < kColumns; ++x) {
        double most = 0;
        for (int j = 0; j < 3; ++j)
          for (int i = 0; i < 3; ++i)
            most = std::max(most, fine[std::size_t(2 * y + j) * w + (2 * x + i) % w]);
        sum += weights[std::size_t(y) * kColumns + x] = most;
      }
    const double least = kFloor * sum / double(weights.size());
    for (double& weight : weights) weight += least;
    power_ = 4 * kPi * sum / double(weights.size());
    distribution_ = GridDistribution(kColumns, kRows, weights);
  }

  double power() const override { return power_; }
  Rgb radiance(const Vec3& direction) const override {
    return f_.bands ? sh::reconstruct(f_, direction) : Rgb(Rgb::Zero());
  }
  double pdf(const Vec3& direction) const override {
    if (!(power_ > 0)) return 1 / (4 * kPi);
    const double u = std::atan2(direction.z(), direction.x()) / (2 * kPi) + 0.5;
    const double v = 0.5 * (1 - double(direction.y()));
    const int x = std::clamp(int(u * kColumns), 0, kColumns - 1);
    const int y = std::clamp(int(v * kRows), 0, kRows - 1);
    return density(x, y);
  }
  Drawn draw(double u1, double u2) const override {
    if (!(power_ > 0)) {
      const Vec3 s = directionAt(u1, u2);
      return {s, radiance(s), 1 / (4 * kPi)};
    }
    const GridDistribution::Cell cell = distribution_.draw(u1, u2);
    const Vec3 s = directionAt((cell.x + cell.u) / kColumns, (cell.y + cell.v) / kRows);
    return {s, radiance(s), density(cell.x, cell.y)};
  }
  void addProjection(int bands, std::span<double> out) const override {
    const int count = sh::coefficientCount(std::min(bands, f_.bands));
    for (int c = 0; c < 3; ++c)
      for (int i = 0; i < count; ++i)
        out[c * sh::coefficientCount(bands) + i] += double(f_.channel(c)[i]);
  }
  ComponentPtr rotated(const Mat3& dstFromSrc) const override {
    return makeHarmonics(f_.bands ? sh::rotate(dstFromSrc, f_) : f_);
  }

 private:
  double density(int x, int y) const {
    return distribution_.probability(x, y) * (kColumns * kRows) / (4 * kPi);
  }
  sh::RgbCoefficients f_;
  double power_ = 0;
  GridDistribution distribution_;
};

}  // namespace

ComponentPtr makeHarmonics(sh::RgbCoefficients coefficients) {
  return std::make_shared<Harmonics>(std::move(coefficients));
}

}  // namespace lambent::light
