#include "lambent/scene/layers.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "lambent/radiometry/srgb.h"
#include "lambent/scene/shapes.h"

namespace lambent::scene {
namespace {

constexpr float kLeastAlpha = 0.5f / 255.0f;  ///< what a texel can not say

std::uint8_t codeOf(float share) {
  return std::uint8_t(std::lround(255.0f * std::clamp(share, 0.0f, 1.0f)));
}

/// The centre of a texel.
Vec2 centerOf(const Texture& texture, double x, double y) {
  return Vec2(float((x + 0.5) / texture.width), float((y + 0.5) / texture.height));
}

/// Whether bilinear look-ups anywhere on a triangle of the texture plane meet alpha: texels reach
/// as far as the centres of their neighbours. `p` in texels, texels' centres at whole numbers.
bool meetsAlpha(const Texture& texture, const std::array<Vec2d, 3>& p) {
  const Vec2d low = p[0].cwiseMin(p[1]).cwiseMin(p[2]), high = p[0].cwiseMax(p[1]).cwiseMax(p[2]);
  const Vec2d texels = high - low + Vec2d::Constant(2.0);
  // Over the whole of it many times, or not finite.
  if (!(texels.prod() < std::max(65536.0, 4.0 * texture.width * texture.height))) return true;
  const auto cross = [](const Vec2d& a, const Vec2d& b) { return a.x() * b.y() - a.y() * b.x(); };
  const double side = cross(p[1] - p[0], p[2] - p[0]) < 0.0 ? -1.0 : 1.0;
  const auto reaches = [&](const Vec2d& texel) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec2d edge = p[(k + 1) % 3] - p[k];
      if (side * cross(edge, texel - p[k]) + edge.cwiseAbs().sum() < 0.0) return false;
    }
    return true;
  };
  for (double y = std::floor(low.y()); y < high.y() + 1.0; ++y)
    for (double x = std::floor(low.x()); x < high.x() + 1.0; ++x)
      if (reaches({x, y}) && sampleAlpha(texture, centerOf(texture, x, y)) > kLeastAlpha)
        return true;
  return false;
}

std::array<Vec3, 3> cornersOf(const Mesh& mesh, std::uint32_t triangle) {
  const auto [i, j, k] = mesh.triangles[triangle];
  return {mesh.positions[i], mesh.positions[j], mesh.positions[k]};
}

/// The corner that is least by its coordinates.
int leastOf(const std::array<Vec3, 3>& corners) {
  const auto less = [](const Vec3& a, const Vec3& b) {
    return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
  };
  return int(std::min_element(corners.begin(), corners.end(), less) - corners.begin());
}

std::array<Vec3, 3> turned(const std::array<Vec3, 3>& corners, int first) {
  std::array<Vec3, 3> from = corners;
  std::rotate(from.begin(), from.begin() + first, from.end());
  return from;
}

/// −1, 0, 1.
int compared(const std::array<Vec3, 3>& a, const std::array<Vec3, 3>& b) {
  for (std::size_t k = 0; k < 3; ++k)
    for (int c = 0; c < 3; ++c)
      if (a[k][c] != b[k][c]) return a[k][c] < b[k][c] ? -1 : 1;
  return 0;
}

}  // namespace

Texture masked(const Texture* color, const Texture& mask, int channel) {
  assert(channel >= 0 && channel < 3);
  Texture alpha = mask;
  for (std::size_t i = 0; i + 3 < alpha.rgba.size(); i += 4)
    alpha.rgba[i + 3] = alpha.rgba[i + std::size_t(channel)];

  Texture made;
  made.name = mask.name;
  made.width = color ? std::max(color->width, mask.width) : mask.width;
  made.height = color ? std::max(color->height, mask.height) : mask.height;
  made.wrapU = alpha.wrapU = color ? color->wrapU : mask.wrapU;
  made.wrapV = alpha.wrapV = color ? color->wrapV : mask.wrapV;
  made.rgba.reserve(4 * std::size_t(made.width) * std::size_t(made.height));
  for (int y = 0; y < made.height; ++y)
    for (int x = 0; x < made.width; ++x) {
      const Vec2 uv = centerOf(made, x, y);
      const Rgb rgb = color ? sampleBaseColor(*color, uv) : Rgb(Rgb::Ones());
      for (const float linear : rgb) made.rgba.push_back(codeOf(radiometry::srgbEncode(linear)));
      made.rgba.push_back(codeOf(sampleAlpha(alpha, uv)));
    }
  return made;
}

std::vector<std::uint32_t> trianglesWithAlpha(const Mesh& mesh, const Texture& texture) {
  assert(mesh.uvs.size() == mesh.positions.size());
  std::vector<std::uint32_t> found;
  bool any = false;
  for (std::size_t i = 3; i < texture.rgba.size(); i += 4) any = any || texture.rgba[i] > 0;
  const Vec2d size(texture.width, texture.height);
  for (std::uint32_t t = 0; any && t < mesh.triangles.size(); ++t) {
    std::array<Vec2d, 3> p;
    for (std::size_t k = 0; k < 3; ++k)
      p[k] =
          mesh.uvs[mesh.triangles[t][k]].cast<double>().cwiseProduct(size) - Vec2d::Constant(0.5);
    if (meetsAlpha(texture, p)) found.push_back(t);
  }
  return found;
}

std::vector<std::uint32_t> makeLayer(Mesh& mesh, const std::vector<std::uint32_t>& triangles) {
  std::vector<Triangle> kept;
  for (const std::uint32_t t : triangles) kept.push_back(mesh.triangles[t]);
  mesh.triangles = std::move(kept);
  mesh.layer = true;
  mesh.source = {};  // the file had none
  return dropUnusedVertices(mesh);
}

Layers::Layers(const Scene& scene) : scene_(scene) {
  for (std::uint32_t m = 0; m < scene.meshes.size(); ++m) {
    const Mesh& mesh = scene.meshes[m];
    for (std::uint32_t t = 0; mesh.layer && t < mesh.triangles.size(); ++t) {
      const std::array<Vec3, 3> corners = cornersOf(mesh, t);
      const int first = leastOf(corners);
      all_.push_back({turned(corners, first), m, t, first});
    }
  }
  std::sort(all_.begin(), all_.end(), [](const Entry& a, const Entry& b) {
    const int order = compared(a.corners, b.corners);
    return order != 0 ? order < 0 : a.mesh != b.mesh ? a.mesh > b.mesh : a.triangle < b.triangle;
  });
}

std::vector<Layers::Place> Layers::above(std::uint32_t mesh, std::uint32_t triangle, float u,
                                         float v) const {
  std::vector<Place> places;
  const std::array<Vec3, 3> corners = cornersOf(scene_.meshes[mesh], triangle);
  const int first = leastOf(corners);
  const std::array<Vec3, 3> sought = turned(corners, first);
  auto at = std::lower_bound(all_.begin(), all_.end(), sought,
                             [](const Entry& entry, const std::array<Vec3, 3>& corners_) {
                               return compared(entry.corners, corners_) < 0;
                             });
  const std::array<float, 3> weights = {1.0f - u - v, u, v};
  for (; at != all_.end() && compared(at->corners, sought) == 0; ++at) {
    const auto weight = [&](int corner) {
      return weights[std::size_t(corner - at->first + first + 3) % 3];
    };
    places.push_back({at->mesh, at->triangle, weight(1), weight(2)});
  }
  return places;
}

}  // namespace lambent::scene
