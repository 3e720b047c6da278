// Rows of floats that follow from others by linear equations, the same for every column.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <Eigen/SparseCholesky>

namespace lambent::transport {

/// Numbered rows of floats: row i begins at data + i·stride.
struct RowsToFill {
  float* data;
  std::size_t stride;
};

inline constexpr std::uint32_t kNoRow = 0xffffffffu;

/// The rows x that solve A x = b, where every entry of b is a sum over rows as they stand. A is
/// factorised once.
class RowSystem {
 public:
  /// A share of a row, known or not, that goes to the right side of an unknown's equation.
  struct Term {
    std::uint32_t unknown, row;
    double factor;
  };
  using Entry = Eigen::Triplet<double>;  ///< of A, by places in `unknowns`; those of a place add up

  RowSystem() = default;
  /// A must be positive definite. `unknowns`: the numbers of their rows.
  RowSystem(std::vector<std::uint32_t> unknowns, const std::vector<Entry>& entries,
            std::vector<Term> terms);

  bool empty() const { return unknowns_.empty(); }
  /// Sets the unknown rows. `rowOf[r]`: where row r is among `rows`, or kNoRow where it is not
  /// there; empty: r itself.
  void solve(RowsToFill rows, std::span<const std::uint32_t> rowOf = {}) const;

 private:
  using Solver = Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>;

  std::vector<std::uint32_t> unknowns_;
  std::vector<Term> terms_;
  std::shared_ptr<const Solver> solver_;
};

/// Where row r is; null where it is not there.
inline float* rowAt(RowsToFill rows, std::span<const std::uint32_t> rowOf, std::uint32_t r) {
  const std::uint32_t row = rowOf.empty() ? r : rowOf[r];
  return row == kNoRow ? nullptr : rows.data + row * rows.stride;
}

}  // namespace lambent::transport
