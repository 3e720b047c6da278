#include "lambent/meso/height_field.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace lambent::meso {

Patch patchOf(const HeightField& field, const Vec2& size, const scene::Material& material,
              std::string name) {
  const int w = field.width, h = field.height;
  assert(w >= 2 && h >= 2 && field.heights.size() == std::size_t(w) * h);
  const double dx = double(size.x()) / w, dy = double(size.y()) / h;
  scene::Mesh mesh;
  mesh.name = name;
  for (int y = 0; y <= h; ++y)
    for (int x = 0; x <= w; ++x) {
      const int i = x % w, j = y % h;
      mesh.positions.emplace_back(static_cast<float>((x + 0.5) * dx),
                                  static_cast<float>((y + 0.5) * dy), field.at(i, j));
      const double slopeX = (field.at((i + 1) % w, j) - field.at((i + w - 1) % w, j)) / (2.0 * dx);
      const double slopeY = (field.at(i, (j + 1) % h) - field.at(i, (j + h - 1) % h)) / (2.0 * dy);
      mesh.normals.push_back(Vec3d(-slopeX, -slopeY, 1.0).normalized().cast<float>());
      mesh.uvs.emplace_back(static_cast<float>((x + 0.5) / w),
                            static_cast<float>(1.0 - (y + 0.5) / h));
      if (!field.colors.empty()) mesh.colors.push_back(field.colors[std::size_t(j) * w + i]);
    }
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x) {
      const auto a = static_cast<std::uint32_t>(y * (w + 1) + x), b = a + 1;
      const std::uint32_t c = b + static_cast<std::uint32_t>(w), d = c + 1;
      const float rising = std::abs(mesh.positions[a].z() - mesh.positions[d].z());
      const float falling = std::abs(mesh.positions[b].z() - mesh.positions[c].z());
      if (rising <= falling) {
        mesh.triangles.push_back({a, b, d});
        mesh.triangles.push_back({a, d, c});
      } else {
        mesh.triangles.push_back({a, b, c});
        mesh.triangles.push_back({b, d, c});
      }
    }
  Patch patch;
  patch.name = std::move(name);
  patch.size = size;
  patch.scene.materials.push_back(material);
  patch.scene.meshes.push_back(std::move(mesh));
  return patch;
}

namespace {

/// 0 at a border, 1 from `margin` of the period inwards, smooth.
float inside(int i, int count, float margin) {
  const float toBorder = std::min(i + 0.5f, count - i - 0.5f) / static_cast<float>(count);
  const float t = std::clamp(toBorder / margin, 0.0f, 1.0f);
  return t * t * (3.0f - 2.0f * t);
}

}  // namespace

HeightField withBlendedBorders(const HeightField& field, float margin) {
  assert(margin >= 0.0f && margin <= 0.5f);
  if (margin <= 0.0f) return field;
  const int w = field.width, h = field.height;
  const auto index = [w](int x, int y) { return std::size_t(y) * w + x; };
  HeightField out = field;
  // One axis after the other: the second pass blends rows that already tile along x.
  for (int axis = 0; axis < 2; ++axis) {
    const HeightField before = out;
    for (int y = 0; y < h; ++y)
      for (int x = 0; x < w; ++x) {
        const float keep = axis == 0 ? inside(x, w, margin) : inside(y, h, margin);
        const std::size_t at = index(x, y);
        const std::size_t moved = axis == 0 ? index((x + w / 2) % w, y) : index(x, (y + h / 2) % h);
        out.heights[at] = keep * before.heights[at] + (1.0f - keep) * before.heights[moved];
        if (!out.colors.empty())
          out.colors[at] = keep * before.colors[at] + (1.0f - keep) * before.colors[moved];
      }
  }
  return out;
}

}  // namespace lambent::meso
