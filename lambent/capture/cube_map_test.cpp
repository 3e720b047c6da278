#include "lambent/capture/cube_map.h"

#include <cmath>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "lambent/capture/projection_error.h"
#include "lambent/sh/basis.h"
#include "lambent/sh/zonal.h"

namespace lambent::capture {
namespace {

// OpenGL 4.5 core profile, Table 8.19, row by row: (sc, tc, ma) of a direction.
TEST(CubeMap, FacesAreOpenGls) {
  const Vec3d direction(0.3, -0.2, 0.25);
  const double x = direction.x(), y = direction.y(), z = direction.z();
  const double rows[6][3] = {{-z, -y, x}, {z, -y, -x}, {x, z, y},
                             {x, -z, -y}, {x, -y, z},  {-x, -y, -z}};
  for (int face = 0; face < 6; ++face) {
    const CubeFace& f = cubeFaces()[face];
    EXPECT_DOUBLE_EQ(f.right.dot(direction), rows[face][0]) << face;
    EXPECT_DOUBLE_EQ(f.up.dot(direction), rows[face][1]) << face;
    EXPECT_DOUBLE_EQ(f.forward.dot(direction), rows[face][2]) << face;
    EXPECT_EQ(f.right.cross(f.up), -f.forward) << face;
  }
  EXPECT_TRUE(cubeDirection(0, 0.5, 0.5).isApprox(Vec3d(1, 0, 0)));
  EXPECT_TRUE(cubeDirection(3, 1, 0.5).isApprox(Vec3d(1, -1, 0).normalized()));
}

TEST(CubeMap, SolidAnglesFillTheSphere) {
  EXPECT_NEAR(cubeSolidAngle(0, 1, 0, 1), 4 * kPi / 6, 1e-12);
  for (const CubeSize& shape : {CubeSize{1, 1}, CubeSize{4, 1}, CubeSize{5, 3}, CubeSize{16, 2}}) {
    double sum = 0;
    forAllSubTexels(shape, [&](std::size_t, std::size_t, const Vec3d&, double a) { sum += a; });
    EXPECT_NEAR(sum, 4 * kPi, 1e-10);
    const std::vector<double> weights = cubeWeights(shape, 1);
    double total = 0;
    for (const double w : weights) total += w;
    EXPECT_NEAR(total, std::sqrt(4 * kPi), 1e-10);
  }
}

TEST(CubeMap, UniformLightIsCapturedExactly) {
  CubePicture picture{{8, 2}, std::vector<Rgb>(6 * 16 * 16, Rgb(1, 2, 3))};
  const sh::RgbCoefficients light = project(picture, 5);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(light.channel(c)[0], (c + 1) * std::sqrt(4 * kPi), 1e-5);
  for (int i = 1; i < 9; ++i) EXPECT_NEAR(light.channel(1)[i], 0, 2e-2);
}

// The paper's first analysis: about 0.3% and 1% at 6×4×4, 0.003% and 0.02% at 6×8×8.
TEST(ProjectionError, OfBandlimitedFunctions) {
  struct Case {
    int size;
    double average, worst;  // percent
  };
  for (const Case& c : {Case{4, 0.265, 1.21}, Case{8, 0.0032, 0.016}, Case{16, 1.93e-4, 9.4e-4},
                        Case{32, 1.19e-5, 5.8e-5}}) {
    const ProjectionError error = projectionError({c.size, 1}, 6, SolidAngles::Differential);
    EXPECT_NEAR(100 * error.average, c.average, 0.02 * c.average) << c.size;
    EXPECT_NEAR(100 * error.worst, c.worst, 0.02 * c.worst) << c.size;
  }
  const ProjectionError exact = projectionError({4, 1}, 6);
  EXPECT_LT(100 * exact.average, 0.27);
  EXPECT_LT(100 * exact.worst, 0.95);
}

// A matrix of errors against errors of actual functions, each captured and compared.
TEST(ProjectionError, IsThatOfCapturedFunctions) {
  const CubeSize shape{4, 2};
  const int bands = 3, count = 9;
  double sum = 0;
  for (int i = 0; i < count; ++i) {
    CubePicture picture{shape, std::vector<Rgb>(6 * 64)};
    std::vector<double> y(count);
    forAllSubTexels(shape, [&](std::size_t, std::size_t at, const Vec3d& direction, double) {
      sh::evaluate(bands, direction, std::span<double>(y));
      picture.texels[at] = Rgb::Constant(float(y[i]));
    });
    const sh::RgbCoefficients captured = project(picture, bands);
    for (int j = 0; j < count; ++j) sum += std::pow(double(captured.channel(0)[j]) - (i == j), 2);
  }
  EXPECT_NEAR(projectionError(shape, bands).average, sum / count, 1e-6);
}

// The paper's second analysis, as far as it says what it did: errors fall from about a
// percent at 6×8×8, most of it in what lies between the samples.
TEST(ProjectionError, OfBilinearReconstruction) {
  const BilinearErrors at8 = bilinearErrors(8, 6), at16 = bilinearErrors(16, 6);
  EXPECT_NEAR(100 * at8.reconstructed.average, 0.656, 0.01);
  EXPECT_NEAR(100 * at8.reconstructed.worst, 1.565, 0.02);
  EXPECT_NEAR(100 * at8.projected.average, 0.414, 0.01);
  EXPECT_NEAR(100 * at8.projected.worst, 0.986, 0.02);
  EXPECT_LT(at16.reconstructed.average, at8.reconstructed.average / 8);
  EXPECT_LT(at16.projected.average, at8.projected.average / 12);
}

/// The captured coefficients of a disc against its closed form: √(Σ squared error / Σ square),
/// root mean square over many places of the disc.
double discError(const CubeSize& shape, double halfAngle) {
  const int bands = 5, count = 25, places = 12;
  const sh::ZonalMoments moments = sh::cap(bands, halfAngle);
  double error = 0, power = 0;
  for (int k = 0; k < places; ++k) {
    const double z = (2 * k + 1.0) / places - 1, phi = 2.4 * k;
    const Vec3d axis(std::sqrt(1 - z * z) * std::cos(phi), z, std::sqrt(1 - z * z) * std::sin(phi));
    CubePicture picture{shape, std::vector<Rgb>(std::size_t(6 * shape.drawn() * shape.drawn()))};
    forAllSubTexels(shape, [&](std::size_t, std::size_t at, const Vec3d& direction, double) {
      picture.texels[at] = Rgb::Constant(direction.dot(axis) > std::cos(halfAngle) ? 1.0f : 0.0f);
    });
    const sh::RgbCoefficients captured = project(picture, bands);
    std::vector<double> exact(count);
    sh::turnTo(moments, axis, std::span<double>(exact));
    for (int i = 0; i < count; ++i) {
      error += std::pow(double(captured.channel(0)[i]) - exact[i], 2);
      power += exact[i] * exact[i];
    }
  }
  return std::sqrt(error / power);
}

TEST(CubeMap, ADiscIsCaptured) {
  const double halfAngle = 20 * kPi / 180;
  double before = 1e9;
  for (const int size : {4, 8, 16, 32}) {
    const double plain = discError({size, 1}, halfAngle), finer = discError({size, 2}, halfAngle);
    EXPECT_LT(plain, before) << size;
    EXPECT_LT(finer, plain) << size;  // twice the samples find an edge better
    before = plain;
  }
  EXPECT_LT(discError({16, 2}, halfAngle), 0.02);
  EXPECT_LT(discError({32, 2}, halfAngle), 0.01);
}

}  // namespace
}  // namespace lambent::capture
