// This work is based on:
// - bommes2009mixed, bommes2013integer: a map whose jumps over cuts are quarter turns and whole
//   translations shows a periodic texture without a seam; it is the least-squares fit to a field,
//   with some numbers whole.
// - liu2008local: as rigid as possible, by turns of a rotation for each triangle and one linear
//   solve with an unchanging matrix.
// - babai1986lovasz: whole numbers one after the other, each conditional on those before.
//
// As the code spells it: places are complex numbers z in metres, in the directions of the triangle
// where they are seen. Over half-edge h they become i^k z + t, k the field's matching. On the edges
// of a spanning tree of triangles t is 0. On the others it is a sum of variables τ with factors
// 1, i, −1, −i: there is one variable for every loop about a singularity, border or handle, and
// around every other vertex the sum has to vanish, which makes all t of the edges there depend on
// these. Whoever takes τ from the lattice of the patch takes all t from it.
//
// Where we deviate: τ is eliminated from the system by a Schur complement, so that whole numbers
// are found in a small dense problem, at one back substitution for each τ, rather than by solving
// the sparse one anew after each of them. Of a large system the complement is a rough one, which
// costs little more: then it leads to the best τ in several steps rather than at once.
#include "lambent/synthesis/lattice_map.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <complex>
#include <numeric>
#include <optional>
#include <vector>

#include <Eigen/Dense>
#include <Eigen/SparseCore>

#include "lambent/scene/shapes.h"
#include "lambent/synthesis/connection_solver.h"
#include "lambent/synthesis/frames.h"
#include "lambent/work/parallel_for.h"

namespace lambent::synthesis {
namespace {

using Complex = std::complex<double>;
using Vector = Eigen::VectorXcd;
using Vec2d = Eigen::Vector2d;

/// A sum of variables with factors, sorted by variable.
using Form = std::vector<std::pair<std::uint32_t, Complex>>;

/// a + factor · b
Form sum(const Form& a, const Complex& factor, const Form& b) {
  Form out;
  out.reserve(a.size() + b.size());
  for (std::size_t i = 0, j = 0; i < a.size() || j < b.size();) {
    if (j == b.size() || (i < a.size() && a[i].first < b[j].first)) {
      out.push_back(a[i++]);
    } else if (i == a.size() || b[j].first < a[i].first) {
      out.emplace_back(b[j].first, factor * b[j].second), ++j;
    } else {
      const Complex both = a[i].second + factor * b[j].second;
      if (std::abs(both) > 1e-9) out.emplace_back(a[i].first, both);
      ++i, ++j;
    }
  }
  return out;
}

/// How places jump over edges: forms of variables that are free to be any vectors of a lattice.
class Jumps {
 public:
  Jumps(const Manifold& m, const CrossField& field, std::span<const std::uint32_t> chartOfTriangle);

  std::uint32_t variables() const { return variables_; }
  int turns(std::uint32_t h) const { return field_.matching[h]; }
  /// t over half-edge h, in the directions of the triangle beyond.
  Form over(std::uint32_t h) const {
    const std::uint32_t twin = m_.twin[h];
    if (h < twin) return forms_[h];
    return sum({}, -quarterTurns(turns(h)), forms_[twin]);
  }
  bool crossesTree(std::uint32_t h) const { return !cut_[std::min(h, m_.twin[h])]; }
  bool singular(std::uint32_t vertex) const { return singular_[vertex]; }

 private:
  void findTree(std::span<const std::uint32_t> chartOfTriangle);
  void relate();
  void close(std::uint32_t vertex, std::uint32_t parentEdge);

