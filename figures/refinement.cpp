#include "figures/refinement.h"

#include <fmt/format.h>

#include <cmath>

#include "figures/plot.h"
#include "figures/scenes.h"
#include "figures/sheet.h"
#include "lambent/macro/refine.h"
#include "lambent/math/random.h"
#include "lambent/scene/shapes.h"
#include "lambent/scene/split_edges.h"
#include "lambent/shade/shade.h"
#include "lambent/sources/source.h"

namespace lambent::figures {

namespace {

/// A corner of a room, open to the sky, with a table, a bench, a cupboard and a shelf: boxes of two
/// triangles a side, a centimetre apart, so that no receiver lies inside of another body.
scene::Scene furnishedRoom() {
  scene::Scene scene;
  const auto put = [&](const Vec3& size, const Vec3& at, const Rgb& albedo) {
    scene::addTo(
        scene, scene::translated(scene::box(size - Vec3::Constant(0.01f)), at + Vec3(0, 0.005f, 0)),
        diffuseMaterial(albedo));
  };
  const Rgb wall(0.8f, 0.78f, 0.74f), wood(0.6f, 0.42f, 0.27f), cloth(0.35f, 0.45f, 0.6f);
  scene::addTo(scene, scene::gridPlane(6, 5, 1, 1), diffuseMaterial(Rgb(0.7f, 0.68f, 0.64f)));
  put(Vec3(6, 2.8f, 0.2f), Vec3(0, 1.4f, -2.6f), wall);
  put(Vec3(0.2f, 2.8f, 5), Vec3(-3.1f, 1.4f, 0), wall);
  put(Vec3(1.6f, 0.06f, 0.9f), Vec3(0.4f, 0.75f, 0.2f), wood);
  for (const float x : {-0.34f, 1.14f})
    for (const float z : {-0.19f, 0.59f}) put(Vec3(0.07f, 0.72f, 0.07f), Vec3(x, 0.36f, z), wood);
  put(Vec3(1.5f, 0.42f, 0.45f), Vec3(0.4f, 0.21f, 1.3f), cloth);
  put(Vec3(1.2f, 1.9f, 0.6f), Vec3(-2.3f, 0.95f, -2.15f), wood);
  for (const float y : {1.3f, 1.65f, 2.0f})
    put(Vec3(1.4f, 0.04f, 0.3f), Vec3(0.9f, y, -2.33f), wood);
  put(Vec3(0.35f, 0.35f, 0.35f), Vec3(2.2f, 0.175f, -1.2f), cloth);
  return scene;
}

/// Every edge cut that is longer than `longest` metres.
scene::Scene evenly(scene::Scene scene, float longest) {
  for (;;) {
    const scene::SceneEdges edges = scene::edgesOf(scene);
    std::vector<std::uint8_t> marks;
    for (const float length : edges.lengths) marks.push_back(length > longest ? 1 : 0);
    scene::closeMarks(edges, marks);
    if (scene::addedVertices(scene, edges, marks) == 0) return scene;
    scene = scene::splitEdges(scene, edges, marks).scene;
  }
}

std::size_t verticesOf(const scene::Scene& scene) {
  std::size_t count = 0;
  for (const scene::Mesh& mesh : scene.meshes) count += mesh.positions.size();
  return count;
}

/// Places spread evenly over what is seen of the surfaces, and what they send out.
struct Truth {
  std::vector<scene::SurfacePoint> points;
  std::vector<reference::Estimate> radiance;
};

Truth truthOf(const scene::Scene& scene, const light::Environment& light, std::size_t count,
              int paths, int bounces) {
  const trace::RayScene rays = orDie(trace::RayScene::build(scene));
  std::vector<double> areaUpTo;
  std::vector<trace::RayScene::GlobalTriangle> triangles;
  double area = 0.0;
  for (std::uint32_t m = 0; m < scene.meshes.size(); ++m)
    for (std::uint32_t t = 0; t < scene.meshes[m].triangles.size(); ++t) {
      const scene::Triangle& c = scene.meshes[m].triangles[t];
      const std::vector<Vec3>& p = scene.meshes[m].positions;
      const Vec3 a = p[c[1]] - p[c[0]], b = p[c[2]] - p[c[0]];
      area +=
          0.5 * std::sqrt(std::max(0.0f, a.squaredNorm() * b.squaredNorm() - a.dot(b) * a.dot(b)));
      areaUpTo.push_back(area), triangles.push_back({m, t});
    }
  std::vector<reference::Probe> probes;
  math::Random random(3, 0);
  while (probes.size() < count) {
    const double at = random.uniformDouble() * area;
    const auto found = std::upper_bound(areaUpTo.begin(), areaUpTo.end(), at);
    const auto [mesh, triangle] = triangles[std::min<std::size_t>(
        std::size_t(found - areaUpTo.begin()), triangles.size() - 1)];
    Vec2 uv = random.uniform2();
    if (uv.sum() > 1.0f) uv = Vec2::Ones() - uv;
    const scene::SurfacePoint point = scene::surfaceAt(scene, mesh, triangle, uv.x(), uv.y());
    probes.push_back({point, point.normal});
  }
  reference::PathTraceOptions options;
  options.samples = paths, options.bounces = bounces;
  std::vector<reference::Estimate> all =
      orDie(reference::exitRadiance(scene, rays, light, probes, options));
  Truth truth;
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (!(all[k].mean.maxCoeff() > 0.0f)) continue;  // where one body stands on another
    truth.points.push_back(probes[k].point), truth.radiance.push_back(all[k]);
  }
  return truth;
}

/// Relative RMSE of what is interpolated between receivers, the truth's own noise taken out.
double errorOf(const scene::Scene& scene, const asset::Asset& asset,
               const sh::RgbCoefficients& light, const Truth& truth) {
  const trace::RayScene rays = orDie(trace::RayScene::build(scene));
  std::vector<std::vector<Rgb>> radiance;
  for (std::uint32_t m = 0; m < scene.meshes.size(); ++m)
    radiance.push_back(shade::exitRadiance(asset, m, light));
  double squared = 0.0, variance = 0.0, power = 0.0;
  for (std::size_t k = 0; k < truth.points.size(); ++k) {
    const scene::SurfacePoint& point = truth.points[k];
    const auto hit =
        rays.closest(point.position + 1e-3f * point.normal, Vec3(-point.normal), 0.0f, 1e-2f);
    if (!hit) continue;
    const scene::Triangle& corners = scene.meshes[hit->mesh].triangles[hit->triangle];
    const std::vector<Rgb>& at = radiance[hit->mesh];
    const Rgb ours =
        (1 - hit->u - hit->v) * at[corners[0]] + hit->u * at[corners[1]] + hit->v * at[corners[2]];
    const reference::Estimate& is = truth.radiance[k];
    squared += double((ours - is.mean).square().sum());
    variance += double(is.variance.sum()), power += double(is.mean.square().sum());
  }
  return std::sqrt(std::max(0.0, squared - variance) / power);
}

}  // namespace

