#include "lambent/transport/row_system.h"

#include <algorithm>

#include "lambent/work/parallel_for.h"

namespace lambent::transport {

namespace {

constexpr std::size_t kColumns = 64;  ///< solved at a time

}  // namespace

RowSystem::RowSystem(std::vector<std::uint32_t> unknowns, const std::vector<Entry>& entries,
                     std::vector<Term> terms)
    : unknowns_(std::move(unknowns)), terms_(std::move(terms)) {
  if (unknowns_.empty()) return;
  const auto size = static_cast<Eigen::Index>(unknowns_.size());
  Eigen::SparseMatrix<double> matrix(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  auto solver = std::make_shared<Solver>();
  solver->compute(matrix);
  solver_ = std::move(solver);
}

void RowSystem::solve(RowsToFill rows, std::span<const std::uint32_t> rowOf) const {
  if (unknowns_.empty()) return;
  const auto solveColumns = [&](std::size_t begin, std::size_t end) {
    Eigen::MatrixXd right = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(unknowns_.size()),
                                                  static_cast<Eigen::Index>(end - begin));
    for (const Term& term : terms_) {
      const float* row = rowAt(rows, rowOf, term.row);
      if (row == nullptr) continue;
      for (std::size_t j = begin; j < end; ++j)
        right(term.unknown, static_cast<Eigen::Index>(j - begin)) += term.factor * row[j];
    }
    const Eigen::MatrixXd solved = solver_->solve(right);
    for (std::size_t k = 0; k < unknowns_.size(); ++k) {
      float* row = rowAt(rows, rowOf, unknowns_[k]);
      if (row == nullptr) continue;
      for (std::size_t j = begin; j < end; ++j)
        row[j] = static_cast<float>(
            solved(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(j - begin)));
    }
  };
  work::parallelFor((rows.stride + kColumns - 1) / kColumns, [&](std::size_t block) {
    solveColumns(block * kColumns, std::min(rows.stride, (block + 1) * kColumns));
  });
}

}  // namespace lambent::transport
