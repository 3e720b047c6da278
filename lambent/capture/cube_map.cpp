// This work is based on:
// - sloan2002precomputed: §6.2, B_j^m(s) = y_j^m(s) ds(s) over the cube map, averaged over
//   sub-texels as the pictures are.
//
// Where we deviate: ds(s) is the exact solid angle of a sub-texel unless its differential is asked
// for. The errors of both are in docs/reproduction.md, "Captured light".
#include "lambent/capture/cube_map.h"

#include <cassert>
#include <cmath>

#include "lambent/sh/basis.h"

namespace lambent::capture {

const std::array<CubeFace, 6>& cubeFaces() {
  static const std::array<CubeFace, 6> faces{{
      {{1, 0, 0}, {0, 0, -1}, {0, -1, 0}},
      {{-1, 0, 0}, {0, 0, 1}, {0, -1, 0}},
      {{0, 1, 0}, {1, 0, 0}, {0, 0, 1}},
      {{0, -1, 0}, {1, 0, 0}, {0, 0, -1}},
      {{0, 0, 1}, {1, 0, 0}, {0, -1, 0}},
      {{0, 0, -1}, {-1, 0, 0}, {0, -1, 0}},
  }};
  return faces;
}

Vec3d cubeDirection(int face, double s, double t) {
  const CubeFace& f = cubeFaces()[std::size_t(face)];
  return (f.forward + (2 * s - 1) * f.right + (2 * t - 1) * f.up).normalized();
}

// The part of a face between its middle and (x, y) subtends atan(xy / √(x² + y² + 1)).
double cubeSolidAngle(double s0, double s1, double t0, double t1) {
  const auto corner = [](double s, double t) {
    const double x = 2 * s - 1, y = 2 * t - 1;
    return std::atan2(x * y, std::sqrt(x * x + y * y + 1));
  };
  return corner(s1, t1) - corner(s0, t1) - corner(s1, t0) + corner(s0, t0);
}

std::vector<double> cubeWeights(const CubeSize& shape, int bands, SolidAngles angles) {
  assert(shape.size > 0 && shape.supersampling > 0);
  const auto count = std::size_t(sh::coefficientCount(bands));
  std::vector<double> weights(std::size_t(shape.texels()) * count), y(count);
  const double area = 4.0 / (double(shape.drawn()) * shape.drawn());  // on the cube of side 2
  forAllSubTexels(shape, [&](std::size_t texel, std::size_t, const Vec3d& direction, double exact) {
    sh::evaluate(bands, direction, std::span<double>(y));
    // The largest component of a direction is 1 / √(1 + x² + y²).
    const double angle =
        angles == SolidAngles::Exact ? exact : area * std::pow(direction.cwiseAbs().maxCoeff(), 3);
    for (std::size_t i = 0; i < count; ++i) weights[texel * count + i] += angle * y[i];
  });
  return weights;
}

sh::RgbCoefficients project(const CubePicture& picture, std::span<const double> weights) {
  const CubeSize& shape = picture.shape;
  const int n = shape.size, f = shape.supersampling, drawn = shape.drawn();
  assert(picture.texels.size() == std::size_t(6 * drawn * drawn));
  const std::size_t count = weights.size() / std::size_t(shape.texels());
  std::vector<Eigen::Array3d> sums(count, Eigen::Array3d::Zero());
  const double* texelWeights = weights.data();
  for (int row = 0; row < 6 * n; ++row)  // of all faces
    for (int i = 0; i < n; ++i, texelWeights += count) {
      Eigen::Array3d mean = Eigen::Array3d::Zero();
      for (int k = 0; k < f * f; ++k)
        mean +=
            picture.texels[std::size_t((row * f + k / f) * drawn + i * f + k % f)].cast<double>();
      mean /= f * f;
      for (std::size_t c = 0; c < count; ++c) sums[c] += texelWeights[c] * mean;
    }
  sh::RgbCoefficients light(sh::bandsOf(count));
  for (std::size_t i = 0; i < count; ++i)
    for (int c = 0; c < 3; ++c) light.channel(c)[i] = float(sums[i][c]);
  return light;
}

sh::RgbCoefficients project(const CubePicture& picture, int bands) {
  return project(picture, cubeWeights(picture.shape, bands));
}

}  // namespace lambent::capture
