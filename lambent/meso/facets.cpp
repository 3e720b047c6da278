#include "lambent/meso/facets.h"

#include <algorithm>
#include <cmath>

namespace lambent::meso {

namespace {

/// Facets of a triangle with n cuts lie in rows of rising u; row i has 2(n − i) − 1 of them, the
/// even ones upright, the odd ones upside down. i(2n − i) come before it.
struct Part {
  int row, along;
};

Part partOf(int n, float u, float v) {
  const int row = std::clamp(static_cast<int>(u * n), 0, n - 1);
  const int column = std::clamp(static_cast<int>(v * n), 0, n - 1 - row);
  const bool upsideDown = u * n - row + (v * n - column) > 1.0f && row + column < n - 1;
  return {row, 2 * column + upsideDown};
}

bool isGrey(const Rgb& colour) {
  return colour[0] == colour[1] && colour[1] == colour[2];
}

}  // namespace

Facets::Facets(const PeriodicScene& scene, float spacing) {
  constexpr int kMostCuts = 1024;
  std::uint32_t triangle = 0;
  for (const scene::Mesh& mesh : scene.tile().meshes) {
    const scene::Material& material = scene.tile().materials[mesh.material];
    grey_ = grey_ && material.baseColorTexture < 0 && isGrey(material.diffuse) &&
            isGrey(material.glossy) && std::all_of(mesh.colors.begin(), mesh.colors.end(), isGrey);
    for (const scene::Triangle& t : mesh.triangles) {
      float longest = 0.0f;
      for (int k = 0; k < 3; ++k)
        longest = std::max(longest, (mesh.positions[t[k]] - mesh.positions[t[(k + 1) % 3]]).norm());
      const int n = std::clamp(static_cast<int>(std::ceil(longest / spacing)), 1, kMostCuts);
      first_.push_back(static_cast<std::uint32_t>(points_.size()));
      cuts_.push_back(static_cast<std::uint16_t>(n));
      for (int row = 0; row < n; ++row)
        for (int along = 0; along < 2 * (n - row) - 1; ++along) {
          const float third = along % 2 == 0 ? 1.0f / 3.0f : 2.0f / 3.0f;
          PeriodicHit middle;
          middle.triangle = triangle;
          middle.u = (row + third) / n, middle.v = (along / 2 + third) / n;
          points_.push_back(scene.surfaceAt(middle));
        }
      ++triangle;
    }
  }
}

std::uint32_t Facets::at(const PeriodicHit& hit) const {
  const int n = cuts_[hit.triangle];
  if (n == 1) return first_[hit.triangle];
  const Part part = partOf(n, hit.u, hit.v);
  return first_[hit.triangle] +
         static_cast<std::uint32_t>(part.row * (2 * n - part.row) + part.along);
}

Rgb Facets::albedo(std::uint32_t facet) const {
  return (points_[facet].diffuse + points_[facet].glossy).min(1.0f);
}

}  // namespace lambent::meso
