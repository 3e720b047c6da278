// This work is based on:
// - bommes2009mixed, bommes2013integer: a map whose jumps over cuts are quarter turns and whole
//   translations shows a periodic texture without a seam; it is the least-squares fit to a field,
//   with some numbers whole.
// - liu2008local: as rigid as possible, by turns of a rotation for each triangle and one linear
//   solve with an unchanging matrix.
// - babai1986lovasz: whole numbers one after the other, each conditional on those before.
//
// Where we deviate: τ is eliminated from the system by a Schur complement, so that whole numbers
// are found in a small dense problem, at one back substitution for each τ, rather than by solving
// the sparse one anew after each of them.
#include "lambent/synthesis/lattice_map.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <complex>

#include <Eigen/Dense>

#include "lambent/synthesis/frames.h"
#include "lambent/synthesis/lattice_fit.h"
#include "lambent/synthesis/whole_jumps.h"
#include "lambent/work/parallel_for.h"

namespace lambent::synthesis {
namespace {

using Complex = std::complex<double>;
using Vector = Eigen::VectorXcd;

/// Looks at the finished map alone.
void countContinued(const Manifold& m, const CrossField& field, const LatticeCorners& corners,
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
  const LatticeJumps jumps(m, field, chartOfTriangle);
  const LatticeCorners corners = cornersOf(m, jumps);
  LatticeFit system(m, field, corners, jumps.variables());
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
    if (loose) tau = system.jumps(r, s);
    z = system.places(r, tau);
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
  const std::vector<Vec3> normals = normalsOf(mesh);
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
