// This work is based on:
// - smith2015bijective: the symmetric Dirichlet energy (§3) and the largest step before a triangle
//   turns over, the smaller root of a quadratic (§3.3).
// - pinkall1993computing: cotangent weights.
// - liu2008local: as-rigid-as-possible layout, §3, eq. 5 and 6.
// Its terms: J, the 2×2 Jacobian of plane by surface, of singular values σ₁ ≥ σ₂;
// σ₁² + σ₂² = |J|², and 1/σ₁² + 1/σ₂² = |J|² / det² J, which is twice the square of the L² stretch
// (sander2001texture §3): the energy minimises stretch, and shrinking too.
#include "lambent/atlas/layout_energy.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

namespace lambent::atlas {
namespace {

/// A triangle's height for the purpose of the layout is at least this share of its longest edge:
/// a sliver would otherwise hold all its neighbours where they are.
constexpr double kThinnest = 2e-3;

}  // namespace

LayoutEnergy::LayoutEnergy(const ChartPatch& patch) : vertices_(patch.positions.size()) {
  elements_.reserve(patch.triangles.size());
  for (const auto& t : patch.triangles) {
    const auto& p = patch.positions;
    // The longest edge lies along x, whatever corner it begins at.
    int k = 0;
    for (int i = 1; i < 3; ++i)
      if ((p[t[(i + 1) % 3]] - p[t[i]]).squaredNorm() > (p[t[(k + 1) % 3]] - p[t[k]]).squaredNorm())
        k = i;
    const Vec3d a = p[t[k]], b = p[t[(k + 1) % 3]], c = p[t[(k + 2) % 3]];
    const double length = (b - a).norm();
    if (!(length > 0.0)) continue;
    const Vec3d along = (b - a) / length;
    const double foot = std::clamp((c - a).dot(along), 0.0, length);
    const double height =
        std::max(((c - a) - (c - a).dot(along) * along).norm(), kThinnest * length);
    Element e;
    e.vertices = {t[k], t[(k + 1) % 3], t[(k + 2) % 3]};
    e.area = 0.5 * length * height;
    e.gx = Vec3d(-1.0 / length, 1.0 / length, 0.0);
    e.gy = Vec3d((foot - length) / (length * height), -foot / (length * height), 1.0 / height);
    area_ += e.area;
    elements_.push_back(e);
  }
}

namespace {

struct Jacobian {
  double xx, xy, yx, yy;  ///< ∂(x, y of the plane) / ∂(x, y of the surface)
  double determinant() const { return xx * yy - xy * yx; }
};

template <class Element>
Jacobian jacobian(const Element& e, const Layout& layout) {
  Jacobian j{0.0, 0.0, 0.0, 0.0};
  for (int k = 0; k < 3; ++k) {
    const double x = layout(e.vertices[k], 0), y = layout(e.vertices[k], 1);
    j.xx += x * e.gx[k], j.xy += x * e.gy[k];
    j.yx += y * e.gx[k], j.yy += y * e.gy[k];
  }
  return j;
}

}  // namespace

double LayoutEnergy::evaluate(const Layout& layout, Layout* gradient) const {
  if (gradient) gradient->setZero(layout.rows(), 2);
  double energy = 0.0;
  for (const Element& e : elements_) {
    const Jacobian j = jacobian(e, layout);
    const double det = j.determinant();
    if (!(det > 0.0)) return std::numeric_limits<double>::infinity();
    const double norm = j.xx * j.xx + j.xy * j.xy + j.yx * j.yx + j.yy * j.yy;
    const double inverse = 1.0 / (det * det);
    energy += e.area * norm * (1.0 + inverse);
    if (!gradient) continue;
    const double p = 2.0 * e.area * (1.0 + inverse), q = -2.0 * e.area * norm * inverse / det;
    const double dxx = p * j.xx + q * j.yy, dxy = p * j.xy - q * j.yx;
    const double dyx = p * j.yx - q * j.xy, dyy = p * j.yy + q * j.xx;
    for (int k = 0; k < 3; ++k) {
      (*gradient)(e.vertices[k], 0) += dxx * e.gx[k] + dxy * e.gy[k];
      (*gradient)(e.vertices[k], 1) += dyx * e.gx[k] + dyy * e.gy[k];
    }
  }
  return energy;
}

double LayoutEnergy::largestStep(const Layout& layout, const Layout& direction) const {
  double largest = std::numeric_limits<double>::infinity();
  for (const Element& e : elements_) {
    const Jacobian j = jacobian(e, layout), d = jacobian(e, direction);
    // det(J + s D) = c + b s + a s²
    const double a = d.determinant(), c = j.determinant();
    const double b = j.xx * d.yy + d.xx * j.yy - j.xy * d.yx - d.xy * j.yx;
    const double discriminant = b * b - 4.0 * a * c;
    if (discriminant < 0.0) continue;
    // The smaller positive root, in the form that does not cancel.
    const double root = std::sqrt(discriminant);
    const double q = -0.5 * (b + (b < 0.0 ? -root : root));
    for (const double s : {a != 0.0 ? q / a : 0.0, q != 0.0 ? c / q : 0.0})
      if (s > 0.0) largest = std::min(largest, s);
  }
  return largest;
}

bool LayoutEnergy::flipFree(const Layout& layout) const {
  return std::all_of(elements_.begin(), elements_.end(),
                     [&](const Element& e) { return jacobian(e, layout).determinant() > 1e-9; });
}

Eigen::SparseMatrix<double> LayoutEnergy::laplacian() const {
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(9 * elements_.size());
  for (const Element& e : elements_)
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k)
        entries.emplace_back(e.vertices[i], e.vertices[k],
                             e.area * (e.gx[i] * e.gx[k] + e.gy[i] * e.gy[k]));
  const auto size = static_cast<Eigen::Index>(vertices_);
  Eigen::SparseMatrix<double> matrix(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

Layout LayoutEnergy::rigidTarget(const Layout& layout) const {
  Layout target = Layout::Zero(layout.rows(), 2);
  for (const Element& e : elements_) {
    const Jacobian j = jacobian(e, layout);
    // The nearest rotation to a 2×2 matrix, in closed form.
    double c = j.xx + j.yy, s = j.yx - j.xy;
    const double length = std::hypot(c, s);
    if (length > 0.0)
      c /= length, s /= length;
    else
      c = 1.0, s = 0.0;
    for (int k = 0; k < 3; ++k) {
      target(e.vertices[k], 0) += e.area * (c * e.gx[k] - s * e.gy[k]);
      target(e.vertices[k], 1) += e.area * (s * e.gx[k] + c * e.gy[k]);
    }
  }
  return target;
}

}  // namespace lambent::atlas
