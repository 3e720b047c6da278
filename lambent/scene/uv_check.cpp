#include <algorithm>
#include <cassert>
#include <cmath>
#include <string>

#include "lambent/scene/diagnose.h"
#include "lambent/scene/texel_map.h"

namespace lambent::scene {
namespace {

/// How far inside a triangle, in texels, a centre must lie to be claimed by it alone: triangles
/// that share an edge do not overlap, however it was rounded.
constexpr double kInside = 1.0 / 64.0;

/// How far inside its triangle the place with these barycentric coordinates lies, in texels.
double depthInside(const Mesh& mesh, const Triangle& triangle, int width, int height, double u,
                   double v) {
  Vec2d p[3];
  for (int k = 0; k < 3; ++k)
    p[k] = texelUvsOf(mesh)[triangle[k]].cast<double>().cwiseProduct(Vec2d(width, height));
  const Vec2d e = p[1] - p[0], f = p[2] - p[0];
  const double area = std::abs(e.x() * f.y() - e.y() * f.x());
  // A barycentric coordinate is 1 at its corner, and that far from the opposite edge.
  return area * std::min({(1.0 - u - v) / (p[2] - p[1]).norm(), u / f.norm(), v / e.norm()});
}

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
  const std::vector<Vec2>& uvs = texelUvsOf(mesh);
  if (uvs.size() != mesh.positions.size() || uvs.empty()) {
    return report::badInput(name +
                            " has no texture coordinates, which a texel grid needs; unwrap it in a "
                            "modelling program, or bake at its vertices");
  }
  for (std::size_t i = 0; i < uvs.size(); ++i) {
    const Vec2& uv = uvs[i];
    if (!(uv.minCoeff() >= -1e-5f && uv.maxCoeff() <= 1.0f + 1e-5f)) {
      return report::badInput(
          name + ": vertex " + std::to_string(i) + " has the texture coordinate (" +
          number(uv.x()) + ", " + number(uv.y()) +
          "), outside the square 0 to 1 that a texel grid covers; unwrap the mesh "
          "without repetition, or bake at its vertices");
    }
  }

  std::vector<std::uint32_t> owner(std::size_t(width) * height, kNobody);
  std::size_t covered = 0, overlapping = 0;
  std::uint32_t firstPair[2] = {0, 0};
  int firstTexel[2] = {0, 0};
  for (std::size_t triangle = 0; triangle < mesh.triangles.size(); ++triangle) {
    const Triangle& corners = mesh.triangles[triangle];
    visitTexels(mesh, corners, width, height, [&](int x, int y, double u, double v) {
      ++covered;
      if (!(depthInside(mesh, corners, width, height, u, v) > kInside)) return;
      std::uint32_t& own = owner[std::size_t(y) * width + x];
      if (own == kNobody) {
        own = std::uint32_t(triangle);
        return;
      }
      if (overlapping == 0) {
        firstPair[0] = own, firstPair[1] = std::uint32_t(triangle);
        firstTexel[0] = x, firstTexel[1] = y;
      }
      ++overlapping;
    });
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
