#include "lambent/meso/effective_albedo.h"

#include <cassert>
#include <cmath>
#include <vector>

#include "lambent/math/directions.h"

namespace lambent::meso {

Rgb effectiveAlbedo(const transfer::SimulatedRtt& rtt) {
  assert(rtt.values.size() >= rtt.planeSize());
  // View cells cover equal solid angles.
  std::vector<double> weights;
  double total = 0.0;
  for (int y = 0; y < rtt.views; ++y)
    for (int x = 0; x < rtt.views; ++x) {
      const Vec2 middle((x + 0.5f) / rtt.views, (y + 0.5f) / rtt.views);
      weights.push_back(math::hemisphereFromSquare(middle).z());
      total += weights.back();
    }
  Eigen::Array3d sum = Eigen::Array3d::Zero();
  for (std::size_t position = 0; position < rtt.positionCount(); ++position)
    for (std::size_t view = 0; view < rtt.viewCount(); ++view)
      for (int c = 0; c < 3; ++c)
        sum[c] += weights[view] * rtt.values[(position * rtt.viewCount() + view) * 3 + c];
  // Even light of radiance 1 has y_00's coefficient √4π and no other.
  sum *= std::sqrt(4.0 * kPi) / (total * static_cast<double>(rtt.positionCount()));
  return sum.cast<float>().max(0.0f);
}

}  // namespace lambent::meso
