#include "lambent/transport/texel_seams.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "lambent/transport/texel_charts.h"
#include "lambent/transport/texel_taps.h"

namespace lambent::transport {

namespace {

constexpr double kPlacesATexel = 2.0;  ///< along a seam
constexpr double kSimulated = 0.05;    ///< λ of texels that hold a place of the surface
constexpr double kCopied = 0.002;      ///< λ of others
constexpr float kApart =
    1e-5f;  ///< of the mesh's size: files hold the two ends of a turn so far apart
constexpr float kLeastCosine = 0.999f;  ///< between normals of one smooth surface, some 2.5°

/// An edge as one triangle has it.
struct Side {
  std::uint32_t from, to;  ///< vertices
};

/// Edges found by their middle, which others have to within `tolerance`.
class OpenEdges {
 public:
  OpenEdges(const scene::Mesh& mesh, float tolerance) : mesh_(mesh), tolerance_(tolerance) {}

  void add(const Side& side) { cells_.emplace(cellOf(middle(side)), side); }
  /// One that runs along `side` the other way, as its neighbour does; it is open no longer.
  std::optional<Side> take(const Side& side) {
    const Cell cell = cellOf(middle(side));
    for (int k = 0; k < 27; ++k) {
      const auto [first, last] =
          cells_.equal_range({cell[0] + k % 3 - 1, cell[1] + k / 3 % 3 - 1, cell[2] + k / 9 - 1});
      for (auto at = first; at != last; ++at) {
        const Side other = at->second;
        if (!near(other.from, side.to) || !near(other.to, side.from)) continue;
        cells_.erase(at);
        return other;
      }
    }
    return std::nullopt;
  }

 private:
  using Cell = std::array<std::int64_t, 3>;

  Vec3 middle(const Side& side) const {
    return 0.5f * (mesh_.positions[side.from] + mesh_.positions[side.to]);
  }
  bool near(std::uint32_t a, std::uint32_t b) const {
    return (mesh_.positions[a] - mesh_.positions[b]).norm() <= tolerance_;
  }
  Cell cellOf(const Vec3& p) const {
    const auto cell = [&](int axis) {
      return static_cast<std::int64_t>(std::floor(double(p[axis]) / (2.0 * double(tolerance_))));
    };
    return {cell(0), cell(1), cell(2)};
  }

  const scene::Mesh& mesh_;
  float tolerance_;
  std::multimap<Cell, Side> cells_;
};

/// Edges of charts, each with the one that lies on it in another chart or elsewhere in the same.
std::vector<std::pair<Side, Side>> seamsOf(const scene::Mesh& mesh) {
  const std::vector<std::uint32_t> corners = cornersOf(mesh);
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> uses;
  for (const scene::Triangle& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) ++uses[std::minmax({corners[t[k]], corners[t[(k + 1) % 3]]})];
  const float tolerance = std::max(kApart * scene::bounds(mesh).diagonal(), 1e-30f);
  OpenEdges open(mesh, tolerance);
  std::vector<std::pair<Side, Side>> seams;
  for (const scene::Triangle& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) {
      const Side side{t[k], t[(k + 1) % 3]};
      if (uses[std::minmax({corners[side.from], corners[side.to]})] != 1) continue;
      if ((mesh.positions[side.from] - mesh.positions[side.to]).norm() <= 2.0f * tolerance)
        continue;
      const std::optional<Side> other = open.take(side);
      if (!other) {
        open.add(side);
        continue;
      }
      const Side turned{other->to, other->from};
      if (mesh.normals[side.from].dot(mesh.normals[turned.from]) > kLeastCosine &&
          mesh.normals[side.to].dot(mesh.normals[turned.to]) > kLeastCosine)
        seams.emplace_back(side, turned);
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
