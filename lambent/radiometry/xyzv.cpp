// From spectra to what eyes make of them.
#include <cassert>
#include <cmath>
#include <limits>

#include <Eigen/LU>

#include "lambent/radiometry/spectra.h"

namespace lambent::radiometry {
namespace {

constexpr double kStepOfFunctions = 5;  // nm, between entries of the tables of both observers

Eigen::Vector4d efficacies(double nm) {
  Eigen::Vector4d e;
  e << kPhotopicEfficacy * cie1931(nm), kScotopicEfficacy * scotopicEfficiency(nm);
  return e;
}

}  // namespace

XyzvWeights xyzvWeights(std::span<const double> nm) {
  XyzvWeights weights = XyzvWeights::Zero(4, Eigen::Index(nm.size()));
  for (size_t i = 0; i + 1 < nm.size(); ++i) {
    assert(nm[i] < nm[i + 1]);
    // Between entries of the tables the integrand is a quadratic, which two Gauss points integrate
    // exactly; they lie inside, where the ends of the tables do not matter.
    for (double low = nm[i]; low < nm[i + 1];) {
      const double next = (std::floor(low / kStepOfFunctions) + 1) * kStepOfFunctions;
      const double high = std::min(next, nm[i + 1]);
      for (const double node : {-1 / std::sqrt(3.0), 1 / std::sqrt(3.0)}) {
        const double at = (low + high) / 2 + node * (high - low) / 2;
        const double t = (at - nm[i]) / (nm[i + 1] - nm[i]);
        const Eigen::Vector4d part = (high - low) / 2 * efficacies(at);
        weights.col(Eigen::Index(i)) += (1 - t) * part;
        weights.col(Eigen::Index(i) + 1) += t * part;
      }
      low = high;
    }
  }
  return weights;
}

Xyzv xyzvOf(std::span<const double> nm, std::span<const double> spectralRadiance) {
  assert(nm.size() == spectralRadiance.size());
  return xyzvWeights(nm) *
         Eigen::Map<const Eigen::VectorXd>(spectralRadiance.data(), Eigen::Index(nm.size()));
}

Eigen::Array3d linearRgbOf(const Xyzv& xyzv) {
  // Rec. 709 primaries and D65, x, y = .3127, .3290 (ITU-R BT.709): the inverse of the matrix whose
  // second row is the luminance of the primaries. It is computed from those chromaticities, with
  // the luminance row rounded to four digits as the standard rounds it.
  static const Mat3d rgbFromXyz = [] {
    const auto column = [](double x, double y) { return Vec3d(x / y, 1, (1 - x - y) / y); };
    Mat3d xyzFromRgb;
    xyzFromRgb << column(.64, .33), column(.30, .60), column(.15, .06);
    xyzFromRgb *= Vec3d(.2126, .7152, .0722).asDiagonal();
    return Mat3d(xyzFromRgb.inverse());
  }();
  return (rgbFromXyz * xyzv.head<3>().matrix()).array() / kPhotopicEfficacy;
}

double magnitudesPerSquareArcsecond(double luminance) {
  return luminance > 0 ? 12.58 - 2.5 * std::log10(luminance)
                       : std::numeric_limits<double>::infinity();
}

}  // namespace lambent::radiometry
