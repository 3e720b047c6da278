#include <fmt/format.h>

#include <cmath>

#include "figures/capture.h"
#include "lambent/capture/projection_error.h"
#include "lambent/math/sequences.h"
#include "lambent/sh/zonal.h"

namespace lambent::figures {

namespace {

using capture::CubeSize;

std::string percents(const capture::ProjectionError& error) {
  return fmt::format("{:.2g}% / {:.2g}%", 100 * error.average, 100 * error.worst);
}

/// √(Σ squared error / Σ square) of a disc's captured coefficients, over many places of the disc:
/// its root mean square and its largest.
struct DiscError {
  double mean = 0, largest = 0;
};

DiscError discError(const CubeSize& shape, double halfAngleDegrees) {
  const int bands = 5, count = sh::coefficientCount(bands), places = 200;
  const double halfAngle = halfAngleDegrees * kPi / 180, cosine = std::cos(halfAngle);
  const sh::ZonalMoments moments = sh::cap(bands, halfAngle);
  DiscError result;
  for (const Vec3& place : math::sphericalFibonacci(places)) {
    const Vec3d axis = place.cast<double>().normalized();
    capture::CubePicture picture{shape,
                                 std::vector<Rgb>(std::size_t(6 * shape.drawn() * shape.drawn()))};
    capture::forAllSubTexels(
        shape, [&](std::size_t, std::size_t at, const Vec3d& direction, double) {
          picture.texels[at] = Rgb::Constant(direction.dot(axis) > cosine ? 1.0f : 0.0f);
        });
    const sh::RgbCoefficients captured = capture::project(picture, bands);
    std::vector<double> exact(std::size_t(count), 0.0);
    sh::turnTo(moments, axis, std::span<double>(exact));
    double error = 0, power = 0;
    for (std::size_t i = 0; i < exact.size(); ++i) {
      error += std::pow(double(captured.channel(0)[i]) - exact[i], 2);
      power += exact[i] * exact[i];
    }
    result.mean += error / power / places;
    result.largest = std::max(result.largest, std::sqrt(error / power));
  }
  result.mean = std::sqrt(result.mean);
  return result;
}

}  // namespace

void captureProjection(const Studio&) {
  const int bands = 6;
  fmt::print(
      "squared error of projecting unit-power functions of 6 bands, average / worst\n"
      "| cube | samples, differential ds | paper | samples, exact ds | as captured (2×2) "
      "| bilinear, projected | bilinear, whole | paper, bilinear |\n"
      "|---|---|---|---|---|---|---|---|\n");
  struct Row {
    int size;
    const char *points, *bilinear;
  };
  for (const Row& row : {Row{4, "0.3% / 1%", ""}, Row{8, "0.003% / 0.02%", "0.7% / 2%"},
                         Row{16, "", "0.2% / 0.5%"}, Row{32, "", "0.05% / 0.1%"}}) {
    const capture::BilinearErrors bilinear = capture::bilinearErrors(row.size, bands);
    fmt::print("| 6×{0}×{0} | {1} | {2} | {3} | {4} | {5} | {6} | {7} |\n", row.size,
               percents(capture::projectionError({row.size, 1}, bands,
                                                 capture::SolidAngles::Differential)),
               row.points, percents(capture::projectionError({row.size, 1}, bands)),
               percents(capture::projectionError({row.size, 2}, bands)),
               percents(bilinear.projected), percents(bilinear.reconstructed), row.bilinear);
  }
  fmt::print(
      "\nrelative error of the 25 coefficients of a disc, rms / largest over 200 directions\n"
      "| cube | 40° disc, 1×1 | 40° disc, 2×2 | 10° disc, 1×1 | 10° disc, 2×2 |\n"
      "|---|---|---|---|---|\n");
  for (const int size : {4, 8, 16, 32}) {
    fmt::print("| 6×{0}×{0} |", size);
    for (const double halfAngle : {20.0, 5.0})
      for (const int supersampling : {1, 2}) {
        const DiscError error = discError({size, supersampling}, halfAngle);
        fmt::print(" {:.2g}% / {:.2g}% |", 100 * error.mean, 100 * error.largest);
      }
    fmt::print("\n");
  }
}

}  // namespace lambent::figures
