#include "lambent/sky/scattering.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstdio>

#include "lambent/math/types.h"
#include "lambent/sky/test_angles.h"

namespace lambent::sky {
namespace {

using test::kDegree;

struct PublishedRow {
  double sun, view, azimuth;
  double radiance[4];
};
const PublishedRow kPublished[] = {{60, 0, 0, {0.035825, 0.017673, 0.0085881, 0.0062806}},
                                   {60, 30, 0, {0.073335, 0.047008, 0.029601, 0.022941}},
                                   {60, 30, 180, {0.033419, 0.015335, 0.0067103, 0.0048445}},
                                   {60, 60, 0, {0.33826, 0.29751, 0.22687, 0.1853}},
                                   {60, 60, 90, {0.056374, 0.02797, 0.012917, 0.0096486}},
                                   {60, 60, 180, {0.061081, 0.029453, 0.012966, 0.0092729}},
                                   {60, 80, 0, {0.34851, 0.31074, 0.23173, 0.1908}},
                                   {60, 80, 90, {0.093749, 0.056588, 0.028038, 0.023084}},
                                   {60, 80, 180, {0.12145, 0.073292, 0.035872, 0.027313}},
                                   {94, 0, 0, {0.000282, 0.0002508, 0.00018128, 0.00013308}},
                                   {94, 30, 0, {0.00042042, 0.00037789, 0.00027556, 0.00020054}},
                                   {94, 30, 180, {0.000332, 0.00030674, 0.00023197, 0.00017531}},
                                   {94, 60, 0, {0.0010159, 0.0009977, 0.00074374, 0.00055536}},
                                   {94, 60, 90, {0.00047466, 0.00044973, 0.00034181, 0.00025589}},
                                   {94, 60, 180, {0.00042561, 0.00046655, 0.00037539, 0.00029539}},
                                   {94, 80, 0, {0.0020823, 0.0029166, 0.0024903, 0.001949}},
                                   {94, 80, 90, {0.00057846, 0.00075058, 0.00065378, 0.00052858}},
                                   {94, 80, 180, {0.000273, 0.000255, 0.000203, 0.000168}}};

RayInAir rayOf(const PublishedRow& row, double altitude = 0) {
  const double sun = row.sun * kDegree, view = row.view * kDegree;
  return {altitude, std::cos(view), sun,
          std::cos(view) * std::cos(sun) +
              std::sin(view) * std::sin(sun) * std::cos(row.azimuth * kDegree)};
}

void report(const Resolution& resolution) {
  const double nm[] = {450, 550, 650, 720};
  const auto began = std::chrono::steady_clock::now();
  const auto solved = Scattering::solve(mediumOf(*preset("reference"), nm), resolution);
  std::printf("solved in %.2f s, %d orders\n",
              std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count(),
              solved->orders());
  double sum[2] = {};
  for (const PublishedRow& row : kPublished) {
    const std::vector<double> ours = solved->radiance(rayOf(row));
    std::printf("%3.0f %3.0f %3.0f ", row.sun, row.view, row.azimuth);
    for (int i = 0; i < 4; ++i) {
      const double error = ours[i] * solved->medium().solarIrradiance[i] / row.radiance[i] - 1;
      std::printf(" %+6.2f%%", 100 * error);
      sum[row.sun > 90] += error * error;
    }
    std::printf("\n");
  }
  std::printf("rms %.2f%% %.2f%%\n", 100 * std::sqrt(sum[0] / 36), 100 * std::sqrt(sum[1] / 36));
  RayInAir zenith{0, 1, 60 * kDegree, 0.5};
  const AirLight light = solved->along(zenith);
  std::printf("first order %.6f %.6f\n",
              (light.air[0] * media::evaluate(media::RayleighPhase{}, 0.5) +
               light.aerosol[0] * media::evaluate(solved->medium().aerosolPhase, 0.5)) *
                  solved->medium().solarIrradiance[0],
              (light.air[3] * media::evaluate(media::RayleighPhase{}, 0.5) +
               light.aerosol[3] * media::evaluate(solved->medium().aerosolPhase, 0.5)) *
                  solved->medium().solarIrradiance[3]);
}

TEST(Scattering, Report) {
  report(Resolution::fast());
  if (std::getenv("EXACT")) report(Resolution::exact());
}

}  // namespace
}  // namespace lambent::sky
