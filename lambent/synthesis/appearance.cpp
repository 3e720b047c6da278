// This work is based on:
// - lefebvre2006appearance (§3): places are compared by the principal components of what they look
//   like, here of their whole response to light from every side.
// - halko2011finding (algorithms 4.4 and 5.1): the components by a randomised range finder with
//   power iterations, so that 4,800 numbers at each of 4,096 places take about a second and the
//   covariance is never formed.
// - dror2004statistical: the power of natural light falls as l⁻² over the bands.
#include "lambent/synthesis/appearance.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include <Eigen/Eigenvalues>
#include <Eigen/QR>

#include "lambent/math/directions.h"
#include "lambent/math/random.h"
#include "lambent/work/parallel_for.h"

namespace lambent::synthesis {
namespace {

using RowMatrix = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using Plane = Eigen::Map<const RowMatrix>;  ///< positions × (views · channels) of one coefficient

/// The responses as one matrix, positions × (coefficients · views · channels), each column weighted
/// and less its mean: never written down, only multiplied with.
class Responses {
 public:
  explicit Responses(const transfer::SimulatedRtt& rtt)
      : rows_(Eigen::Index(rtt.positionCount())), columns_(Eigen::Index(rtt.viewCount() * 3)) {
    const auto coefficients = std::size_t(rtt.bands) * std::size_t(rtt.bands);
    for (std::size_t c = 0; c < coefficients; ++c) {
      planes_.emplace_back(rtt.values.data() + c * rtt.planeSize(), rows_, columns_);
    }
    // A view counts as much as the surface seems large from there. The weights' squares sum to 1.
    Eigen::VectorXf views(columns_);
    for (int y = 0; y < rtt.views; ++y) {
      for (int x = 0; x < rtt.views; ++x) {
        const Vec2 u((float(x) + 0.5f) / float(rtt.views), (float(y) + 0.5f) / float(rtt.views));
        const float cosine = rtt.views == 1 ? 1.0f : math::hemisphereFromSquare(u).z();
        views.segment<3>(3 * (y * rtt.views + x)).setConstant(std::sqrt(std::max(cosine, 0.0f)));
      }
    }
    views.normalize();
    for (int l = 0; l < rtt.bands; ++l) {
      for (int m = -l; m <= l; ++m) weights_.push_back(views / float(std::max(l, 1)));
    }
    means_.resize(planes_.size());
    std::vector<double> variance(planes_.size(), 0.0);
    work::parallelFor(planes_.size(), [&](std::size_t c) {
      means_[c] = (planes_[c].cast<double>().colwise().mean().transpose()).cast<float>();
      for (Eigen::Index r = 0; r < rows_; ++r) {
        variance[c] += double(
            ((planes_[c].row(r).transpose() - means_[c]).cwiseProduct(weights_[c])).squaredNorm());
      }
    });
    for (double v : variance) variance_ += v;
  }

  Eigen::Index rows() const { return rows_; }
  Eigen::Index columns() const { return columns_ * Eigen::Index(planes_.size()); }
  double variance() const { return variance_; }  ///< summed over places

  /// This · right.
  Eigen::MatrixXf times(const Eigen::MatrixXf& right) const {
    Eigen::MatrixXf weighted = right;
    Eigen::RowVectorXf offset = Eigen::RowVectorXf::Zero(right.cols());
    for (std::size_t c = 0; c < planes_.size(); ++c) {
      auto block = weighted.middleRows(Eigen::Index(c) * columns_, columns_);
      block = weights_[c].asDiagonal() * block;
      offset += means_[c].transpose() * block;
    }
    Eigen::MatrixXf product(rows_, right.cols());
    constexpr Eigen::Index kRows = 256;
    work::parallelFor((rows_ + kRows - 1) / kRows, [&](Eigen::Index b) {
      const Eigen::Index first = b * kRows, count = std::min(kRows, rows_ - first);
      RowMatrix sum = RowMatrix::Zero(count, right.cols());
      for (std::size_t c = 0; c < planes_.size(); ++c) {
        sum.noalias() += planes_[c].middleRows(first, count) *
                         weighted.middleRows(Eigen::Index(c) * columns_, columns_);
      }
      product.middleRows(first, count) = sum.rowwise() - offset;
    });
    return product;
  }

