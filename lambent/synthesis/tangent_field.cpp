// This work is based on:
// - knoppel2013globally: the smoothest field is the eigenvector of the least eigenvalue of the
//   connection Laplacian, found by inverse iteration (§4, algorithms 1 and 2); alignment to a given
//   field is one linear solve (§3.3, eq. 10); the index of a triangle (§5).
// - sharp2019vector (§5.1-5.2): the Laplacian with cotangent weights over tangent planes whose
//   angles are scaled to 2π, which we use in place of Knöppel's finite elements.
// - viertel2019approach: diffusion and normalisation in turns, which spread the singularities of a
//   field of several equivalent directions.
//
// As the code spells it: a tangent at vertex i is a complex number u_i, its argument the scaled
// angle from the first edge of the vertex's fan (or, of N equivalent directions, N times that, which
// is the same for all of them); e^{iρ} carries it along an edge. The energy is
// Σ w |u_j − e^{iρ} u_i|², and M the diagonal of vertex areas as shares of their component.
//
// Where we deviate: weights are held within 1/64 … 64, so that slivers and obtuse triangles leave
// the matrix positive definite; every component is normalised by itself, so that one factorisation
// serves all of them; the iteration begins from the upward direction, so that where the smoothest
// field is not unique (a sphere) singularities lie at the poles, far from each other.
#include "lambent/synthesis/tangent_field.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <complex>
#include <string>

#include <Eigen/Geometry>

#include "lambent/math/random.h"
#include "lambent/synthesis/connection_solver.h"
#include "lambent/synthesis/frames.h"
#include "lambent/synthesis/manifold.h"

namespace lambent::synthesis {
namespace {

using Complex = std::complex<double>;
using Field = ConnectionSolver::Field;
using Matrix = ConnectionSolver::Matrix;

/// Per vertex of the manifold a plane with axes x and y, and per half-edge its angle in there.
struct TangentPlanes {
  std::vector<Vec3d> normal, x, y;
  std::vector<double> scale;   ///< of angles at the vertex: to 2π around an inner one
  std::vector<double> angle;   ///< per half-edge: scaled, at its tail
  std::vector<double> corner;  ///< per corner: its unscaled angle
  std::vector<double> mass;    ///< a third of the area around, as a share of the component's
  int turns = 1;               ///< equivalent directions: u is the power that all of them have

