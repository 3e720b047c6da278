// This work is based on:
// - felzenszwalb2012distance: §2, the lower envelope of parabolas, one axis after the other. Here
//   what is kept is where the nearest full texel is, and all numbers are whole.
#include "lambent/scene/texel_map.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>

namespace lambent::scene {

TexelMap texelMap(const Mesh& mesh, int width, int height) {
  assert(width > 0 && height > 0 && texelUvsOf(mesh).size() == mesh.positions.size());
  TexelMap map;
  map.width = width, map.height = height;
  map.triangle.assign(std::size_t(width) * height, kNobody);
  map.barycentric.assign(map.triangle.size(), Vec2(Vec2::Zero()));
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    visitTexels(mesh, mesh.triangles[t], width, height, [&](int x, int y, double u, double v) {
      const std::size_t texel = std::size_t(y) * width + x;
      if (map.triangle[texel] != kNobody) return;
      map.triangle[texel] = t;
      map.barycentric[texel] = Vec2(static_cast<float>(u), static_cast<float>(v));
    });
  return map;
}

std::vector<std::uint32_t> nearestFull(int width, int height, std::span<const std::uint8_t> full) {
  assert(full.size() == std::size_t(width) * height);
  std::vector<std::uint32_t> nearest(full.size(), kNobody);
  // Along columns: the row of the nearest full texel, the upper one of two.
  std::vector<std::int32_t> row(full.size(), -1);
  for (int y = 1; y <= height; ++y)
    for (int x = 0; x < width; ++x) {
      const std::size_t t = std::size_t(y - 1) * width + x;
      row[t] = full[t] ? y - 1 : y > 1 ? row[t - width] : -1;
    }
  for (int y = height - 2; y >= 0; --y)
    for (int x = 0; x < width; ++x) {
      const std::size_t t = std::size_t(y) * width + x;
      const std::int32_t below = row[t + width];
      if (below >= 0 && (row[t] < 0 || below - y < y - row[t])) row[t] = below;
    }
  // Along rows: of the columns' nearest, those whose parabolas (x − column)² + height² are lowest
  // somewhere, from left to right.
  std::vector<std::int32_t> columns(width);
  std::vector<std::int64_t> heights(width);
  for (int y = 0; y < height; ++y) {
    const std::int32_t* rows = &row[std::size_t(y) * width];
    int count = 0;
    const auto squared = [](std::int64_t a) { return a * a; };
    // The last whole place at which parabola i is no higher than the later parabola k, by twice
    // the distance of their columns.
    const auto leads = [&](std::int32_t i, std::int64_t hi, std::int32_t k, std::int64_t hk) {
      const std::int64_t top = hk + squared(k) - hi - squared(i), bottom = 2 * (k - i);
      return top >= 0 ? top / bottom : -((-top + bottom - 1) / bottom);
    };
    for (std::int32_t x = 0; x < width; ++x) {
      if (rows[x] < 0) continue;
      const std::int64_t h = squared(rows[x] - y);
      while (count > 0) {
        const std::int64_t until = leads(columns[count - 1], heights[count - 1], x, h);
        const std::int64_t from = count > 1 ? leads(columns[count - 2], heights[count - 2],
                                                    columns[count - 1], heights[count - 1]) +
                                                  1
                                            : 0;
        if (until >= from) break;
        --count;
      }
      columns[count] = x, heights[count] = h;
      ++count;
    }
    if (count == 0) continue;
    int at = 0;
    for (std::int32_t x = 0; x < width; ++x) {
      while (at + 1 < count && heights[at + 1] + squared(x - columns[at + 1]) <
                                   heights[at] + squared(x - columns[at]))
        ++at;
      nearest[std::size_t(y) * width + x] = static_cast<std::uint32_t>(rows[columns[at]]) * width +
                                            static_cast<std::uint32_t>(columns[at]);
    }
  }
  return nearest;
}

}  // namespace lambent::scene
