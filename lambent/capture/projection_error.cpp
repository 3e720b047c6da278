// This work is based on:
// - sloan2002precomputed: §6.2 and its footnote 1: "average-case error is the integrated squared
//   difference between the reference and reconstruction signals, averaged over all unit-power
//   signals", and "the same integrated error, but for the worst-case unit-power signal".
//
// A function with coefficients a comes out as M a instead of R a. Over all a of length 1 the mean
// of |(M − R) a|² is the sum of the squared entries of M − R over the number of its columns; its
// maximum is the square of the largest singular value.
#include "lambent/capture/projection_error.h"

#include <algorithm>

#include <Eigen/Dense>

#include "lambent/math/quadrature.h"
#include "lambent/sh/basis.h"

namespace lambent::capture {
namespace {

using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// gram = (M − R)ᵀ (M − R).
ProjectionError fromGram(const Eigen::MatrixXd& gram) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(gram, Eigen::EigenvaluesOnly);
  return {gram.trace() / double(gram.cols()), solver.eigenvalues().maxCoeff()};
}

/// Row after row the basis functions, averaged over the samples of each texel.
Rows sampledBasis(const CubeSize& shape, int bands) {
  Rows samples = Rows::Zero(shape.texels(), sh::coefficientCount(bands));
  Eigen::RowVectorXd y(samples.cols());
  const double share = 1.0 / (shape.supersampling * shape.supersampling);
  forAllSubTexels(shape, [&](std::size_t texel, std::size_t, const Vec3d& direction, double) {
    sh::evaluate(bands, direction, std::span<double>(y.data(), std::size_t(y.size())));
    samples.row(Eigen::Index(texel)) += share * y;
  });
  return samples;
}

Rows weightRows(const CubeSize& shape, int bands, SolidAngles angles) {
  const std::vector<double> weights = cubeWeights(shape, bands, angles);
  return Eigen::Map<const Rows>(weights.data(), shape.texels(), sh::coefficientCount(bands));
}

/// Four texels of a face and what each counts for at a place of it.
struct Bilinear {
  std::array<Eigen::Index, 4> texel;
  std::array<double, 4> weight;

  Bilinear(int size, int face, double s, double t) {
    const double x = std::clamp(s * size - 0.5, 0.0, size - 1.0);
    const double y = std::clamp(t * size - 0.5, 0.0, size - 1.0);
    const int i = std::clamp(int(x), 0, std::max(size - 2, 0));
    const int j = std::clamp(int(y), 0, std::max(size - 2, 0));
    const int right = std::min(i + 1, size - 1), above = std::min(j + 1, size - 1);
    const double u = x - i, v = y - j;
    const auto at = [&](int column, int row) {
      return Eigen::Index((face * size + row) * size + column);
    };
    texel = {at(i, j), at(right, j), at(i, above), at(right, above)};
    weight = {(1 - u) * (1 - v), u * (1 - v), (1 - u) * v, u * v};
  }
};

}  // namespace

ProjectionError projectionError(const CubeSize& shape, int bands, SolidAngles angles) {
  const Rows samples = sampledBasis(shape, bands);
  const Eigen::MatrixXd difference = weightRows(shape, bands, angles).transpose() * samples -
                                     Eigen::MatrixXd::Identity(samples.cols(), samples.cols());
  return fromGram(difference.transpose() * difference);
}

BilinearErrors bilinearErrors(int size, int bands) {
  const CubeSize shape{size, 1};
  const Rows samples = sampledBasis(shape, bands);
  const Eigen::Index count = samples.cols();
  Rows exact = Rows::Zero(samples.rows(), count);  // ∫ y · (the hat of a texel) ds
  Eigen::MatrixXd whole = Eigen::MatrixXd::Zero(count, count);
  Eigen::VectorXd y(count), missing(count);
  // The reconstruction is smooth on cells of half a texel.
  const int cells = 2 * size;
  const math::Quadrature rule = math::gaussLegendre(4, 0, 1);
  for (int face = 0; face < 6; ++face)
    for (int cell = 0; cell < cells * cells; ++cell)
      for (std::size_t k = 0; k < rule.nodes.size() * rule.nodes.size(); ++k) {
        const std::size_t a = k % rule.nodes.size(), b = k / rule.nodes.size();
        const double s = (cell % cells + rule.nodes[a]) / cells;
        const double t = (cell / cells + rule.nodes[b]) / cells;
        const Vec3d direction = cubeDirection(face, s, t);
        const double angle = rule.weights[a] * rule.weights[b] * 4 / (double(cells) * cells) *
                             std::pow(direction.cwiseAbs().maxCoeff(), 3);
        sh::evaluate(bands, direction, std::span<double>(y.data(), std::size_t(count)));
        const Bilinear place(size, face, s, t);
        missing = -y;
        for (int corner = 0; corner < 4; ++corner) {
          exact.row(place.texel[corner]) += angle * place.weight[corner] * y.transpose();
          missing += place.weight[corner] * samples.row(place.texel[corner]).transpose();
        }
        whole.selfadjointView<Eigen::Lower>().rankUpdate(missing, angle);
      }
  const Eigen::MatrixXd difference =
      (weightRows(shape, bands, SolidAngles::Differential) - exact).transpose() * samples;
  whole.triangularView<Eigen::StrictlyUpper>() = whole.transpose();
  return {fromGram(difference.transpose() * difference), fromGram(whole)};
}

}  // namespace lambent::capture