  /// The rotation ρ that carries a tangent, to the power of `turns`, along half-edge h.
  double transport(const Manifold& m, std::uint32_t h) const {
    const std::uint32_t head = Manifold::next(h);
    return turns * (angle[head] + scale[m.vertexOfCorner[head]] * corner[head] + kPi - angle[h]);
  }
};

Vec3d position(const scene::Mesh& mesh, std::uint32_t corner) {
  return mesh.positions[mesh.triangles[corner / 3][corner % 3]].cast<double>();
}

TangentPlanes tangentPlanes(const scene::Mesh& mesh, const Manifold& m) {
  TangentPlanes p;
  const std::size_t count = m.vertexCount();
  p.normal.assign(count, Vec3d::Zero());
  p.x.resize(count), p.y.resize(count);
  p.scale.assign(count, 1.0);
  p.mass.assign(count, 0.0);
  p.angle.assign(m.twin.size(), 0.0);
  p.corner.assign(m.twin.size(), 0.0);
  for (std::uint32_t v = 0; v < count; ++v) {
    double total = 0.0;
    Vec3d largest = Vec3d::Zero();
    std::uint32_t c = m.firstCorner[v];
    bool closed = false;
    while (c != kNone && !closed) {
      const Vec3d at = position(mesh, c);
      const Vec3d a = position(mesh, Manifold::next(c)) - at;
      const Vec3d b = position(mesh, Manifold::previous(c)) - at;
      const Vec3d cross = a.cross(b);
      const double twiceArea = cross.norm();
      p.corner[c] = std::atan2(twiceArea, a.dot(b));
      p.angle[c] = total;
      total += p.corner[c];
      p.mass[v] += twiceArea / 6.0;
      if (twiceArea > 0.0) p.normal[v] += p.corner[c] / twiceArea * cross;
      if (twiceArea > largest.norm()) largest = cross;
      c = m.turnLeft(c);
      closed = c == m.firstCorner[v];
    }
    if (closed && total > 0.0) p.scale[v] = 2.0 * kPi / total;
    // Two sides of a folded sheet cancel: there the largest triangle decides.
    if (p.normal[v].norm() < 1e-6 * total) p.normal[v] = largest;
    p.normal[v] = p.normal[v].norm() > 0.0 ? p.normal[v].normalized() : Vec3d(Vec3d::UnitY());

    // The axes that agree best with all edges: the fan is not flat, and every edge's direction in
    // the plane differs a little from its scaled angle.
    const Vec3d e0 = p.normal[v].unitOrthogonal(), e1 = p.normal[v].cross(e0);
    Complex fit = 0.0;
    c = m.firstCorner[v];
    do {
      p.angle[c] *= p.scale[v];
      const Vec3d a = (position(mesh, Manifold::next(c)) - position(mesh, c)).normalized();
      fit += Complex(a.dot(e0), a.dot(e1)) * std::polar(1.0, -p.angle[c]);
      c = m.turnLeft(c);
    } while (c != kNone && c != m.firstCorner[v]);
    fit = std::abs(fit) > 1e-12 ? fit / std::abs(fit) : Complex(1.0);
    p.x[v] = fit.real() * e0 + fit.imag() * e1;
    p.y[v] = p.normal[v].cross(p.x[v]);
  }
  std::vector<double> area(m.components, 0.0), vertices(m.components, 0.0);
  for (std::uint32_t v = 0; v < count; ++v) {
    area[m.componentOfVertex[v]] += p.mass[v];
    vertices[m.componentOfVertex[v]] += 1.0;
  }
  for (std::uint32_t v = 0; v < count; ++v) {
    const std::uint32_t k = m.componentOfVertex[v];
    const double share = area[k] > 0.0 ? p.mass[v] / area[k] : 0.0;
    p.mass[v] = std::max(share, 1e-6 / vertices[k]);
  }
  return p;
}

/// smooth · (connection Laplacian) + the diagonal given; lower triangle.
Matrix laplacian(const Manifold& m, const TangentPlanes& p, double smooth,
                 const std::vector<double>& diagonal) {
  std::vector<double> sums = diagonal;
  std::vector<Eigen::Triplet<Complex>> entries;
  entries.reserve(m.twin.size() + sums.size());
  for (std::uint32_t h = 0; h < m.twin.size(); ++h) {
    if (m.vertexOfCorner[h] == kNone) continue;
    const std::uint32_t i = m.vertexOfCorner[h], j = m.vertexOfCorner[Manifold::next(h)];
    const double opposite = p.corner[Manifold::previous(h)];
    const double cotangent = std::cos(opposite) / std::max(std::sin(opposite), 1e-12);
    const double w = smooth * std::clamp(0.5 * cotangent, 1.0 / 64.0, 64.0);
    sums[i] += w, sums[j] += w;
    const Complex r = std::polar(w, p.transport(m, h));
    if (j > i) {
      entries.emplace_back(int(j), int(i), -r);
    } else {
      entries.emplace_back(int(i), int(j), -std::conj(r));
    }
  }
  for (std::size_t i = 0; i < sums.size(); ++i) entries.emplace_back(int(i), int(i), sums[i]);
  Matrix a(Eigen::Index(sums.size()), Eigen::Index(sums.size()));
  a.setFromTriplets(entries.begin(), entries.end());
  return a;
}

Field project(const TangentPlanes& p, const Vec3d& direction) {
  Field u(Eigen::Index(p.x.size()));
  for (std::size_t i = 0; i < p.x.size(); ++i) {
    const Complex along(direction.dot(p.x[i]), direction.dot(p.y[i]));
    // Its length is that of the projection, whatever the power.
    const double length = std::abs(along);
    u[Eigen::Index(i)] =
        length > 0.0 ? std::polar(length, p.turns * std::arg(along)) : Complex(0.0);
  }
  return u;
}

constexpr const char* kNoMemory =
    "the tangent field's matrix could not be factorised; a mesh with fewer vertices may fit";

/// Singularities driven apart: as lengths of the smoothest field go to zero around singularities,
/// it does not mind several of them beside each other, which turn a texture as sharply as one large
/// one. Diffused for a while and brought back to unit length in turns, it does.
Result<Field> spread(const Manifold& m, const TangentPlanes& p, Field u) {
  // Times at which a component's longest waves have sunk to about a third, and to nine tenths.
  for (const double time : {0.1, 0.01}) {
    const ConnectionSolver solver(laplacian(m, p, time, p.mass));
    if (!solver.ok()) return report::failed(kNoMemory);
    for (int i = 0; i < 15; ++i) {
      Field b = u;
      for (Eigen::Index k = 0; k < b.size(); ++k) {
        const double length = std::abs(u[k]);
        b[k] = p.mass[std::size_t(k)] * (length > 0.0 ? u[k] / length : Complex(1.0));
      }
      u = solver.solve(b, u, 1e-5);
    }
  }
  return u;
}

Result<Field> smoothest(const Manifold& m, const TangentPlanes& p) {
  // Eigenvalues are pure numbers of about 10 here. The shift keeps a flat sheet, whose least is 0,
  // solvable, and is far below any gap that matters.
  constexpr double kShift = 1e-5;
  constexpr int kIterations = 60;
  std::vector<double> shift(p.mass.size());
  for (std::size_t i = 0; i < shift.size(); ++i) shift[i] = kShift * p.mass[i];
  const ConnectionSolver solver(laplacian(m, p, 1.0, shift));
  if (!solver.ok()) return report::failed(kNoMemory);

  // Powers of the upward direction would bring all singularities to the poles.
  Field u = p.turns == 1 ? project(p, Vec3d(0.003, 1.0, 0.001)) : Field::Zero(p.x.size());
  // A symmetric surface may have a smoothest field that is orthogonal to that.
  for (Eigen::Index i = 0; i < u.size(); ++i) {
    const Vec2 random = math::Random(0x7a67u, std::uint64_t(i)).uniform2() - Vec2(0.5f, 0.5f);
    u[i] += 2e-3 * Complex(random.x(), random.y());
  }
  std::vector<double> last(m.components, 0.0), norm(m.components);
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    Field b = u;
    for (Eigen::Index i = 0; i < b.size(); ++i) b[i] *= p.mass[std::size_t(i)];
    // Where components differ in their eigenvalues the guess is right for each.
    Field guess = u;
    for (Eigen::Index i = 0; i < u.size(); ++i) {
      guess[i] *= last[m.componentOfVertex[std::size_t(i)]];
    }
    u = solver.solve(b, guess, 1e-5);
    // As u has unit length before, its length now tends to the inverse of the least eigenvalue.
    std::fill(norm.begin(), norm.end(), 0.0);
    for (Eigen::Index i = 0; i < u.size(); ++i) {
      norm[m.componentOfVertex[std::size_t(i)]] += p.mass[std::size_t(i)] * std::norm(u[i]);
    }
    bool settled = iteration > 4;
    for (std::size_t k = 0; k < norm.size(); ++k) {
      norm[k] = std::sqrt(norm[k]);
      settled = settled && std::abs(norm[k] - last[k]) <= 1e-5 * norm[k];
    }
    last = norm;
    for (Eigen::Index i = 0; i < u.size(); ++i) {
      const double length = norm[m.componentOfVertex[std::size_t(i)]];
      if (length > 0.0) u[i] /= length;
    }
    if (settled) break;
  }
  return p.turns == 1 ? Result<Field>(std::move(u)) : spread(m, p, std::move(u));
}

Result<Field> steered(const Manifold& m, const TangentPlanes& p, const Vec3d& direction,
                      double steering) {
  // Smooth over 1/√100 of a component's extent at a steering of one half; a trace of smoothness
  // stays at 1, to decide where the direction stands at right angles to the surface.
  const double smooth = std::max(1.0 - steering, 1e-6);
  const double pull = 100.0 * std::max(steering, 1e-6);
  std::vector<double> diagonal(p.mass.size());
  Field b = project(p, direction);
  for (std::size_t i = 0; i < diagonal.size(); ++i) {
    diagonal[i] = pull * p.mass[i];
    b[Eigen::Index(i)] *= diagonal[i];
  }
  const ConnectionSolver solver(laplacian(m, p, smooth, diagonal));
  if (!solver.ok()) return report::failed(kNoMemory);
  return solver.solve(b, project(p, direction), 1e-7);
}

std::vector<TangentField::Singularity> singularities(const Manifold& m, const TangentPlanes& p,
                                                     const Field& u) {
  std::vector<TangentField::Singularity> found;
  for (std::uint32_t t = 0; 3 * t < m.twin.size(); ++t) {
    if (m.vertexOfCorner[3 * t] == kNone) continue;
    // The curvature of the triangle under scaled angles: over a closed surface it sums to 2πχ.
    double turn = -p.turns * kPi;
    for (std::uint32_t h = 3 * t; h < 3 * t + 3; ++h) {
      const std::uint32_t i = m.vertexOfCorner[h], j = m.vertexOfCorner[Manifold::next(h)];
      turn += p.turns * p.scale[i] * p.corner[h];
      turn += std::arg(u[j] * std::conj(u[i]) * std::polar(1.0, -p.transport(m, h)));
    }
    const int index = int(std::lround(turn / (2.0 * kPi)));
    if (index != 0) found.push_back({t, index});
  }
  return found;
}

Findings whatWasCut(const Manifold& m) {
  Findings findings;
  const auto tell = [&](Severity severity, const char* code, std::size_t count,
                        const std::string& message) {
    if (count > 0) findings.push_back({severity, code, std::to_string(count) + message, count});
  };
  tell(Severity::Warning, "non-manifold-edges", m.nonManifoldEdges,
       " edges belong to three triangles or more; the surface is cut there, and texture will not "
       "run on across them");
  tell(Severity::Warning, "inconsistent-winding", m.inconsistentEdges,
       " edges lie between triangles that are wound against each other; the surface is cut there, "
       "and texture will not run on across them");
  tell(Severity::Note, "degenerate-triangles", m.degenerateTriangles,
       " triangles have two corners at one place and are left out");
  return findings;
}

}  // namespace

