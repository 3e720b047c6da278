#include "lambent/transport/texel_seams.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "lambent/transport/texel_charts.h"
#include "lambent/transport/texel_taps.h"

namespace lambent::transport {

namespace {

constexpr double kPlacesATexel = 2.0;   ///< along a seam
constexpr double kSimulated = 0.05;     ///< λ of texels that hold a place of the surface
constexpr double kCopied = 0.002;       ///< λ of others
constexpr float kLeastCosine = 0.999f;  ///< between normals of one smooth surface, some 2.5°

/// An edge as one triangle has it.
struct Side {
  std::uint32_t from, to;  ///< vertices
};

using Place = std::array<float, 3>;
Place placeOf(const Vec3& p) {
  const Vec3 q = p + Vec3::Zero();  // −0 equals +0
  return {q.x(), q.y(), q.z()};
}

/// Edges of charts, each with the one that lies on it in another chart or elsewhere in the same.
std::vector<std::pair<Side, Side>> seamsOf(const scene::Mesh& mesh) {
  const std::vector<std::uint32_t> corners = cornersOf(mesh);
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> uses;
  for (const scene::Triangle& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) ++uses[std::minmax({corners[t[k]], corners[t[(k + 1) % 3]]})];
  std::map<std::pair<Place, Place>, Side> open;
  std::vector<std::pair<Side, Side>> seams;
  for (const scene::Triangle& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) {
      const Side side{t[k], t[(k + 1) % 3]};
      if (uses[std::minmax({corners[side.from], corners[side.to]})] != 1) continue;
      const Place from = placeOf(mesh.positions[side.from]), to = placeOf(mesh.positions[side.to]);
      if (from == to) continue;
      const auto other = open.find({to, from});  // the neighbour runs along it the other way
      if (other == open.end()) {
        open.emplace(std::pair(from, to), side);
        continue;
      }
      const Side turned{other->second.to, other->second.from};
      const bool smooth = mesh.normals[side.from].dot(mesh.normals[turned.from]) > kLeastCosine &&
                          mesh.normals[side.to].dot(mesh.normals[turned.to]) > kLeastCosine;
      if (smooth) seams.emplace_back(side, turned);
      open.erase(other);
    }
  return seams;
}

}  // namespace

TexelSeams::TexelSeams(const scene::Mesh& mesh, const PlacedReceivers::PerMesh& place) {
  const Vec2 size(static_cast<float>(place.width), static_cast<float>(place.height));
  std::vector<std::map<std::uint32_t, double>> differences;  // texel → a − b, of every place
  for (const auto& [one, other] : seamsOf(mesh)) {
    const auto& uvs = scene::texelUvsOf(mesh);
    const auto texelsAlong = [&](const Side& side) {
      return (uvs[side.to] - uvs[side.from]).cwiseProduct(size).norm();
    };
    const double length = std::max(texelsAlong(one), texelsAlong(other));
    const int count = std::max(1, static_cast<int>(std::ceil(kPlacesATexel * length)));
    for (int i = 0; i < count; ++i) {
      const float at = (static_cast<float>(i) + 0.5f) / static_cast<float>(count);
      std::map<std::uint32_t, double> difference;
      const auto add = [&](const Side& side, double sign) {
        const Vec2 uv = (1.0f - at) * uvs[side.from] + at * uvs[side.to];
        const TexelTaps taps = tapsAt(uv, place.width, place.height);
        for (int k = 0; k < 4; ++k) difference[taps.texels[k]] += sign * taps.weights[k];
      };
      add(one, 1.0);
      add(other, -1.0);
      std::erase_if(difference, [](const auto& term) { return std::abs(term.second) < 1e-9; });
      if (!difference.empty()) differences.push_back(std::move(difference));
    }
  }
  std::vector<std::uint32_t> unknowns;
  for (const auto& difference : differences)
    for (const auto& [texel, weight] : difference) unknowns.push_back(texel);
  std::sort(unknowns.begin(), unknowns.end());
  unknowns.erase(std::unique(unknowns.begin(), unknowns.end()), unknowns.end());
  const auto numberOf = [&](std::uint32_t texel) {
    return static_cast<int>(std::lower_bound(unknowns.begin(), unknowns.end(), texel) -
                            unknowns.begin());
  };
  std::vector<RowSystem::Entry> normal;
  std::vector<RowSystem::Term> terms;
  for (std::uint32_t k = 0; k < unknowns.size(); ++k) {
    const double lambda = place.covered[unknowns[k]] ? kSimulated : kCopied;
    normal.emplace_back(static_cast<int>(k), static_cast<int>(k), lambda);
    terms.push_back({k, unknowns[k], lambda});
  }
  for (const auto& difference : differences)
    for (const auto& [i, a] : difference)
      for (const auto& [j, b] : difference) normal.emplace_back(numberOf(i), numberOf(j), a * b);
  system_ = RowSystem(std::move(unknowns), normal, std::move(terms));
}

}  // namespace lambent::transport
