#include "lambent/scene/flaps.h"

#include <algorithm>
#include <map>
#include <unordered_map>

#include "lambent/math/union_find.h"
#include "lambent/scene/shapes.h"
#include "lambent/scene/weld.h"

namespace lambent::scene {
namespace {

constexpr std::size_t kMostPairs = 2;  ///< of one flap

/// Two triangles of the mesh.
struct BackToBack {
  std::uint32_t front, back;
};

/// Those that lie on the same three places and are wound against each other, each in one pair.
std::vector<BackToBack> pairsOf(const std::vector<Triangle>& triangles) {
  std::map<Triangle, std::vector<std::uint32_t>> unpaired;  // by where it is and how it is wound
  std::vector<BackToBack> pairs;
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    Triangle key = triangles[t];
    std::rotate(key.begin(), std::min_element(key.begin(), key.end()), key.end());
    const auto other = unpaired.find({key[0], key[2], key[1]});
    if (other == unpaired.end() || other->second.empty()) {
      unpaired[key].push_back(t);
    } else {
      pairs.push_back({other->second.back(), t});
      other->second.pop_back();
    }
  }
  return pairs;
}

std::uint64_t edgeOf(const Triangle& t, int k) {
  const std::uint32_t a = t[std::size_t(k)], b = t[std::size_t((k + 1) % 3)];
  return std::uint64_t(std::min(a, b)) << 32 | std::max(a, b);
}

}  // namespace

std::size_t dropFlaps(Mesh& mesh) {
  const std::vector<std::uint32_t> places = weldPositions(mesh);
  std::vector<Triangle> triangles = mesh.triangles;
  for (Triangle& t : triangles)
    for (std::uint32_t& v : t) v = places[v];
  const std::vector<BackToBack> pairs = pairsOf(triangles);
  if (pairs.empty()) return 0;

  std::vector<std::uint8_t> isPaired(triangles.size(), 0);
  for (const BackToBack& pair : pairs) isPaired[pair.front] = isPaired[pair.back] = 1;
  std::unordered_map<std::uint64_t, int> others;  // at the edges, how many that are in no pair
  for (const BackToBack& pair : pairs)
    for (int k = 0; k < 3; ++k) others[edgeOf(triangles[pair.front], k)] = 0;
  for (std::uint32_t t = 0; t < triangles.size(); ++t)
    for (int k = 0; k < 3 && !isPaired[t]; ++k)
      if (const auto at = others.find(edgeOf(triangles[t], k)); at != others.end()) ++at->second;

  // Pairs that go on into each other are one sheet, and hang on a surface or do not.
  math::UnionFind sheets(pairs.size());
  std::unordered_map<std::uint64_t, std::uint32_t> firstAt;
  for (std::uint32_t p = 0; p < pairs.size(); ++p)
    for (int k = 0; k < 3; ++k) {
      const std::uint64_t edge = edgeOf(triangles[pairs[p].front], k);
      if (others.at(edge) > 0) continue;
      sheets.join(p, firstAt.try_emplace(edge, p).first->second);
    }
  std::vector<std::size_t> sizes(pairs.size(), 0);
  std::vector<std::uint8_t> hangs(pairs.size(), 0);
  for (std::uint32_t p = 0; p < pairs.size(); ++p) {
    const std::uint32_t sheet = sheets.rootOf(p);
    ++sizes[sheet];
    for (int k = 0; k < 3; ++k) hangs[sheet] |= others.at(edgeOf(triangles[pairs[p].front], k)) > 1;
  }

  std::vector<std::uint8_t> goes(triangles.size(), 0);
  std::size_t dropped = 0;
  for (std::uint32_t p = 0; p < pairs.size(); ++p) {
    const std::uint32_t sheet = sheets.rootOf(p);
    if (!hangs[sheet] || sizes[sheet] > kMostPairs) continue;
    goes[pairs[p].front] = goes[pairs[p].back] = 1;
    ++dropped;
  }
  if (dropped == 0) return 0;
  std::size_t kept = 0;
  for (std::uint32_t t = 0; t < triangles.size(); ++t)
    if (!goes[t]) mesh.triangles[kept++] = mesh.triangles[t];
  mesh.triangles.resize(kept);
  dropUnusedVertices(mesh);
  return dropped;
}

}  // namespace lambent::scene
