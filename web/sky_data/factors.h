// A matrix as the sum of its mean row and of few products: what is smooth along its rows' parameters
// takes few numbers.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "lambent/report/result.h"

namespace lambent::page {

struct FactorOptions {
  int components = 56;
  double step = 0.002;  ///< to which the matrix is rounded
  /// What errors count in each column, and in each row; empty: 1 in all.
  Eigen::RowVectorXd ofColumns;
  Eigen::VectorXd ofRows;
};

/// As arrays (packed_numbers.h): the mean [column], times step; for each component its basis [column],
/// times step, and its weights [row], times weightSteps[component]. mean + Σ weight · basis is the
/// matrix.
struct Factors {
  std::string arrays;
  std::vector<double> weightSteps;
};
Result<Factors> factorise(Eigen::MatrixXd matrix, const FactorOptions& options);

}  // namespace lambent::page