void refinement(const Studio& studio) {
  const scene::Scene room = furnishedRoom();
  const light::Environment sky = orDie(sources::parseSource("disc:115,40,25,3+uniform:0.5")).value;
  macro::BakeOptions options;
  options.directions = studio.quick ? 1024 : 4096;
  const sh::RgbCoefficients light = sky.project(options.bands);
  const light::Environment shown = light::Environment::harmonics(light);
  options.kind = transfer::Kind::Shadowed;
  const Truth truth = truthOf(room, shown, studio.quick ? 2000 : 4000, studio.paths(1024), 0);
  const auto baked = [&](const scene::Scene& scene) { return bake(scene, options).asset; };
  fmt::print("| triangles cut | receivers | relative RMSE |\n|---|---|---|\n");
  const auto measured = [&](const std::string& how, const scene::Scene& scene,
                            const asset::Asset& asset) {
    const double error = errorOf(scene, asset, light, truth);
    fmt::print("| {} | {} | {:.2f}% |\n", how, verticesOf(scene), 100 * error);
    std::fflush(stdout);
    return Eigen::Vector2d(double(verticesOf(scene)), 100 * error);
  };
  Series even{"everywhere", {}, seriesColor(0), Series::Style::Line};
  Series where{"where shadows fall", {}, seriesColor(1), Series::Style::Line};
  const asset::Asset coarse = baked(room);
  const Eigen::Vector2d none = measured("none", room, coarse);
  even.points.push_back(none), where.points.push_back(none);
  for (const float longest : {1.0f, 0.5f, 0.25f, 0.125f, 0.0625f}) {
    if (studio.quick && longest < 0.1f) break;
    const scene::Scene cut = evenly(room, longest);
    even.points.push_back(measured(fmt::format("to {} m", longest), cut, baked(cut)));
  }
  const trace::RayScene rays = orDie(trace::RayScene::build(room));
  const transport::PlacedReceivers receivers =
      orDie(transport::placeReceivers(room, {}, rays.offset()));
  asset::Asset finest;
  std::size_t finestCount = 0;
  for (const double error : {0.2, 0.1, 0.05, 0.03, 0.02, 0.01}) {
    if (studio.quick && error < 0.02) break;
    macro::RefineOptions asked;
    asked.error = error;
    const scene::Scene cut = orDie(macro::refine(room, rays, receivers, asked, {})).scene;
    asset::Asset asset = baked(cut);
    where.points.push_back(measured(fmt::format("--refine {}", error), cut, asset));
    if (error == 0.02) finest = std::move(asset), finestCount = verticesOf(cut);
  }
  fmt::print("\n");
  Plot plot;
  plot.x = {"receivers", 100, 1e6, true, 0};
  plot.y = {"relative RMSE, %", 0.3, 100, true, 0};
  plot.series = {even, where};
  plot.width = 560, plot.height = 400;
  studio.save(draw(plot), "refinement-error");

  const scene::Camera camera = lookAt(Vec3(4.6f, 3.6f, 5.2f), Vec3(-0.3f, 0.6f, -0.4f), 38);
  const int width = studio.pixels(480), height = studio.pixels(360);
  Sheet sheet;
  sheet.columnLabels = {fmt::format("as modelled: {} receivers", verticesOf(room)),
                        fmt::format("--refine: {} receivers", finestCount), "path-traced"};
  const float ev = -0.5f;
  sheet.rows.push_back(
      {develop(photograph(coarse, light, shown, camera, width, height), ev),
       develop(photograph(finest, light, shown, camera, width, height), ev),
       develop(pathTrace(room, shown, camera, width, height, studio.paths(512), 0), ev)});
  studio.save(compose(sheet), "refinement-room");
}

}  // namespace lambent::figures
