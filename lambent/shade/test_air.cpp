#include "lambent/shade/test_air.h"

#include <vector>

#include "lambent/sky/aerial_table.h"

namespace lambent::shade::test {

Air clearAir(double metresPerUnit) {
  static const std::shared_ptr<const sky::AirTable> table = [] {
    std::vector<double> nm;
    for (int i = 0; i < 16; ++i) nm.push_back(380 + 24 * i);
    sky::Resolution r;
    r.orders = 2;
    r.altitudes = 6;
    r.upward = r.downward = r.around = 4;
    r.zeniths = r.azimuths = 7;
    r.sunFrom = 1.1;
    r.sunTo = 1.4;
    const sky::Atmosphere atmosphere = *sky::preset("clear");
    const auto solved = sky::Scattering::solve(sky::mediumOf(atmosphere, nm), r);
    return std::make_shared<const sky::AirTable>(
        *solved, atmosphere,
        sky::ViewerInAir{.altitude = 50, .sunElevation = 18 * kPi / 180, .sunDistance = 1});
  }();
  return {table, Mat3d::Identity(), metresPerUnit};
}

}  // namespace lambent::shade::test
