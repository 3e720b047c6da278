// This work is based on:
// - knoppel2013globally: the smoothest field is the eigenvector of the least eigenvalue of the
//   connection Laplacian, found by inverse iteration (§4, algorithms 1 and 2); alignment to a given
//   field is one linear solve (§3.3, eq. 10), here to what is given at some vertices too; the index
//   of a triangle (§5).
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
#include "lambent/synthesis/features_of_field.h"
#include "lambent/synthesis/frames.h"
#include "lambent/synthesis/manifold.h"
#include "lambent/synthesis/tangent_planes.h"

namespace lambent::synthesis {
namespace {

using Complex = std::complex<double>;
using Field = ConnectionSolver::Field;
using Matrix = ConnectionSolver::Matrix;

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

/// A direction in the plane of vertex i, to the power of `turns`. Its length is that of the
/// projection, whatever the power.
Complex projectAt(const TangentPlanes& p, std::size_t i, const Vec3d& direction) {
  const Complex along(direction.dot(p.x[i]), direction.dot(p.y[i]));
  const double length = std::abs(along);
  return length > 0.0 ? std::polar(length, p.turns * std::arg(along)) : Complex(0.0);
}

Field project(const TangentPlanes& p, const Vec3d& direction) {
  Field u(Eigen::Index(p.x.size()));
  for (std::size_t i = 0; i < p.x.size(); ++i) u[Eigen::Index(i)] = projectAt(p, i, direction);
  return u;
}

/// Against the least eigenvalues of the Laplacian, about 10, next to nothing.
constexpr double kHold = 1e-2;

constexpr const char* kNoMemory =
    "the tangent field's matrix could not be factorised; a mesh with fewer vertices may fit";

/// What draws the field: vertex i to sum_i/strength_i, as strongly as strength_i in the energy.
struct Pulls {
  std::vector<double> strength;
  Field sum;

