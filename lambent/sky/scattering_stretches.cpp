// Light along one ray up to many distances, in one march.
#include <algorithm>
#include <cmath>

#include "lambent/math/quadrature.h"
#include "lambent/math/types.h"
#include "lambent/sky/scattering_tables.h"

namespace lambent::sky {
namespace {

/// No path is followed farther below the ground, m: it is dark there.
constexpr double kDeepest = 3e6;
/// Most pieces of a stretch below the ground, and their length, m.
constexpr int kMostPieces = 64;
constexpr double kPiece = 2e4;

/// Lets a path that ended on the ground go on to the last of the distances.
void goOnBelowGround(const Medium& medium, std::span<const double> ends, int nodes, AirPath& path) {
  const math::Quadrature rule = math::gaussLegendre(nodes, 0, 1);
  double density[kParts];
  for (int part = 0; part < kParts; ++part) density[part] = medium.profiles[part].at(0);
  const double ground = path.end;
  double from = ground;
  for (const double end : ends) {
    const double to = std::min(end, ground + kDeepest);
    if (to <= from) continue;
    const int pieces = std::clamp(int(std::ceil((to - from) / kPiece)), 1, kMostPieces);
    const double length = (to - from) / pieces;
    for (int piece = 0; piece < pieces; ++piece)
      for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
        AirPath::Node node{};
        node.distance = from + (piece + rule.nodes[i]) * length;
        node.weight = rule.weights[i] * length;
        node.horizon = kPi / 2;
        for (int part = 0; part < kParts; ++part) {
          node.density[part] = float(density[part]);
          node.length[part] =
              float(double(path.length[part]) + density[part] * (node.distance - ground));
        }
        path.nodes.push_back(node);
      }
    from = to;
  }
}

}  // namespace

void Scattering::upTo(const RayInAir& ray, std::span<const double> ends, int nodes,
                      AirStretches& out) const {
  const Medium& m = impl_->medium;
  const std::size_t count = m.wavelengths.size(), stretches = ends.size();
  for (std::vector<double>* values : {&out.air, &out.aerosol, &out.multiple, &out.depth})
    values->assign(stretches * count, 0);
  if (stretches == 0) return;

  PathSplit split = impl_->split;
  split.nodes = nodes;
  std::vector<double> breaks = shadowEdges(m.shell, ray);
  breaks.insert(breaks.end(), ends.begin(), ends.end());
  AirPath path = airPath(m, split, ray.altitude, ray.cosine, ends.back(), breaks);
  if (path.hitsGround) goOnBelowGround(m, ends, nodes, path);
  std::vector<MarchNode> marched;
  const std::vector<Impl::Place> places = impl_->prepareAlong(path, ray.cosine, marched);
  impl_->prepareOnce(path, ray, Impl::Shadow::Sharp, marched);
  impl_->prepareAgain(path, ray, places, marched);

  const MarchKernels kernel = marchKernels();
  std::size_t node = 0;
  double length[kParts] = {};
  for (std::size_t k = 0; k < stretches; ++k) {
    const std::size_t first = node;
    for (; node < path.nodes.size() && path.nodes[node].distance < ends[k]; ++node)
      for (int part = 0; part < kParts; ++part)
        length[part] += path.nodes[node].weight * double(path.nodes[node].density[part]);
    for (std::size_t i = 0; i < count; i += kLanes) {
      const Block& block = impl_->blocks[i / kLanes];
      MarchSums sums{};
      if (node > first)
        kernel.march(block.tables(block.held, impl_->grid), marched.data() + first,
                     int(node - first), true, true, sums);
      for (std::size_t l = 0; l < std::min(std::size_t(kLanes), count - i); ++l) {
        const std::size_t at = k * count + i + l, before = at - (k > 0 ? count : 0);
        const double add = k > 0 ? 1 : 0;
        out.air[at] = add * out.air[before] + double(sums.air[l]);
        out.aerosol[at] = add * out.aerosol[before] + double(sums.aerosol[l]);
        out.multiple[at] = add * out.multiple[before] + double(sums.multiple[l]);
        for (int part = 0; part < kParts; ++part)
          out.depth[at] += m.extinction[part][i + l] * length[part];
      }
    }
  }
}

}  // namespace lambent::sky
