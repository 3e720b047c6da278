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

/// The receivers at the corners of the samples' triangles, each once, by rising number.
std::vector<std::uint32_t> cornersOf(const scene::Scene& scene, const PlacedReceivers& receivers,
                                     const std::vector<SurfaceSample>& samples) {
  std::vector<std::uint32_t> corners;
  for (const SurfaceSample& sample : samples)
    for (const std::uint32_t v : scene.meshes[sample.mesh].triangles[sample.triangle])
      corners.push_back(receivers.meshes[sample.mesh].first + v);
  std::sort(corners.begin(), corners.end());
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  return corners;
}

struct SampleError {
  double squared = 0.0;
  bool counts = false;
};

}  // namespace

Result<std::optional<InterpolationError>> interpolationError(
    const scene::Scene& scene, const trace::RayScene& rays, const PlacedReceivers& receivers,
    const InterpolationErrorOptions& options, const Progress& progress) {
  const std::vector<SurfaceSample> samples =
      drawSamples(scene, rays, receivers, options.samples, options.seed).samples;
  if (samples.empty()) return std::optional<InterpolationError>();
  const SightTest test(rays, options.bands, options.seed);
  const work::Runner runner(progress, options.threads);
  const std::vector<std::uint32_t> corners = cornersOf(scene, receivers, samples);
  const auto cornerSights =
      runner.map({"between receivers", "points"}, work::Chunks(corners.size()),
                 SightTest::Scratch(), [&](const work::Chunk& chunk, SightTest::Scratch& scratch) {
                   const std::uint32_t r = corners[chunk.begin];
                   return test.at({receivers.origins[r], receivers.normals[r]}, scratch);
                 });
  if (!cornerSights) return cornerSights.error();
  const auto errors = runner.map(
      {"between receivers", "points"}, work::Chunks(samples.size()), SightTest::Scratch(),
      [&](const work::Chunk& chunk, SightTest::Scratch& scratch) {
        const SurfaceSample& sample = samples[chunk.begin];
        const scene::SurfacePoint point =
            scene::surfaceAt(scene, sample.mesh, sample.triangle, sample.u, sample.v);
        const Sight here =
            test.at({point.position + rays.offset() * point.normal, point.normal}, scratch);
        if (here.buried) return SampleError();
        std::array<const Sight*, 3> seen{};
        const scene::Triangle& triangle = scene.meshes[sample.mesh].triangles[sample.triangle];
        for (std::size_t k = 0; k < 3; ++k) {
          const std::uint32_t r = receivers.meshes[sample.mesh].first + triangle[k];
          const auto place = std::lower_bound(corners.begin(), corners.end(), r);
          seen[k] = &(*cornerSights)[std::size_t(place - corners.begin())];
        }
        const Vec3 weights =
            exposedWeights(seen, Vec3(1.0f - sample.u - sample.v, sample.u, sample.v));
        return SampleError{test.squaredError(here, seen, weights, point.geometricNormal, scratch),
                           true};
      });
  if (!errors) return errors.error();

  InterpolationError found;
  std::vector<double> perMesh(scene.meshes.size(), 0.0);
  double sum = 0.0, beyond = 0.0;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const SampleError& error = (*errors)[k];
    if (!error.counts) continue;
    ++found.samples;
    sum += error.squared;
    perMesh[samples[k].mesh] += error.squared;
    if (error.squared > options.tolerance * options.tolerance) beyond += 1.0;
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
                    const InterpolationErrorOptions& options) {
  if (!(error.rms > options.tolerance)) return {};
  char size[48];
  std::snprintf(size, sizeof(size), "%.2g", error.rms);
  return {{Severity::Warning, "coarse-receivers",
           "triangles are too large for the shadows on them, most of all those of " +
               meshInWords(scene, error.worstMesh) + ": between its receivers light is off by " +
               size +
               " of what a white surface sends back under an even sky. --refine cuts "
               "triangles where that is so, --texels bakes a mesh on a grid over its UVs",
           static_cast<std::uint64_t>(std::lround(error.beyond * double(error.samples)))}};
}

}  // namespace lambent::macro
