#include "lambent/sh/product.h"

#include <gtest/gtest.h>

#include <cmath>
#include <thread>

#include "lambent/math/isa.h"
#include "lambent/math/random.h"
#include "lambent/sh/basis.h"
#include "lambent/sh/product_kernel.h"
#include "lambent/sh/projection.h"
#include "lambent/sh/zonal.h"

namespace lambent::sh {
namespace {

double triple(int li, int mi, int lj, int mj, int lk, int mk) {
  return tripleProduct(index(li, mi), index(lj, mj), index(lk, mk));
}

std::vector<float> randomFunction(int bands, std::uint64_t seed) {
  math::Random random(seed, 9);
  std::vector<float> f(coefficientCount(bands));
  for (float& v : f) v = 2 * random.uniform() - 1;
  return f;
}

/// The product by the tensor, in double precision.
std::vector<double> slowProduct(int bands, std::span<const float> a, std::span<const float> b) {
  std::vector<double> c(coefficientCount(bands), 0.0);
  for (const auto& e : tripleProductTensor(bands, bands, bands).entries)
    c[e.k] += e.value * a[e.i] * b[e.j];
  return c;
}

TEST(TripleProduct, HasTheKnownValues) {
  EXPECT_NEAR(triple(0, 0, 0, 0, 0, 0), 1 / std::sqrt(4 * kPi), 1e-15);
  EXPECT_NEAR(triple(1, 0, 1, 0, 2, 0), 1 / std::sqrt(5 * kPi), 1e-15);
  EXPECT_NEAR(triple(2, 0, 2, 0, 2, 0), std::sqrt(5 / kPi) / 7, 1e-15);
  EXPECT_NEAR(triple(1, 1, 1, 1, 2, 2), std::sqrt(3 / (20 * kPi)), 1e-15);
  EXPECT_NEAR(triple(1, 1, 1, 1, 2, 0), -1 / std::sqrt(20 * kPi), 1e-15);
  EXPECT_EQ(triple(1, 1, 1, -1, 2, 0), 0);
  EXPECT_EQ(triple(1, 0, 1, 0, 3, 0), 0);
}

TEST(TripleProduct, TensorHasTheKnownNumberOfEntries) {
  EXPECT_EQ(tripleProductTensor(3, 3, 3).entries.size(), 83u);
  EXPECT_EQ(tripleProductTensor(4, 4, 4).entries.size(), 353u);
  EXPECT_EQ(tripleProductTensor(5, 5, 5).entries.size(), 1158u);
  EXPECT_EQ(tripleProductTensor(5, 5, 9).entries.size(), 2229u);
}

TEST(TripleProduct, TensorIsSortedAndSymmetric) {
  const auto& entries = tripleProductTensor(5, 5, 9).entries;
  for (std::size_t e = 1; e < entries.size(); ++e)
    EXPECT_LT(std::tie(entries[e - 1].i, entries[e - 1].j, entries[e - 1].k),
              std::tie(entries[e].i, entries[e].j, entries[e].k));
  for (std::size_t e = 0; e < entries.size(); e += 7) {
    const auto& t = entries[e];
    EXPECT_NEAR(tripleProduct(t.i, t.j, t.k), t.value, 1e-14);
    EXPECT_NEAR(tripleProduct(t.k, t.i, t.j), t.value, 1e-14);
    EXPECT_NEAR(tripleProduct(t.j, t.i, t.k), t.value, 1e-14);
  }
  EXPECT_EQ(&tripleProductTensor(5, 5, 9).entries, &entries) << "made once and kept";
}

TEST(TripleProduct, TensorAgreesWithQuadratureOnTheSphere) {
  // Every (j, k) for some i, those that no rule forbids and those that one does.
  const int bands = 4;
  const auto& tensor = tripleProductTensor(bands, bands, bands);
  std::vector<double> y(16);
  for (int i : {0, 2, 5, 8, 9, 12, 15})
    for (int j = 0; j < 16; ++j) {
      const std::vector<double> expected = project(
          bands,
          [&](const Vec3d& s) {
            evaluate(bands, s, y);
            return y[i] * y[j];
          },
          8);
      std::vector<double> row(16, 0.0);
      for (const auto& e : tensor.entries)
        if (e.i == i && e.j == j) row[e.k] = e.value;
      for (int k = 0; k < 16; ++k) EXPECT_NEAR(row[k], expected[k], 1e-13);
    }
}

TEST(TripleProduct, TensorsMayBeAskedForFromManyThreads) {
  std::vector<std::thread> threads;
  std::vector<const TripleProductTensor*> seen(8);
  for (std::size_t t = 0; t < seen.size(); ++t)
    threads.emplace_back([&seen, t] { seen[t] = &tripleProductTensor(4, 5, 6); });
  for (std::thread& t : threads) t.join();
  for (const TripleProductTensor* s : seen) EXPECT_EQ(s, seen[0]);
  EXPECT_EQ(seen[0]->rowBands, 4);
  EXPECT_EQ(seen[0]->columnBands, 5);
  EXPECT_EQ(seen[0]->functionBands, 6);
}

TEST(ProductMatrix, OfAHemisphereHasTheKnownValues) {
  std::vector<double> hemisphereProjection(81), matrix(25 * 25);
  turnTo(hemisphere(9), Vec3d(0, 0, 1), hemisphereProjection);
  productMatrix(hemisphereProjection, 5, 5, matrix);
  const auto at = [&](int li, int lj) { return matrix[index(li, 0) * 25 + index(lj, 0)]; };
  EXPECT_NEAR(at(0, 0), 0.5, 1e-14);
  EXPECT_NEAR(at(0, 1), std::sqrt(3.0) / 4, 1e-14);
  // ∫₀¹ of √15/2 (3z³ − z)/2: √15/16.
  EXPECT_NEAR(at(1, 2), std::sqrt(15.0) / 16, 1e-14);
  EXPECT_NEAR(at(0, 2), 0, 1e-14);
}

TEST(ProductMatrix, MultipliesFunctions) {
  // With enough bands of a it is exact: (Â b)(s) projected = a·b projected, by quadrature.
  const int rowBands = 5, columnBands = 3, functionBands = rowBands + columnBands - 1;
  std::vector<double> a(coefficientCount(functionBands)), b(9), y(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) a[i] = std::sin(2.1 * double(i) + 0.3);
  for (std::size_t i = 0; i < b.size(); ++i) b[i] = std::cos(1.3 * double(i));
  std::vector<double> matrix(25 * 9);
  productMatrix(a, rowBands, columnBands, matrix);
  const std::vector<double> expected = project(
      rowBands,
      [&](const Vec3d& s) {
        evaluate(functionBands, s, y);
        double fa = 0, fb = 0;
        for (std::size_t i = 0; i < a.size(); ++i) fa += a[i] * y[i];
        for (std::size_t i = 0; i < 9; ++i) fb += b[i] * y[i];
        return fa * fb;
      },
      16);
  for (int i = 0; i < 25; ++i) {
    double sum = 0;
    for (int j = 0; j < 9; ++j) sum += matrix[i * 9 + j] * b[j];
    EXPECT_NEAR(sum, expected[i], 1e-12);
  }
  // More bands than can matter change nothing.
  std::vector<double> longer = a, same(25 * 9);
  longer.resize(100, 5.0);
  productMatrix(longer, rowBands, columnBands, same);
  EXPECT_EQ(matrix, same);
}

TEST(Product, FollowsTheTensor) {
  for (int bands = 1; bands <= kMaxBands; ++bands) {
    const std::size_t count = coefficientCount(bands);
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
      const std::vector<float> a = randomFunction(bands, seed),
                               b = randomFunction(bands, seed + 50);
      std::vector<float> c(count + 1, 77.0f);
      product(bands, a, b, std::span(c).first(count));
      const std::vector<double> expected = slowProduct(bands, a, b);
      for (std::size_t i = 0; i < count; ++i)
        ASSERT_NEAR(c[i], expected[i], 1e-6 * bands) << bands << " bands, coefficient " << i;
      EXPECT_EQ(c[count], 77.0f);
    }
  }
}

TEST(Product, KernelsOfEveryInstructionSetAgree) {
  // Any rings will do to compare kernels.
  std::vector<ProductKernels> kernels{baseline::productKernels()};
#if defined(__x86_64__)
  if (math::bestIsa() != math::Isa::Baseline) kernels.push_back(avx2::productKernels());
  if (math::bestIsa() == math::Isa::Avx512) kernels.push_back(avx512::productKernels());
#endif
  for (int bands = 1; bands <= kMaxBands; ++bands) {
    std::vector<float> rings(std::size_t(productLanes(bands)) * bands * (bands + 1));
    for (std::size_t i = 0; i < rings.size(); ++i) rings[i] = 0.2f * float(std::sin(double(i)));
    const std::vector<float> a = randomFunction(bands, 1), b = randomFunction(bands, 2);
    std::vector<float> expected(a.size()), c(a.size());
    kernels[0].forBands[bands](rings.data(), a.data(), b.data(), expected.data());
    for (const ProductKernels& k : kernels) {
      k.forBands[bands](rings.data(), a.data(), b.data(), c.data());
      for (std::size_t i = 0; i < c.size(); ++i) EXPECT_NEAR(c[i], expected[i], 1e-5) << bands;
    }
  }
}

TEST(Product, IsTheProjectionOfTheProduct) {
  const std::vector<float> a = randomFunction(5, 1), b = randomFunction(5, 2);
  std::vector<float> c(25);
  product(5, a, b, c);
  std::vector<double> y(25);
  const std::vector<double> expected = project(
      5,
      [&](const Vec3d& s) {
        evaluate(5, s, y);
        double fa = 0, fb = 0;
        for (int i = 0; i < 25; ++i) {
          fa += a[i] * y[i];
          fb += b[i] * y[i];
        }
        return fa * fb;
      },
      10);
  for (int i = 0; i < 25; ++i) EXPECT_NEAR(c[i], expected[i], 2e-6);
}

TEST(Product, EqualsTheProductMatrixTimesTheVector) {
  const std::vector<float> a = randomFunction(6, 1), b = randomFunction(6, 2);
  std::vector<float> c(36);
  product(6, a, b, c);
  std::vector<double> matrix(36 * 36);
  productMatrix(std::vector<double>(a.begin(), a.end()), 6, 6, matrix);
  for (int i = 0; i < 36; ++i) {
    double sum = 0;
    for (int j = 0; j < 36; ++j) sum += matrix[i * 36 + j] * b[j];
    EXPECT_NEAR(c[i], sum, 3e-6);
  }
}

TEST(Product, WithOneIsTheFunctionAndInPlaceIsAllowed) {
  for (int bands : {2, 5, 8}) {
    std::vector<float> one(coefficientCount(bands), 0.0f), f = randomFunction(bands, 3);
    one[0] = float(std::sqrt(4 * kPi));
    const std::vector<float> before = f;
    product(bands, f, one, f);
    for (std::size_t i = 0; i < f.size(); ++i) EXPECT_NEAR(f[i], before[i], 1e-6);
    std::vector<float> square(f.size());
    product(bands, f, f, square);
    product(bands, f, f, f);
    EXPECT_EQ(f, square);
  }
}

}  // namespace
}  // namespace lambent::sh
