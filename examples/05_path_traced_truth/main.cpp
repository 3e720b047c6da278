// 5. Truth: how large is the error of a bake? Ask a path tracer at the same points.
//
// A light of 5 bands needs only the first 25 numbers of diffuse transfer: there the bake and the
// path tracer must agree up to the noise of both. Their difference over its standard error is a
// z value, and about 5 of 100 honest ones lie beyond 2.
#include <lambent/asset/asset.h>
#include <lambent/light/environment.h>
#include <lambent/macro/bake.h>
#include <lambent/reference/path_tracer.h>
#include <lambent/scene/shapes.h>
#include <lambent/shade/shade.h>
#include <lambent/transfer/encode.h>

#include <cmath>
#include <cstdio>

using namespace lambent;

int main() {
  // The inside of a bowl: every point sees others, so that bounces matter.
  scene::Material grey;
  grey.diffuse = Rgb::Constant(0.5f);
  const scene::Scene scene = scene::sceneOf(scene::bowl(1, 0.5f, 48, 24), grey);
  const auto rays = trace::RayScene::build(scene);
  if (!rays) return std::fprintf(stderr, "%s\n", rays.error().message.c_str()), 1;

  const auto receivers = transport::placeReceivers(scene, {}, rays->offset());
  if (!receivers) return std::fprintf(stderr, "%s\n", receivers.error().message.c_str()), 1;
  macro::BakeOptions bakeOptions;
  bakeOptions.directions = 8192;
  bakeOptions.bounces = 2;
  const auto field = macro::bake(scene, *rays, *receivers, bakeOptions, {});
  if (!field) return std::fprintf(stderr, "%s\n", field.error().message.c_str()), 1;
  const asset::Asset asset{scene, transfer::encode(field->value, transfer::Encoding::Float32)};

  // The light: a warm disc and an even sky, cut to what the bake can see.
  const auto sky = light::Environment::disc(Vec3(0.6f, 0.8f, 0), 0.6, Rgb(6, 5, 3)) +
                   light::Environment::uniform(Rgb(0.2f, 0.25f, 0.4f));
  const sh::RgbCoefficients light = sky.project(5);
  const std::vector<Rgb> baked = shade::exitRadiance(asset, 0, light);

  std::vector<reference::Probe> probes;
  std::vector<std::size_t> vertices;
  for (std::size_t v = 7; v < scene.meshes[0].positions.size(); v += 61) {
    const auto point = scene::surfaceAtVertex(scene, 0, std::uint32_t(v));
    probes.push_back({point, point.normal});
    vertices.push_back(v);
  }
  reference::PathTraceOptions options;
  options.samples = 4096;
  options.bounces = bakeOptions.bounces;
  const auto truth =
      reference::exitRadiance(scene, *rays, light::Environment::harmonics(light), probes, options);
  if (!truth) return std::fprintf(stderr, "%s\n", truth.error().message.c_str()), 1;

  double squared = 0.0, power = 0.0;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const Rgb difference = baked[vertices[i]] - (*truth)[i].mean;
    squared += double(difference.square().sum());
    power += double((*truth)[i].mean.square().sum());
    if (i % 4 == 0)
      std::printf("vertex %4zu: baked %.4f, path traced %.4f ± %.4f\n", vertices[i],
                  baked[vertices[i]][1], (*truth)[i].mean[1], std::sqrt((*truth)[i].variance[1]));
  }
  const double error = std::sqrt(squared / power);
  std::printf("relative RMSE over %zu vertices: %.2f%%\n", vertices.size(), 100.0 * error);
  return error < 0.03 ? 0 : 1;
}
