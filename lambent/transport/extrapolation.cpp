#include "lambent/transport/extrapolation.h"

#include <algorithm>
#include <cassert>

#include "lambent/work/parallel_for.h"

namespace lambent::transport {

namespace {

/// λ. A wanted receiver that weighs a third at three places has a sum of squares of a third itself:
/// it is left to them, and one that weighs a tenth is not.
constexpr double kTowardsMean = 0.02;
constexpr std::size_t kColumns = 64;  ///< solved at a time

}  // namespace

Extrapolation::Extrapolation(std::span<const std::uint8_t> wanted, std::vector<Interpolated> places,
                             std::vector<Mean> means)
    : means_(std::move(means)) {
  for (const Interpolated& place : places)
    for (const auto& [receiver, weight] : place.weights)
      if (wanted[receiver]) unknowns_.push_back(receiver);
  std::sort(unknowns_.begin(), unknowns_.end());
  unknowns_.erase(std::unique(unknowns_.begin(), unknowns_.end()), unknowns_.end());
  if (unknowns_.empty()) return;
  const auto numberOf = [&](std::uint32_t receiver) {
    const auto at = std::lower_bound(unknowns_.begin(), unknowns_.end(), receiver);
    return static_cast<std::uint32_t>(at - unknowns_.begin());
  };
  std::vector<double> sums(unknowns_.size(), 0.0);  // Σ_s w of each unknown
  for (const Interpolated& place : places)
    for (const auto& [receiver, weight] : place.weights)
      if (wanted[receiver]) sums[numberOf(receiver)] += weight;

  using Triplet = Eigen::Triplet<double>;
  std::vector<Triplet> normal;
  for (std::size_t k = 0; k < unknowns_.size(); ++k)
    normal.emplace_back(static_cast<int>(k), static_cast<int>(k), kTowardsMean);
  for (const Interpolated& place : places)
    for (const auto& [b, wb] : place.weights) {
      if (!wanted[b]) continue;
      const std::uint32_t row = numberOf(b);
      terms_.push_back(
          {row, place.witness, wb + (sums[row] > 0.0 ? kTowardsMean * wb / sums[row] : 0.0)});
      for (const auto& [k, wk] : place.weights) {
        if (wanted[k])
          normal.emplace_back(static_cast<int>(row), static_cast<int>(numberOf(k)),
                              double(wb) * wk);
        else
          terms_.push_back({row, k, -double(wb) * wk});
      }
    }
  const auto size = static_cast<Eigen::Index>(unknowns_.size());
  Eigen::SparseMatrix<double> matrix(size, size);
  matrix.setFromTriplets(normal.begin(), normal.end());
  auto solver = std::make_shared<Solver>();
  solver->compute(matrix);  // positive definite: λ > 0
  solver_ = std::move(solver);
}

void Extrapolation::fill(RowsToFill rows, std::span<const std::uint32_t> rowOf) const {
  const auto rowOfReceiver = [&](std::uint32_t receiver) -> float* {
    const std::uint32_t row = rowOf.empty() ? receiver : rowOf[receiver];
    return row == kNoRow ? nullptr : rows.data + row * rows.stride;
  };
  const auto solve = [&](std::size_t begin, std::size_t end) {
    Eigen::MatrixXd right = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(unknowns_.size()),
                                                  static_cast<Eigen::Index>(end - begin));
    for (const Term& term : terms_) {
      const float* row = rowOfReceiver(term.receiver);
      if (row == nullptr) continue;
      for (std::size_t j = begin; j < end; ++j)
        right(term.unknown, static_cast<Eigen::Index>(j - begin)) += term.factor * row[j];
    }
    const Eigen::MatrixXd solved = solver_->solve(right);
    for (std::size_t k = 0; k < unknowns_.size(); ++k) {
      float* row = rowOfReceiver(unknowns_[k]);
      if (row == nullptr) continue;
      for (std::size_t j = begin; j < end; ++j)
        row[j] = static_cast<float>(
            solved(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(j - begin)));
    }
  };
  if (!unknowns_.empty())
    work::parallelFor((rows.stride + kColumns - 1) / kColumns, [&](std::size_t block) {
      solve(block * kColumns, std::min(rows.stride, (block + 1) * kColumns));
    });
  for (const Mean& mean : means_) {
    float* row = rowOfReceiver(mean.receiver);
    if (row == nullptr) continue;
    std::fill_n(row, rows.stride, 0.0f);
    for (const std::uint32_t receiver : mean.of) {
      const float* other = rowOfReceiver(receiver);
      for (std::size_t j = 0; j < rows.stride; ++j)
        row[j] += other[j] / static_cast<float>(mean.of.size());
    }
  }
}

}  // namespace lambent::transport
