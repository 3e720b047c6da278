#include "lambent/synthesis/feature_lines.h"

#include <array>
#include <cmath>

#include <Eigen/Geometry>

#include "lambent/math/union_find.h"

namespace lambent::synthesis {
namespace {

/// An edge that stands out, as seen from one of its ends.
struct Spoke {
  FeatureLine::Step step;  ///< away from that end
  std::uint32_t end;       ///< the other end
  std::uint32_t edge;      ///< the same from both
};

struct FeatureGraph {
  std::vector<std::vector<Spoke>> spokes;  ///< per vertex of the manifold
  std::vector<double> length;              ///< per edge, metres
  std::vector<Vec3d> way;                  ///< per edge, unit, from its half-edge's tail
};

Vec3d crossOf(const scene::Mesh& mesh, std::uint32_t triangle) {
  const auto& [a, b, c] = mesh.triangles[triangle];
  const Vec3d p = mesh.positions[a].cast<double>();
  return (mesh.positions[b].cast<double>() - p).cross(mesh.positions[c].cast<double>() - p);
}

FeatureGraph graphOf(const scene::Mesh& mesh, const Manifold& m, const FeatureOptions& options) {
  FeatureGraph graph;
  graph.spokes.resize(m.vertexCount());
  const double bend = std::cos(double(options.crease) * kPi / 180.0);
  for (std::uint32_t h = 0; h < m.twin.size(); ++h) {
    if (m.vertexOfCorner[h] == kNone) continue;
    const std::uint32_t twin = m.twin[h];
    if (twin != kNone) {
      if (twin < h) continue;
      const Vec3d a = crossOf(mesh, h / 3), b = crossOf(mesh, twin / 3);
      // Of a triangle without area nothing is known.
      if (!(a.dot(b) < bend * a.norm() * b.norm())) continue;
    }
    const std::uint32_t i = m.vertexOfCorner[h], j = m.vertexOfCorner[Manifold::next(h)];
    const auto place = [&](std::uint32_t corner) {
      return Vec3d(mesh.positions[mesh.triangles[corner / 3][corner % 3]].cast<double>());
    };
    const Vec3d along = place(Manifold::next(h)) - place(h);
    const auto edge = std::uint32_t(graph.length.size());
    graph.length.push_back(along.norm());
    graph.way.push_back(along.normalized());
    graph.spokes[i].push_back({{h, false}, j, edge});
    graph.spokes[j].push_back({{h, true}, i, edge});
  }
  return graph;
}

/// Which vertices a line passes: those of two edges that go straight on, more or less.
std::vector<bool> passedBy(const FeatureGraph& graph, const FeatureOptions& options) {
  const double straight = std::cos(double(options.corner) * kPi / 180.0);
  std::vector<bool> passed(graph.spokes.size());
  for (std::size_t v = 0; v < passed.size(); ++v) {
    if (graph.spokes[v].size() != 2) continue;
    const auto& [one, two] = std::array{graph.spokes[v][0], graph.spokes[v][1]};
    const auto away = [&](const Spoke& s) {
      return Vec3d(s.step.reversed ? -graph.way[s.edge] : graph.way[s.edge]);
    };
    passed[v] = one.edge != two.edge && away(one).dot(away(two)) < -straight;
  }
  return passed;
}

/// Edges of lines that hang together and are too short in all.
std::vector<bool> noiseIn(const scene::Mesh& mesh, const Manifold& m, const FeatureGraph& graph,
                          const FeatureOptions& options) {
  std::vector<double> area(m.components, 0.0);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    if (const std::uint32_t k = m.componentOfTriangle(t); k != kNone)
      area[k] += 0.5 * crossOf(mesh, t).norm();
  math::UnionFind together(graph.spokes.size());
  for (std::size_t v = 0; v < graph.spokes.size(); ++v)
    for (const Spoke& s : graph.spokes[v]) together.join(std::uint32_t(v), s.end);
  std::vector<double> length(graph.spokes.size(), 0.0);
  std::vector<bool> noise(graph.length.size());
  const auto each = [&](const auto& visit) {
    for (std::size_t v = 0; v < graph.spokes.size(); ++v)
      for (const Spoke& s : graph.spokes[v])
        if (!s.step.reversed) visit(s, std::size_t(together.rootOf(std::uint32_t(v))), v);
  };
  each([&](const Spoke& s, std::size_t group, std::size_t) {
    length[group] += graph.length[s.edge];
  });
  each([&](const Spoke& s, std::size_t group, std::size_t v) {
    noise[s.edge] =
        !(length[group] > double(options.least) * std::sqrt(area[m.componentOfVertex[v]]));
  });
  return noise;
}

}  // namespace

std::vector<FeatureLine> featureLines(const scene::Mesh& mesh, const Manifold& m,
                                      const FeatureOptions& options) {
  const FeatureGraph graph = graphOf(mesh, m, options);
  const std::vector<bool> passed = passedBy(graph, options);
  std::vector<bool> done = noiseIn(mesh, m, graph, options);
  std::vector<FeatureLine> lines;
  const auto follow = [&](const Spoke& first) {
    FeatureLine line;
    const Spoke* next = &first;
    while (next != nullptr) {
      const Spoke at = *next;
      done[at.edge] = true;
      line.steps.push_back(at.step);
      line.length += graph.length[at.edge];
      next = nullptr;
      if (!passed[at.end]) break;
      for (const Spoke& s : graph.spokes[at.end])
        if (!done[s.edge]) next = &s;
    }
    lines.push_back(std::move(line));
  };
  // Those with ends first; what is left are loops.
  for (const bool loops : {false, true})
    for (std::size_t v = 0; v < graph.spokes.size(); ++v)
      for (const Spoke& s : graph.spokes[v])
        if (!done[s.edge] && (loops || !passed[v])) follow(s);
  return lines;
}

}  // namespace lambent::synthesis
