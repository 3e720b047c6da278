// How far a layout of triangles in the plane is from isometry: the symmetric Dirichlet energy.
#pragma once

#include <vector>

#include <Eigen/SparseCore>

#include "lambent/atlas/chart_patch.h"

namespace lambent::atlas {

/// Coordinates of all vertices: column 0 is x, column 1 is y.
using Layout = Eigen::MatrixX2d;

class LayoutEnergy {
 public:
  explicit LayoutEnergy(const ChartPatch& patch);

  /// Σ area · (σ₁² + σ₂² + 1/σ₁² + 1/σ₂²) with the singular values σ of surface → plane, 4 · area
  /// where lengths are kept; infinite if a triangle is turned over or has no area. With `gradient`,
  /// its derivative by every coordinate as well.
  double evaluate(const Layout& layout, Layout* gradient = nullptr) const;
  /// The largest step along `direction` from `layout` at which no triangle has lost its area yet;
  /// infinite if none ever does.
  double largestStep(const Layout& layout, const Layout& direction) const;
  bool flipFree(const Layout& layout) const;

  /// Weights of Σ over edges w (uᵢ − uⱼ)² = Σ area · |gradient|²: cotangents of the angles
  /// opposite. A symmetric matrix of the weights, with their sums on the diagonal.
  Eigen::SparseMatrix<double> laplacian() const;
  /// The right-hand side of the global step of "as rigid as possible": what the Laplacian would
  /// make of every triangle's own shape, turned to lie as `layout` has it.
  Layout rigidTarget(const Layout& layout) const;

  double area() const { return area_; }

 private:
  struct Element {
    std::array<std::uint32_t, 3> vertices;
    /// Gradients of the three hat functions in the triangle's own plane, 1/m.
    Vec3d gx, gy;
    double area;
  };
  std::vector<Element> elements_;
  std::size_t vertices_;
  double area_ = 0.0;
};

}  // namespace lambent::atlas
