// This work is based on:
// - rivara1984algorithms: a triangle that is cut is cut at its longest edge first, and its other
//   marked edges are joined to the middle of that one.
#include "lambent/scene/split_edges.h"

#include <algorithm>
#include <cassert>
#include <unordered_map>
#include <utility>

#include "lambent/scene/sheets.h"
#include "lambent/scene/weld.h"

namespace lambent::scene {

namespace {

/// For every mesh and vertex the number of its position in the whole scene.
std::vector<std::vector<std::uint32_t>> placesOf(const Scene& scene) {
  Mesh whole;
  for (const Mesh& mesh : scene.meshes)
    whole.positions.insert(whole.positions.end(), mesh.positions.begin(), mesh.positions.end());
  const std::vector<std::uint32_t> numbers = weldPositions(whole);
  std::vector<std::vector<std::uint32_t>> places;
  auto at = numbers.begin();
  for (const Mesh& mesh : scene.meshes) {
    const auto end = at + static_cast<std::ptrdiff_t>(mesh.positions.size());
    places.emplace_back(at, end);
    at = end;
  }
  return places;
}

std::uint64_t pairOf(std::uint32_t a, std::uint32_t b) {
  return std::uint64_t(std::min(a, b)) << 32 | std::max(a, b);
}

/// New vertices of one mesh, by the two vertices that they lie between.
class Middles {
 public:
  explicit Middles(std::size_t firstNumber) : next_(static_cast<std::uint32_t>(firstNumber)) {}

  std::uint32_t between(std::uint32_t a, std::uint32_t b) {
    const auto [place, isNew] = known_.try_emplace(pairOf(a, b), next_);
    if (isNew) ++next_, made_.push_back({std::min(a, b), std::max(a, b)});
    return place->second;
  }
  const std::vector<MiddleVertex>& made() const { return made_; }
  std::vector<MiddleVertex> take() { return std::move(made_); }
  std::size_t count() const { return made_.size(); }

 private:
  std::uint32_t next_;
  std::unordered_map<std::uint64_t, std::uint32_t> known_;
  std::vector<MiddleVertex> made_;
};

template <class Value>
void append(std::vector<Value>& values, const std::vector<MiddleVertex>& middles) {
  if (values.empty()) return;
  values.reserve(values.size() + middles.size());
  for (const auto& [a, b] : middles) values.push_back(Value(0.5f * values[a] + 0.5f * values[b]));
}

/// As append; opposite normals leave the first of the two.
void appendNormals(std::vector<Vec3>& normals, const std::vector<MiddleVertex>& middles) {
  if (normals.empty()) return;
  for (const auto& [a, b] : middles) {
    const Vec3 sum = normals[a] + normals[b];
    const float length = sum.norm();
    normals.push_back(length > 1e-6f ? Vec3(sum / length) : Vec3(normals[a]));
  }
}

/// Triangle (a, b, c) with its longest edge from a to b, cut at that and at the others if marked.
void cut(const Triangle& corners, bool second, bool third, Middles& middles,
         std::vector<Triangle>& into) {
  const auto [a, b, c] = corners;
  const std::uint32_t m = middles.between(a, b);
  if (second) {
    const std::uint32_t n = middles.between(b, c);
    into.push_back({m, b, n});
    into.push_back({m, n, c});
  } else {
    into.push_back({m, b, c});
  }
  if (third) {
    const std::uint32_t k = middles.between(c, a);
    into.push_back({a, m, k});
    into.push_back({k, m, c});
  } else {
    into.push_back({a, m, c});
  }
}

/// Appends the backs of triangles that are the pieces of `fronts` of a mesh. `other`: for each of
/// its vertices the one of the other side.
void turnOver(std::size_t fronts, std::vector<std::uint32_t>& other, Middles& middles,
              std::vector<Triangle>& triangles, std::vector<std::uint32_t>& parents) {
  const std::size_t pieces = triangles.size(), made = middles.count();
  for (std::size_t k = 0; k < made; ++k) {
    const auto [a, b] = middles.made()[k];
    other.push_back(middles.between(other[a], other[b]));
  }
  for (std::size_t t = 0; t < pieces; ++t) {
    const auto [a, b, c] = triangles[t];
    triangles.push_back({other[a], other[c], other[b]});
    parents.push_back(parents[t] + static_cast<std::uint32_t>(fronts));
  }
}

}  // namespace

int SceneEdges::longestOf(std::uint32_t mesh, std::uint32_t triangle) const {
  const std::array<std::uint32_t, 3>& edges = ofTriangle[mesh][triangle];
  int longest = -1;
  for (int k = 0; k < 3; ++k) {
    if (edges[std::size_t(k)] == kNone) continue;
    if (longest < 0) longest = k;
    const std::uint32_t here = edges[std::size_t(k)], best = edges[std::size_t(longest)];
    if (std::pair(lengths[here], here) > std::pair(lengths[best], best)) longest = k;
  }
  return longest;
}

SceneEdges edgesOf(const Scene& scene) {
  const std::vector<std::vector<std::uint32_t>> places = placesOf(scene);
  SceneEdges edges;
  std::unordered_map<std::uint64_t, std::uint32_t> known;
  std::vector<std::uint32_t> uses;
  for (std::uint32_t m = 0; m < scene.meshes.size(); ++m) {
    const Mesh& mesh = scene.meshes[m];
    edges.ofTriangle.emplace_back();
    edges.ofTriangle.back().reserve(mesh.triangles.size());
    for (const Triangle& corners : mesh.triangles) {
      std::array<std::uint32_t, 3> three;
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t v = corners[k], w = corners[(k + 1) % 3];
        three[k] = SceneEdges::kNone;
        if (places[m][v] == places[m][w]) continue;
        const auto [place, isNew] = known.try_emplace(pairOf(places[m][v], places[m][w]),
                                                      static_cast<std::uint32_t>(edges.size()));
        if (isNew)
          edges.lengths.push_back((mesh.positions[v] - mesh.positions[w]).norm()),
              uses.push_back(0);
        three[k] = place->second;
        ++uses[three[k]];
      }
      edges.ofTriangle.back().push_back(three);
    }
  }
  edges.firstUser.assign(edges.size() + 1, 0);
  for (std::size_t e = 0; e < edges.size(); ++e)
    edges.firstUser[e + 1] = edges.firstUser[e] + uses[e];
  edges.users.resize(edges.firstUser.back());
  std::vector<std::uint32_t> next(edges.firstUser.begin(), edges.firstUser.end() - 1);
  for (std::uint32_t m = 0; m < scene.meshes.size(); ++m)
    for (std::uint32_t t = 0; t < edges.ofTriangle[m].size(); ++t)
      for (const std::uint32_t e : edges.ofTriangle[m][t])
        if (e != SceneEdges::kNone) edges.users[next[e]++] = {m, t};
  return edges;
}

