// Which texel belongs to which chart: what pictures of an atlas show and tests ask.
#include <algorithm>
#include <cmath>

#include "lambent/atlas/atlas.h"
#include "lambent/atlas/flatten.h"
#include "lambent/atlas/touched_texels.h"

namespace lambent::atlas {
namespace {

/// Borders that lie on the line between two texels, but for rounding, touch one of them.
constexpr double kRounding = 1e-3;

template <class Visit>
void forTexels(const Atlas& atlas, int size, const Visit& visit) {
  for (std::uint32_t t = 0; t < atlas.mesh.triangles.size(); ++t) {
    const std::uint32_t chart = atlas.chartOfTriangle[t];
    Vec2d p[3];
    for (int k = 0; k < 3; ++k)
      p[k] = atlas.mesh.uvs[atlas.mesh.triangles[t][k]].cast<double>() * size;
    const Vec2d e = p[1] - p[0], f = p[2] - p[0];
    if (e.x() * f.y() - e.y() * f.x() == 0.0) continue;
    forTouchedRows(p, -kRounding, [&](int y, int x0, int x1) {
      if (y < 0 || y >= size) return;
      for (int x = std::max(0, x0); x <= std::min(size - 1, x1); ++x)
        visit(std::size_t(y) * size + x, chart);
    });
  }
}

}  // namespace

std::vector<std::uint32_t> chartOfTexel(const Atlas& atlas, int size) {
  std::vector<std::uint32_t> texels(std::size_t(size) * size, kNoChart);
  forTexels(atlas, size, [&](std::size_t texel, std::uint32_t chart) {
    texels[texel] = std::min(texels[texel], chart);
  });
  return texels;
}

GutterCount countGutters(const Atlas& atlas, int size) {
  GutterCount count;
  const std::vector<std::uint32_t> texels = chartOfTexel(atlas, size);
  std::vector<bool> shared(texels.size());
  forTexels(atlas, size, [&](std::size_t texel, std::uint32_t chart) {
    if (texels[texel] != chart && !shared[texel]) shared[texel] = true, ++count.sharedTexels;
  });
  // A bilinear look-up in a texel reaches the texels around it; two of those reach the same texel
  // where they are two apart.
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      const std::uint32_t own = texels[std::size_t(y) * size + x];
      if (own == kNoChart) continue;
      bool narrow = false;
      for (int ny = std::max(0, y - 2); ny <= std::min(size - 1, y + 2) && !narrow; ++ny)
        for (int nx = std::max(0, x - 2); nx <= std::min(size - 1, x + 2) && !narrow; ++nx) {
          const std::uint32_t other = texels[std::size_t(ny) * size + nx];
          narrow = other != kNoChart && other != own;
        }
      if (narrow) ++count.narrowTexels;
    }
  return count;
}

}  // namespace lambent::atlas
