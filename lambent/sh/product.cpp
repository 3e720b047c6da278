// This work is based on:
// - sloan2002precomputed: eq. 7, the product matrix from triple products.
// - gaunt1929triplets: the integral of three associated Legendre functions; the azimuthal part of
//   the real basis is integrated in closed form, the polar part by a Gauss-Legendre rule that is
//   exact for its degree.
#include "lambent/sh/product.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdlib>
#include <map>
#include <memory>
#include <mutex>
#include <tuple>

#include "lambent/math/isa.h"
#include "lambent/math/quadrature.h"
#include "lambent/math/types.h"
#include "lambent/sh/legendre_table.h"
#include "lambent/sh/product_kernel.h"

namespace lambent::sh {

namespace {

/// ∫ Φ_a Φ_b Φ_c dφ of the real azimuthal functions Φ_0 = 1, Φ_m = cos mφ, Φ_−m = sin mφ. (Their √2
/// is in the Legendre table.)
double azimuthIntegral(int a, int b, int c) {
  const int sines = (a < 0) + (b < 0) + (c < 0);
  if (sines % 2 != 0) return 0;
  std::array<int, 3> m{a, b, c};
  std::sort(m.begin(), m.end(), [](int p, int q) { return std::abs(p) < std::abs(q); });
  if (std::abs(m[0]) + std::abs(m[1]) != std::abs(m[2])) return 0;
  if (m[2] == 0) return 2 * kPi;
  if (m[0] == 0) return kPi;  // both cosines, or both sines: of one, the other rules say 0
  // cos p cos q cos(p+q), or the sum angle in a sine and one of the others: π/2; sin p sin q
  // cos(p+q): −π/2.
  return sines == 2 && m[2] > 0 ? -kPi / 2 : kPi / 2;
}

/// Whether parity, the triangle and the azimuth leave anything of the triple product.
bool mayBeNonZero(int li, int mi, int lj, int mj, int lk, int mk) {
  return (li + lj + lk) % 2 == 0 && lk <= li + lj && lk >= std::abs(li - lj) &&
         azimuthIntegral(mi, mj, mk) != 0;
}

/// P_lm(z) sinᵐθ at the nodes of a rule for polynomials of degree 3(bands − 1).
struct PolarTable {
  explicit PolarTable(int degree, int bands)
      : rule(math::gaussLegendre(degree / 2 + 1)),
        values(std::size_t(bands * (bands + 1) / 2) * rule.nodes.size()) {
    for (std::size_t q = 0; q < rule.nodes.size(); ++q) {
      const double z = rule.nodes[q], sine = std::sqrt((1 - z) * (1 + z));
      double power = 1;
      for (int m = 0; m < bands; ++m, power *= sine) {
        double previous = 0, p = kLegendre.diagonal[m] * power;
        for (int l = m; l < bands; ++l) {
          if (l > m) {
            const double next = kLegendre.step[l][m] * z * p - kLegendre.back[l][m] * previous;
            previous = p;
            p = next;
          }
          values[row(l, m) + q] = p;
        }
      }
    }
  }
  std::size_t row(int l, int m) const {
    return std::size_t(l * (l + 1) / 2 + std::abs(m)) * rule.nodes.size();
  }
  double integral(int li, int mi, int lj, int mj, int lk, int mk) const {
    const double *a = &values[row(li, mi)], *b = &values[row(lj, mj)], *c = &values[row(lk, mk)];
    double sum = 0;
    for (std::size_t q = 0; q < rule.nodes.size(); ++q) sum += rule.weights[q] * a[q] * b[q] * c[q];
    return sum;
  }

