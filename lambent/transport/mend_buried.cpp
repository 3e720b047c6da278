#include "lambent/transport/mend_buried.h"

#include <algorithm>

#include "lambent/transport/buried.h"
#include "lambent/transport/inside_probe.h"
#include "lambent/transport/neighbours.h"
#include "lambent/transport/pieces.h"

namespace lambent::transport {

namespace {

constexpr std::size_t kWitnesses = 3;  ///< at most, for each piece
/// A place at which buried corners weigh less says nothing about them.
constexpr float kLeastWeight = 0.02f;

/// Of a piece all of whose corners are buried.
constexpr std::size_t kFewPlaces = 6;

struct Witness {
  scene::SurfacePoint point;
  Interpolated place;  ///< its witness's number is not yet known
};

/// Places of a piece that are seen, for witnesses to stand at: from where buried corners weigh most,
/// right beside what they are buried in, outwards.
std::vector<Witness> witnessesIn(const scene::Scene& scene, const trace::RayScene& rays,
                                 std::uint32_t mesh, std::vector<PlaceInPiece>& piece,
                                 std::span<const std::uint8_t> buried, const InsideProbe& probe,
                                 trace::CastResult& scratch) {
  struct Seen {
    float buriedWeight;
    std::size_t at;
    scene::SurfacePoint point;
  };
  const auto isSeen = [&](const scene::SurfacePoint& point) {
    return !probe.seesBacks(point.position + rays.offset() * point.normal, point.normal, scratch);
  };
  const auto pointAt = [&](const PlaceInPiece& at) {
    return scene::surfaceAt(scene, mesh, at.triangle, at.u, at.v);
  };
  // Most pieces all of whose corners are buried lie deep inside: a few places tell.
  const bool allBuried = std::all_of(piece.begin(), piece.end(), [&](const PlaceInPiece& at) {
    return std::all_of(at.weights.begin(), at.weights.end(),
                       [&](const auto& weight) { return buried[weight.first] != 0; });
  });
  if (allBuried) {
    bool any = false;
    for (std::size_t k = 0; k < kFewPlaces && !any && !piece.empty(); ++k)
      any = isSeen(pointAt(piece[(2 * k + 1) * piece.size() / (2 * kFewPlaces)]));
    if (!any) return {};
  }
  std::vector<Seen> seen;
  for (std::size_t k = 0; k < piece.size(); ++k) {
    float weight = 0.0f;
    for (const auto& [receiver, w] : piece[k].weights)
      if (buried[receiver]) weight += w;
    if (weight < kLeastWeight) continue;
    const scene::SurfacePoint point = pointAt(piece[k]);
    if (isSeen(point)) seen.push_back({weight, k, point});
  }
  std::stable_sort(seen.begin(), seen.end(),
                   [](const Seen& a, const Seen& b) { return a.buriedWeight > b.buriedWeight; });
  std::vector<Witness> witnesses;
  const std::size_t count = std::min(kWitnesses, seen.size());
  for (std::size_t k = 0; k < count; ++k) {
    const Seen& chosen = seen[k * seen.size() / count];
    witnesses.push_back({chosen.point, {0, std::move(piece[chosen.at].weights)}});
  }
  return witnesses;
}

/// Buried receivers that no witness speaks for, ring by ring from those that are known: each is the
/// mean of its neighbours of the rings before.
void addMeans(const scene::Mesh& mesh, const PlacedReceivers::PerMesh& place,
              std::vector<std::uint8_t>& unknown, std::vector<Mean>& means) {
  std::vector<std::vector<std::uint32_t>> neighbours(place.count);
  visitNeighbours(mesh, place, [&](std::uint32_t a, std::uint32_t b) {
    if (unknown[a]) neighbours[a - place.first].push_back(b);
    if (unknown[b]) neighbours[b - place.first].push_back(a);
  });
  std::vector<std::uint32_t> next;
  for (std::uint32_t r = place.first; r < place.first + place.count; ++r)
    if (unknown[r]) next.push_back(r);
  while (!next.empty()) {
    std::vector<std::uint32_t> rest;
    const std::size_t first = means.size();
    for (const std::uint32_t r : next) {
      Mean mean{r, {}};
      for (const std::uint32_t n : neighbours[r - place.first])
        if (!unknown[n]) mean.of.push_back(n);
      if (mean.of.empty())
        rest.push_back(r);
      else
        means.push_back(std::move(mean));
    }
    if (means.size() == first) return;  // cut off from all that is known
    for (std::size_t k = first; k < means.size(); ++k) unknown[means[k].receiver] = 0;
    next = std::move(rest);
  }
}

}  // namespace

Result<std::optional<MendedReceivers>> mendBuried(const scene::Scene& scene,
                                                  const trace::RayScene& rays,
                                                  const PlacedReceivers& receivers,
                                                  const work::Runner& runner) {
  auto found = findBuried(scene, rays, receivers, runner);
  if (!found) return found.error();
  if (found->empty()) return std::optional<MendedReceivers>();

  MendedReceivers mended{receivers, std::move(*found), {}, 0};
  std::vector<std::uint8_t>& buried = mended.buried;
  const InsideProbe probe(rays);
  std::vector<Interpolated> places;
  for (std::uint32_t m = 0; m < scene.meshes.size(); ++m) {
    auto pieces = piecesAt(scene.meshes[m], receivers.meshes[m], buried);
    const auto chosen = runner.map(
        {"surface beside bodies", "pieces"}, work::Chunks(pieces.size(), 16), trace::CastResult(),
        [&](const work::Chunk& chunk, trace::CastResult& scratch) {
          std::vector<Witness> witnesses;
          for (std::size_t k = chunk.begin; k < chunk.end; ++k)
            for (Witness& w : witnessesIn(scene, rays, m, pieces[k], buried, probe, scratch))
              witnesses.push_back(std::move(w));
          return witnesses;
        });
    if (!chosen) return chosen.error();
    for (const std::vector<Witness>& witnesses : *chosen)
      for (const Witness& witness : witnesses) {
        places.push_back(witness.place);
        places.back().witness = mended.receivers.addWitness(
            m, witness.point, witness.point.position + rays.offset() * witness.point.normal);
      }
  }
  std::vector<std::uint8_t> unknown = buried;
  for (const Interpolated& place : places)
    for (const auto& [receiver, weight] : place.weights) unknown[receiver] = 0;
  std::vector<Mean> means;
  for (std::uint32_t m = 0; m < scene.meshes.size(); ++m)
    addMeans(scene.meshes[m], receivers.meshes[m], unknown, means);
  mended.buriedCount = static_cast<std::size_t>(std::count(buried.begin(), buried.end(), 1));
  mended.extrapolation = Extrapolation(buried, std::move(places), std::move(means));
  buried.resize(mended.receivers.size(), 0);
  return std::optional<MendedReceivers>(std::move(mended));
}

}  // namespace lambent::transport
