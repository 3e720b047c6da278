// Jumps of a lattice map made whole: the closest vector of a lattice, nearly.
#pragma once

#include <array>
#include <complex>

#include <Eigen/Core>

namespace lambent::synthesis {

/// The vectors of the lattice with `basis` (metres), one for each jump, that cost least beyond the
/// jumps `best`: (x − best)ᴴ S (x − best), S the `schur` complement. Not the least of all, which is
/// hard to find: whole numbers one after the other, the one that costs least first, each time with
/// the best of the rest (babai1986lovasz; of many, several at a time); then every single step that
/// betters the whole.
Eigen::VectorXcd wholeJumps(const Eigen::MatrixXcd& schur, const Eigen::VectorXcd& best,
                            const std::array<std::complex<double>, 2>& basis);

}  // namespace lambent::synthesis