  math::Quadrature rule;
  std::vector<double> values;
};

/// Some triple products vanish though no rule says so: their quadrature leaves rounding.
constexpr double kRounding = 1e-13;

TripleProductTensor makeTensor(int rowBands, int columnBands, int functionBands) {
  TripleProductTensor tensor;
  tensor.rowBands = rowBands;
  tensor.columnBands = columnBands;
  tensor.functionBands = functionBands;
  const int bands = std::max({rowBands, columnBands, functionBands});
  const PolarTable polar(rowBands + columnBands + functionBands - 3, bands);
  for (int li = 0; li < rowBands; ++li)
    for (int mi = -li; mi <= li; ++mi)
      for (int lj = 0; lj < columnBands; ++lj)
        for (int mj = -lj; mj <= lj; ++mj)
          for (int lk = 0; lk < functionBands; ++lk)
            for (int mk = -lk; mk <= lk; ++mk) {
              if (!mayBeNonZero(li, mi, lj, mj, lk, mk)) continue;
              const double value =
                  azimuthIntegral(mi, mj, mk) * polar.integral(li, mi, lj, mj, lk, mk);
              if (std::abs(value) < kRounding) continue;
              tensor.entries.push_back({std::uint16_t(index(li, mi)), std::uint16_t(index(lj, mj)),
                                        std::uint16_t(index(lk, mk)), value});
            }
  return tensor;
}

}  // namespace

double tripleProduct(int i, int j, int k) {
  const int li = bandOf(i), lj = bandOf(j), lk = bandOf(k);
  const int mi = i - index(li, 0), mj = j - index(lj, 0), mk = k - index(lk, 0);
  assert(std::max({li, lj, lk}) < kTableBands);
  if (!mayBeNonZero(li, mi, lj, mj, lk, mk)) return 0;
  const PolarTable polar(li + lj + lk, std::max({li, lj, lk}) + 1);
  const double value = azimuthIntegral(mi, mj, mk) * polar.integral(li, mi, lj, mj, lk, mk);
  return std::abs(value) < kRounding ? 0 : value;
}

const TripleProductTensor& tripleProductTensor(int rowBands, int columnBands, int functionBands) {
  assert(std::min({rowBands, columnBands, functionBands}) >= 1);
  assert(std::max({rowBands, columnBands, functionBands}) <= kTableBands);
  static std::mutex mutex;
  static std::map<std::tuple<int, int, int>, std::unique_ptr<const TripleProductTensor>> made;
  const std::lock_guard lock(mutex);
  auto& tensor = made[{rowBands, columnBands, functionBands}];
  if (!tensor)
    tensor = std::make_unique<const TripleProductTensor>(
        makeTensor(rowBands, columnBands, functionBands));
  return *tensor;
}

void productMatrix(std::span<const double> a, int rowBands, int columnBands,
                   std::span<double> out) {
  const int rows = coefficientCount(rowBands), columns = coefficientCount(columnBands);
  assert(out.size() >= std::size_t(rows) * std::size_t(columns));
  // Bands past rowBands + columnBands − 1 meet no pair of basis functions.
  const int functionBands = std::min(bandsOf(a.size()), rowBands + columnBands - 1);
  std::fill_n(out.begin(), std::size_t(rows) * std::size_t(columns), 0.0);
  for (const auto& [i, j, k, value] :
       tripleProductTensor(rowBands, columnBands, functionBands).entries)
    out[std::size_t(i) * std::size_t(columns) + j] += value * a[k];
}

namespace {

/// What the kernel wants to know of its rings (see product_kernel.h), for 1 … 10 bands.
std::vector<float> makeRings(int bands) {
  const int lanes = productLanes(bands), rings = (3 * (bands - 1)) / 2 + 1;
  const math::Quadrature rule = math::gaussLegendre(rings);
  std::vector<float> table(std::size_t(2 * lanes) * std::size_t(bands * (bands + 1) / 2), 0.0f);
  for (int lane = 0; lane < (rings + 1) / 2; ++lane) {
    const double z = rule.nodes[rings - 1 - lane], sine = std::sqrt((1 - z) * (1 + z));
    // The ring on the equator stands in both halves.
    const bool equator = 2 * lane + 1 == rings;
    const double weight = rule.weights[rings - 1 - lane] * (equator ? 0.5 : 1.0);
    double power = 1;
    for (int m = 0; m < bands; ++m, power *= sine) {
      // ∫ cos² mφ dφ, which is 2π for m = 0, else π; the kernel's terms with m > 0 are doubled.
      const double azimuth = m == 0 ? 2 * kPi : kPi / 2;
      double previous = 0, p = kLegendre.diagonal[m] * power;
      for (int l = m; l < bands; ++l) {
        if (l > m) {
          const double next = kLegendre.step[l][m] * z * p - kLegendre.back[l][m] * previous;
          previous = p;
          p = next;
        }
        const auto row = std::size_t(2 * lanes) * std::size_t(l * (l + 1) / 2 + m);
        table[row + std::size_t(lane)] = float(p);
        table[row + std::size_t(lanes + lane)] = float(p * weight * azimuth);
      }
    }
  }
  return table;
}

struct ProductPlan {
  ProductKernels kernels;
  std::array<std::vector<float>, kMaxBands + 1> rings;
};

ProductPlan makeProductPlan() {
  ProductPlan plan{};
  switch (math::bestIsa()) {
#if defined(__x86_64__)
    case math::Isa::Avx512:
      plan.kernels = avx512::productKernels();
      break;
    case math::Isa::Avx2:
      plan.kernels = avx2::productKernels();
      break;
#endif
    default:
      plan.kernels = baseline::productKernels();
  }
  for (int bands = 1; bands <= kMaxBands; ++bands) plan.rings[bands] = makeRings(bands);
  return plan;
}

}  // namespace

void product(int bands, std::span<const float> a, std::span<const float> b, std::span<float> c) {
  assert(bands >= 1 && bands <= kMaxBands);
  [[maybe_unused]] const auto count = std::size_t(coefficientCount(bands));
  assert(a.size() >= count && b.size() >= count && c.size() >= count);
  static const ProductPlan plan = makeProductPlan();
  plan.kernels.forBands[bands](plan.rings[bands].data(), a.data(), b.data(), c.data());
}

}  // namespace lambent::sh
