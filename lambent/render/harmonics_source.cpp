#include "lambent/render/harmonics_source.h"

#include <cmath>

#include <fmt/format.h>

#include "lambent/math/types.h"
#include "lambent/sh/coefficients.h"

namespace lambent::render {

// y_lm = √2 P̄_l^|m|(z) · {cos, sin}(|m| φ) sin^|m| θ, with the normalised Legendre functions by the
// recurrence in l, and the trigonometric factor as a polynomial in x and y by the recurrence in m.
std::string harmonicsSource(int bands) {
  std::string text = fmt::format(
      "const int kCoefficients = {};\n"
      "void harmonics(vec3 d, out float y[kCoefficients]) {{\n"
      "  float c0 = 1.0, s0 = 0.0;\n",
      sh::coefficientCount(bands));
  double sectoral = std::sqrt(1.0 / (4.0 * kPi));  // P̄_m^m without its sin^m θ
  for (int m = 0; m < bands; ++m) {
    for (int l = m; l < bands; ++l) {
      const std::string name = fmt::format("p{}_{}", l, m);
      if (l == m) {
        text += fmt::format("  const float {} = {:.9f};\n", name, sectoral);
      } else {
        const double ll = double(l) * l, mm = double(m) * m, before = double(l - 1) * (l - 1);
        const double a = std::sqrt((4.0 * ll - 1.0) / (ll - mm));
        const double b = l > m + 1 ? std::sqrt((before - mm) / (4.0 * before - 1.0)) : 0.0;
        text += fmt::format("  float {} = {:.9f} * d.z * p{}_{}", name, a, l - 1, m);
        text += l > m + 1 ? fmt::format(" - {:.9f} * p{}_{};\n", a * b, l - 2, m) : ";\n";
      }
      if (m == 0) {
        text += fmt::format("  y[{}] = {};\n", sh::index(l, 0), name);
      } else {
        text += fmt::format("  y[{}] = 1.414213562 * {} * c{};\n", sh::index(l, m), name, m);
        text += fmt::format("  y[{}] = 1.414213562 * {} * s{};\n", sh::index(l, -m), name, m);
      }
    }
    text += fmt::format("  float c{0} = d.x * c{1} - d.y * s{1}, s{0} = d.x * s{1} + d.y * c{1};\n",
                        m + 1, m);
    sectoral *= std::sqrt((2.0 * m + 3.0) / (2.0 * m + 2.0));
  }
  return text + "}\n";
}

}  // namespace lambent::render
