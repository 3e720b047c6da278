// This work is based on:
// - ray2008nsymmetry: N-symmetry direction fields, their matching over edges (period jumps), and the
//   index of a vertex from them.
// - bommes2009mixed: the field on triangles, whose singularities are vertices.
// Where we differ: the field is found at vertices (tangent_field.cpp) and read off on triangles.
#include "lambent/synthesis/cross_field.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include <Eigen/Geometry>

#include "lambent/synthesis/frames.h"
#include "lambent/work/parallel_for.h"

namespace lambent::synthesis {
namespace {

using Complex = std::complex<double>;

Complex unit(const Complex& z) {
  const double length = std::abs(z);
  return length > 0.0 ? z / length : Complex(1.0);
}

/// What the edge of half-edge h is in the plane of its triangle.
Complex edgeOf(const CrossField& field, std::uint32_t h) {
  const auto& corners = field.corners[h / 3];
  return corners[Manifold::next(h) % 3] - corners[h % 3];
}

/// The turn from the plane of a half-edge's triangle into that of its twin's.
Complex unfolded(const CrossField& field, std::uint32_t h, std::uint32_t twin) {
  return unit(-edgeOf(field, twin) * std::conj(edgeOf(field, h)));
}

/// −1 for components whose normals look to the other side than their winding says.
std::vector<double> sensesOf(const scene::Mesh& mesh, const Manifold& m,
                             const std::vector<Vec3>& normals) {
  std::vector<double> agreement(m.components, 0.0);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const std::uint32_t component = m.componentOfTriangle(t);
    if (component == kNone) continue;
    const auto& [a, b, c] = mesh.triangles[t];
    const Vec3 cross =
        (mesh.positions[b] - mesh.positions[a]).cross(mesh.positions[c] - mesh.positions[a]);
    agreement[component] += double(cross.dot(normals[a] + normals[b] + normals[c]));
  }
  for (double& each : agreement) each = each < 0.0 ? -1.0 : 1.0;
  return agreement;
}

}  // namespace

