#include "lambent/image/project.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>

#include "lambent/image/test_pictures.h"
#include "lambent/sh/basis.h"
#include "lambent/sh/zonal.h"
#include "lambent/work/thread_limit.h"

namespace lambent::image {
namespace {

const MapShape kProjectedShapes[] = {{MapKind::LatLong, 256, 128},   {MapKind::LatLong, 251, 127},
                                     {MapKind::Cube, 64, 384},       {MapKind::Cube, 256, 192},
                                     {MapKind::Cube, 192, 256},      {MapKind::Angular, 256, 256},
                                     {MapKind::MirrorBall, 256, 256}};

TEST(Project, ConstantIsExact) {
  for (const MapShape& shape : kProjectedShapes) {
    const sh::RgbCoefficients f =
        project(paint(shape, [](const Vec3d&) { return Rgb(1, 2, 3); }), shape.kind, 5);
    ASSERT_EQ(f.bands, 5);
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(f.channel(c)[0], (c + 1) * std::sqrt(4 * kPi), 1e-5) << int(shape.kind);
      for (int i = 1; i < 25; ++i)
        EXPECT_NEAR(f.channel(c)[i], 0.0, shape.kind == MapKind::MirrorBall ? 3e-2 : 2e-3);
    }
  }
}

TEST(Project, EveryBasisFunctionComesBack) {
  for (const MapShape& shape : kProjectedShapes) {
    for (int i = 0; i < 25; ++i) {
      std::vector<double> basis(25);
      const Image image = paint(shape, [&](const Vec3d& d) {
        sh::evaluate(5, d, basis);
        const auto value = static_cast<float>(basis[i]);
        return Rgb(value, 2 * value, -value);
      });
      const sh::RgbCoefficients f = project(image, shape.kind, 5);
      // The ball squeezes all that is behind it into its rim.
      const double tolerance = shape.kind == MapKind::MirrorBall ? 1e-2 : 1e-3;
      for (int j = 0; j < 25; ++j) {
        EXPECT_NEAR(f.channel(0)[j], i == j ? 1.0 : 0.0, tolerance) << int(shape.kind) << " " << i;
        EXPECT_NEAR(f.channel(1)[j], 2.0 * f.channel(0)[j], 1e-5);
        EXPECT_NEAR(f.channel(2)[j], -1.0 * f.channel(0)[j], 1e-5);
      }
    }
  }
}

TEST(Project, RowsBySeriesEqualPixelByPixel) {
  const Image image = noise(50, 27, 3.0f);
  const MapShape shape{MapKind::LatLong, 50, 27};
  const std::vector<double> angles = solidAngles(shape);
  for (const int bands : {1, 2, 5, 10, 16}) {
    const int n = bands * bands;
    std::vector<double> expected(3 * n), basis(n);
    for (size_t i = 0; i < image.pixels.size(); ++i) {
      const double x = static_cast<double>(i % 50) + 0.5, y = static_cast<double>(i / 50) + 0.5;
      sh::evaluate(bands, *directionOf(shape, {x, y}), basis);
      for (int c = 0; c < 3; ++c) {
        for (int k = 0; k < n; ++k)
          expected[c * n + k] += angles[i] * image.pixels[i][c] * basis[k];
      }
    }
    const sh::RgbCoefficients f = project(image, MapKind::LatLong, bands);
    for (int k = 0; k < 3 * n; ++k)
      EXPECT_NEAR(f.values[k], expected[k], 3e-6) << bands << " " << k;
  }
}

TEST(Project, DiscOfKnownSize) {
  // A cap of 30° about a tilted axis, against its closed form.
  const Vec3d axis = Vec3d(1, 2, -0.5).normalized();
  const double halfAngle = kPi / 6;
  std::vector<double> expected(25);
  sh::turnTo(sh::cap(5, halfAngle), axis, expected);
  for (const MapShape& shape :
       {MapShape{MapKind::LatLong, 1024, 512}, MapShape{MapKind::Cube, 256, 1536},
        MapShape{MapKind::Angular, 800, 800}}) {
    const sh::RgbCoefficients f =
        project(paint(shape,
                      [&](const Vec3d& d) {
                        return Rgb(Rgb::Constant(d.dot(axis) > std::cos(halfAngle) ? 1.0f : 0.0f));
                      }),
                shape.kind, 5);
    for (int i = 0; i < 25; ++i) EXPECT_NEAR(f.channel(1)[i], expected[i], 1e-3);
  }
}

TEST(Project, SameBytesWhateverTheThreads) {
  for (const MapShape& shape : kProjectedShapes) {
    const Image image = noise(shape.width, shape.height);
    std::vector<std::vector<float>> results;
    for (const size_t threads : {1, 2, 5}) {
      const work::ThreadLimit limit(threads);
      results.push_back(project(image, shape.kind, 5).values);
    }
    EXPECT_EQ(results[0], results[1]);
    EXPECT_EQ(results[0], results[2]);
  }
}

// sloan2002precomputed §6.2: signals of 6 bands and unit power, sampled at the pixel centres of a
// cube map and projected with weights w, come back as G·f, G = Σ w y yᵀ: the squared error is
// |(G − 1) f|², on average over f ‖G − 1‖²/36 (Frobenius), at worst the largest eigenvalue's
// square.
struct SquaredError {
  double average, worst;
};

SquaredError cubeError(int n, const std::vector<double>& weights) {
  constexpr int kCount = 36;
  const MapShape shape{MapKind::Cube, n, 6 * n};
  Eigen::MatrixXd difference = -Eigen::MatrixXd::Identity(kCount, kCount);
  Eigen::VectorXd basis(kCount);
  for (int y = 0; y < 6 * n; ++y) {
    for (int x = 0; x < n; ++x) {
      sh::evaluate(6, *directionOf(shape, {x + 0.5, y + 0.5}), {basis.data(), kCount});
      difference += weights[size_t(y) * n + x] * basis * basis.transpose();
    }
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(difference);
  const double largest = solver.eigenvalues().cwiseAbs().maxCoeff();
  return {difference.squaredNorm() / kCount, largest * largest};
}

/// The paper's weights: the differential solid angle at each pixel's centre.
std::vector<double> differentialAngles(int n) {
  std::vector<double> weights;
  for (int y = 0; y < 6 * n; ++y) {
    for (int x = 0; x < n; ++x) {
      const double a = 2 * (x + 0.5) / n - 1, b = 2 * (y % n + 0.5) / n - 1;
      weights.push_back(4.0 / (n * n) * std::pow(1 + a * a + b * b, -1.5));
    }
  }
  return weights;
}

TEST(Project, CubeMapErrorsOfTheLiterature) {
  const SquaredError four = cubeError(4, differentialAngles(4));
  EXPECT_NEAR(four.average, 0.00265, 0.000005);
  EXPECT_NEAR(four.worst, 0.0121, 0.00005);
  const SquaredError eight = cubeError(8, differentialAngles(8));
  EXPECT_NEAR(eight.average, 0.000032, 0.0000005);
  EXPECT_NEAR(eight.worst, 0.00016, 0.000005);
  // With the exact solid angles that project() uses, the worst case of small maps is better.
  const SquaredError exact = cubeError(4, solidAngles({MapKind::Cube, 4, 24}));
  EXPECT_LT(exact.average, four.average);
  EXPECT_LT(exact.worst, 0.0095);
}

}  // namespace
}  // namespace lambent::image
