#include "lambent/radiometry/spectra.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace lambent::radiometry {
namespace {

constexpr double kSolar[] = {
#include "lambent/radiometry/solar_astm_g173.inc"
};
constexpr double kSolarOfComparisons[] = {
#include "lambent/radiometry/solar_reference.inc"
};
constexpr double kPenndorf[] = {
#include "lambent/radiometry/rayleigh_penndorf.inc"
};
constexpr double kOzone[] = {
#include "lambent/radiometry/ozone.inc"
};
constexpr double kScotopic[] = {
#include "lambent/radiometry/cie1951_scotopic.inc"
};
constexpr double kColourMatching[][3] = {
#include "lambent/radiometry/cie1931.inc"
};

static_assert(std::size(kSolar) == 51 && std::size(kSolarOfComparisons) == 42);
static_assert(std::size(kPenndorf) == 51 && std::size(kOzone) == 51);
static_assert(std::size(kScotopic) == 81 && std::size(kColourMatching) == 95);

/// Where a wavelength lies in a table that begins at `first` and goes on in steps: between entry i
/// and the next, at the fraction t; clamped to the table.
struct PlaceInTable {
  size_t i;
  double t;
};
PlaceInTable placeInTable(double nm, double first, double step, size_t size) {
  const double u = std::clamp((nm - first) / step, 0.0, double(size - 1));
  const size_t i = std::min(size_t(u), size - 2);
  return {i, u - double(i)};
}

double linearInTable(std::span<const double> table, double nm, double first, double step) {
  const PlaceInTable at = placeInTable(nm, first, step, table.size());
  return (1 - at.t) * table[at.i] + at.t * table[at.i + 1];
}

}  // namespace

double solarIrradiance(double nm) {
  return linearInTable(kSolar, nm, 330, 10);
}

double solarIrradianceOfComparisons(double nm) {
  return linearInTable(kSolarOfComparisons, nm, 336.5, 11.75);
}

double penndorf15C(double nm) {
  return 1e-6 * (273.16 / 288.16) * linearInTable(kPenndorf, nm, 330, 10);
}

double ozoneCrossSection(double nm) {
  return 1e-27 * linearInTable(kOzone, nm, 335, 10);
}

Vec3d cie1931(double nm) {
  if (!(nm >= 360 && nm <= 830)) {
    return Vec3d::Zero();
  }
  const PlaceInTable at = placeInTable(nm, 360, 5, std::size(kColourMatching));
  return (1 - at.t) * Vec3d(kColourMatching[at.i]) + at.t * Vec3d(kColourMatching[at.i + 1]);
}

double scotopicEfficiency(double nm) {
  return nm >= 380 && nm <= 780 ? linearInTable(kScotopic, nm, 380, 5) : 0;
}

}  // namespace lambent::radiometry
