#include "lambent/synthesis/tangent_planes.h"

#include <algorithm>
#include <cmath>
#include <complex>

#include <Eigen/Geometry>

namespace lambent::synthesis {
namespace {

using Complex = std::complex<double>;

Vec3d placeOf(const scene::Mesh& mesh, std::uint32_t corner) {
  return mesh.positions[mesh.triangles[corner / 3][corner % 3]].cast<double>();
}

}  // namespace

TangentPlanes tangentPlanes(const scene::Mesh& mesh, const Manifold& m, int turns) {
  TangentPlanes p;
  p.turns = turns;
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
      const Vec3d at = placeOf(mesh, c);
      const Vec3d a = placeOf(mesh, Manifold::next(c)) - at;
      const Vec3d b = placeOf(mesh, Manifold::previous(c)) - at;
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
      const Vec3d a = (placeOf(mesh, Manifold::next(c)) - placeOf(mesh, c)).normalized();
      fit += Complex(a.dot(e0), a.dot(e1)) * std::polar(1.0, -p.angle[c]);
      c = m.turnLeft(c);
    } while (c != kNone && c != m.firstCorner[v]);
    fit = std::abs(fit) > 1e-12 ? fit / std::abs(fit) : Complex(1.0);
    p.x[v] = fit.real() * e0 + fit.imag() * e1;
    p.y[v] = p.normal[v].cross(p.x[v]);
  }
  std::vector<double> vertices(m.components, 0.0);
  p.area.assign(m.components, 0.0);
  for (std::uint32_t v = 0; v < count; ++v) {
    p.area[m.componentOfVertex[v]] += p.mass[v];
    vertices[m.componentOfVertex[v]] += 1.0;
  }
  for (std::uint32_t v = 0; v < count; ++v) {
    const std::uint32_t k = m.componentOfVertex[v];
    const double share = p.area[k] > 0.0 ? p.mass[v] / p.area[k] : 0.0;
    p.mass[v] = std::max(share, 1e-6 / vertices[k]);
  }
  return p;
}

}  // namespace lambent::synthesis
