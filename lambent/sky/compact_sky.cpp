// This work is based on dobashi1995fast, as preetham2003modeling tells of it: the sky as a weighted
// sum of cosines of elevation and azimuth, beside spherical harmonics.
// Deviations:
// - azimuth counts from the Sun, where skies are even: cosines do without sines;
// - weights are those of least squares over the hemisphere by solid angle, not of projection in the
//   plane of both angles, in which the zenith would count as much as the horizon.
// Cosines of the azimuth do not agree at the zenith, where all azimuths meet: there the sum is what
// its direction says, and the terms with j > 0 spread by a few percent.
#include "lambent/sky/compact_sky.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>

#include "lambent/sh/basis.h"
#include "lambent/sky/dome_quadrature.h"

namespace lambent::sky {
namespace {

constexpr int kMostPerSide = 10;

void evaluateCosines(int n, const Vec3d& direction, double* out) {
  const double zenith = std::acos(std::clamp(direction.y(), 0.0, 1.0));
  const double azimuth = std::atan2(direction.z(), direction.x());
  double across[kMostPerSide];
  for (int j = 0; j < n; ++j) {
    across[j] = std::cos(j * azimuth);
  }
  for (int i = 0; i < n; ++i) {
    const double down = std::cos(2 * i * zenith);
    for (int j = 0; j < n; ++j) {
      out[i * n + j] = down * across[j];
    }
  }
}

/// With the polar axis +y: z and −z of the sky are y and −y of the harmonics, so that skies have no
/// orders m < 0.
void evaluateHarmonics(int n, const Vec3d& d, double* out) {
  sh::evaluate(n, Vec3d(d.x(), -d.z(), d.y()), std::span<double>(out, size_t(n) * n));
}

void evaluateBasis(CompactBasis basis, int n, const Vec3d& direction, double* out) {
  if (basis == CompactBasis::Cosines) {
    evaluateCosines(n, direction, out);
  } else {
    evaluateHarmonics(n, direction, out);
  }
}

/// Which functions of a basis skies have, in rising sequence.
std::vector<int> evenFunctions(CompactBasis basis, int n) {
  std::vector<int> functions;
  if (basis == CompactBasis::Cosines) {
    for (int i = 0; i < n * n; ++i) functions.push_back(i);
    return functions;
  }
  for (int l = 0; l < n; ++l) {
    for (int m = 0; m <= l; ++m) functions.push_back(l * (l + 1) + m);
  }
  return functions;
}

using Samples = Eigen::Matrix<double, Eigen::Dynamic, 4>;

/// Least squares by solid angle. Harmonics of many bands are hardly independent on half of the
/// sphere: what the quadrature cannot tell apart gets the smallest coefficients.
Samples leastSquares(const Eigen::MatrixXd& basis, const Eigen::VectorXd& weights,
                     const Samples& sky) {
  const Eigen::MatrixXd gram = basis.transpose() * weights.asDiagonal() * basis;
  const Samples right = basis.transpose() * weights.asDiagonal() * sky;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> modes(gram);
  const double least = 1e-9 * modes.eigenvalues().maxCoeff();
  const Eigen::VectorXd inverse = modes.eigenvalues().unaryExpr(
      [least](double value) { return value > least ? 1 / value : 0.0; });
  return modes.eigenvectors() * (inverse.asDiagonal() * (modes.eigenvectors().transpose() * right));
}

}  // namespace

radiometry::Xyzv CompactSky::color(const Vec3d& direction) const {
  double functions[kMostPerSide * kMostPerSide];
  evaluateBasis(basis, n, direction, functions);
  radiometry::Xyzv sum = radiometry::Xyzv::Zero();
  for (size_t i = 0; i < coefficients.size(); ++i) {
    sum += functions[i] * coefficients[i];
  }
  return sum;
}

CompactSky compactSky(CompactBasis basis, int n, const SkyColor& sky) {
  CompactSky compact;
  compact.basis = basis;
  compact.n = std::clamp(n, 1, kMostPerSide);
  const int count = compact.n * compact.n;
  compact.coefficients.assign(size_t(count), radiometry::Xyzv::Zero());

  const DomeQuadrature dome = domeQuadrature(72, 72);
  const std::vector<int> functions = evenFunctions(basis, compact.n);
  const Eigen::Index rows = Eigen::Index(dome.directions.size());
  Eigen::MatrixXd values(rows, Eigen::Index(functions.size()));
  Eigen::VectorXd weights(rows);
  Samples samples(rows, 4);
  std::vector<double> all(size_t(count), 0.0);
  for (Eigen::Index row = 0; row < rows; ++row) {
    const Vec3d& direction = dome.directions[size_t(row)];
    weights[row] = dome.solidAngles[size_t(row)];
    samples.row(row) = sky(direction).matrix().transpose();
    evaluateBasis(basis, compact.n, direction, all.data());
    for (size_t k = 0; k < functions.size(); ++k) {
      values(row, Eigen::Index(k)) = all[size_t(functions[k])];
    }
  }

  Samples solution;
  if (basis == CompactBasis::Cosines || basis == CompactBasis::HarmonicsAbove) {
    solution = leastSquares(values, weights, samples);
  } else {
    solution = values.transpose() * weights.asDiagonal() * samples;
  }
  for (size_t k = 0; k < functions.size(); ++k) {
    radiometry::Xyzv& coefficient = compact.coefficients[size_t(functions[k])];
    coefficient = solution.row(Eigen::Index(k)).transpose().array();
    if (basis == CompactBasis::HarmonicsMirrored) {
      // A function with l + m even has the same integral below the horizon, another its negative.
      const int l = int(std::sqrt(double(functions[k])));
      const int m = functions[k] - l * (l + 1);
      coefficient *= (l + m) % 2 == 0 ? 2 : 0;
    }
  }
  return compact;
}

CompactSkyError errorOf(const CompactSky& compact, const SkyColor& sky) {
  const DomeQuadrature dome = domeQuadrature(61, 61);  // not those of the fit
  double squares = 0, level = 0, largest = 0;
  for (size_t i = 0; i < dome.directions.size(); ++i) {
    const double truth = sky(dome.directions[i])[1];
    const double difference = compact.color(dome.directions[i])[1] - truth;
    squares += dome.solidAngles[i] * difference * difference;
    level += dome.solidAngles[i] * truth * truth;
    largest = std::max(largest, std::abs(difference));
  }
  if (!(level > 0)) {
    return {};
  }
  return {std::sqrt(squares / level), largest / std::sqrt(level / (2 * kPi))};
}

}  // namespace lambent::sky
