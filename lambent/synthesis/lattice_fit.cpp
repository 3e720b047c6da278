#include "lambent/synthesis/lattice_fit.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "lambent/work/parallel_for.h"

namespace lambent::synthesis {
namespace {

using Complex = std::complex<double>;
using Vector = Eigen::VectorXcd;

}  // namespace

LatticeFit::LatticeFit(const Manifold& m, const CrossField& field, const LatticeCorners& corners,
                       std::uint32_t variables)
    : m_(m), field_(field), corners_(corners), variables_(variables) {
  const std::size_t triangles = field.direction.size();
  weights_.resize(3 * triangles);
  for (std::uint32_t h = 0; h < 3 * triangles; ++h) {
    if (m.vertexOfCorner[h] == kNone) continue;
    const auto& p = field.corners[h / 3];
    const std::size_t apex = Manifold::previous(h) % 3;
    const Complex angle = (p[Manifold::next(h) % 3] - p[apex]) * std::conj(p[h % 3] - p[apex]);
    const double cotangent = angle.real() / std::max(std::abs(angle.imag()), 1e-30);
    weights_[h] = std::clamp(0.5 * cotangent, 1.0 / 64.0, 64.0);
  }
}

template <class Visit>
void LatticeFit::eachEdge(const Visit& visit) const {
  JumpForm form;
  for (std::uint32_t h = 0; h < weights_.size(); ++h) {
    if (m_.vertexOfCorner[h] == kNone) continue;
    const LatticeCorner &a = corners_.of[h], &b = corners_.of[Manifold::next(h)];
    form.clear();
    if (!a.form.empty() || !b.form.empty()) form = sumOf(b.form, -1.0, a.form);
    visit(h, a, b, form);
  }
}

bool LatticeFit::factorise() {
  std::vector<Eigen::Triplet<Complex>> entries, columns;
  entries.reserve(4 * weights_.size() + corners_.unknowns);
  Eigen::MatrixXcd c = Eigen::MatrixXcd::Zero(variables_, variables_);
  double total = 0.0;
  eachEdge(
      [&](std::uint32_t h, const LatticeCorner& a, const LatticeCorner& b, const JumpForm& form) {
        const double w = weights_[h];
        total += w;
        if (a.unknown != kNone) entries.emplace_back(int(a.unknown), int(a.unknown), w);
        if (b.unknown != kNone) entries.emplace_back(int(b.unknown), int(b.unknown), w);
        if (a.unknown != kNone && b.unknown != kNone) {
          const Complex ba = -w * std::conj(b.factor) * a.factor;
          if (b.unknown > a.unknown)
            entries.emplace_back(int(b.unknown), int(a.unknown), ba);
          else if (b.unknown < a.unknown)
            entries.emplace_back(int(a.unknown), int(b.unknown), std::conj(ba));
          else
            entries.emplace_back(int(a.unknown), int(a.unknown), 2.0 * ba.real());
        }
        for (const auto& [j, factor] : form) {
          if (b.unknown != kNone)
            columns.emplace_back(int(b.unknown), int(j), w * std::conj(b.factor) * factor);
          if (a.unknown != kNone)
            columns.emplace_back(int(a.unknown), int(j), -w * std::conj(a.factor) * factor);
          for (const auto& [k, other] : form) c(k, j) += w * std::conj(other) * factor;
        }
      });
  const double little = 1e-9 * total / std::max(1u, corners_.unknowns);
  for (std::uint32_t i = 0; i < corners_.unknowns; ++i)
    entries.emplace_back(int(i), int(i), little);
  Matrix a(corners_.unknowns, corners_.unknowns);
  a.setFromTriplets(entries.begin(), entries.end());
  b_.resize(corners_.unknowns, variables_);
  b_.setFromTriplets(columns.begin(), columns.end());
  solver_.compute(a);
  if (solver_.info() != Eigen::Success) return false;
  if (variables_ == 0) return true;
  // S = C − Bᴴ A⁻¹ B, column by column.
  s_ = std::move(c);
  work::parallelFor(variables_, [&](std::size_t j) {
    const Vector x = solver_.solve(Vector(b_.col(Eigen::Index(j))));
    s_.col(Eigen::Index(j)) -= b_.adjoint() * x;
  });
  s_ = (0.5 * (s_ + s_.adjoint())).eval();
  s_.diagonal().array() += 1e-9 * s_.diagonal().real().mean();
  inverse_.compute(s_);
  return true;
}

void LatticeFit::rightSide(std::span<const Complex> turns, Vector& r, Vector& s) const {
  r = Vector::Zero(corners_.unknowns), s = Vector::Zero(variables_);
  eachEdge(
      [&](std::uint32_t h, const LatticeCorner& a, const LatticeCorner& b, const JumpForm& form) {
        const auto& p = field_.corners[h / 3];
        const Complex d = weights_[h] * turns[h / 3] * (p[Manifold::next(h) % 3] - p[h % 3]);
        if (b.unknown != kNone) r[b.unknown] += std::conj(b.factor) * d;
        if (a.unknown != kNone) r[a.unknown] -= std::conj(a.factor) * d;
        for (const auto& [j, factor] : form) s[j] += std::conj(factor) * d;
      });
}

Vector LatticeFit::jumps(const Vector& r, const Vector& s) const {
  if (variables_ == 0) return Vector();
  return inverse_.solve(s - b_.adjoint() * Vector(solver_.solve(r)));
}

Vector LatticeFit::places(const Vector& r, const Vector& jumps) const {
  return solver_.solve(variables_ == 0 ? r : Vector(r - b_ * jumps));
}

Complex LatticeFit::at(std::uint32_t corner, const Vector& z, const Vector& jumps) const {
  const LatticeCorner& c = corners_.of[corner];
  Complex sum = c.unknown == kNone ? Complex(0.0) : c.factor * z[c.unknown];
  for (const auto& [j, factor] : c.form) sum += factor * jumps[j];
  return sum;
}

}  // namespace lambent::synthesis
