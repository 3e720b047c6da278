// The least-squares fit of a lattice map to given turns of its triangles: sparse in places, dense in
// jumps.
#pragma once

#include <complex>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Dense>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include "lambent/synthesis/lattice_jumps.h"

namespace lambent::synthesis {

/// Σ w |z_b − z_a − d|² over the edges of all triangles, at its least: w cotangents, d the edge,
/// turned (liu2008local eq. 1). What it is made of must outlive it.
class LatticeFit {
 public:
  LatticeFit(const Manifold& manifold, const CrossField& field, const LatticeCorners& corners,
             std::uint32_t variables);

  /// To be called first. False where there is no memory.
  bool factorise();
  /// The right side for triangles that are to be turned by `turns`: Z's and τ's.
  void rightSide(std::span<const std::complex<double>> turns, Eigen::VectorXcd& r,
                 Eigen::VectorXcd& s) const;
  /// The best jumps.
  Eigen::VectorXcd jumps(const Eigen::VectorXcd& r, const Eigen::VectorXcd& s) const;
  /// What jumps cost, with the best places for each: a quadratic form.
  const Eigen::MatrixXcd& schur() const { return s_; }
  /// The best places with these jumps.
  Eigen::VectorXcd places(const Eigen::VectorXcd& r, const Eigen::VectorXcd& jumps) const;
  /// z of a corner.
  std::complex<double> at(std::uint32_t corner, const Eigen::VectorXcd& z,
                          const Eigen::VectorXcd& jumps) const;

 private:
  using Matrix = Eigen::SparseMatrix<std::complex<double>>;

  template <class Visit>
  void eachEdge(const Visit& visit) const;

  const Manifold& m_;
  const CrossField& field_;
  const LatticeCorners& corners_;
  std::uint32_t variables_;
  std::vector<double> weights_;           ///< per half-edge: cotangents
  Eigen::SimplicialLDLT<Matrix> solver_;  ///< of A
  Matrix b_;
  Eigen::MatrixXcd s_;
  Eigen::LLT<Eigen::MatrixXcd> inverse_;  ///< of S
};

}  // namespace lambent::synthesis
