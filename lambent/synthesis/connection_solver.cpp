// This work is based on:
// - vanek1996algebraic: aggregates of neighbouring unknowns make a coarse problem without any mesh,
//   and a step of Jacobi's iteration smooths what leads there and back (§2-3); here an aggregate is
//   a tangent carried from its first vertex over the edges to all others.
// - saad2003iterative (§9.2, §13.5): conjugate gradients, preconditioned by one cycle of multigrid.
//
// A factor of the matrix of 650,000 vertices takes 1.5 GB and minutes; this takes seconds.
#include "lambent/synthesis/connection_solver.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "lambent/work/parallel_for.h"

namespace lambent::synthesis {
namespace {

using Complex = ConnectionSolver::Complex;
using Field = ConnectionSolver::Field;

constexpr std::size_t kAggregate = 24;  ///< vertices at most
constexpr int kIterations = 1000;

/// matrix · x, rows on all threads.
template <class Rows>
Field product(const Rows& matrix, const Field& x) {
  constexpr std::size_t kGrain = 4096;
  Field y(matrix.rows());
  work::parallelRanges(matrix.rows(), kGrain, [&](Eigen::Index begin, Eigen::Index end) {
    for (Eigen::Index i = begin; i < end; ++i) {
      Complex sum = 0.0;
      for (typename Rows::InnerIterator e(matrix, i); e; ++e) sum += e.value() * x[e.col()];
      y[i] = sum;
    }
  });
  return y;
}

}  // namespace

ConnectionSolver::ConnectionSolver(const Matrix& lower, Eigen::Index largestDirect) {
  if (lower.rows() <= largestDirect) {
    factor_.compute(lower);
    return;
  }
  full_ = Matrix(lower.selfadjointView<Eigen::Lower>());
  coarsen(largestDirect);
}

ConnectionSolver::Aggregates ConnectionSolver::aggregates() const {
  constexpr std::size_t kFree = std::size_t(-1);
  Aggregates made{std::vector<std::size_t>(std::size_t(full_.rows()), kFree), Field(full_.rows())};
  std::vector<Eigen::Index> members;
  for (Eigen::Index first = 0; first < full_.rows(); ++first) {
    if (made.of[std::size_t(first)] != kFree) continue;
    members.assign(1, first);
    made.of[std::size_t(first)] = made.count;
    made.turn[first] = 1.0;
    for (std::size_t m = 0; m < members.size() && members.size() < kAggregate; ++m) {
      const Eigen::Index i = members[m];
      for (Rows::InnerIterator e(full_, i); e && members.size() < kAggregate; ++e) {
        const Eigen::Index j = e.col();
        const double size = std::abs(e.value());
        if (j == i || size == 0.0 || made.of[std::size_t(j)] != kFree) continue;
        made.of[std::size_t(j)] = made.count;
        made.turn[j] = -std::conj(e.value()) / size * made.turn[i];
        members.push_back(j);
      }
    }
    ++made.count;
  }
  return made;
}

void ConnectionSolver::coarsen(Eigen::Index largestDirect) {
  // Above the largest eigenvalue of the matrix over its diagonal (Gershgorin); 4/3 of its inverse
  // damps the upper half of the spectrum best.
  double most = 1.0;
  Field inverse(full_.rows());
  for (Eigen::Index i = 0; i < full_.rows(); ++i) {
    double sum = 0.0, diagonal = 0.0;
    for (Rows::InnerIterator e(full_, i); e; ++e) {
      sum += std::abs(e.value());
      if (e.col() == i) diagonal = e.value().real();
    }
    inverse[i] = 1.0 / diagonal;
    most = std::max(most, sum / diagonal);
  }
  damped_ = 4.0 / (3.0 * most) * inverse;

  const Aggregates from = aggregates();
  Rows tentative(full_.rows(), Eigen::Index(from.count));
  tentative.reserve(Eigen::VectorXi::Ones(full_.rows()));
  for (Eigen::Index i = 0; i < full_.rows(); ++i)
    tentative.insert(i, Eigen::Index(from.of[std::size_t(i)])) = from.turn[i];
  prolong_ = tentative - Rows(damped_.asDiagonal() * Rows(full_ * tentative));
  restrict_ = prolong_.adjoint();
  const Matrix coarse = restrict_ * Rows(full_ * prolong_);
  coarse_ = std::make_unique<ConnectionSolver>(Matrix(coarse.triangularView<Eigen::Lower>()),
                                               largestDirect);
}

ConnectionSolver::Field ConnectionSolver::roughly(const Field& b) const {
  if (!coarse_) return factor_.solve(b);
  Field x = damped_.cwiseProduct(b);
  x += product(prolong_, coarse_->roughly(product(restrict_, b - product(full_, x))));
  return x + damped_.cwiseProduct(b - product(full_, x));
}

ConnectionSolver::Field ConnectionSolver::solve(const Field& b, const Field& guess,
                                                double tolerance, double reduction) const {
  if (!coarse_) return factor_.solve(b);
  Field x = guess, r = b - product(full_, x);
  Field z = roughly(r), p = z;
  double rz = r.dot(z).real();
  const double enough = std::max(tolerance * b.norm(), reduction * r.norm());
  for (int i = 0; i < kIterations && r.norm() > enough; ++i) {
    const Field ap = product(full_, p);
    const double alpha = rz / p.dot(ap).real();
    x += alpha * p;
    r -= alpha * ap;
    z = roughly(r);
    const double last = rz;
    rz = r.dot(z).real();
    p = z + (rz / last) * p;
  }
  return x;
}

}  // namespace lambent::synthesis
