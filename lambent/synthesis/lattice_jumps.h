// How the places of a patch that is laid as a lattice jump over the edges of triangles.
//
// Places are complex numbers z in metres, in the directions of the triangle where they are seen.
// Over half-edge h they become i^k z + t, k the field's matching. On the edges of a spanning tree of
// triangles t is 0. On the others it is a sum of variables τ with factors 1, i, −1, −i: there is one
// variable for every loop about a singularity, border or handle, and around every other vertex the
// sum has to vanish, which makes all t of the edges there depend on these. Whoever takes τ from a
// lattice that quarter turns leave as it is takes all t from it.
#pragma once

#include <algorithm>
#include <complex>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "lambent/synthesis/cross_field.h"
#include "lambent/synthesis/manifold.h"

namespace lambent::synthesis {

/// A sum of variables with factors, sorted by variable.
using JumpForm = std::vector<std::pair<std::uint32_t, std::complex<double>>>;

/// a + factor · b
JumpForm sumOf(const JumpForm& a, const std::complex<double>& factor, const JumpForm& b);

/// How places jump over edges: forms of variables that are free to be any vectors of a lattice.
class LatticeJumps {
 public:
  LatticeJumps(const Manifold& m, const CrossField& field,
               std::span<const std::uint32_t> chartOfTriangle);

  std::uint32_t variables() const { return variables_; }
  int turns(std::uint32_t h) const { return field_.matching[h]; }
  /// t over half-edge h, in the directions of the triangle beyond.
  JumpForm over(std::uint32_t h) const {
    const std::uint32_t twin = m_.twin[h];
    if (h < twin) return forms_[h];
    return sumOf({}, -quarterTurns(turns(h)), forms_[twin]);
  }
  bool crossesTree(std::uint32_t h) const { return !cut_[std::min(h, m_.twin[h])]; }
  bool singular(std::uint32_t vertex) const { return singular_[vertex]; }

 private:
  void findTree(std::span<const std::uint32_t> chartOfTriangle);
  void relate();
  void close(std::uint32_t vertex, std::uint32_t parentEdge);

  const Manifold& m_;
  const CrossField& field_;
  std::vector<bool> cut_;        ///< per half-edge, the lesser of two: not crossed by the tree
  std::vector<JumpForm> forms_;  ///< per half-edge, the lesser of two
  std::vector<bool> singular_;
  std::uint32_t variables_ = 0;
};

/// z of a corner: factor · Z[unknown] + form · τ; of a singular vertex the form alone.
struct LatticeCorner {
  std::uint32_t unknown = kNone;
  std::complex<double> factor = 1.0;
  JumpForm form;
};

struct LatticeCorners {
  std::vector<LatticeCorner> of;
  std::uint32_t unknowns = 0;
};

LatticeCorners cornersOf(const Manifold& manifold, const LatticeJumps& jumps);

}  // namespace lambent::synthesis
