#include "lambent/transport/buried.h"

#include <algorithm>

#include "lambent/math/union_find.h"
#include "lambent/transport/inside_probe.h"
#include "lambent/transport/neighbours.h"

namespace lambent::transport {

namespace {

/// How far a step from receiver to receiver is lifted off the surface, over its length: curved
/// surfaces bulge between their receivers, and must not be in the way themselves.
constexpr float kLift = 0.05f;

/// Whether a step from one receiver to another goes through the front of a surface.
bool entersBody(const trace::RayScene& rays, const PlacedReceivers& receivers, std::uint32_t from,
                std::uint32_t to) {
  const float lift = kLift * (receivers.positions[to] - receivers.positions[from]).norm();
  const Vec3 start = receivers.origins[from] + lift * receivers.normals[from];
  const Vec3 step = receivers.origins[to] + lift * receivers.normals[to] - start;
  const float length = step.norm();
  if (!(length > 0.0f)) return false;
  const auto hit = rays.closest(start, step / length, 0.0f, length);
  return hit && !hit->backFace;
}

}  // namespace

Result<std::vector<std::uint8_t>> findBuried(const scene::Scene& scene, const trace::RayScene& rays,
                                             const PlacedReceivers& receivers,
                                             const work::Runner& runner) {
  const InsideProbe probe(rays);
  std::vector<std::uint8_t> seesBacks(receivers.size(), 0);
  const Status tested = runner.run(
      {"receivers inside", "receivers"}, work::Chunks(receivers.size(), 256), trace::CastResult(),
      [&](const work::Chunk& chunk, trace::CastResult& scratch) {
        for (std::size_t r = chunk.begin; r < chunk.end; ++r)
          seesBacks[r] = probe.seesBacks(receivers.origins[r], receivers.normals[r], scratch);
      });
  if (!tested) return tested.error();
  if (std::find(seesBacks.begin(), seesBacks.end(), 1) == seesBacks.end())
    return std::vector<std::uint8_t>();

  math::UnionFind patches(receivers.size());  // of receivers
  std::vector<std::uint32_t> steps(receivers.size(), 0), through(receivers.size(), 0);
  for (std::size_t m = 0; m < scene.meshes.size(); ++m)
    visitNeighbours(scene.meshes[m], receivers.meshes[m], [&](std::uint32_t a, std::uint32_t b) {
      if (seesBacks[a] && seesBacks[b]) patches.join(a, b);
      if (seesBacks[a] == seesBacks[b]) return;
      const std::uint32_t inner = seesBacks[a] ? a : b, outer = seesBacks[a] ? b : a;
      ++steps[inner];
      through[inner] += entersBody(rays, receivers, outer, inner);
    });
  for (std::uint32_t r = 0; r < receivers.size(); ++r) {
    const std::uint32_t root = patches.rootOf(r);
    if (root != r) steps[root] += steps[r], through[root] += through[r];
  }
  std::vector<std::uint8_t> buried(receivers.size(), 0);
  bool any = false;
  for (std::uint32_t r = 0; r < receivers.size(); ++r) {
    const std::uint32_t root = patches.rootOf(r);
    buried[r] = seesBacks[r] && 2 * through[root] > steps[root];
    any = any || buried[r];
  }
  return any ? buried : std::vector<std::uint8_t>();
}

}  // namespace lambent::transport
