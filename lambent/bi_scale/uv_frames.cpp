// ∂P/∂u and ∂P/∂v of a triangle with edges e₁, e₂ and UV edges d₁, d₂ solve
//   e₁ = d₁.u ∂P/∂u + d₁.v ∂P/∂v,  e₂ = d₂.u ∂P/∂u + d₂.v ∂P/∂v.
#include "lambent/bi_scale/uv_frames.h"

#include <cmath>
#include <optional>
#include <utility>

#include <Eigen/Geometry>

#include "lambent/math/directions.h"

namespace lambent::bi_scale {

namespace {

struct Gradient {
  Vec3 alongU, alongV;
  float area = 0.0f;  ///< of the triangle, m²
  bool mirrored = false;
};

std::optional<Gradient> gradientOf(const scene::Mesh& mesh, const scene::Triangle& t) {
  const Vec3 e1 = mesh.positions[t[1]] - mesh.positions[t[0]];
  const Vec3 e2 = mesh.positions[t[2]] - mesh.positions[t[0]];
  const Vec2 d1 = mesh.uvs[t[1]] - mesh.uvs[t[0]], d2 = mesh.uvs[t[2]] - mesh.uvs[t[0]];
  const float determinant = d1.x() * d2.y() - d1.y() * d2.x();
  if (!(std::abs(determinant) > 1e-20f)) return std::nullopt;
  // v runs downwards: a front seen upright has its UVs wound the other way round.
  return Gradient{(e1 * d2.y() - e2 * d1.y()) / determinant,
                  (e2 * d1.x() - e1 * d2.x()) / determinant, 0.5f * e1.cross(e2).norm(),
                  determinant > 0.0f};
}

}  // namespace

Result<WithFindings<std::vector<Vec3>>> uvTangents(const scene::Mesh& mesh) {
  if (mesh.uvs.size() != mesh.positions.size())
    return report::badInput("mesh \"" + mesh.name +
                            "\" has no UVs to place the patch by: leave the placement to the "
                            "synthesis, or give the mesh UVs");
  std::vector<Vec3> tangents(mesh.positions.size(), Vec3::Zero());
  std::uint64_t mirrored = 0, degenerate = 0;
  for (const scene::Triangle& t : mesh.triangles) {
    const auto gradient = gradientOf(mesh, t);
    if (!gradient) {
      ++degenerate;
      continue;
    }
    mirrored += gradient->mirrored;
    for (const std::uint32_t v : t) tangents[v] += gradient->area * gradient->alongU.normalized();
  }
  for (std::size_t v = 0; v < tangents.size(); ++v) {
    const Vec3& n = mesh.normals[v];
    const Vec3 t = tangents[v] - n * n.dot(tangents[v]);
    tangents[v] =
        t.squaredNorm() > 1e-30f ? Vec3(t.normalized()) : Vec3(math::worldFromTangent(n).col(0));
  }
  Findings findings;
  if (mirrored > 0)
    findings.push_back({Severity::Warning, "mirrored-uvs",
                        std::to_string(mirrored) + " triangles of mesh \"" + mesh.name +
                            "\" have mirrored UVs: there the patch lies inside out along v, and "
                            "its shadows fall the wrong way. Turn these UVs over, or let the "
                            "synthesis place the patch",
                        mirrored});
  if (degenerate > 0)
    findings.push_back({Severity::Note, "degenerate-uvs",
                        std::to_string(degenerate) + " triangles of mesh \"" + mesh.name +
                            "\" cover no area of the UV square",
                        degenerate});
  return WithFindings<std::vector<Vec3>>{std::move(tangents), std::move(findings)};
}

Vec2 metresPerUv(const scene::Mesh& mesh) {
  double u = 0.0, v = 0.0, area = 0.0;
  for (const scene::Triangle& t : mesh.triangles)
    if (const auto gradient = gradientOf(mesh, t)) {
      u += double(gradient->area) * gradient->alongU.norm();
      v += double(gradient->area) * gradient->alongV.norm();
      area += gradient->area;
    }
  return area > 0.0 ? Vec2(float(u / area), float(v / area)) : Vec2(1.0f, 1.0f);
}

}  // namespace lambent::bi_scale