CrossField crossField(const scene::Mesh& mesh, const Manifold& m, std::span<const Vec3> tangents,
                      int turns) {
  assert(turns == 1 || turns == 2 || turns == 4);
  const std::size_t count = mesh.triangles.size();
  CrossField field;
  field.turns = turns;
  field.x.resize(count), field.y.resize(count), field.corners.resize(count);
  field.direction.assign(count, 1.0);
  field.matching.assign(3 * count, 0);
  const std::vector<Vec3> normals = normalsOf(mesh);
  const std::vector<double> senses = sensesOf(mesh, m, normals);
  work::parallelFor(count, [&](std::size_t t) {
    const std::uint32_t component = m.componentOfTriangle(std::uint32_t(t));
    if (component == kNone) return;
    const scene::Triangle& corners = mesh.triangles[t];
    Vec3d p[3];
    for (std::size_t k = 0; k < 3; ++k) p[k] = mesh.positions[corners[k]].cast<double>();
    // Along the longest edge, so that a triangle without area has its directions as well.
    std::size_t longest = 0;
    for (std::size_t k = 1; k < 3; ++k)
      if ((p[(k + 1) % 3] - p[k]).norm() > (p[(longest + 1) % 3] - p[longest]).norm()) longest = k;
    const Vec3d x = (p[(longest + 1) % 3] - p[longest]).normalized();
    Vec3d normal = (p[1] - p[0]).cross(p[2] - p[0]);
    normal -= normal.dot(x) * x;
    normal = normal.norm() > 0.0 ? Vec3d(normal.normalized()) : Vec3d(x.unitOrthogonal());
    normal *= senses[component];
    const Vec3d y = normal.cross(x);
    field.x[t] = x, field.y[t] = y;
    Complex sum = 0.0, first = 1.0;
    for (std::size_t k = 0; k < 3; ++k) {
      field.corners[t][k] = Complex((p[k] - p[0]).dot(x), (p[k] - p[0]).dot(y));
      const Vec3 n = normals[corners[k]];
      const Vec3d tangent =
          turnedInto(tangents[corners[k]], n, normal.cast<float>()).template cast<double>();
      const Complex power = std::pow(unit(Complex(tangent.dot(x), tangent.dot(y))), turns);
      sum += power;
      if (k == 0) first = power;
    }
    if (std::abs(sum) < 1e-3) sum = first;
    field.direction[t] = std::polar(1.0, std::arg(sum) / turns);
  });

  std::vector<double> turn(3 * count, 0.0);  // of the field over a half-edge
  const int step = 4 / turns;
  for (std::uint32_t h = 0; h < 3 * count; ++h) {
    const std::uint32_t twin = m.twin[h];
    if (twin == kNone || m.vertexOfCorner[h] == kNone || twin < h) continue;
    const Complex seen =
        field.direction[h / 3] * unfolded(field, h, twin) * std::conj(field.direction[twin / 3]);
    const int k = step * int(std::lround(std::arg(seen) / (0.5 * kPi * step)));
    field.matching[h] = std::uint8_t(k & 3);
    field.matching[twin] = std::uint8_t(-k & 3);
    turn[h] = -std::arg(seen * quarterTurns(-k));
    turn[twin] = -turn[h];
  }

  for (std::uint32_t v = 0; v < m.vertexCount(); ++v) {
    double angles = 0.0, turned = 0.0;
    std::uint32_t c = m.firstCorner[v];
    bool closed = false;
    do {
      const Complex a = edgeOf(field, c), b = -edgeOf(field, Manifold::previous(c));
      angles += std::abs(std::arg(b * std::conj(a)));
      turned += turn[Manifold::previous(c)];
      c = m.turnLeft(c);
      closed = c == m.firstCorner[v];
    } while (c != kNone && !closed);
    if (!closed) continue;
    const double sense = senses[m.componentOfVertex[v]];
    const double index = (2.0 * kPi - angles + sense * turned) / (2.0 * kPi);
    const int parts = int(std::lround(index * turns));
    if (parts != 0) field.singularities.push_back({v, parts});
  }
  return field;
}

void comb(const Manifold& m, std::span<const std::uint32_t> chartOfTriangle, CrossField& field) {
  const std::size_t count = field.direction.size();
  assert(chartOfTriangle.size() == count);
  constexpr std::uint8_t kUnset = 4;
  std::vector<std::uint8_t> ahead(count, kUnset);
  std::vector<std::uint32_t> queue;
  for (std::uint32_t seed = 0; seed < count; ++seed) {
    if (ahead[seed] != kUnset || m.vertexOfCorner[3 * seed] == kNone) continue;
    ahead[seed] = 0;
    queue.assign(1, seed);
    for (std::size_t i = 0; i < queue.size(); ++i) {
      const std::uint32_t t = queue[i];
      for (std::uint32_t h = 3 * t; h < 3 * t + 3; ++h) {
        const std::uint32_t other = m.twin[h] == kNone ? kNone : m.twin[h] / 3;
        if (other == kNone || ahead[other] != kUnset ||
            chartOfTriangle[other] != chartOfTriangle[t])
          continue;
        ahead[other] = std::uint8_t((field.matching[h] + ahead[t]) & 3);
        queue.push_back(other);
      }
    }
  }
  for (std::uint32_t t = 0; t < count; ++t)
    if (ahead[t] != kUnset) field.direction[t] *= quarterTurns(ahead[t]);
  for (std::uint32_t h = 0; h < 3 * count; ++h) {
    if (m.twin[h] == kNone || m.vertexOfCorner[h] == kNone) continue;
    field.matching[h] =
        std::uint8_t((field.matching[h] + ahead[h / 3] + 8 - ahead[m.twin[h] / 3]) & 3);
  }
}

}  // namespace lambent::synthesis
