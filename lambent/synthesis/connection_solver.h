// Solves with the connection Laplacian of a surface, small or large.
#pragma once

#include <complex>
#include <vector>

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

namespace lambent::synthesis {

/// A Hermitian positive definite matrix whose entry (j, i) is −w e^{iρ}, with w > 0 and ρ the
/// rotation from i to j: of up to `largestDirect` rows factorised, of more solved by iteration.
class ConnectionSolver {
 public:
  using Complex = std::complex<double>;
  using Field = Eigen::VectorXcd;
  using Matrix = Eigen::SparseMatrix<Complex>;

  /// `lower`: the matrix's lower triangle.
  explicit ConnectionSolver(const Matrix& lower, Eigen::Index largestDirect = 60000);
  /// The factorisation stood.
  bool ok() const { return factor_.info() == Eigen::Success; }
  /// x with matrix · x = b; the iteration begins at `guess` and ends at a residual of `tolerance`
  /// times that of 0.
  Field solve(const Field& b, const Field& guess, double tolerance) const;
  /// The same roughly, at the cost of one step of the iteration: the aggregates' solution and the
  /// diagonal's. Exact where the matrix was factorised.
  Field roughly(const Field& b) const {
    return direct_ ? Field(factor_.solve(b)) : precondition(b);
  }

 private:
  void aggregate();
  Field precondition(const Field& r) const;

  bool direct_;
  Matrix full_;  ///< both triangles; empty if direct
  Eigen::VectorXd inverseDiagonal_;
  std::vector<Eigen::Index> aggregateOf_;  ///< per row
  Field turn_;                             ///< per row: the rotation from its aggregate's root
  Eigen::Index aggregates_ = 0;
  Eigen::SimplicialLDLT<Matrix, Eigen::Lower> factor_;  ///< of the matrix, or of the aggregates'
};

}  // namespace lambent::synthesis
