// 1. Spherical harmonics: a function on the sphere as a few numbers.
//
// n bands have n² coefficients. A function that varies slowly is caught by few of them; turning
// it, adding to it and multiplying by it are then small sums.
#include <lambent/sh/basis.h>
#include <lambent/sh/projection.h>
#include <lambent/sh/rotation.h>
#include <lambent/sh/zonal.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstdio>
#include <vector>

using lambent::Mat3;
using lambent::Vec3;
using lambent::Vec3d;
namespace sh = lambent::sh;

int main() {
  constexpr int kBands = 5;

  // A soft light from the side of +x: project it. `project` integrates f · y_i over the sphere.
  const auto light = [](const Vec3d& s) { return std::exp(2.0 * s.x() - 2.0); };
  const std::vector<double> projected = sh::project(kBands, light);
  std::vector<float> f(projected.begin(), projected.end());

  std::printf("direction     exact   from %d numbers\n", sh::coefficientCount(kBands));
  double worst = 0.0;
  for (const Vec3& s : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0.6f, 0, 0.8f), Vec3(-1, 0, 0)}) {
    const double exact = light(s.cast<double>()), ours = sh::reconstruct(f, s);
    std::printf("%4.1f %4.1f %4.1f  %6.4f  %6.4f\n", s.x(), s.y(), s.z(), exact, ours);
    worst = std::max(worst, std::abs(exact - ours));
  }

  // Turn it by 90 degrees about +y: what stood at +x now stands at −z. No sample is taken again.
  const Mat3 quarter = Eigen::AngleAxisf(float(lambent::kPi / 2), Vec3::UnitY()).matrix();
  std::vector<float> turned(f.size());
  sh::rotate(kBands, quarter, f, turned);
  const double moved = sh::reconstruct(turned, Vec3(0, 0, -1));
  std::printf("after a quarter turn, at -z: %.4f\n", moved);

  // Blur it by the clamped cosine: this is irradiance, the light that a surface with that normal
  // gathers. It is a product with one number per band.
  sh::convolve(sh::clampedCosine(kBands), f);
  std::printf("irradiance on a surface that faces +x: %.4f, that faces away: %.4f\n",
              sh::reconstruct(f, Vec3(1, 0, 0)), sh::reconstruct(f, Vec3(-1, 0, 0)));

  const bool asPromised = worst < 0.02 && std::abs(moved - 1.0) < 0.02;
  return asPromised ? 0 : 1;
}
