// This work is based on:
// - sloan2003biscale: §4.3, "Constructing the ID Map": scan conversion, normal shooting among the k
//   nearest meso-vertices, dilation into gutters.
// - sander2001texture: normal shooting.
// Where we deviate: there a texel records its meso-vertex's place of the patch as it is; here the
// place is moved on by the texel's own offset from that vertex. And candidates whose normals point
// the other way are passed over: they are the other side of a thin sheet.
#include "lambent/synthesis/place_ids.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "lambent/scene/texel_map.h"
#include "lambent/scene/uv_steps.h"
#include "lambent/synthesis/point_tree.h"
#include "lambent/work/parallel_for.h"
#include "lambent/work/runner.h"

namespace lambent::synthesis {
namespace {

/// Buffers of one thread's searches.
struct Search {
  std::vector<std::uint32_t> indices;
  std::vector<float> distances;
};

/// The meso-vertex for a point P of normal N: of the k nearest, those that face as N does, the one
/// nearest to the line through P along N. If none faces so, of ever more; in the end the nearest.
std::uint32_t shoot(const auto& tree, const MesoMesh& mesh, const Vec3& at, const Vec3& normal,
                    std::size_t neighbours, Search& search) {
  const std::size_t count = mesh.positions.size();
  for (std::size_t k = std::min(neighbours, count);; k = std::min(4 * k, count)) {
    search.indices.resize(k), search.distances.resize(k);
    const std::size_t found =
        tree.knnSearch(at.data(), k, search.indices.data(), search.distances.data());
    float best = std::numeric_limits<float>::infinity();
    std::uint32_t chosen = search.indices[0];
    for (std::size_t i = 0; i < found; ++i) {
      const std::uint32_t v = search.indices[i];
      if (!(mesh.normals[v].dot(normal) > 0.0f)) continue;
      const Vec3 offset = mesh.positions[v] - at;
      const float distance = (offset - offset.dot(normal) * normal).squaredNorm();
      if (distance < best || (distance == best && v < chosen)) best = distance, chosen = v;
    }
    // Beyond a thousand, what faces the right way is no longer near.
    if (std::isfinite(best) || k == count || k >= 1024) return chosen;
  }
}

/// Charts that hold no texel's centre get the texel in which their first triangle's middle lies,
/// unless that is another's.
void giveEveryChartATexel(const atlas::Atlas& atlas, scene::TexelMap& map) {
  std::vector<bool> seen(atlas.charts);
  for (std::size_t texel = 0; texel < map.size(); ++texel)
    if (map.covered(texel)) seen[atlas.chartOfTriangle[map.triangle[texel]]] = true;
  for (std::uint32_t t = 0; t < atlas.mesh.triangles.size(); ++t) {
    const std::uint32_t chart = atlas.chartOfTriangle[t];
    if (chart >= seen.size() || seen[chart]) continue;
    const scene::Triangle& corners = atlas.mesh.triangles[t];
    const std::vector<Vec2>& uvs = atlas.mesh.uvs;
    const Vec2 middle = (uvs[corners[0]] + uvs[corners[1]] + uvs[corners[2]]) / 3.0f;
    const int x = std::clamp(static_cast<int>(middle.x() * map.width), 0, map.width - 1);
    const int y = std::clamp(static_cast<int>(middle.y() * map.height), 0, map.height - 1);
    const std::size_t texel = std::size_t(y) * map.width + x;
    if (map.covered(texel)) continue;
    map.triangle[texel] = t;
    map.barycentric[texel] = Vec2::Constant(1.0f / 3.0f);
    seen[chart] = true;
  }
}

/// The covered texels, block by block: texels that lie together need the same parts of the tree.
std::vector<std::uint32_t> coveredByBlocks(const scene::TexelMap& map) {
  constexpr int kBlock = 32;
  std::vector<std::uint32_t> texels;
  for (int y0 = 0; y0 < map.height; y0 += kBlock)
    for (int x0 = 0; x0 < map.width; x0 += kBlock)
      for (int y = y0; y < std::min(map.height, y0 + kBlock); ++y)
        for (int x = x0; x < std::min(map.width, x0 + kBlock); ++x) {
          const std::size_t texel = std::size_t(y) * map.width + x;
          if (map.covered(texel)) texels.push_back(static_cast<std::uint32_t>(texel));
        }
  return texels;
}

std::uint16_t codeOf(double place) {
  return static_cast<std::uint16_t>(
      static_cast<std::int64_t>(std::llround((place - std::floor(place)) * 65536.0)) & 0xffff);
}

Error tooSmall(int size) {
  return report::badInput("the atlas covers no texel of a " + std::to_string(size) + "×" +
                          std::to_string(size) + " map; ask for a larger one");
}

std::vector<std::uint8_t> fullTexels(const scene::TexelMap& map) {
  std::vector<std::uint8_t> full(map.size());
  for (std::size_t texel = 0; texel < map.size(); ++texel) full[texel] = map.covered(texel);
  return full;
}

}  // namespace

Result<transfer::IdMap> placeIds(const atlas::Atlas& atlas, const LatticeMap& lattice, int size) {
  if (size < 1 || size > 16384)
    return report::badUsage("an id map must have 1 to 16384 texels a side");
  scene::TexelMap map = scene::texelMap(atlas.mesh, size, size);
  giveEveryChartATexel(atlas, map);
  const std::vector<std::uint8_t> full = fullTexels(map);
  const std::vector<std::uint32_t> nearest = scene::nearestFull(size, size, full);
  if (nearest.empty() || nearest[0] == scene::kNobody) return tooSmall(size);
  transfer::IdMap ids;
  ids.width = ids.height = size;
  ids.ids.resize(2 * map.size());
  work::parallelRanges(map.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t texel = begin; texel < end; ++texel) {
      const std::uint32_t from = nearest[texel], t = map.triangle[from];
      const Vec2d q[3] = {lattice.places[3 * t].cast<double>(),
                          lattice.places[3 * t + 1].cast<double>(),
                          lattice.places[3 * t + 2].cast<double>()};
      const auto& [a, b, c] = atlas.mesh.triangles[t];
      Vec2d weights = map.barycentric[from].cast<double>();
      Eigen::Matrix2d sides;
      sides << (atlas.mesh.uvs[b] - atlas.mesh.uvs[a]).cast<double>(),
          (atlas.mesh.uvs[c] - atlas.mesh.uvs[a]).cast<double>();
      if (from != texel && std::abs(sides.determinant()) > 1e-18) {
        const double step = 1.0 / size;
        weights += sides.inverse() * Vec2d((double(texel % size) - double(from % size)) * step,
                                           (double(texel / size) - double(from / size)) * step);
      }
      const Vec2d place = q[0] + weights.x() * (q[1] - q[0]) + weights.y() * (q[2] - q[0]);
      ids.ids[2 * texel] = codeOf(place.x()), ids.ids[2 * texel + 1] = codeOf(place.y());
    }
  });
  return ids;
}

