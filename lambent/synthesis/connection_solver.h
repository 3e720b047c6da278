// Solves with the connection Laplacian of a surface, small or large.
#pragma once

#include <complex>
#include <cstddef>
#include <memory>
#include <vector>

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

namespace lambent::synthesis {

/// A Hermitian positive definite matrix whose entry (j, i) is −w e^{iρ}, with w > 0 and ρ the
/// rotation from i to j: of up to `largestDirect` rows factorised, of more solved by iteration.
/// Products run on all threads, and come out the same on any number of them.
class ConnectionSolver {
 public:
  using Complex = std::complex<double>;
  using Field = Eigen::VectorXcd;
  using Matrix = Eigen::SparseMatrix<Complex>;

  /// `lower`: the matrix's lower triangle.
  explicit ConnectionSolver(const Matrix& lower, Eigen::Index largestDirect = 60000);
  /// The factorisation stood.
  bool ok() const { return coarse_ ? coarse_->ok() : factor_.info() == Eigen::Success; }
  /// x with matrix · x = b. The iteration begins at `guess` and ends at a residual of `tolerance`
  /// times that of 0, or `reduction` times that of the guess.
  Field solve(const Field& b, const Field& guess, double tolerance, double reduction = 0.0) const;

 private:
  using Rows = Eigen::SparseMatrix<Complex, Eigen::RowMajor>;
  /// Neighbours that are nearly one unknown, each carried from its aggregate's first.
  struct Aggregates {
    std::vector<std::size_t> of;  ///< per row
    Field turn;                   ///< per row: the rotation from its aggregate's first
    std::size_t count = 0;
  };

  Aggregates aggregates() const;
  void coarsen(Eigen::Index largestDirect);
  /// One cycle from fine to coarse and back; exact where the matrix was factorised.
  Field roughly(const Field& b) const;

  // What is factorised.
  Eigen::SimplicialLDLT<Matrix, Eigen::Lower> factor_;
  // What is not.
  Rows full_;                ///< both triangles
  Field damped_;             ///< the inverse diagonal, damped so that steps of it converge
  Rows prolong_, restrict_;  ///< from the coarse problem's unknowns, and to them
  std::unique_ptr<ConnectionSolver> coarse_;
};

}  // namespace lambent::synthesis
