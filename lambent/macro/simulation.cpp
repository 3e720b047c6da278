#include "lambent/macro/simulation.h"

#include <algorithm>

namespace lambent::macro {

Simulation::Simulation(const scene::Scene& scene_, const trace::RayScene& rays_,
                       const PlacedReceivers& receivers_, const DirectionSets& directions_,
                       const BakeOptions& options_, int channels_,
                       std::span<const std::uint8_t> set)
    : scene(scene_),
      rays(rays_),
      receivers(receivers_),
      directions(directions_),
      veils(scene_),
      options(options_),
      order(transport::spatialOrder(receivers_)),
      channels(channels_),
      inBands(options_.bands),
      outBands(options_.glossyBands > 0 ? options_.glossyBands : options_.bands),
      inCount(sh::coefficientCount(inBands)),
      outCount(sh::coefficientCount(outBands)),
      rowStride(transport::paddedRow(channels_ * inCount)),
      cosine(sh::clampedCosine(inBands)),
      hemisphere(sh::hemisphere(inBands + outBands - 1)) {
  if (!set.empty()) std::erase_if(order, [&](std::uint32_t r) { return set[r] != 0; });
  sentDiffuse = receivers.diffuse, sentGlossy = receivers.glossy;
  channelMasks.resize(3 * rowStride);
  for (std::size_t c = 0; c < std::size_t(channels); ++c)
    std::fill_n(channelMasks.begin() + c * rowStride + c * inCount, inCount, 1.0f);
  texturedReceiver_.assign(receivers.size(), 0);
  matrixIndex.assign(receivers.size(), kNoMatrix);
  diffuseReceiver_.assign(receivers.size(), 0);
  lobeReceiver_.assign(receivers.size(), 0);
  const auto describe = [&](std::uint32_t r, std::uint32_t m) {
    const PlacedReceivers::PerMesh& mesh = receivers.meshes[m];
    const scene::Material& material = scene.materials[scene.meshes[m].material];
    diffuseReceiver_[r] = mesh.isDiffuse;
    lobeReceiver_[r] = mesh.isGlossy;
    texturedReceiver_[r] = mesh.textured;
    if (mesh.textured) sentDiffuse[r] = material.diffuse, sentGlossy[r] = material.glossy;
    const bool local = mesh.local && options.kind != transfer::Kind::Unshadowed;
    if (mesh.isGlossy || local) matrixIndex[r] = static_cast<std::uint32_t>(matrixCount++);
  };
  for (std::uint32_t m = 0; m < receivers.meshes.size(); ++m)
    for (std::uint32_t k = 0; k < receivers.meshes[m].count; ++k)
      describe(receivers.meshes[m].first + k, m);
  const std::size_t first = receivers.size() - receivers.witnesses.size();
  for (std::size_t k = 0; k < receivers.witnesses.size(); ++k)
    describe(static_cast<std::uint32_t>(first + k), receivers.witnesses[k]);
  for (const Vec3& position : receivers.positions)
    setOfReceiver_.push_back(static_cast<std::uint8_t>(directions.numberAt(position)));
  // What a thread takes at a time looks into one set after the other: its table and the parts of
  // the scene that lie there stay in the cache.
  for (std::size_t begin = 0; begin < order.size(); begin += kChunk)
    std::stable_sort(
        order.begin() + begin, order.begin() + std::min(begin + kChunk, order.size()),
        [&](std::uint32_t a, std::uint32_t b) { return setOfReceiver_[a] < setOfReceiver_[b]; });
  for (std::size_t k = 0; k < directions.count(); ++k) {
    Tables& of = tables.emplace_back(Tables{DirectionTable(directions[k], inBands), {}, {}});
    if (matrixCount == 0) continue;
    of.out = std::make_unique<DirectionTable>(directions[k], outBands);
    of.wide = std::make_unique<DirectionTable>(directions[k], inBands + outBands - 1);
  }
  if (matrixCount == 0) outCount = 0;  // no matrices to hold
}

}  // namespace lambent::macro