void closeMarks(const SceneEdges& edges, std::vector<std::uint8_t>& marks) {
  assert(marks.size() == edges.size());
  std::vector<std::uint32_t> open;
  for (std::uint32_t e = 0; e < marks.size(); ++e)
    if (marks[e]) open.push_back(e);
  while (!open.empty()) {
    const std::uint32_t edge = open.back();
    open.pop_back();
    for (const auto& [mesh, triangle] : edges.usersOf(edge)) {
      const int longest = edges.longestOf(mesh, triangle);
      const std::uint32_t needed = edges.ofTriangle[mesh][triangle][std::size_t(longest)];
      if (marks[needed]) continue;
      marks[needed] = 1;
      open.push_back(needed);
    }
  }
}

std::size_t addedVertices(const Scene& scene, const SceneEdges& edges,
                          std::span<const std::uint8_t> marks) {
  std::size_t added = 0;
  for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
    Middles middles(0);
    const std::vector<Triangle>& triangles = scene.meshes[m].triangles;
    for (std::size_t t = 0; t < triangles.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k)
        if (const std::uint32_t e = edges.ofTriangle[m][t][k]; e != SceneEdges::kNone && marks[e])
          middles.between(triangles[t][k], triangles[t][(k + 1) % 3]);
    added += middles.count();
  }
  return added;
}

SplitScene splitEdges(const Scene& scene, const SceneEdges& edges,
                      std::span<const std::uint8_t> marks) {
  assert(marks.size() == edges.size());
  SplitScene split;
  split.scene = scene;
  for (std::uint32_t m = 0; m < scene.meshes.size(); ++m) {
    Mesh& mesh = split.scene.meshes[m];
    Middles middles(mesh.positions.size());
    std::vector<Triangle> triangles;
    std::vector<std::uint32_t> parents;
    // Backs are cut as their fronts are, so that they stay that.
    std::vector<std::uint32_t> other = verticesOfOtherSide(mesh);
    const std::size_t fronts = mesh.triangles.size() / (other.empty() ? 1 : 2);
    for (std::uint32_t t = 0; t < fronts; ++t) {
      const std::array<std::uint32_t, 3>& own = edges.ofTriangle[m][t];
      const auto marked = [&](std::size_t k) {
        const std::uint32_t e = own[k % 3];
        return e != SceneEdges::kNone && marks[e] != 0;
      };
      const Triangle& corners = mesh.triangles[t];
      if (marked(0) || marked(1) || marked(2)) {
        const auto k = static_cast<std::size_t>(edges.longestOf(m, t));
        assert(marked(k));
        cut({corners[k], corners[(k + 1) % 3], corners[(k + 2) % 3]}, marked(k + 1), marked(k + 2),
            middles, triangles);
      } else {
        triangles.push_back(corners);
      }
      parents.resize(triangles.size(), t);
    }
    if (!other.empty()) turnOver(fronts, other, middles, triangles, parents);
    mesh.triangles = std::move(triangles);
    split.parentOf.push_back(std::move(parents));
    std::vector<MiddleVertex> made = middles.take();
    append(mesh.positions, made);
    append(mesh.uvs, made);
    append(mesh.texelUvs, made);
    append(mesh.colors, made);
    append(mesh.alphas, made);
    for (const auto& [a, b] : made) addMiddle(mesh.others, a, b);
    appendNormals(mesh.normals, made);
    split.middles.push_back(std::move(made));
  }
  return split;
}

std::size_t splitLongEdges(Scene& scene, std::span<const std::uint32_t> meshes, float longest,
                           std::size_t budget) {
  std::size_t added = 0;
  for (;;) {
    const SceneEdges edges = edgesOf(scene);
    std::vector<std::uint8_t> marks(edges.size(), 0);
    bool any = false;
    for (const std::uint32_t m : meshes)
      for (const auto& three : edges.ofTriangle[m])
        for (const std::uint32_t e : three)
          if (e != SceneEdges::kNone && edges.lengths[e] > longest) marks[e] = any = true;
    if (!any) return added;
    closeMarks(edges, marks);
    const std::size_t more = addedVertices(scene, edges, marks);
    if (added + more > budget) return added;
    scene = splitEdges(scene, edges, marks).scene;
    added += more;
  }
}

}  // namespace lambent::scene