  explicit Pulls(std::size_t count) : strength(count, 0.0), sum(Field::Zero(Eigen::Index(count))) {}
  void add(std::size_t i, double howStrongly, const Complex& wanted) {
    strength[i] += howStrongly;
    sum[Eigen::Index(i)] += howStrongly * wanted;
  }
};

/// Singularities driven apart: as lengths of the smoothest field go to zero around singularities,
/// it does not mind several of them beside each other, which turn a texture as sharply as one large
/// one. Diffused for a while and brought back to unit length in turns, it does.
Result<Field> spread(const Manifold& m, const TangentPlanes& p, Field u,
                     const Pulls* pulls = nullptr) {
  // Times at which a component's longest waves have sunk to about a third, and to nine tenths.
  for (const double time : {0.1, 0.01}) {
    std::vector<double> diagonal = p.mass;
    for (std::size_t i = 0; pulls && i < diagonal.size(); ++i)
      diagonal[i] += time * pulls->strength[i];
    const ConnectionSolver solver(laplacian(m, p, time, diagonal));
    if (!solver.ok()) return report::failed(kNoMemory);
    for (int i = 0; i < 15; ++i) {
      Field b = u;
      for (Eigen::Index k = 0; k < b.size(); ++k) b[k] = p.mass[std::size_t(k)] * unitOf(u[k]);
      if (pulls) b += time * pulls->sum;
      u = solver.solve(b, u, 1e-4);
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
    // No nearer to the solution than it pays: the next right side is another.
    u = solver.solve(b, guess, 1e-5, 0.1);
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

/// The smoothest field under its pulls; every component has some.
Result<Field> drawn(const Manifold& m, const TangentPlanes& p, const Pulls& pulls) {
  const ConnectionSolver solver(laplacian(m, p, 1.0, pulls.strength));
  if (!solver.ok()) return report::failed(kNoMemory);
  Field guess = pulls.sum;
  for (Eigen::Index i = 0; i < guess.size(); ++i) {
    const double strength = pulls.strength[std::size_t(i)];
    guess[i] = strength > 0.0 ? guess[i] / strength : Complex(0.0);
  }
  return solver.solve(pulls.sum, guess, 1e-7);
}

/// Of a direction that is given over the surface. Smooth over 1/√100 of a component's extent at a
/// steering of one half; a trace of smoothness stays at 1, to decide where the direction stands at
/// right angles to the surface.
double steeringPull(double steering) {
  return 100.0 * std::max(steering, 1e-6) / std::max(1.0 - steering, 1e-6);
}

/// Of the guides at the mesh's vertices that are one vertex of the manifold, their weighted mean.
std::vector<Guide> guidesOf(const scene::Mesh& mesh, const Manifold& m,
                            const std::vector<Guide>& guides) {
  std::vector<Guide> result(m.vertexCount());
  std::vector<float> counts(m.vertexCount(), 0.0f);
  for (std::uint32_t c = 0; c < m.vertexOfCorner.size(); ++c) {
    if (m.vertexOfCorner[c] == kNone) continue;
    const Guide& from = guides[mesh.triangles[c / 3][c % 3]];
    Guide& to = result[m.vertexOfCorner[c]];
    const float length = from.direction.norm();
    if (length > 0.0f) to.direction += from.weight / length * from.direction;
    to.weight += from.weight;
    counts[m.vertexOfCorner[c]] += 1.0f;
  }
  for (std::size_t i = 0; i < result.size(); ++i)
    if (counts[i] > 0.0f) result[i].weight = std::clamp(result[i].weight / counts[i], 0.0f, 1.0f);
  return result;
}

/// Draws the field along the features or across them, as it would rather: first those for which it
/// says so, and then, by what it has become, others. Where it stays undecided nothing is drawn:
/// about the corners of a box a field of one or two directions has to turn somewhere, and does so
/// at edges that one side wants along and the other across. Counts what is drawn.
Result<Field> aligned(const Manifold& m, const TangentPlanes& p, std::vector<Feature> features,
                      const std::vector<Guide>& guides, Field base, Pulls& pulls,
                      std::uint32_t& count) {
  // For each metre, on a surface of 1 m²: the field is off by as much as it turns over 1/30 m.
  constexpr double kFeaturePull = 30.0;
  const double decided = 0.35 * p.turns;  // some 30° from either way
  std::stable_sort(features.begin(), features.end(),
                   [](const Feature& a, const Feature& b) { return a.length > b.length; });
  while (!features.empty()) {
    const std::uint32_t before = count;
    std::vector<Feature> undecided;
    const auto draw = [&](const Feature& feature, int quarters) {
      ++count;
      for (const Feature::End& end : feature.ends) {
        const double extent = std::sqrt(p.area[m.componentOfVertex[end.vertex]]);
        const double free = guides.empty() ? 1.0 : 1.0 - double(guides[end.vertex].weight);
        if (extent > 0.0)
          pulls.add(end.vertex, kFeaturePull * free * end.share / extent,
                    std::polar(1.0, p.turns * (end.angle + 0.5 * kPi * quarters)));
      }
    };
    for (Feature& feature : features) {
      const Choice choice = choiceOf(feature, p, base);
      if (choice.margin >= decided)
        draw(feature, choice.quarters);
      else
        undecided.push_back(std::move(feature));
    }
    // Where it says nothing at all, the longest goes first.
    if (count == 0) {
      draw(undecided.front(), choiceOf(undecided.front(), p, base).quarters);
      undecided.erase(undecided.begin());
    }
    if (count == before) break;
    Result<Field> next = drawn(m, p, pulls);
    if (!next) return next;
    base = std::move(*next);
    features = std::move(undecided);
  }
  return base;
}

/// What is wanted of a field, and how well it lies.
Result<Field> solved(const scene::Mesh& mesh, const Manifold& m, const TangentPlanes& p,
                     const TangentFieldOptions& options, TangentField& report) {
  const double steering = double(options.steering);
  const bool steers = options.direction && steering > 0.0;
  const std::vector<Guide> guides =
      options.guides.empty() ? std::vector<Guide>() : guidesOf(mesh, m, options.guides);
  Pulls pulls(p.mass.size());
  bool guided = false;
  if (steers) {
    const Field wanted = project(p, options.direction->cast<double>().normalized());
    for (std::size_t i = 0; i < p.mass.size(); ++i) {
      const double free = guides.empty() ? 1.0 : 1.0 - double(guides[i].weight);
      pulls.add(i, std::max(free, 1e-6) * steeringPull(steering) * p.mass[i],
                wanted[Eigen::Index(i)]);
    }
  }
  for (std::size_t i = 0; i < guides.size(); ++i) {
    if (!(guides[i].weight > 0.0f) || !(guides[i].direction.norm() > 0.0f)) continue;
    guided = true;
    pulls.add(i, double(guides[i].weight) * steeringPull(steering) * p.mass[i],
              projectAt(p, i, guides[i].direction.cast<double>().normalized()));
  }
  Result<Field> base = Field();
  if (!steers) {
    base = smoothest(m, p);
    if (!base) return base;
    // Components that nothing else draws stay as they are; for others this is nothing.
    for (std::size_t i = 0; i < p.mass.size(); ++i)
      pulls.add(i, kHold * p.mass[i], unitOf((*base)[Eigen::Index(i)]));
  }
  if (steers || guided) {
    base = drawn(m, p, pulls);
    if (!base) return base;
  }
  if (options.align && !steers) {
    std::vector<Feature> features = featuresOf(mesh, m, p);
    report.featureLines = std::uint32_t(features.size());
    if (!features.empty()) {
      guided = true;
      base =
          aligned(m, p, std::move(features), guides, std::move(*base), pulls, report.alignedLines);
      if (!base) return base;
    }
  }
  return guided && p.turns > 1 ? spread(m, p, std::move(*base), &pulls) : base;
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
  if (!options.guides.empty() && options.guides.size() != mesh.positions.size())
    return report::badUsage("there must be as many guides as vertices");
  const Manifold m = manifoldOf(mesh);
  if (m.vertexCount() == 0) {
    return report::badInput("the mesh " + mesh.name +
                            " has no triangle, so no surface to lay tangents on");
  }
  const TangentPlanes p = tangentPlanes(mesh, m, options.turns);
  TangentField field;
  const Result<Field> made = solved(mesh, m, p, options, field);
  if (!made) return made.error();
  const Field& u = *made;
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
