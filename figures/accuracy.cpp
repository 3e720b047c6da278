#include "figures/accuracy.h"

#include <fmt/format.h>

#include <cmath>

#include "figures/scenes.h"
#include "lambent/math/random.h"
#include "lambent/scene/shapes.h"
#include "lambent/shade/shade.h"

namespace lambent::figures {

namespace {

/// Some vertices of mesh 0, drawn at random, seen from `eye` or along their normals.
struct Sample {
  std::vector<std::uint32_t> vertices;
  std::vector<reference::Probe> probes;
};

Sample drawVertices(const scene::Scene& scene, std::size_t count, const std::optional<Vec3>& eye) {
  Sample sample;
  const auto total = static_cast<std::uint32_t>(scene.meshes[0].positions.size());
  math::Random random(17, 0);
  for (std::size_t k = 0; k < std::min<std::size_t>(count, total); ++k) {
    const std::uint32_t v = random.below(total);
    const scene::SurfacePoint point = scene::surfaceAtVertex(scene, 0, v);
    const Vec3 toViewer = eye ? Vec3((*eye - point.position).normalized()) : point.normal;
    if (toViewer.dot(point.normal) <= 0.05f) continue;  // not seen
    sample.vertices.push_back(v);
    sample.probes.push_back({point, toViewer});
  }
  return sample;
}

std::vector<reference::Estimate> truth(const scene::Scene& scene, const Sample& sample,
                                       const light::Environment& light, int paths, int bounces) {
  const auto rays = trace::RayScene::build(scene);
  reference::PathTraceOptions options;
  options.samples = paths, options.bounces = bounces;
  auto estimates = reference::exitRadiance(scene, *rays, light, sample.probes, options);
  return std::move(*estimates);
}

/// What remains of the difference when the path tracer's own variance is taken away.
struct Error {
  double measured = 0.0;   ///< relative RMSE, noise included
  double noise = 0.0;      ///< of the path tracer, by its variance
  double bake = 0.0;       ///< √(measured² − noise²)
  double bias = 0.0;       ///< Σ(ours − truth)/Σ truth
  double biasError = 0.0;  ///< standard error of that by the path tracer's variance
};

Error compare(const std::vector<Rgb>& ours, const Sample& sample,
              const std::vector<reference::Estimate>& truth) {
  double squared = 0.0, variance = 0.0, power = 0.0, sum = 0.0, difference = 0.0;
  for (std::size_t k = 0; k < truth.size(); ++k)
    for (int c = 0; c < 3; ++c) {
      const double d = double(ours[sample.vertices[k]][c]) - truth[k].mean[c];
      squared += d * d;
      variance += truth[k].variance[c];
      power += double(truth[k].mean[c]) * truth[k].mean[c];
      sum += truth[k].mean[c];
      difference += d;
    }
  Error error;
  error.measured = std::sqrt(squared / power);
  error.noise = std::sqrt(variance / power);
  error.bake = std::sqrt(std::max(0.0, squared - variance) / power);
  error.bias = difference / sum;
  error.biasError = std::sqrt(3.0 * variance) / sum;  // channels share their paths
  return error;
}

}  // namespace

void diffuseAccuracy(const Studio& studio) {
  const scene::Scene bunny =
      madeOf(studio.load("bunny.obj"), diffuseMaterial(Rgb(0.75f, 0.68f, 0.6f)));
  const sh::RgbCoefficients light = studio.hdri("venice").project(5);
  const light::Environment environment = light::Environment::harmonics(light);
  const Sample sample = drawVertices(bunny, studio.quick ? 500 : 2000, std::nullopt);
  fmt::print(
      "Diffuse, {} vertices, light of 5 bands; {} vertices path-traced\n\n"
      "| bounces | directions | relative RMSE | of it the path tracer's noise | the bake's own | "
      "bias | z of the bias over seeds |\n|---|---|---|---|---|---|---|\n",
      bunny.meshes[0].positions.size(), sample.vertices.size());
  for (const int bounces : {0, 2}) {
    const auto expected = truth(bunny, sample, environment, studio.paths(16384), bounces);
    for (const int directions : {1024, 2048, 4096, 8192, 16384}) {
      // Each seed turns the direction set another way: their biases are independent.
      const int seeds = directions == 8192 ? 8 : 1;
      Error first;
      std::vector<double> biases;
      for (int seed = 0; seed < seeds; ++seed) {
        macro::BakeOptions options;
        options.directions = directions, options.bounces = bounces;
        options.seed = static_cast<std::uint64_t>(seed);
        const Baked baked = bake(bunny, options);
        const Error error = compare(shade::exitRadiance(baked.asset, 0, light), sample, expected);
        if (seed == 0) first = error;
        biases.push_back(error.bias);
      }
      std::string z = "-";
      if (seeds > 1) {
        double mean = 0.0, scatter = 0.0;
        for (double b : biases) mean += b / seeds;
        for (double b : biases) scatter += (b - mean) * (b - mean) / (seeds - 1);
        const double standardError = std::sqrt(scatter / seeds + first.biasError * first.biasError);
        z = fmt::format("{:+.2f} ({:+.4f}% ± {:.4f}%)", mean / standardError, 100 * mean,
                        100 * standardError);
      }
      fmt::print("| {} | {} | {:.3f}% | {:.3f}% | {:.3f}% | {:+.4f}% | {} |\n", bounces, directions,
                 100 * first.measured, 100 * first.noise, 100 * first.bake, 100 * first.bias, z);
      std::fflush(stdout);
    }
  }
  fmt::print("\n");
}

void glossyAccuracy(const Studio& studio) {
  const scene::Scene mesh = studio.load("dragon/dragon_vrip_res4.ply");
  const sh::RgbCoefficients light = studio.hdri("venice").project(5);
  const light::Environment environment = light::Environment::harmonics(light);
  const scene::Box box = scene::bounds(mesh);
  const Vec3 eye = box.center() + box.diagonal() * Vec3(0.5f, 0.4f, 1.2f);
  fmt::print(
      "Glossy, dragon of {} vertices, light of 5 bands, seen from one side: relative RMSE by bands "
      "of the matrix's rows (in brackets with one bounce)\n\n"
      "| lobe exponent | 3 bands | 5 bands | 7 bands | 9 bands |\n|---|---|---|---|---|\n",
      mesh.meshes[0].positions.size());
  for (const float exponent : {4.0f, 16.0f, 64.0f}) {
    const scene::Scene scene = madeOf(mesh, glossyMaterial(Rgb::Constant(0.8f), exponent));
    const Sample sample = drawVertices(scene, studio.quick ? 500 : 2000, eye);
    const auto direct = truth(scene, sample, environment, studio.paths(4096), 0);
    const auto bounced = truth(scene, sample, environment, studio.paths(4096), 1);
    fmt::print("| {} |", exponent);
    for (const int bands : {3, 5, 7, 9}) {
      macro::BakeOptions options;
      options.directions = studio.directions();
      options.glossyBands = bands;
      options.bounces = 0;
      shade::ReceiverView view;
      view.eye = eye;
      view.showing.softLobes = false;  // the truth has the lobe
      const Error shadowed =
          compare(shade::exitRadiance(bake(scene, options).asset, 0, light, view), sample, direct);
      options.bounces = 1;
      const Error interreflected =
          compare(shade::exitRadiance(bake(scene, options).asset, 0, light, view), sample, bounced);
      fmt::print(" {:.2f}% ({:.2f}%) |", 100 * shadowed.bake, 100 * interreflected.bake);
      std::fflush(stdout);
    }
    fmt::print("\n");
  }
  fmt::print("\n");
}

}  // namespace lambent::figures
