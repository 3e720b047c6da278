#include "lambent/scene/winding.h"

#include <algorithm>
#include <cassert>

#include <Eigen/Geometry>

#include "lambent/scene/weld.h"

namespace lambent::scene {
namespace {

constexpr std::uint32_t kNoTriangle = 0xffffffffu;
/// Cosine between a triangle and a normal that lies behind it. Not 0: what stands at right angles
/// is on either side by rounding alone.
constexpr float kBehind = -0.01f;

/// The triangle on the other side of an edge, where two share it.
struct Across {
  std::uint32_t triangle = kNoTriangle;
  bool agrees = false;  ///< the two go along their edge in opposite directions, as they should
};

/// Of edge k of triangle t, from its corner k to the next: entry 3t + k. Edges are put into buckets
/// by their lower end, which makes that linear.
std::vector<Across> acrossEdges(const Mesh& mesh) {
  struct Edge {
    std::uint32_t upper, corner;
    bool upwards;
  };
  const std::vector<std::uint32_t> places = weldPositions(mesh);
  const auto ends = [&](std::size_t corner) {
    const Triangle& t = mesh.triangles[corner / 3];
    return std::pair(places[t[corner % 3]], places[t[(corner + 1) % 3]]);
  };
  const std::size_t corners = 3 * mesh.triangles.size();
  std::vector<std::uint32_t> begin(places.size() + 1, 0);
  for (std::size_t c = 0; c < corners; ++c) {
    const auto [a, b] = ends(c);
    if (a != b) ++begin[std::min(a, b) + 1];
  }
  for (std::size_t p = 1; p < begin.size(); ++p) begin[p] += begin[p - 1];
  std::vector<Edge> edges(begin.back());
  std::vector<std::uint32_t> next(begin.begin(), begin.end() - 1);
  for (std::size_t c = 0; c < corners; ++c) {
    const auto [a, b] = ends(c);
    if (a != b)
      edges[next[std::min(a, b)]++] = {std::max(a, b), static_cast<std::uint32_t>(c), a < b};
  }
  std::vector<Across> across(corners);
  for (std::size_t p = 0; p + 1 < begin.size(); ++p) {
    const auto first = edges.begin() + begin[p], last = edges.begin() + begin[p + 1];
    std::sort(first, last, [](const Edge& a, const Edge& b) {
      return a.upper != b.upper ? a.upper < b.upper : a.corner < b.corner;
    });
    for (auto edge = first; edge != last;) {
      auto end = edge;
      while (end != last && end->upper == edge->upper) ++end;
      if (end - edge == 2) {
        const bool agrees = edge[0].upwards != edge[1].upwards;
        across[edge[0].corner] = {edge[1].corner / 3, agrees};
        across[edge[1].corner] = {edge[0].corner / 3, agrees};
      }
      edge = end;
    }
  }
  return across;
}

/// Six times the volume between a triangle and a point.
double sixfoldVolume(const Mesh& mesh, const Triangle& t, const Vec3d& from) {
  const Vec3d a = mesh.positions[t[0]].cast<double>() - from;
  const Vec3d b = mesh.positions[t[1]].cast<double>() - from;
  const Vec3d c = mesh.positions[t[2]].cast<double>() - from;
  return a.dot(b.cross(c));
}

bool contradictsNormals(const Mesh& mesh, const Triangle& t) {
  const Vec3 a = mesh.positions[t[0]];
  const Vec3 cross = (mesh.positions[t[1]] - a).cross(mesh.positions[t[2]] - a);
  const float limit = kBehind * cross.norm();
  return limit < 0.0f && std::all_of(t.begin(), t.end(), [&](std::uint32_t v) {
           return cross.dot(mesh.normals[v]) < limit;
         });
}

void reverse(Triangle& t) {
  std::swap(t[1], t[2]);
}

}  // namespace

std::size_t reverseAgainstNormals(Mesh& mesh, LonePart lone) {
  assert(mesh.normals.size() == mesh.positions.size());
  std::vector<std::uint8_t> contradicts(mesh.triangles.size());
  bool any = false;
  for (std::size_t t = 0; t < contradicts.size(); ++t)
    any |= (contradicts[t] = contradictsNormals(mesh, mesh.triangles[t])) != 0;
  if (!any) return 0;

  const std::vector<Across> across = acrossEdges(mesh);
  std::vector<std::uint8_t> seen(contradicts.size());
  std::vector<std::uint32_t> patch;
  std::size_t reversed = 0;
  for (std::uint32_t start = 0; start < contradicts.size(); ++start) {
    if (!contradicts[start] || seen[start]) continue;
    patch.assign(1, start);
    seen[start] = 1;
    std::size_t breaks = 0, goesOn = 0;
    bool closed = true;
    double volume = 0.0;
    const Vec3d from = mesh.positions[mesh.triangles[start][0]].cast<double>();
    for (std::size_t k = 0; k < patch.size(); ++k) {
      const std::uint32_t t = patch[k];
      volume += sixfoldVolume(mesh, mesh.triangles[t], from);
      for (std::size_t edge = 3 * std::size_t(t); edge < 3 * std::size_t(t) + 3; ++edge) {
        const Across& other = across[edge];
        closed = closed && other.triangle != kNoTriangle && other.agrees;
        if (other.triangle == kNoTriangle) continue;
        if (!contradicts[other.triangle]) ++(other.agrees ? goesOn : breaks);
        if (!contradicts[other.triangle] || !other.agrees || seen[other.triangle]) continue;
        seen[other.triangle] = 1;
        patch.push_back(other.triangle);
      }
    }
    const bool alone = breaks == 0 && goesOn == 0;
    if (alone ? lone == LonePart::Normals || (closed && volume < 0.0) : breaks > goesOn) {
      for (const std::uint32_t t : patch) reverse(mesh.triangles[t]);
      reversed += patch.size();
    }
  }
  return reversed;
}

std::size_t reverseAgainstNeighbours(Mesh& mesh) {
  const std::vector<Across> across = acrossEdges(mesh);
  const auto consistent = [](const Across& a) { return a.triangle == kNoTriangle || a.agrees; };
  if (std::all_of(across.begin(), across.end(), consistent)) return 0;

  enum : std::uint8_t { Unseen, AsFirst, AgainstFirst };
  std::vector<std::uint8_t> sides(mesh.triangles.size(), Unseen);
  std::vector<std::uint32_t> part;
  std::size_t reversed = 0;
  for (std::uint32_t start = 0; start < sides.size(); ++start) {
    if (sides[start] != Unseen) continue;
    part.assign(1, start);
    sides[start] = AsFirst;
    bool closed = true, twoSided = true;
    std::size_t against = 0;
    double volume = 0.0;  // with all triangles turned as the first one is
    const Vec3d from = mesh.positions[mesh.triangles[start][0]].cast<double>();
    for (std::size_t k = 0; k < part.size(); ++k) {
      const std::uint32_t t = part[k];
      against += sides[t] == AgainstFirst;
      volume += (sides[t] == AsFirst ? 1.0 : -1.0) * sixfoldVolume(mesh, mesh.triangles[t], from);
      for (std::size_t edge = 3 * std::size_t(t); edge < 3 * std::size_t(t) + 3; ++edge) {
        const Across& other = across[edge];
        closed = closed && other.triangle != kNoTriangle;
        if (other.triangle == kNoTriangle) continue;
        std::uint8_t side = sides[t];
        if (!other.agrees) side = side == AsFirst ? AgainstFirst : AsFirst;
        twoSided = twoSided && (sides[other.triangle] == Unseen || sides[other.triangle] == side);
        if (sides[other.triangle] != Unseen) continue;
        sides[other.triangle] = side;
        part.push_back(other.triangle);
      }
    }
    if (!twoSided || against == 0) continue;
    const std::size_t fewer = std::min(against, part.size() - against);
    const bool byMost = 4 * fewer < part.size() || !closed || volume == 0.0;
    const bool firstIsRight = byMost ? 2 * against <= part.size() : volume > 0.0;
    for (const std::uint32_t t : part)
      if ((sides[t] == AsFirst) != firstIsRight) reverse(mesh.triangles[t]), ++reversed;
  }
  return reversed;
}

}  // namespace lambent::scene