  const Manifold& m_;
  const CrossField& field_;
  std::vector<bool> cut_;    ///< per half-edge, the lesser of two: not crossed by the tree
  std::vector<Form> forms_;  ///< per half-edge, the lesser of two
  std::vector<bool> singular_;
  std::uint32_t variables_ = 0;
};

std::uint32_t rootOf(std::vector<std::uint32_t>& parent, std::uint32_t v) {
  while (parent[v] != v) v = parent[v] = parent[parent[v]];
  return v;
}

Jumps::Jumps(const Manifold& m, const CrossField& field,
             std::span<const std::uint32_t> chartOfTriangle)
    : m_(m), field_(field) {
  singular_.assign(m.vertexCount(), false);
  for (const CrossField::Singularity& s : field.singularities) singular_[s.vertex] = true;
  findTree(chartOfTriangle);
  relate();
}

/// A spanning tree of triangles, within charts first: inside of them places go on.
void Jumps::findTree(std::span<const std::uint32_t> chartOfTriangle) {
  const auto count = std::uint32_t(m_.twin.size());
  cut_.assign(count, false);
  std::vector<std::uint32_t> parent(count / 3);
  std::iota(parent.begin(), parent.end(), 0u);
  for (int round = 0; round < 3; ++round) {
    for (std::uint32_t h = 0; h < count; ++h) {
      const std::uint32_t twin = m_.twin[h];
      if (twin == kNone || twin < h || m_.vertexOfCorner[h] == kNone) continue;
      const bool same = chartOfTriangle[h / 3] == chartOfTriangle[twin / 3];
      if (round != (same ? (field_.matching[h] == 0 ? 0 : 2) : 1)) continue;
      const std::uint32_t a = rootOf(parent, h / 3), b = rootOf(parent, twin / 3);
      if (a == b) {
        cut_[h] = true;
      } else {
        parent[std::max(a, b)] = std::min(a, b);
      }
    }
  }
}

void Jumps::relate() {
  const auto count = std::uint32_t(m_.twin.size());
  forms_.assign(count, {});
  // Every border is one node: what goes round it is free.
  std::vector<std::uint32_t> node(m_.vertexCount());
  std::iota(node.begin(), node.end(), 0u);
  std::vector<bool> atBorder(m_.vertexCount(), false);
  for (std::uint32_t h = 0; h < count; ++h) {
    if (m_.vertexOfCorner[h] == kNone || m_.twin[h] != kNone) continue;
    const std::uint32_t a = m_.vertexOfCorner[h], b = m_.vertexOfCorner[Manifold::next(h)];
    atBorder[a] = atBorder[b] = true;
    const std::uint32_t x = rootOf(node, a), y = rootOf(node, b);
    node[std::max(x, y)] = std::min(x, y);
  }
  std::vector<bool> isFree(m_.vertexCount(), false);  // nodes
  for (std::uint32_t v = 0; v < m_.vertexCount(); ++v)
    if (atBorder[v] || singular_[v]) isFree[rootOf(node, v)] = true;

  // The cut edges about each node.
  std::vector<std::uint32_t> begin(m_.vertexCount() + 1, 0), edges;
  const auto eachCut = [&](const auto& visit) {
    for (std::uint32_t h = 0; h < count; ++h)
      if (cut_[h]) {
        visit(h, rootOf(node, m_.vertexOfCorner[h]));
        visit(h, rootOf(node, m_.vertexOfCorner[Manifold::next(h)]));
      }
  };
  eachCut([&](std::uint32_t, std::uint32_t v) { ++begin[v + 1]; });
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  edges.resize(begin.back());
  std::vector<std::uint32_t> at(begin.begin(), begin.end() - 1);
  eachCut([&](std::uint32_t h, std::uint32_t v) { edges[at[v]++] = h; });

  // A spanning tree of the nodes over these edges, from a free node if there is one.
  std::vector<std::uint32_t> order, parentEdge(m_.vertexCount(), kNone);
  std::vector<bool> reached(m_.vertexCount(), false), inTree(count, false);
  const auto growFrom = [&](std::uint32_t first) {
    if (rootOf(node, first) != first || reached[first]) return;
    reached[first] = true;
    order.push_back(first);
    for (std::size_t i = order.size() - 1; i < order.size(); ++i) {
      const std::uint32_t v = order[i];
      for (std::uint32_t e = begin[v]; e < begin[v + 1]; ++e) {
        const std::uint32_t h = edges[e];
        std::uint32_t other = rootOf(node, m_.vertexOfCorner[h]);
        if (other == v) other = rootOf(node, m_.vertexOfCorner[Manifold::next(h)]);
        if (reached[other]) continue;
        reached[other] = true, inTree[h] = true;
        parentEdge[other] = h;
        order.push_back(other);
      }
    }
  };
  for (std::uint32_t v = 0; v < m_.vertexCount(); ++v)
    if (isFree[v]) growFrom(v);
  for (std::uint32_t v = 0; v < m_.vertexCount(); ++v) growFrom(v);

  for (std::uint32_t h = 0; h < count; ++h)
    if (cut_[h] && !inTree[h]) forms_[h] = {{variables_++, 1.0}};
  for (std::size_t i = order.size(); i-- > 0;) {
    const std::uint32_t v = order[i];
    if (parentEdge[v] == kNone) continue;
    if (isFree[v]) {
      forms_[parentEdge[v]] = {{variables_++, 1.0}};
    } else {
      close(v, parentEdge[v]);
    }
  }
}

/// Sets t of one edge so that places come back to themselves around the vertex.
void Jumps::close(std::uint32_t vertex, std::uint32_t parentEdge) {
  Form total;     // of all other edges, as seen after the last
  int after = 0;  // quarter turns since the parent edge was crossed
  bool backwards = false, crossed = false;
  std::uint32_t c = m_.firstCorner[vertex];
  do {
    const std::uint32_t h = Manifold::previous(c), twin = m_.twin[h];
    total = sum({}, quarterTurns(turns(h)), total);
    if (crossed) after += turns(h);
    if (std::min(h, twin) == parentEdge) {
      crossed = true, after = 0, backwards = h != parentEdge;
    } else if (!crossesTree(h)) {
      total = sum(total, 1.0, over(h));
    }
    c = m_.turnLeft(c);
  } while (c != m_.firstCorner[vertex]);
  assert(crossed);
  // i^after · t + total = 0
  Form t = sum({}, -quarterTurns(-after), total);
  if (backwards) t = sum({}, -quarterTurns(turns(parentEdge)), t);
  forms_[parentEdge] = std::move(t);
}

/// z of a corner: factor · Z[unknown] + form · τ; of a singular vertex the form alone.
struct Corner {
  std::uint32_t unknown = kNone;
  Complex factor = 1.0;
  Form form;
};

struct Corners {
  std::vector<Corner> of;
  std::uint32_t unknowns = 0;
};

Corners cornersOf(const Manifold& m, const Jumps& jumps) {
  Corners corners;
  corners.of.resize(m.twin.size());
  for (std::uint32_t v = 0; v < m.vertexCount(); ++v) {
    const std::uint32_t first = m.firstCorner[v];
    int turns = 0;
    Form form;
    std::uint32_t c = first;
    bool closed = false;
    do {
      Corner& corner = corners.of[c];
      corner.unknown = corners.unknowns;
      corner.factor = quarterTurns(turns);
      corner.form = form;
      const std::uint32_t h = Manifold::previous(c);
      if (m.twin[h] != kNone) {
        turns = (turns + jumps.turns(h)) & 3;
        form = sum({}, quarterTurns(jumps.turns(h)), form);
        if (!jumps.crossesTree(h)) form = sum(form, 1.0, jumps.over(h));
      }
      c = m.turnLeft(c);
      closed = c == first;
    } while (c != kNone && !closed);
    if (closed && turns != 0) {
      // (1 − i^k) Z = what the loop adds: the one place that the turn leaves where it is.
      const Complex scale = 1.0 / (1.0 - quarterTurns(turns));
      c = first;
      do {
        Corner& corner = corners.of[c];
        corner.form = sum(corner.form, corner.factor * scale, form);
        corner.unknown = kNone;
        c = m.turnLeft(c);
      } while (c != first);
      continue;
    }
    ++corners.unknowns;
    if (closed && (!form.empty() || jumps.singular(v))) {
      // No place would do for all around it: each triangle has its own.
      for (c = m.turnLeft(first); c != first; c = m.turnLeft(c))
        corners.of[c].unknown = corners.unknowns++;
    }
  }
  return corners;
}

/// The fit: Σ w |z_b − z_a − d|² over the edges of all triangles.
class System {
 public:
  System(const Manifold& m, const CrossField& field, const Corners& corners,
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

  /// False where there is no memory.
  bool factorise() {
    std::vector<Eigen::Triplet<Complex>> entries, columns;
    entries.reserve(4 * weights_.size() + corners_.unknowns);
    Eigen::MatrixXcd c = Eigen::MatrixXcd::Zero(variables_, variables_);
    double total = 0.0;
    eachEdge([&](std::uint32_t h, const Corner& a, const Corner& b, const Form& form) {
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
    ConnectionSolver::Matrix a(corners_.unknowns, corners_.unknowns);
    a.setFromTriplets(entries.begin(), entries.end());
    b_.resize(corners_.unknowns, variables_);
    b_.setFromTriplets(columns.begin(), columns.end());
    solver_.emplace(a);
    if (!solver_->ok()) return false;
    if (variables_ == 0) return true;
    // S = C − Bᴴ A⁻¹ B, column by column.
    c_ = std::move(c), s_ = c_;
    work::parallelFor(variables_, [&](std::size_t j) {
      const Vector x = solver_->roughly(Vector(b_.col(Eigen::Index(j))));
      s_.col(Eigen::Index(j)) -= b_.adjoint() * x;
    });
    s_ = (0.5 * (s_ + s_.adjoint())).eval();
    s_.diagonal().array() += 1e-9 * s_.diagonal().real().mean();
    inverse_.compute(s_);
    return true;
  }

  /// The right side for triangles that are to be turned by `turns`: Z's and τ's.
  void rightSide(std::span<const Complex> turns, Vector& r, Vector& s) const {
    r = Vector::Zero(corners_.unknowns), s = Vector::Zero(variables_);
    eachEdge([&](std::uint32_t h, const Corner& a, const Corner& b, const Form& form) {
      const auto& p = field_.corners[h / 3];
      const Complex d = weights_[h] * turns[h / 3] * (p[Manifold::next(h) % 3] - p[h % 3]);
      if (b.unknown != kNone) r[b.unknown] += std::conj(b.factor) * d;
      if (a.unknown != kNone) r[a.unknown] -= std::conj(a.factor) * d;
      for (const auto& [j, factor] : form) s[j] += std::conj(factor) * d;
    });
  }
  /// A step from jumps, and the places that are best with them, to the best jumps.
  Vector better(const Vector& jumps, const Vector& z, const Vector& s) const {
    return variables_ == 0 ? jumps
                           : Vector(jumps + inverse_.solve(s - b_.adjoint() * z - c_ * jumps));
  }
  const Eigen::MatrixXcd& schur() const { return s_; }
  /// The best places with these jumps; `guess` is near them.
  Vector places(const Vector& r, const Vector& jumps, const Vector& guess) const {
    return solver_->solve(variables_ == 0 ? r : Vector(r - b_ * jumps), guess, 1e-4);
  }
  Complex at(std::uint32_t corner, const Vector& z, const Vector& jumps) const {
    const Corner& c = corners_.of[corner];
    Complex sum = c.unknown == kNone ? Complex(0.0) : c.factor * z[c.unknown];
    for (const auto& [j, factor] : c.form) sum += factor * jumps[j];
    return sum;
  }

 private:
  template <class Visit>
  void eachEdge(const Visit& visit) const {
    Form form;
    for (std::uint32_t h = 0; h < weights_.size(); ++h) {
      if (m_.vertexOfCorner[h] == kNone) continue;
      const Corner &a = corners_.of[h], &b = corners_.of[Manifold::next(h)];
      form.clear();
      if (!a.form.empty() || !b.form.empty()) form = sum(b.form, -1.0, a.form);
      visit(h, a, b, form);
    }
  }

  const Manifold& m_;
  const CrossField& field_;
  const Corners& corners_;
  std::uint32_t variables_;
  std::vector<double> weights_;             ///< per half-edge: cotangents
  std::optional<ConnectionSolver> solver_;  ///< of A
  Eigen::SparseMatrix<Complex> b_;
  Eigen::MatrixXcd c_, s_;
  Eigen::LLT<Eigen::MatrixXcd> inverse_;  ///< of S
};

/// The vectors of the lattice, `basis` in metres, that cost least beyond `best`: whole numbers one
/// after the other, the one that costs least first, each time with the best of the rest; then every
/// single step that betters the whole.
Vector wholeJumps(const Eigen::MatrixXcd& schur, const Vector& best,
                  const std::array<Complex, 2>& basis) {
  const Eigen::Index count = best.size(), n = 2 * count;
  if (count == 0) return best;
  Eigen::MatrixXd matrix(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j)
      matrix(i, j) =
          (std::conj(basis[i % 2]) * schur(i / 2, j / 2) * basis[std::size_t(j % 2)]).real();
  Eigen::VectorXd wanted(n);
  const double area = (std::conj(basis[0]) * basis[1]).imag();
  for (Eigen::Index j = 0; j < count; ++j) {
    wanted[2 * j] = (std::conj(best[j]) * basis[1]).imag() / area;
    wanted[2 * j + 1] = (std::conj(basis[0]) * best[j]).imag() / area;
  }
  // What is not yet whole, the best of it given what is, and how it varies together.
  std::vector<Eigen::Index> rest(static_cast<std::size_t>(n));
  std::iota(rest.begin(), rest.end(), 0);
  Eigen::VectorXd x = wanted, whole = Eigen::VectorXd::Zero(n);
  Eigen::MatrixXd covariance = matrix.llt().solve(Eigen::MatrixXd::Identity(n, n));
  while (!rest.empty()) {
    const auto cost = [&](Eigen::Index i) {
      const double off = std::round(x[i]) - x[i];
      return off * off / std::max(covariance(i, i), 1e-300);
    };
    // One at a time; of many, several at a time, or there would be no end.
    std::vector<Eigen::Index> order(rest.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(),
                     [&](Eigen::Index i, Eigen::Index j) { return cost(i) < cost(j); });
    const std::size_t now = n <= 256 ? 1 : std::max<std::size_t>(1, rest.size() / 16);
    std::vector<Eigen::Index> taken(order.begin(), order.begin() + std::ptrdiff_t(now)),
        left(order.begin() + std::ptrdiff_t(now), order.end());
    std::sort(left.begin(), left.end());
    Eigen::VectorXd off(taken.size());
    for (std::size_t k = 0; k < now; ++k) {
      const double rounded = std::round(x[taken[k]]);
      off[Eigen::Index(k)] = rounded - x[taken[k]];
      whole[rest[std::size_t(taken[k])]] = rounded;
    }
    const Eigen::MatrixXd own = covariance(taken, taken), with = covariance(left, taken);
    const Eigen::MatrixXd gain = own.ldlt().solve(with.transpose()).transpose();
    x = (x(left) + gain * off).eval();
    Eigen::MatrixXd smaller = covariance(left, left);
    smaller.noalias() -= gain * with.transpose();
    covariance = std::move(smaller);
    std::vector<Eigen::Index> remaining;
    for (const Eigen::Index i : left) remaining.push_back(rest[std::size_t(i)]);
    rest = std::move(remaining);
  }
  Eigen::VectorXd slope = matrix * (whole - wanted);
  for (int round = 0; round < 100; ++round) {
    bool better = false;
    for (Eigen::Index i = 0; i < n; ++i) {
      const double step = slope[i] > 0.0 ? -1.0 : 1.0;
      if (matrix(i, i) + 2.0 * step * slope[i] >= -1e-9 * matrix(i, i)) continue;
      whole[i] += step;
      slope += step * matrix.col(i);
      better = true;
    }
    if (!better) break;
  }
  Vector jumps(count);
  for (Eigen::Index j = 0; j < count; ++j)
    jumps[j] = whole[2 * j] * basis[0] + whole[2 * j + 1] * basis[1];
  return jumps;
}

/// Looks at the finished map alone.
void countContinued(const Manifold& m, const CrossField& field, const Corners& corners,
                    const PatchSymmetry& symmetry, const Vec2& patchSize, LatticeMap& map) {
  std::vector<bool> open(m.vertexCount(), false);
  for (std::uint32_t v = 0; v < m.vertexCount(); ++v) {
    const std::uint32_t c = m.firstCorner[v], next = m.turnLeft(c);
    open[v] = next != kNone && corners.of[c].unknown != corners.of[next].unknown;
  }
  Eigen::Matrix2d basis;
  basis << symmetry.lattice[0].cast<double>(), symmetry.lattice[1].cast<double>();
  const Eigen::Matrix2d inverse = basis.inverse();
  const auto at = [&](std::uint32_t corner) {
    const Vec2 q = map.places[corner] - symmetry.centre;
    return Complex(double(q.x()) * patchSize.x(), double(q.y()) * patchSize.y());
  };
  for (std::uint32_t h = 0; h < m.twin.size(); ++h) {
    const std::uint32_t twin = m.twin[h], next = Manifold::next(h);
    if (twin == kNone || twin < h || m.vertexOfCorner[h] == kNone) continue;
    if (open[m.vertexOfCorner[h]] || open[m.vertexOfCorner[next]]) continue;
    ++map.edges;
    bool continues = true;
    for (const auto& [here, there] : {std::pair(h, Manifold::next(twin)), std::pair(next, twin)}) {
      const Complex jump = at(there) - quarterTurns(field.matching[h]) * at(here);
      const Vec2d times = inverse * Vec2d(jump.real() / patchSize.x(), jump.imag() / patchSize.y());
      const Vec2d whole(std::round(times.x()), std::round(times.y()));
      continues = continues && (basis * (times - whole)).norm() < 1e-3;
    }
    map.continued += continues;
  }
}

}  // namespace

Result<LatticeMap> latticeMap(const Manifold& m, const CrossField& field,
                              std::span<const std::uint32_t> chartOfTriangle,
                              const PatchSymmetry& symmetry, const Vec2& patchSize,
                              const Progress& progress) {
  constexpr int kLoose = 6, kWhole = 24;  // turns of fit, before and after jumps are whole
  const std::size_t triangles = field.direction.size();
  int steps = 0;
  const auto proceed = [&] {
    return !progress || progress({"lattice", std::uint64_t(steps++), kLoose + kWhole + 1, "steps"});
  };
  if (!proceed()) return report::cancelled();
  const Jumps jumps(m, field, chartOfTriangle);
  const Corners corners = cornersOf(m, jumps);
  System system(m, field, corners, jumps.variables());
  if (!system.factorise())
    return report::failed(
        "the system of the patch's lattice could not be factorised; a mesh with fewer vertices "
        "may fit");

  std::vector<Complex> turns(triangles);
  for (std::size_t t = 0; t < triangles; ++t) turns[t] = std::conj(field.direction[t]);
  Vector z = Vector::Zero(corners.unknowns), tau = Vector::Zero(jumps.variables()), r, s;
  // z = a w + b w̄ over a triangle; a tells its turn.
  const auto linear = [&](std::uint32_t t) {
    const auto& p = field.corners[t];
    const Complex z0 = system.at(3 * t, z, tau);
    const Complex e = system.at(3 * t + 1, z, tau) - z0, f = system.at(3 * t + 2, z, tau) - z0;
    const Complex u = p[1] - p[0], v = p[2] - p[0];
    const Complex area = u * std::conj(v) - std::conj(u) * v;
    if (std::abs(area) < 1e-300) return std::pair(Complex(0.0), Complex(0.0));
    return std::pair((e * std::conj(v) - f * std::conj(u)) / area, (f * u - e * v) / area);
  };
  const auto fit = [&](bool loose) {
    system.rightSide(turns, r, s);
    if (loose) tau = system.better(tau, system.places(r, tau, z), s);
    z = system.places(r, tau, z);
    work::parallelFor(triangles, [&](std::size_t t) {
      if (m.vertexOfCorner[3 * t] == kNone) return;
      const Complex a = linear(std::uint32_t(t)).first;
      if (std::abs(a) > 1e-6) turns[t] = a / std::abs(a);
    });
  };
  for (int i = 0; i < kLoose; ++i) {
    if (!proceed()) return report::cancelled();
    fit(true);
  }
  const auto metres = [&](const Vec2& v) {
    return Complex(double(v.x()) * patchSize.x(), double(v.y()) * patchSize.y());
  };
  tau = wholeJumps(system.schur(), tau, {metres(symmetry.lattice[0]), metres(symmetry.lattice[1])});
  for (int i = 0; i < kWhole; ++i) {
    if (!proceed()) return report::cancelled();
    fit(false);
  }

  LatticeMap map;
  map.places.resize(3 * triangles, Vec2::Zero());
  map.tangents.resize(triangles, Vec3::UnitX());
  double area = 0.0;
  for (std::uint32_t t = 0; t < triangles; ++t) {
    if (m.vertexOfCorner[3 * t] == kNone) continue;
    for (std::uint32_t c = 3 * t; c < 3 * t + 3; ++c) {
      const Complex at = system.at(c, z, tau);
      map.places[c] = Vec2(float(at.real() / patchSize.x()), float(at.imag() / patchSize.y())) +
                      symmetry.centre;
    }
    const Complex along = std::conj(turns[t]);
    map.tangents[t] = (along.real() * field.x[t] + along.imag() * field.y[t]).cast<float>();
    const auto [a, b] = linear(t);
    const auto& p = field.corners[t];
    const double own = 0.5 * std::abs((std::conj(p[1] - p[0]) * (p[2] - p[0])).imag());
    const double large = std::abs(a) + std::abs(b), small = std::abs(a) - std::abs(b);
    area += own;
    if (small <= 0.0) map.flipped += own;
    if (small < 2.0 / 3.0 || large > 1.5) map.squeezed += own;
    const auto squared = [](double x) { return std::log(x) * std::log(x); };
    map.stretch += 0.5 * own * (squared(std::max(small, 0.05)) + squared(std::max(large, 0.05)));
  }
  countContinued(m, field, corners, symmetry, patchSize, map);
  if (area > 0.0) {
    map.flipped /= area, map.squeezed /= area;
    map.stretch = std::sqrt(map.stretch / area);
  }
  return map;
}

std::vector<Vec3> vertexTangents(const scene::Mesh& mesh, const LatticeMap& map) {
  assert(map.tangents.size() == mesh.triangles.size());
  scene::Mesh own;  // normals, where the mesh has none
  if (mesh.normals.size() != mesh.positions.size()) {
    own.positions = mesh.positions, own.triangles = mesh.triangles;
    scene::computeNormals(own);
  }
  const std::vector<Vec3>& normals = own.normals.empty() ? mesh.normals : own.normals;
  std::vector<Vec3> sums(mesh.positions.size(), Vec3::Zero());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    const Vec3 cross =
        (mesh.positions[b] - mesh.positions[a]).cross(mesh.positions[c] - mesh.positions[a]);
    const float area = cross.norm();
    if (!(area > 0.0f)) continue;
    for (const std::uint32_t v : mesh.triangles[t]) {
      const Vec3 normal = cross.dot(normals[v]) < 0.0f ? Vec3(-cross / area) : Vec3(cross / area);
      sums[v] += area * turnedInto(map.tangents[t], normal, normals[v]);
    }
  }
  for (std::size_t v = 0; v < sums.size(); ++v) {
    Vec3& sum = sums[v];
    sum -= sum.dot(normals[v]) * normals[v];
    sum = sum.norm() > 0.0f ? Vec3(sum.normalized()) : Vec3(normals[v].unitOrthogonal());
  }
  return sums;
}

}  // namespace lambent::synthesis
