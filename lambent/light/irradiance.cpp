#include "lambent/light/irradiance.h"

#include <cmath>

#include "lambent/sh/zonal.h"

namespace lambent::light {

const IrradianceConstants& irradianceConstants() {
  static const IrradianceConstants constants = [] {
    const sh::ZonalMoments a = sh::clampedCosine(3);  // Â_l
    return IrradianceConstants{.c1 = a[2] * std::sqrt(15 / kPi) / 4,
                               .c2 = a[1] * std::sqrt(3 / (4 * kPi)) / 2,
                               .c3 = a[2] * std::sqrt(5 / kPi) * 3 / 4,
                               .c4 = a[0] * std::sqrt(1 / (4 * kPi)),
                               .c5 = a[2] * std::sqrt(5 / kPi) / 4};
  }();
  return constants;
}

IrradianceMap irradianceMap(const sh::RgbCoefficients& light) {
  const sh::RgbCoefficients nine = sh::withBands(light, 3);
  const auto [c1, c2, c3, c4, c5] = irradianceConstants();
  IrradianceMap map;
  for (int c = 0; c < 3; ++c) {
    const auto f = nine.channel(c);
    const auto L = [&](int l, int m) { return double(f[sh::index(l, m)]); };
    Eigen::Matrix4d m;
    m << c1 * L(2, 2), c1 * L(2, -2), c1 * L(2, 1), c2 * L(1, 1),  //
        c1 * L(2, -2), -c1 * L(2, 2), c1 * L(2, -1), c2 * L(1, -1), c1 * L(2, 1), c1 * L(2, -1),
        c3 * L(2, 0), c2 * L(1, 0),  //
        c2 * L(1, 1), c2 * L(1, -1), c2 * L(1, 0), c4 * L(0, 0) - c5 * L(2, 0);
    map.matrix[c] = m.cast<float>();
  }
  return map;
}

Rgb IrradianceMap::evaluate(const Vec3& normal) const {
  const Eigen::Vector4f n(normal.x(), normal.y(), normal.z(), 1.0f);
  return Rgb(n.dot(matrix[0] * n), n.dot(matrix[1] * n), n.dot(matrix[2] * n));
}

Rgb irradiance(const sh::RgbCoefficients& light, const Vec3& normal) {
  const sh::RgbCoefficients nine = sh::withBands(light, 3);
  const auto [c1, c2, c3, c4, c5] = irradianceConstants();
  const double x = normal.x(), y = normal.y(), z = normal.z();
  Rgb e;
  for (int c = 0; c < 3; ++c) {
    const auto f = nine.channel(c);
    const auto L = [&](int l, int m) { return double(f[sh::index(l, m)]); };
    e[c] = float(c1 * L(2, 2) * (x * x - y * y) + c3 * L(2, 0) * z * z + c4 * L(0, 0) -
                 c5 * L(2, 0) +  //
                 2 * c1 * (L(2, -2) * x * y + L(2, 1) * x * z + L(2, -1) * y * z) +
                 2 * c2 * (L(1, 1) * x + L(1, -1) * y + L(1, 0) * z));
  }
  return e;
}

}  // namespace lambent::light
