// Lengths are smooth in √altitude and in the root of the angle above the horizon, where they change
// most; their logarithm is interpolated.
#include "lambent/sky/sun_lengths.h"

#include <algorithm>
#include <cmath>

#include "lambent/math/types.h"
#include "lambent/media/optical_length.h"
#include "lambent/sky/interpolation.h"
#include "lambent/work/parallel_for.h"

namespace lambent::sky {
namespace {
constexpr int kLengthAltitudes = 80, kLengthAngles = 112;
}

double SunLengths::horizonAngle(double altitude) const {
  return std::acos(shell_.horizonCosine(altitude));
}

SunLengths::SunLengths(const Medium& medium)
    : shell_(medium.shell), logLengths_(std::size_t(kLengthAltitudes) * kLengthAngles * 4) {
  work::parallelFor(kLengthAltitudes, [&](int i) {
    const double a = double(i) / (kLengthAltitudes - 1);
    const double altitude = shell_.height * a * a, horizon = horizonAngle(altitude);
    for (int j = 0; j < kLengthAngles; ++j) {
      const double q = double(j) / (kLengthAngles - 1);
      const double cosine = std::cos(horizon * (1 - q * q));
      for (int part = 0; part < kParts; ++part)
        logLengths_[(std::size_t(i) * kLengthAngles + j) * 4 + part] = float(
            std::log1p(media::opticalLengthToTop(shell_, medium.profiles[part], altitude, cosine)));
    }
  });
}

void SunLengths::at(double altitude, double zenithAngle, float (&lengths)[kParts]) const {
  const double horizon = horizonAngle(altitude);
  const double q = std::sqrt(std::clamp((horizon - zenithAngle) / horizon, 0.0, 1.0));
  const Taps rows =
      cubicTaps(std::sqrt(std::max(0.0, altitude / shell_.height)) * (kLengthAltitudes - 1),
                kLengthAltitudes);
  const Taps columns = cubicTaps(q * (kLengthAngles - 1), kLengthAngles);
  float sum[4] = {};
  for (int i = 0; i < 4; ++i) {
    const float* row =
        &logLengths_[(std::size_t(rows.first + i) * kLengthAngles + columns.first) * 4];
    for (int j = 0; j < 4; ++j) {
      const float w = float(rows.weight[i] * columns.weight[j]);
      for (int part = 0; part < 4; ++part) sum[part] += w * row[4 * j + part];
    }
  }
  for (int part = 0; part < kParts; ++part) lengths[part] = std::max(0.0f, std::expm1(sum[part]));
}

}  // namespace lambent::sky
