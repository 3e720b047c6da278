// A sky for tests: brighter towards +x and much so at the horizon.
#pragma once

#include <cmath>
#include <vector>

#include "lambent/light/skylight.h"
#include "lambent/math/quadrature.h"
#include "lambent/sh/basis.h"

namespace lambent::light::test {

class Glow final : public Skylight {
 public:
  Glow(double horizon, const Rgb& color) : horizon_(horizon), color_(color) {}
  double horizon() const override { return horizon_; }
  Rgb radiance(const Vec3d& s) const override {
    const double above = s.y() - std::sin(horizon_);
    return color_ * float((1 + 0.9 * s.x()) * (0.2 + std::exp(-6 * above)));
  }
  void addProjection(int bands, std::span<double> out) const override {
    constexpr int kSteps = 24, kTurns = 32;
    const std::size_t count = std::size_t(bands) * std::size_t(bands);
    const math::Quadrature rule = math::gaussLegendre(kSteps, horizon_, kPi / 2);
    std::vector<double> y(count);
    for (int j = 0; j < kSteps; ++j)
      for (int i = 0; i < kTurns; ++i) {
        const double e = rule.nodes[j], turn = 2 * kPi * i / kTurns;
        const Vec3d s(std::cos(e) * std::cos(turn), std::sin(e), std::cos(e) * std::sin(turn));
        const Rgb there = radiance(s);
        const double weight = rule.weights[j] * std::cos(e) * 2 * kPi / kTurns;
        sh::evaluate(bands, s, std::span<double>(y));
        for (std::size_t c = 0; c < 3; ++c)
          for (std::size_t k = 0; k < count; ++k)
            out[c * count + k] += weight * double(there[Eigen::Index(c)]) * y[k];
      }
  }

 private:
  double horizon_;
  Rgb color_;
};

}  // namespace lambent::light::test
