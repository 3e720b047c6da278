// This work is based on:
// - shoemake1992uniform: a unit quaternion, uniform on S³, from three uniform numbers.
#include "lambent/math/random.h"

#include <cmath>

namespace lambent::math {

Mat3d randomRotationDouble(std::uint64_t seed) {
  Random random(seed, 0x726f746174696f6eu);  // a stream of its own, apart from the samples'
  const double u = random.uniformDouble();
  const double a = 2 * kPi * random.uniformDouble();
  const double b = 2 * kPi * random.uniformDouble();
  const double x = std::sqrt(1 - u) * std::sin(a), y = std::sqrt(1 - u) * std::cos(a);
  const double z = std::sqrt(u) * std::sin(b), w = std::sqrt(u) * std::cos(b);
  Mat3d q;
  q << 1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y),  //
      2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x),   //
      2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y);
  return q;
}

Mat3 randomRotation(std::uint64_t seed) {
  return randomRotationDouble(seed).cast<float>();
}

}  // namespace lambent::math