Result<transfer::IdMap> placeIds(const atlas::Atlas& atlas, const MesoMesh& mesh,
                                 std::span<const Vec2> coordinates, const IdMapOptions& options,
                                 const Progress& progress) {
  if (options.size < 1 || options.size > 16384)
    return report::badUsage("an id map must have 1 to 16384 texels a side");
  if (options.neighbours < 1)
    return report::badUsage("normal shooting needs one neighbour at least");
  if (!(options.patchSize.minCoeff() > 0.0f) || !options.patchSize.allFinite())
    return report::badUsage("the patch must have a size above 0");
  if (mesh.positions.empty()) return report::badInput("the meso-mesh has no vertices");
  if (mesh.normals.size() != mesh.positions.size() ||
      mesh.tangents.size() != mesh.positions.size() || coordinates.size() != mesh.positions.size())
    return report::badUsage(
        "the meso-mesh has " + std::to_string(mesh.positions.size()) +
        " vertices; normals, tangents and synthesised coordinates must be as many");

  scene::TexelMap map = scene::texelMap(atlas.mesh, options.size, options.size);
  giveEveryChartATexel(atlas, map);
  const std::vector<std::uint32_t> covered = coveredByBlocks(map);
  if (covered.empty()) return tooSmall(options.size);

  const Points points{mesh.positions.size(),
                      [&](std::size_t i) -> const Vec3& { return mesh.positions[i]; }};
  nanoflann::KDTreeSingleIndexAdaptorParams parameters;
  parameters.leaf_max_size = 16;
  const PointTree<decltype(points.position)> tree(3, points, parameters);

  transfer::IdMap ids;
  ids.width = ids.height = options.size;
  ids.ids.resize(2 * map.size());
  std::vector<std::uint32_t> mesoVertex(map.size());  // of covered texels
  // The patch as it lies at a meso-vertex, continued to a place.
  const auto write = [&](std::size_t texel, std::uint32_t v, const Vec3& at) {
    const Vec3 offset = at - mesh.positions[v];
    const Vec3& tangent = mesh.tangents[v];
    const Vec3 across = mesh.normals[v].cross(tangent);
    ids.ids[2 * texel] =
        codeOf(double(coordinates[v].x()) + double(offset.dot(tangent)) / options.patchSize.x());
    ids.ids[2 * texel + 1] =
        codeOf(double(coordinates[v].y()) + double(offset.dot(across)) / options.patchSize.y());
  };
  const auto mix = [&](std::uint32_t texel, const std::vector<Vec3>& of) -> Vec3 {
    const scene::Triangle& corners = atlas.mesh.triangles[map.triangle[texel]];
    const Vec2 b = map.barycentric[texel];
    return (1.0f - b.x() - b.y()) * of[corners[0]] + b.x() * of[corners[1]] +
           b.y() * of[corners[2]];
  };
  const auto place = [&](std::uint32_t texel, Search& search) {
    const scene::Triangle& corners = atlas.mesh.triangles[map.triangle[texel]];
    const Vec3 at = mix(texel, atlas.mesh.positions);
    Vec3 normal = mix(texel, atlas.mesh.normals);
    if (normal.squaredNorm() > 0.0f)
      normal.normalize();
    else
      normal = atlas.mesh.normals[corners[0]];
    const std::uint32_t v =
        shoot(tree, mesh, at, normal, static_cast<std::size_t>(options.neighbours), search);
    mesoVertex[texel] = v;
    write(texel, v, at);
  };
  const work::Runner runner(progress, options.threads);
  const Status placed = runner.run({"id map", "texels"}, work::Chunks(covered.size(), 1024),
                                   Search{}, [&](const work::Chunk& chunk, Search& search) {
                                     for (std::size_t k = chunk.begin; k < chunk.end; ++k)
                                       place(covered[k], search);
                                   });
  if (!placed) return placed.error();

  const std::vector<std::uint8_t> full = fullTexels(map);
  const std::vector<std::uint32_t> nearest = scene::nearestFull(options.size, options.size, full);
  work::parallelRanges(map.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t texel = begin; texel < end; ++texel) {
      if (full[texel]) continue;
      const std::uint32_t from = nearest[texel];
      const scene::UvSteps steps = scene::uvSteps(atlas.mesh, map.triangle[from]);
      const auto texels = [&](std::size_t a, std::size_t b) {
        return (float(a) - float(b)) / float(options.size);
      };
      const std::size_t size = std::size_t(options.size);
      write(texel, mesoVertex[from],
            mix(from, atlas.mesh.positions) + texels(texel % size, from % size) * steps.u +
                texels(texel / size, from / size) * steps.v);
    }
  });
  return ids;
}

}  // namespace lambent::synthesis
