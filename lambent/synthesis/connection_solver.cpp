// This work is based on:
// - vanek1996algebraic: aggregates of neighbouring unknowns make a coarse problem without any mesh;
//   here an aggregate is a tangent carried from its root over the edges to all its vertices.
// - saad2003iterative (§9.2): conjugate gradients, preconditioned by the coarse problem's solution
//   plus the diagonal's.
//
// A factor of the matrix of 650,000 vertices takes 1.5 GB and minutes; this takes seconds.
#include "lambent/synthesis/connection_solver.h"

#include <cassert>
#include <cmath>
#include <vector>

namespace lambent::synthesis {
namespace {

constexpr std::size_t kAggregate = 24;  ///< vertices at most
constexpr int kIterations = 1000;

}  // namespace

ConnectionSolver::ConnectionSolver(const Matrix& lower, Eigen::Index largestDirect)
    : direct_(lower.rows() <= largestDirect) {
  if (direct_) {
    factor_.compute(lower);
    return;
  }
  full_ = lower.selfadjointView<Eigen::Lower>();
  inverseDiagonal_ = full_.diagonal().real().cwiseInverse();
  aggregate();
  std::vector<Eigen::Triplet<Complex>> entries;
  entries.reserve(std::size_t(full_.nonZeros()));
  for (Eigen::Index i = 0; i < full_.cols(); ++i) {
    for (Matrix::InnerIterator e(full_, i); e; ++e) {
      const Eigen::Index a = aggregateOf_[std::size_t(e.row())], b = aggregateOf_[std::size_t(i)];
      if (a < b) continue;  // the lower triangle will do
      entries.emplace_back(int(a), int(b), std::conj(turn_[e.row()]) * e.value() * turn_[i]);
    }
  }
  Matrix coarse(aggregates_, aggregates_);
  coarse.setFromTriplets(entries.begin(), entries.end());
  factor_.compute(coarse);
}

void ConnectionSolver::aggregate() {
  aggregateOf_.assign(std::size_t(full_.rows()), -1);
  turn_.resize(full_.rows());
  std::vector<Eigen::Index> members;
  for (Eigen::Index root = 0; root < full_.rows(); ++root) {
    if (aggregateOf_[std::size_t(root)] >= 0) continue;
    members.assign(1, root);
    aggregateOf_[std::size_t(root)] = aggregates_;
    turn_[root] = 1.0;
    for (std::size_t m = 0; m < members.size() && members.size() < kAggregate; ++m) {
      const Eigen::Index i = members[m];
      for (Matrix::InnerIterator e(full_, i); e && members.size() < kAggregate; ++e) {
        const Eigen::Index j = e.row();
        const double size = std::abs(e.value());
        if (j == i || size == 0.0 || aggregateOf_[std::size_t(j)] >= 0) continue;
        aggregateOf_[std::size_t(j)] = aggregates_;
        turn_[j] = -e.value() / size * turn_[i];
        members.push_back(j);
      }
    }
    ++aggregates_;
  }
}

ConnectionSolver::Field ConnectionSolver::precondition(const Field& r) const {
  Field coarse = Field::Zero(aggregates_);
  for (Eigen::Index i = 0; i < r.size(); ++i) {
    coarse[aggregateOf_[std::size_t(i)]] += std::conj(turn_[i]) * r[i];
  }
  coarse = factor_.solve(coarse);
  Field z(r.size());
  for (Eigen::Index i = 0; i < r.size(); ++i) {
    z[i] = inverseDiagonal_[i] * r[i] + turn_[i] * coarse[aggregateOf_[std::size_t(i)]];
  }
  return z;
}

ConnectionSolver::Field ConnectionSolver::solve(const Field& b, const Field& guess,
                                                double tolerance) const {
  if (direct_) return factor_.solve(b);
  Field x = guess, r = b - full_ * x;
  Field z = precondition(r), p = z;
  double rz = r.dot(z).real();
  const double enough = tolerance * b.norm();
  for (int i = 0; i < kIterations && r.norm() > enough; ++i) {
    const Field ap = full_ * p;
    const double alpha = rz / p.dot(ap).real();
    x += alpha * p;
    r -= alpha * ap;
    z = precondition(r);
    const double last = rz;
    rz = r.dot(z).real();
    p = z + (rz / last) * p;
  }
  return x;
}

}  // namespace lambent::synthesis
