// Feature lines in the tangent planes of a field that is to lie along or across them.
#pragma once

#include <complex>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "lambent/scene/scene.h"
#include "lambent/synthesis/manifold.h"
#include "lambent/synthesis/tangent_planes.h"

namespace lambent::synthesis {

/// 1 of nothing.
inline std::complex<double> unitOf(const std::complex<double>& z) {
  const double length = std::abs(z);
  return length > 0.0 ? z / length : std::complex<double>(1.0);
}

/// A feature line as the field sees it.
struct Feature {
  struct End {
    std::uint32_t vertex;
    double angle, share;  ///< of the line's way there; metres of the line that it stands for
  };
  std::vector<End> ends;
  double length = 0.0;
};

std::vector<Feature> featuresOf(const scene::Mesh& mesh, const Manifold& manifold,
                                const TangentPlanes& planes);

/// In quarters, how a feature's way is turned so that `base` agrees best, and by how much better it
/// does than with the next, in shares of the most that it can.
struct Choice {
  int quarters = 0;
  double margin = 2.0;
};

Choice choiceOf(const Feature& feature, const TangentPlanes& planes, const Eigen::VectorXcd& base);

}  // namespace lambent::synthesis
