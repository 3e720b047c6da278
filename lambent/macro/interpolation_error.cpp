#include "lambent/macro/interpolation_error.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "lambent/macro/sight.h"
#include "lambent/macro/surface_samples.h"
#include "lambent/work/runner.h"

namespace lambent::macro {

namespace {

using transport::PlacedReceivers;

/// Every receiver that is named, once, by rising number.
std::vector<std::uint32_t> receiversOf(const std::vector<transport::ReceiversAround>& arounds) {
  std::vector<std::uint32_t> all;
  for (const transport::ReceiversAround& around : arounds)
    all.insert(all.end(), around.receiver.begin(),
               around.receiver.begin() + std::ptrdiff_t(around.count));
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

}  // namespace

Result<std::vector<PlaceError>> placeErrors(const scene::Scene& scene, const trace::RayScene& rays,
                                            const PlacedReceivers& receivers,
                                            const std::vector<bool>& isLookedAt,
                                            const InterpolationErrorOptions& options,
                                            const Progress& progress) {
  const Compared compared = options.withNormals ? Compared::Arriving : Compared::Blocked;
  const std::vector<SurfaceSample> samples =
      drawSamples(scene, rays, isLookedAt, options.samples, options.seed).samples;
  std::vector<transport::ReceiversAround> arounds;
  for (const SurfaceSample& s : samples)
    arounds.push_back(transport::receiversAround(scene, receivers, s.mesh, s.triangle, s.u, s.v));
  const SightTest test(rays, options.bands, options.seed);
  const work::Runner runner(progress, options.threads);
  const std::vector<std::uint32_t> corners = receiversOf(arounds);
  const auto cornerSights =
      runner.map({"between receivers", "points"}, work::Chunks(corners.size()),
                 SightTest::Scratch(), [&](const work::Chunk& chunk, SightTest::Scratch& scratch) {
                   const std::uint32_t r = corners[chunk.begin];
                   return test.at({receivers.origins[r], receivers.normals[r]}, scratch);
                 });
  if (!cornerSights) return cornerSights.error();
  return runner.map(
      {"between receivers", "points"}, work::Chunks(samples.size()), SightTest::Scratch(),
      [&](const work::Chunk& chunk, SightTest::Scratch& scratch) {
        const SurfaceSample& sample = samples[chunk.begin];
        PlaceError place{sample.mesh, sample.triangle, std::nullopt};
        const scene::SurfacePoint point =
            scene::surfaceAt(scene, sample.mesh, sample.triangle, sample.u, sample.v);
        const Sight here =
            test.at({point.position + rays.offset() * point.normal, point.normal}, scratch);
        if (here.buried) return place;
        const transport::ReceiversAround& around = arounds[chunk.begin];
        Corners between;
        between.count = around.count;
        between.weights = around.weight;
        for (std::size_t k = 0; k < around.count; ++k) {
          const auto at = std::lower_bound(corners.begin(), corners.end(), around.receiver[k]);
          between.seen[k] = &(*cornerSights)[std::size_t(at - corners.begin())];
        }
        place.squared =
            test.squaredError(here, exposed(between), point.geometricNormal, scratch, compared);
        return place;
      });
}

Result<std::optional<InterpolationError>> interpolationError(
    const scene::Scene& scene, const trace::RayScene& rays, const PlacedReceivers& receivers,
    const InterpolationErrorOptions& options, const Progress& progress) {
  std::vector<bool> isLookedAt;
  for (const PlacedReceivers::PerMesh& mesh : receivers.meshes)
    isLookedAt.push_back(mesh.layout == transport::Layout::Vertices);
  const auto places = placeErrors(scene, rays, receivers, isLookedAt, options, progress);
  if (!places) return places.error();
  if (places->empty()) return std::optional<InterpolationError>();

  InterpolationError found;
  std::vector<double> perMesh(scene.meshes.size(), 0.0);
  double sum = 0.0, beyond = 0.0;
  for (const PlaceError& place : *places) {
    if (!place.squared) continue;
    ++found.samples;
    sum += *place.squared;
    perMesh[place.mesh] += *place.squared;
    if (*place.squared > options.tolerance * options.tolerance) beyond += 1.0;
  }
  const double count = std::max<double>(1.0, double(found.samples));
  found.rms = std::sqrt(std::max(0.0, sum / count));
  found.beyond = beyond / count;
  const auto worst = std::max_element(perMesh.begin(), perMesh.end());
  found.worstMesh = static_cast<std::uint32_t>(worst - perMesh.begin());
  found.worstMeshShare = sum > 0.0 ? std::clamp(*worst / sum, 0.0, 1.0) : 0.0;
  return std::optional(found);
}

std::string meshInWords(const scene::Scene& scene, std::uint32_t mesh) {
  const std::string& name = scene.meshes[mesh].name;
  return name.empty() ? "mesh " + std::to_string(mesh) : "mesh \"" + name + "\"";
}

Findings findingsOf(const InterpolationError& error, const scene::Scene& scene,
                    const InterpolationErrorOptions& options, std::string_view remedy) {
  if (!(error.rms > options.tolerance)) return {};
  char size[48];
  std::snprintf(size, sizeof(size), "%.2g", error.rms);
  return {{Severity::Warning, "coarse-receivers",
           "triangles are too large for the shadows on them, most of all those of " +
               meshInWords(scene, error.worstMesh) + ": between its receivers light is off by " +
               size + " of what a white surface sends back under an even sky. " +
               std::string(remedy),
           static_cast<std::uint64_t>(std::lround(error.beyond * double(error.samples)))}};
}

}  // namespace lambent::macro
