#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "figures/capture.h"
#include "figures/scenes.h"
#include "figures/sheet.h"
#include "lambent/capture/blending.h"
#include "lambent/capture/sample_points.h"
#include "lambent/math/random.h"
#include "lambent/render/gl_capture.h"
#include "lambent/render/gl_context.h"
#include "lambent/scene/shapes.h"
#include "lambent/shade/shade.h"

namespace lambent::figures {

namespace {

using Lights = std::vector<sh::RgbCoefficients>;

/// A warm lamp close to one end of the object and a cool one close to the other, under a dim sky.
struct LampStage {
  asset::Asset asset;
  capture::MovingScene lamps;
  light::Environment sky;
  scene::Camera camera;
};

capture::Body lamp(const char* name, const Vec3& place, float radius, const Rgb& radiance) {
  capture::Body body{name, scene::icosphere(radius, 4), radiance, {}};
  body.motion.place = place;
  return body;
}

LampStage stage(const Studio& studio) {
  const scene::Scene bunny = madeOf(studio.load("bunny.obj"), diffuseMaterial(Rgb::Constant(0.8f)));
  const scene::Box box = scene::bounds(bunny);
  const float r = 0.5f * box.diagonal();
  macro::BakeOptions options;
  options.kind = transfer::Kind::Shadowed;
  options.directions = studio.directions();
  LampStage result{bake(bunny, options).asset,
                   {},
                   light::Environment::uniform(Rgb::Constant(0.1f)),
                   lookAt(box.center() + r * Vec3(0.15f, 0.25f, 2.9f), box.center(), 38)};
  result.lamps.bodies = {
      lamp("warm", box.center() + r * Vec3(-0.95f, 0.4f, 0.5f), 0.13f * r, Rgb(48, 20, 5)),
      lamp("cool", box.center() + r * Vec3(0.95f, -0.1f, 0.55f), 0.13f * r, Rgb(5, 18, 46))};
  return result;
}

Lights captured(const LampStage& stage, const std::vector<Vec3>& points) {
  render::LightCapture capture = orDie(render::LightCapture::make(stage.lamps, points));
  const Status done = capture.capture(0, Mat4::Identity(), stage.sky.project(5));
  if (!done) die(done.error().message);
  return orDie(capture.read());
}

/// Exit radiance at all receivers of mesh 0 under lights that blend: shading is linear in light.
std::vector<Rgb> relit(const asset::Asset& asset, const capture::Blending& blending,
                       const Lights& lights) {
  std::vector<Rgb> sum(blending.meshes[0].size(), Rgb::Zero());
  for (std::size_t k = 0; k < lights.size(); ++k) {
    const std::vector<Rgb> one = shade::exitRadiance(asset, 0, lights[k]);
    for (std::size_t p = 0; p < sum.size(); ++p)
      for (std::size_t i = 0; i < 4; ++i)
        if (blending.meshes[0][p].sample[i] == k)
          sum[p] += blending.meshes[0][p].weight[i] * one[p];
  }
  return sum;
}

/// A picture of mesh 0 with that radiance at its vertices, and of other bodies that are `radiant`.
image::Image show(const Studio& studio, const LampStage& stage, const std::vector<Rgb>& radiance,
                  const std::vector<capture::Body>& radiant) {
  asset::Asset asset;
  asset.transfer.bands = 1;
  const auto add = [&](const scene::Mesh& mesh, const std::vector<Rgb>& values) {
    // Under a sky of radiance 1 this comes out as the values.
    std::vector<float> numbers;
    for (const Rgb& value : values)
      for (int c = 0; c < 3; ++c) numbers.push_back(value[c] / std::sqrt(4 * float(kPi)));
    transfer::Surface<transfer::Numbers> surface{
        std::make_shared<const transfer::Receivers>(
            transfer::Receivers{mesh.positions, mesh.normals, transfer::AtVertices{}}),
        {}};
    surface.responses.set(asset.transfer.kind,
                          {transfer::Diffuse<transfer::Numbers>{
                               {}, {1, 3, transfer::encode(numbers, transfer::Encoding::Float32)}},
                           {}});
    scene::addTo(asset.scene, mesh, diffuseMaterial(Rgb::Ones()));
    asset.transfer.meshes.push_back(std::move(surface));
  };
  add(stage.asset.scene.meshes[0], radiance);
  for (const capture::Body& body : radiant) {
    const scene::Mesh mesh = scene::transformed(body.mesh, capture::worldFromBody(body.motion, 0));
    add(mesh, std::vector<Rgb>(mesh.positions.size(), body.radiance));
  }
  const int height = studio.pixels(400), width = height * 7 / 5;
  return photograph(asset, light::Environment::uniform(Rgb::Ones()).project(1), {}, stage.camera,
                    width, height);
}

/// Light of each sample in a colour of its own, and the samples as balls.
image::Image showSamples(const Studio& studio, const LampStage& stage,
                         const capture::Blending& blending) {
  const Rgb colors[] = {{0.9f, 0.2f, 0.15f}, {0.1f, 0.55f, 0.9f}, {0.95f, 0.75f, 0.1f},
                        {0.2f, 0.7f, 0.3f},  {0.6f, 0.3f, 0.8f},  {0.1f, 0.75f, 0.75f},
                        {0.95f, 0.5f, 0.7f}, {0.5f, 0.4f, 0.25f}};
  const std::vector<Rgb> shape =
      shade::exitRadiance(stage.asset, 0, light::Environment::uniform(Rgb::Ones()).project(5));
  std::vector<Rgb> radiance;
  for (std::size_t p = 0; p < shape.size(); ++p) {
    Rgb color = Rgb::Zero();
    const capture::BlendWeights& weights = blending.meshes[0][p];
    for (std::size_t i = 0; i < 4; ++i) color += weights.weight[i] * colors[weights.sample[i] % 8];
    radiance.push_back(shape[p] * color);
  }
  return show(studio, stage, radiance, {});
}

/// Vertices drawn at random and what the path tracer says about them.
struct LampTruth {
  std::vector<std::uint32_t> vertices;
  std::vector<Vec3> positions;
  std::vector<reference::Estimate> estimates;
};

scene::Scene withLamps(const LampStage& stage) {
  scene::Scene scene = stage.asset.scene;
  const scene::Scene lamps = capture::frozen(stage.lamps, 0);
  for (const scene::Mesh& mesh : lamps.meshes)
    scene::addTo(scene, mesh, lamps.materials[std::size_t(mesh.material)]);
  return scene;
}

LampTruth truth(const Studio& studio, const LampStage& stage) {
  const scene::Scene scene = withLamps(stage);
  LampTruth result;
  math::Random random(5, 0);
  std::vector<reference::Probe> probes;
  for (int k = 0; k < (studio.quick ? 500 : 3000); ++k) {
    const std::uint32_t v = random.below(std::uint32_t(scene.meshes[0].positions.size()));
    const scene::SurfacePoint point = scene::surfaceAtVertex(scene, 0, v);
    result.vertices.push_back(v);
    result.positions.push_back(point.position);
    probes.push_back({point, point.normal});
  }
  const auto rays = orDie(trace::RayScene::build(scene));
  reference::PathTraceOptions options;
  options.samples = studio.paths(1024), options.bounces = 0;
  result.estimates = orDie(reference::exitRadiance(scene, rays, stage.sky, probes, options));
  return result;
}

double relative(const std::vector<Rgb>& ours, const std::vector<Rgb>& theirs, double noise = 0) {
  double error = 0, power = 0;
  for (std::size_t k = 0; k < ours.size(); ++k) {
    error += double((ours[k] - theirs[k]).square().sum());
    power += double(theirs[k].square().sum());
  }
  return std::sqrt(std::max(0.0, error - noise) / power);
}

}  // namespace

void captureFigure5(const Studio& studio) {
  const render::GlContext context = orDie(render::GlContext::create());
  const LampStage set = stage(studio);
  const LampTruth exact = truth(studio, set);
  std::vector<Rgb> expected;
  double noise = 0;
  for (const reference::Estimate& e : exact.estimates)
    expected.push_back(e.mean), noise += double(e.variance.sum());
  const auto atTruth = [&](const std::vector<Rgb>& all) {
    std::vector<Rgb> some;
    for (const std::uint32_t v : exact.vertices) some.push_back(all[v]);
    return some;
  };

  // What 5 bands can do at all: light captured at every one of the vertices themselves.
  const Lights own = captured(set, exact.positions);
  std::vector<Rgb> local;
  const auto& surface =
      std::get<transfer::Surface<transfer::Numbers>>(set.asset.transfer.meshes[0]);
  const shade::DiffuseShader shader(
      surface.responses.find(set.asset.transfer.kind)->diffuse->vectors);
  std::vector<float> everywhere(3 * shader.receiverCount());
  for (std::size_t k = 0; k < own.size(); ++k) {
    shader.shade(own[k], everywhere);
    local.push_back(Eigen::Map<const Rgb>(&everywhere[3 * exact.vertices[k]]));
  }

  fmt::print(
      "relative RMSE over {} vertices (path tracer's own noise {:.2g}%)\n"
      "| light sampled at | against path tracing | against sampling at every vertex |\n"
      "|---|---|---|\n",
      exact.vertices.size(), 100 * relative(expected, expected, -noise));
  Sheet sheet;
  sheet.columnLabels = {"1 POINT", "8 POINTS", "32 POINTS", "PATH TRACED", "WHOSE OF 8"};
  sheet.rowLabels = {""};
  sheet.rows.resize(1);
  image::Image samples;
  for (const int count : {1, 2, 4, 8, 16, 32}) {
    const capture::Blending blending =
        capture::blendOver(set.asset, capture::samplePoints(set.asset.scene, count).points);
    const std::vector<Rgb> radiance = relit(set.asset, blending, captured(set, blending.samples));
    fmt::print("| {} point{} | {:.1f}% | {:.1f}% |\n", count, count > 1 ? "s" : "",
               100 * relative(atTruth(radiance), expected, noise),
               100 * relative(atTruth(radiance), local));
    std::fflush(stdout);
    if (count != 1 && count != 8 && count != 32) continue;
    sheet.rows[0].push_back(develop(show(studio, set, radiance, set.lamps.bodies), 0));
    if (count == 8) samples = develop(showSamples(studio, set, blending), 0);
  }
  fmt::print("| every vertex | {:.1f}% | |\n", 100 * relative(local, expected, noise));
  const int height = studio.pixels(400), width = height * 7 / 5;
  sheet.rows[0].push_back(develop(
      pathTrace(withLamps(set), set.sky, set.camera, width, height, studio.paths(400), 0), 0));
  sheet.rows[0].push_back(samples);
  studio.save(compose(sheet), "capture-figure5");
}

}  // namespace lambent::figures
