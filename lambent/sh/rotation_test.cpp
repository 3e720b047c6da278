#include "lambent/sh/rotation.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "lambent/math/isa.h"
#include "lambent/math/random.h"
#include "lambent/math/sequences.h"
#include "lambent/sh/basis.h"
#include "lambent/sh/projection.h"
#include "lambent/sh/rotation_kernel.h"
#include "lambent/sh/zonal.h"

namespace lambent::sh {
namespace {

using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

Matrix matrixOf(int bands, const Mat3d& q) {
  const std::vector<double> values = rotationMatrix(bands, q);
  return Eigen::Map<const Matrix>(values.data(), coefficientCount(bands), coefficientCount(bands));
}

Mat3d aboutAxis(const Vec3d& axis, double angle) {
  return Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
}

/// Random rotations, all 24 of the cube, and those next to the poles of the angles.
std::vector<Mat3d> rotations(int randomCount) {
  std::vector<Mat3d> list;
  for (int i = 0; i < randomCount; ++i) list.push_back(math::randomRotationDouble(i));
  const int permutations[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
  for (const auto& p : permutations)
    for (int signs = 0; signs < 8; ++signs) {
      Mat3d q = Mat3d::Zero();
      for (int row = 0; row < 3; ++row) q(row, p[row]) = signs >> row & 1 ? -1 : 1;
      if (q.determinant() > 0) list.push_back(q);
    }
  for (double tilt : {1e-12, 1e-9, 1e-7, 1e-5, 1e-4, 1e-3, 1e-2})
    for (double near : {0.0, kPi})
      for (double turn : {0.0, 0.3, 2.0, -1.1})
        for (double side : {0.0, 0.7, -2.5})
          list.push_back(aboutAxis(Vec3d::UnitZ(), side) *
                         aboutAxis(Vec3d::UnitY(), near == 0 ? tilt : near - tilt) *
                         aboutAxis(Vec3d::UnitZ(), turn));
  return list;
}

std::vector<float> randomUnitFunction(int bands, std::uint64_t seed) {
  math::Random random(seed, 9);
  std::vector<float> f(coefficientCount(bands));
  double square = 0;
  for (float& v : f) {
    v = 2 * random.uniform() - 1;
    square += double(v) * v;
  }
  for (float& v : f) v = float(v / std::sqrt(square));
  return f;
}

TEST(Rotation, MatrixIsOrthogonalInEveryBand) {
  for (const Mat3d& q : rotations(20)) {
    const Matrix d = matrixOf(10, q);
    for (int l = 0; l < 10; ++l) {
      const Matrix block = d.block(l * l, l * l, 2 * l + 1, 2 * l + 1);
      const Matrix excess = block.transpose() * block - Matrix::Identity(2 * l + 1, 2 * l + 1);
      EXPECT_LT(excess.cwiseAbs().maxCoeff(), 1e-13) << "band " << l;
    }
  }
}

TEST(Rotation, MatrixRepresentsTheGroup) {
  for (int i = 0; i < 20; ++i) {
    const Mat3d a = math::randomRotationDouble(i), b = math::randomRotationDouble(100 + i);
    const Matrix difference = matrixOf(10, a * b) - matrixOf(10, a) * matrixOf(10, b);
    EXPECT_LT(difference.cwiseAbs().maxCoeff(), 1e-12);
    EXPECT_LT((matrixOf(10, a.transpose()) - matrixOf(10, a).transpose()).cwiseAbs().maxCoeff(),
              1e-12);
  }
  EXPECT_LT((matrixOf(10, Mat3d::Identity()) - Matrix::Identity(100, 100)).cwiseAbs().maxCoeff(),
            1e-15);
}

TEST(Rotation, MatrixMixesNoBands) {
  const Matrix d = matrixOf(6, math::randomRotationDouble(3));
  for (int i = 0; i < 36; ++i)
    for (int j = 0; j < 36; ++j) {
      if (bandOf(i) != bandOf(j)) {
        EXPECT_EQ(d(i, j), 0);
      }
    }
}

TEST(Rotation, MatrixIsTheProjectionOfRotatedFunctions) {
  // Column j is the projection of s ↦ y_j(Qᵀ s).
  const int bands = 10;
  const Mat3d q = math::randomRotationDouble(11);
  const Matrix d = matrixOf(bands, q);
  std::vector<double> y(coefficientCount(bands));
  for (int j : {0, 1, 2, 3, 7, 12, 20, 24, 30, 48, 63, 64, 81, 99}) {
    const std::vector<double> column = project(
        bands,
        [&](const Vec3d& s) {
          evaluate(bands, Vec3d(q.transpose() * s), y);
          return y[j];
        },
        bands);
    for (int i = 0; i < coefficientCount(bands); ++i) EXPECT_NEAR(d(i, j), column[i], 1e-12);
  }
}

TEST(Rotation, MatrixGoesBeyondTheBandsOfALight) {
  const Matrix d = matrixOf(19, math::randomRotationDouble(8));
  EXPECT_LT((d.transpose() * d - Matrix::Identity(361, 361)).cwiseAbs().maxCoeff(), 1e-12);
}

// The convention: what stood in direction s stands in Q s. A transposed matrix fails here.
TEST(Rotation, MovesALobeFromSToQs) {
  const Mat3 q = aboutAxis(Vec3d::UnitZ(), kPi / 2).cast<float>();  // +x goes to +y
  const ZonalMoments lobe = clampedCosine(5);
  std::vector<float> alongX(25), alongY(25), turned(25);
  turnTo(lobe, Vec3(Vec3::UnitX()), alongX);
  turnTo(lobe, Vec3(Vec3::UnitY()), alongY);
  rotate(5, q, alongX, turned);
  for (int i = 0; i < 25; ++i) EXPECT_NEAR(turned[i], alongY[i], 1e-6);
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Mat3 any = math::randomRotation(seed);
    const Vec3 s = Vec3(0.3f, -0.5f, 0.8f).normalized();
    std::vector<float> before(25), after(25), expected(25);
    turnTo(lobe, s, before);
    turnTo(lobe, Vec3((any * s).normalized()), expected);
    rotate(5, any, before, after);
    for (int i = 0; i < 25; ++i) EXPECT_NEAR(after[i], expected[i], 2e-6);
  }
}

TEST(Rotation, OfOneVectorFollowsTheMatrixToOneInAMillion) {
  for (int bands = 1; bands <= kMaxBands; ++bands) {
    const int count = coefficientCount(bands);
    double worst = 0;
    std::uint64_t seed = 0;
    for (const Mat3d& exact : rotations(200)) {
      // The truth is that of the matrix handed over, rounded to single precision; that one is
      // turned back into an exact rotation first, the nearest there is.
      const Mat3 q = exact.cast<float>();
      const Eigen::JacobiSVD<Mat3d> svd(q.cast<double>(),
                                        Eigen::ComputeFullU | Eigen::ComputeFullV);
      const Matrix d = matrixOf(bands, svd.matrixU() * svd.matrixV().transpose());
      const std::vector<float> f = randomUnitFunction(bands, seed++);
      std::vector<float> g(count + 1, 77.0f);
      rotate(bands, q, f, std::span(g).first(count));
      const Eigen::VectorXd expected =
          d * Eigen::Map<const Eigen::VectorXf>(f.data(), count).cast<double>();
      for (int i = 0; i < count; ++i) worst = std::max(worst, std::abs(g[i] - expected[i]));
      EXPECT_EQ(g[count], 77.0f);
    }
    EXPECT_LT(worst, 1e-6) << bands << " bands";
    RecordProperty("worst" + std::to_string(bands), std::to_string(worst * 1e9));
  }
}

TEST(Rotation, KernelsOfEveryInstructionSetAgree) {
  std::vector<RotationKernels> kernels{baseline::rotationKernels()};
#if defined(__x86_64__)
  if (math::bestIsa() != math::Isa::Baseline) kernels.push_back(avx2::rotationKernels());
  if (math::bestIsa() == math::Isa::Avx512) kernels.push_back(avx512::rotationKernels());
#endif
  for (int bands = 1; bands <= kMaxBands; ++bands) {
    const std::vector<float> f = randomUnitFunction(bands, 3);
    const Mat3 q = math::randomRotation(std::uint64_t(bands));
    std::vector<float> expected(f.size()), g(f.size());
    kernels[0].forBands[bands](q.data(), f.data(), expected.data());
    for (const RotationKernels& k : kernels) {
      k.forBands[bands](q.data(), f.data(), g.data());
      for (std::size_t i = 0; i < f.size(); ++i) EXPECT_NEAR(g[i], expected[i], 6e-7) << bands;
    }
  }
}

TEST(Rotation, OfAMatrixSlightlyOffKeepsTheNorm) {
  // Products of rotations in single precision drift off by a few units in the last place.
  const Mat3 q = math::randomRotation(4) * 1.00002f;
  const std::vector<float> f = randomUnitFunction(5, 3);
  std::vector<float> g(25);
  rotate(5, q, f, g);
  double square = 0;
  for (float v : g) square += double(v) * v;
  EXPECT_NEAR(square, 1, 1e-6);
}

TEST(Rotation, KeepsTheNormAndTheFunction) {
  const std::vector<float> f = randomUnitFunction(7, 1);
  const Mat3 q = math::randomRotation(5);
  std::vector<float> g(49);
  rotate(7, q, f, g);
  double before = 0, after = 0;
  for (int i = 0; i < 49; ++i) {
    before += double(f[i]) * f[i];
    after += double(g[i]) * g[i];
  }
  EXPECT_NEAR(before, after, 1e-6);
  for (const Vec3& s : math::sphericalFibonacci(50))
    EXPECT_NEAR(reconstruct(g, Vec3((q * s).normalized())), reconstruct(f, s), 3e-6);
}

TEST(Rotation, WorksInPlaceAndOnChannels) {
  const Mat3 q = math::randomRotation(2);
  for (int bands : {3, 5, 9}) {
    std::vector<float> f = randomUnitFunction(bands, 4), g(f.size());
    rotate(bands, q, f, g);
    RgbCoefficients rgb(bands);
    for (int c = 0; c < 3; ++c)
      for (std::size_t i = 0; i < f.size(); ++i) rgb.channel(c)[i] = f[i] * float(c + 1);
    rotate(bands, q, f, f);
    EXPECT_EQ(f, g);
    const RgbCoefficients turned = rotate(q, rgb);
    for (int c = 0; c < 3; ++c)
      for (std::size_t i = 0; i < f.size(); ++i)
        EXPECT_NEAR(turned.channel(c)[i], g[i] * float(c + 1), 1e-6);
  }
}

}  // namespace
}  // namespace lambent::sh