Result<WithFindings<TangentField>> tangentField(const scene::Mesh& mesh,
                                                const TangentFieldOptions& options) {
  if (!(options.steering >= 0.0f && options.steering <= 1.0f)) {
    return report::badUsage("steering must lie within 0 and 1");
  }
  if (options.turns < 1) return report::badUsage("a tangent field has one direction at least");
  if (options.direction && !(options.direction->norm() > 0.0f && options.direction->allFinite())) {
    return report::badUsage("the direction that a tangent field follows must not be zero");
  }
  const Manifold m = manifoldOf(mesh);
  if (m.vertexCount() == 0) {
    return report::badInput("the mesh " + mesh.name +
                            " has no triangle, so no surface to lay tangents on");
  }
  TangentPlanes p = tangentPlanes(mesh, m);
  p.turns = options.turns;
  Result<Field> solved =
      options.direction && options.steering > 0.0f
          ? steered(m, p, options.direction->cast<double>().normalized(), options.steering)
          : smoothest(m, p);
  if (!solved) return solved.error();
  const Field& u = *solved;

  TangentField field;
  field.singularities = singularities(m, p, u);
  const std::vector<Vec3> normals = normalsOf(mesh);
  field.tangents.resize(mesh.positions.size());
  for (std::size_t v = 0; v < field.tangents.size(); ++v) {
    field.tangents[v] = normals[v].unitOrthogonal();  // of vertices that no triangle uses
  }
  std::vector<bool> set(field.tangents.size());
  for (std::uint32_t c = 0; c < m.vertexOfCorner.size(); ++c) {
    const std::uint32_t i = m.vertexOfCorner[c], v = mesh.triangles[c / 3][c % 3];
    if (i == kNone || set[v]) continue;
    set[v] = true;
    const double length = std::abs(u[i]);
    const Complex unit = length > 0.0 ? std::polar(1.0, std::arg(u[i]) / p.turns) : Complex(1.0);
    const Vec3d tangent = unit.real() * p.x[i] + unit.imag() * p.y[i];
    // Normals may point to the other side than the winding says: then the plane is turned over.
    const Vec3 normal = p.normal[i].cast<float>();
    field.tangents[v] = turnedInto(
        tangent.cast<float>(), normal.dot(normals[v]) < 0.0f ? Vec3(-normal) : normal, normals[v]);
  }
  return WithFindings<TangentField>{std::move(field), whatWasCut(m)};
}

}  // namespace lambent::synthesis
