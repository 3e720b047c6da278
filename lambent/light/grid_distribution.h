// Drawing a cell of a grid in proportion to its weight.
#pragma once

#include <cstddef>
#include <vector>

namespace lambent::light {

/// A discrete distribution over width × height cells: the row by its sum, then the column within
/// the row (pharr2023physically §A.5.4, kept as running sums).
class GridDistribution {
 public:
  GridDistribution() = default;
  /// Weights ≥ 0 and finite, row after row.
  GridDistribution(int width, int height, const std::vector<double>& weights);

  struct Cell {
    int x, y;
    double u, v;  ///< in [0, 1): what is left of the two random numbers, uniform again
  };
  /// For u1, u2 in [0, 1); total() must not be 0.
  Cell draw(double u1, double u2) const;
  double probability(int x, int y) const;
  double total() const { return rows_.empty() ? 0 : rows_.back(); }

 private:
  int width_ = 0, height_ = 0;
  std::vector<double> rows_;     ///< height running sums of the rows' sums
  std::vector<double> columns_;  ///< in every row, width running sums
};

}  // namespace lambent::light
