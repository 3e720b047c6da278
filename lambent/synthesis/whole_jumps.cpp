#include "lambent/synthesis/whole_jumps.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <vector>

#include <Eigen/Dense>

namespace lambent::synthesis {

Eigen::VectorXcd wholeJumps(const Eigen::MatrixXcd& schur, const Eigen::VectorXcd& best,
                            const std::array<std::complex<double>, 2>& basis) {
  const Eigen::Index count = best.size(), n = 2 * count;
  if (count == 0) return best;
  Eigen::MatrixXd matrix(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j)
      matrix(i, j) =
          (std::conj(basis[i % 2]) * schur(i / 2, j / 2) * basis[std::size_t(j % 2)]).real();
  Eigen::VectorXd wanted(n);
  const double area = (std::conj(basis[0]) * basis[1]).imag();
  for (Eigen::Index j = 0; j < count; ++j) {
    wanted[2 * j] = (std::conj(best[j]) * basis[1]).imag() / area;
    wanted[2 * j + 1] = (std::conj(basis[0]) * best[j]).imag() / area;
  }
  // What is not yet whole, the best of it given what is, and how it varies together.
  std::vector<Eigen::Index> rest(static_cast<std::size_t>(n));
  std::iota(rest.begin(), rest.end(), 0);
  Eigen::VectorXd x = wanted, whole = Eigen::VectorXd::Zero(n);
  Eigen::MatrixXd covariance = matrix.llt().solve(Eigen::MatrixXd::Identity(n, n));
  while (!rest.empty()) {
    const auto cost = [&](Eigen::Index i) {
      const double off = std::round(x[i]) - x[i];
      return off * off / std::max(covariance(i, i), 1e-300);
    };
    // One at a time; of many, several at a time, or there would be no end.
    std::vector<Eigen::Index> order(rest.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(),
                     [&](Eigen::Index i, Eigen::Index j) { return cost(i) < cost(j); });
    const std::size_t now = n <= 256 ? 1 : std::max<std::size_t>(1, rest.size() / 16);
    std::vector<Eigen::Index> taken(order.begin(), order.begin() + std::ptrdiff_t(now)),
        left(order.begin() + std::ptrdiff_t(now), order.end());
    std::sort(left.begin(), left.end());
    Eigen::VectorXd off(taken.size());
    for (std::size_t k = 0; k < now; ++k) {
      const double rounded = std::round(x[taken[k]]);
      off[Eigen::Index(k)] = rounded - x[taken[k]];
      whole[rest[std::size_t(taken[k])]] = rounded;
    }
    const Eigen::MatrixXd own = covariance(taken, taken), with = covariance(left, taken);
    const Eigen::MatrixXd gain = own.ldlt().solve(with.transpose()).transpose();
    x = (x(left) + gain * off).eval();
    Eigen::MatrixXd smaller = covariance(left, left);
    smaller.noalias() -= gain * with.transpose();
    covariance = std::move(smaller);
    std::vector<Eigen::Index> remaining;
    for (const Eigen::Index i : left) remaining.push_back(rest[std::size_t(i)]);
    rest = std::move(remaining);
  }
  Eigen::VectorXd slope = matrix * (whole - wanted);
  for (int round = 0; round < 100; ++round) {
    bool better = false;
    for (Eigen::Index i = 0; i < n; ++i) {
      const double step = slope[i] > 0.0 ? -1.0 : 1.0;
      if (matrix(i, i) + 2.0 * step * slope[i] >= -1e-9 * matrix(i, i)) continue;
      whole[i] += step;
      slope += step * matrix.col(i);
      better = true;
    }
    if (!better) break;
  }
  Eigen::VectorXcd jumps(count);
  for (Eigen::Index j = 0; j < count; ++j)
    jumps[j] = whole[2 * j] * basis[0] + whole[2 * j + 1] * basis[1];
  return jumps;
}

}  // namespace lambent::synthesis
