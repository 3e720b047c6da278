#include "lambent/macro/simulation.h"

namespace lambent::macro {

Simulation::Simulation(const scene::Scene& scene_, const trace::RayScene& rays_,
                       const PlacedReceivers& receivers_, const trace::DirectionSet& directions_,
                       const BakeOptions& options_, int channels_)
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
      inTable(directions_, inBands),
      cosine(sh::clampedCosine(inBands)),
      hemisphere(sh::hemisphere(inBands + outBands - 1)) {
  matrixIndex.assign(receivers.size(), kNoMatrix);
  diffuseReceiver_.assign(receivers.size(), 0);
  lobeReceiver_.assign(receivers.size(), 0);
  for (const PlacedReceivers::PerMesh& mesh : receivers.meshes)
    for (std::uint32_t r = mesh.first; r < mesh.first + mesh.count; ++r) {
      diffuseReceiver_[r] = mesh.isDiffuse;
      lobeReceiver_[r] = mesh.isGlossy;
      const bool local = mesh.local && options.kind != transfer::Kind::Unshadowed;
      if (mesh.isGlossy || local) matrixIndex[r] = static_cast<std::uint32_t>(matrixCount++);
    }
  if (matrixCount == 0) {
    outCount = 0;  // no matrices to hold
    return;
  }
  outTable = std::make_unique<DirectionTable>(directions, outBands);
  wideTable = std::make_unique<DirectionTable>(directions, inBands + outBands - 1);
}

}  // namespace lambent::macro
