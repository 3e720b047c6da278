// Singular vectors, from the eigenvectors of the smaller side: M Mᵀ = U S² Uᵀ.
#include "web/sky_data/factors.h"

#include <algorithm>

#include <Eigen/Eigenvalues>

#include "web/sky_data/packed_numbers.h"

namespace lambent::page {

Result<Factors> factorise(Eigen::MatrixXd m, const FactorOptions& options) {
  const Eigen::RowVectorXd ofColumns =
      options.ofColumns.size() ? options.ofColumns : Eigen::RowVectorXd::Ones(m.cols());
  const Eigen::VectorXd ofRows =
      options.ofRows.size() ? options.ofRows : Eigen::VectorXd::Ones(m.rows());
  const Eigen::RowVectorXd mean = ofRows.transpose() * m / ofRows.sum();
  m.rowwise() -= mean;
  m.array().rowwise() *= ofColumns.array();
  m.array().colwise() *= ofRows.array();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(m * m.transpose());
  if (solver.info() != Eigen::Success)
    return report::Error{report::ErrorKind::BadInput, "the tables could not be factorised"};
  Factors factors;
  packNumbers(mean, 1 / options.step, factors.arrays);
  const int components = std::min<int>(options.components, int(m.rows()));
  for (int k = 0; k < components; ++k) {
    const Eigen::VectorXd u = solver.eigenvectors().col(m.rows() - 1 - k);
    Eigen::VectorXd weights = u.array() / ofRows.array();
    const double largest = weights.cwiseAbs().maxCoeff();
    weights /= largest;
    const Eigen::RowVectorXd basis = (u.transpose() * m).array() * (largest / ofColumns.array());
    const double step = 0.5 * options.step / basis.cwiseAbs().maxCoeff();
    packNumbers(basis, 1 / options.step, factors.arrays);
    factors.weightSteps.push_back(step);
    packNumbers(weights, 1 / step, factors.arrays);
  }
  return factors;
}

}  // namespace lambent::page