  /// Thisᵀ · right.
  Eigen::MatrixXf transposeTimes(const Eigen::MatrixXf& right) const {
    Eigen::MatrixXf product(columns(), right.cols());
    const Eigen::RowVectorXf sums = right.colwise().sum();
    work::parallelFor(planes_.size(), [&](std::size_t c) {
      product.middleRows(Eigen::Index(c) * columns_, columns_) =
          weights_[c].asDiagonal() * (planes_[c].transpose() * right - means_[c] * sums);
    });
    return product;
  }

 private:
  Eigen::Index rows_, columns_;
  std::vector<Plane> planes_;
  std::vector<Eigen::VectorXf> weights_, means_;  ///< per coefficient, over views and channels
  double variance_ = 0.0;
};

Eigen::MatrixXf orthonormal(const Eigen::MatrixXf& m) {
  const Eigen::HouseholderQR<Eigen::MatrixXf> qr(m);
  return qr.householderQ() * Eigen::MatrixXf::Identity(m.rows(), m.cols());
}

}  // namespace

Appearance appearanceOf(const transfer::SimulatedRtt& rtt, int dimensions) {
  assert(dimensions >= 1 && rtt.width >= 1 && rtt.height >= 1 && rtt.views >= 1);
  assert(rtt.values.size() == rtt.planeSize() * std::size_t(rtt.bands) * std::size_t(rtt.bands));
  const Responses responses(rtt);
  Appearance appearance;
  appearance.width = rtt.width, appearance.height = rtt.height;
  appearance.dimensions = dimensions;
  appearance.values.assign(rtt.positionCount() * std::size_t(dimensions), 0.0f);
  if (!(responses.variance() > 0.0)) return appearance;  // all places look alike

  constexpr Eigen::Index kSurplus = 8;
  constexpr int kPowers = 2;
  const Eigen::Index width =
      std::min({Eigen::Index(dimensions) + kSurplus, responses.rows(), responses.columns()});
  Eigen::MatrixXf start(responses.columns(), width);
  for (Eigen::Index c = 0; c < width; ++c) {
    math::Random random(0xa99ea7u, std::uint64_t(c));
    for (Eigen::Index r = 0; r < start.rows(); ++r) start(r, c) = random.uniform() - 0.5f;
  }
  Eigen::MatrixXf range = orthonormal(responses.times(start));
  for (int i = 0; i < kPowers; ++i) {
    range = orthonormal(responses.times(orthonormal(responses.transposeTimes(range))));
  }
  // With responses ≈ range · rest, the left singular vectors times the singular values are
  // range · V √Λ, where rest · restᵀ = V Λ Vᵀ is small.
  const Eigen::MatrixXd rest = responses.transposeTimes(range).transpose().cast<double>();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(rest * rest.transpose());
  double kept = 0.0;
  for (Eigen::Index d = 0; d < std::min(Eigen::Index(dimensions), width); ++d) {
    const double value = std::max(eigen.eigenvalues()[width - 1 - d], 0.0);
    Eigen::VectorXf column = range * eigen.eigenvectors().col(width - 1 - d).cast<float>();
    Eigen::Index largest = 0;
    column.cwiseAbs().maxCoeff(&largest);  // an eigenvector's sign is arbitrary: fix it
    column *= float(column[largest] < 0.0f ? -std::sqrt(value) : std::sqrt(value));
    kept += value;
    for (Eigen::Index r = 0; r < column.size(); ++r) {
      appearance.values[std::size_t(r * dimensions + d)] = column[r];
    }
  }
  appearance.keptVariance = std::min(kept / responses.variance(), 1.0);
  return appearance;
}

}  // namespace lambent::synthesis
