#include <algorithm>
#include <cassert>
#include <cmath>
#include <string>

#include "lambent/scene/diagnose.h"

namespace lambent::scene {
namespace {

/// Texel coordinates in steps of 1/4096 texel, whole numbers so that edges which two triangles
/// share are the same edge for both.
constexpr std::int64_t kStep = 4096;
/// How far inside a triangle, in steps, a texel's centre must lie to be claimed by it.
constexpr double kInside = kStep / 64.0;

struct TexelPoint {
  std::int64_t x, y;
};

std::string describe(const Mesh& mesh) {
  return mesh.name.empty() ? std::string("the mesh") : "mesh \"" + mesh.name + "\"";
}

std::string number(double value) {
  std::string text = std::to_string(value);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text;
}

}  // namespace

Status checkUvs(const Mesh& mesh, int width, int height) {
  assert(width > 0 && height > 0);
  const std::string name = describe(mesh);
  if (mesh.uvs.size() != mesh.positions.size() || mesh.uvs.empty()) {
    return report::badInput(name +
                            " has no texture coordinates, which a texel grid needs; unwrap it in a "
                            "modelling program, or bake at its vertices");
  }
  for (std::size_t i = 0; i < mesh.uvs.size(); ++i) {
    const Vec2& uv = mesh.uvs[i];
    if (!(uv.minCoeff() >= -1e-5f && uv.maxCoeff() <= 1.0f + 1e-5f)) {
      return report::badInput(
          name + ": vertex " + std::to_string(i) + " has the texture coordinate (" +
          number(uv.x()) + ", " + number(uv.y()) +
          "), outside the square 0 to 1 that a texel grid covers; unwrap the mesh "
          "without repetition, or bake at its vertices");
    }
  }

  constexpr std::uint32_t kNone = 0xffffffffu;
  std::vector<std::uint32_t> owner(std::size_t(width) * height, kNone);
  std::size_t covered = 0, overlapping = 0;
  std::uint32_t firstPair[2] = {0, 0};
  int firstTexel[2] = {0, 0};
  for (std::size_t triangle = 0; triangle < mesh.triangles.size(); ++triangle) {
    TexelPoint p[3];
    for (int i = 0; i < 3; ++i) {
      const Vec2& uv = mesh.uvs[mesh.triangles[triangle][i]];
      p[i] = {std::llround(double(uv.x()) * width * kStep),
              std::llround(double(uv.y()) * height * kStep)};
    }
    const std::int64_t area =
        (p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[1].y - p[0].y) * (p[2].x - p[0].x);
    if (area == 0) continue;
    if (area < 0) std::swap(p[1], p[2]);  // a mirrored chart covers texels just the same

    double margin[3];
    for (int i = 0; i < 3; ++i) {
      const TexelPoint &a = p[i], &b = p[(i + 1) % 3];
      margin[i] = kInside * std::hypot(double(b.x - a.x), double(b.y - a.y));
    }
    const auto [minX, maxX] = std::minmax({p[0].x, p[1].x, p[2].x});
    const auto [minY, maxY] = std::minmax({p[0].y, p[1].y, p[2].y});
    const int x0 = int(std::max<std::int64_t>(minX / kStep - 1, 0));
    const int x1 = int(std::min<std::int64_t>(maxX / kStep, width - 1));
    const int y0 = int(std::max<std::int64_t>(minY / kStep - 1, 0));
    const int y1 = int(std::min<std::int64_t>(maxY / kStep, height - 1));
    for (int y = y0; y <= y1; ++y) {
      for (int x = x0; x <= x1; ++x) {
        const TexelPoint c = {x * kStep + kStep / 2, y * kStep + kStep / 2};
        bool inside = true;
        for (int i = 0; i < 3 && inside; ++i) {
          const TexelPoint &a = p[i], &b = p[(i + 1) % 3];
          const std::int64_t edge = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
          inside = double(edge) > margin[i];
        }
        if (!inside) continue;
        std::uint32_t& own = owner[std::size_t(y) * width + x];
        if (own == kNone) {
          own = std::uint32_t(triangle);
          ++covered;
        } else {
          if (overlapping == 0) {
            firstPair[0] = own, firstPair[1] = std::uint32_t(triangle);
            firstTexel[0] = x, firstTexel[1] = y;
          }
          ++overlapping;
        }
      }
    }
  }
  if (overlapping > 0) {
    return report::badInput(
        name + ": its texture coordinates overlap in " + std::to_string(overlapping) +
        " texels of the " + std::to_string(width) + "×" + std::to_string(height) +
        " grid, first triangles " + std::to_string(firstPair[0]) + " and " +
        std::to_string(firstPair[1]) + " at texel (" + std::to_string(firstTexel[0]) + ", " +
        std::to_string(firstTexel[1]) +
        "); unwrap the mesh so that no two triangles share a texel, or bake at its "
        "vertices");
  }
  if (covered == 0) {
    return report::badInput(name + ": its texture coordinates cover no texel of the " +
                            std::to_string(width) + "×" + std::to_string(height) +
                            " grid; unwrap the mesh, ask for more texels, or bake at its vertices");
  }
  return Status::ok();
}

}  // namespace lambent::scene
