// Cuts and turns are read off doubled vertices, singularities off the tangents around welded ones
// (cross_field.h). web/viewer/src/patch_lay.ts does the same.
#include "lambent/synthesis/patch_lay.h"

#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <map>

#include <Eigen/Geometry>

#include "lambent/math/sequences.h"
#include "lambent/synthesis/cross_field.h"
#include "lambent/synthesis/frames.h"
#include "lambent/synthesis/manifold.h"

namespace lambent::synthesis {
namespace {

constexpr float kStrokeLength = 0.7f;  // of the spacing
/// Candidates in a square as wide as the spacing. Of so many a disc of that width keeps about
/// kKept; of any number 0.70 (random sequential adsorption: 0.547 of the surface are covered).
constexpr double kCandidates = 6.0, kKept = 0.6;
/// Share of the vertices along cuts at which a turn is one of the patch's; fields that vary within
/// a triangle's length look turned at a few.
constexpr double kTurnedShare = 0.05;
constexpr double kTurnWidth = kPi / 12;

std::uint32_t vertexAt(const scene::Mesh& mesh, std::uint32_t corner) {
  return mesh.triangles[corner / 3][corner % 3];
}

/// visit(h, twin) once for each edge that is a cut.
template <class Visit>
void visitCuts(const scene::Mesh& mesh, const Manifold& m, const Visit& visit) {
  const auto apart = [&](std::uint32_t a, std::uint32_t b) {
    return mesh.uvs[vertexAt(mesh, a)] != mesh.uvs[vertexAt(mesh, b)];
  };
  for (std::uint32_t h = 0; h < m.twin.size(); ++h) {
    const std::uint32_t twin = m.twin[h];
    if (twin == kNone || twin < h) continue;
    if (apart(h, Manifold::next(twin)) || apart(Manifold::next(h), twin)) visit(h, twin);
  }
}

int turnsOf(const scene::Mesh& mesh, const Manifold& m, std::span<const Vec3> tangents) {
  std::array<double, 4> turned{};  // by quarters
  double all = 0.0;
  visitCuts(mesh, m, [&](std::uint32_t h, std::uint32_t twin) {
    const std::uint32_t a = vertexAt(mesh, h), b = vertexAt(mesh, Manifold::next(twin));
    const Vec3 n = mesh.normals[a];
    const Vec3 other = turnedInto(tangents[b], mesh.normals[b], n);
    const double angle =
        std::atan2(double(n.dot(tangents[a].cross(other))), double(tangents[a].dot(other)));
    const long quarters = std::lround(angle / (0.5 * kPi));
    if (std::abs(angle - 0.5 * kPi * double(quarters)) < kTurnWidth)
      ++turned[std::size_t(quarters & 3)];
    ++all;
  });
  if (turned[1] + turned[3] > kTurnedShare * all) return 4;
  return turned[2] > kTurnedShare * all ? 2 : 1;
}

Vec3 normalBetween(const scene::Mesh& mesh, std::uint32_t a, std::uint32_t b) {
  return (mesh.normals[a] + mesh.normals[b]).stableNormalized();
}

/// Places at least `spacing` apart: of candidates spread by area, in the sequence of the triangles,
/// each that is far enough from all before it.
std::vector<PatchLay::Line> strokesOf(const scene::Mesh& mesh, std::span<const Vec3> tangents,
                                      float spacing) {
  std::vector<PatchLay::Line> strokes;
  std::map<std::array<int, 3>, std::vector<Vec3>> kept;  // by cells as wide as the spacing
  const auto cellOf = [&](const Vec3& p) {
    std::array<int, 3> cell;
    for (int k = 0; k < 3; ++k) cell[std::size_t(k)] = int(std::floor(p[k] / spacing));
    return cell;
  };
  const auto isFree = [&](const Vec3& p) {
    const auto [x, y, z] = cellOf(p);
    for (int i = 0; i < 27; ++i) {
      const auto found = kept.find({x + i % 3 - 1, y + i / 3 % 3 - 1, z + i / 9 - 1});
      if (found == kept.end()) continue;
      for (const Vec3& other : found->second)
        if ((other - p).squaredNorm() < spacing * spacing) return false;
    }
    return true;
  };
  const double step = double(spacing) * spacing / kCandidates;
  double area = 0.0;
  std::uint32_t index = 0;
  for (const auto& [i, j, k] : mesh.triangles) {
    const Vec3 &p = mesh.positions[i], e1 = mesh.positions[j] - p, e2 = mesh.positions[k] - p;
    const Vec3 cross = e1.cross(e2);
    area += 0.5 * double(cross.norm());
    for (; (index + 0.5) * step < area; ++index) {
      Vec2 at = math::r2(index);
      if (at.sum() > 1.0f) at = Vec2::Ones() - at;
      const Vec3 place = p + at.x() * e1 + at.y() * e2;
      if (!isFree(place)) continue;
      const Vec3 weights(1.0f - at.sum(), at.x(), at.y());
      Vec3 along = weights[0] * tangents[i] + weights[1] * tangents[j] + weights[2] * tangents[k];
      Vec3 normal = weights[0] * mesh.normals[i] + weights[1] * mesh.normals[j] +
                    weights[2] * mesh.normals[k];
      normal.stableNormalize();
      const Vec3 face = cross.stableNormalized();
      along -= along.dot(face) * face;
      if (!(along.norm() > 1e-3f)) continue;
      kept[cellOf(place)].push_back(place);
      along *= 0.5f * kStrokeLength * spacing / along.norm();
      strokes.push_back({place - along, place + along, normal});
    }
  }
  return strokes;
}

}  // namespace

PatchLay patchLay(const scene::Mesh& mesh, std::span<const Vec3> tangents, float spacing) {
  assert(mesh.normals.size() == mesh.positions.size());
  assert(mesh.uvs.size() == mesh.positions.size() && tangents.size() == mesh.positions.size());
  assert(spacing > 0.0f);
  const Manifold m = manifoldOf(mesh);
  PatchLay lay;
  lay.turns = turnsOf(mesh, m, tangents);
  const CrossField field = crossField(mesh, m, tangents, lay.turns);
  for (const auto& [v, index] : field.singularities) {
    const std::uint32_t vertex = vertexAt(mesh, m.firstCorner[v]);
    lay.singularities.push_back({mesh.positions[vertex], mesh.normals[vertex], index});
  }
  visitCuts(mesh, m, [&](std::uint32_t h, std::uint32_t) {
    const std::uint32_t a = vertexAt(mesh, h), b = vertexAt(mesh, Manifold::next(h));
    lay.cuts.push_back({mesh.positions[a], mesh.positions[b], normalBetween(mesh, a, b)});
  });
  lay.field = strokesOf(mesh, tangents, spacing);
  return lay;
}

float strokeSpacing(double area, int strokes) {
  return float(std::sqrt(kKept * area / double(strokes)));
}

}  // namespace lambent::synthesis
