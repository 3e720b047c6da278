// Bi-scale rendering beside the path-traced truth: the same patches as real geometry under the same
// light of five bands.
#include <fmt/format.h>

#include <chrono>
#include <cmath>

#include "figures/biscale.h"
#include "figures/displaced.h"
#include "figures/relief.h"
#include "figures/scenes.h"
#include "figures/sheet.h"
#include "lambent/image/compare.h"
#include "lambent/meso/generators.h"
#include "lambent/scene/shapes.h"
#include "lambent/sh/window.h"
#include "lambent/tone/compare.h"
#include "lambent/trace/ray_scene.h"

namespace lambent::figures {

namespace {

constexpr int kSide = 160;   ///< pixels
constexpr int kBounces = 4;  ///< of the path tracer, the RTT and the macro scale alike

/// A scene twice: with the patch as triangles, and with a smooth mesh 0 whose UVs repeat it.
struct Stage {
  std::string name;
  scene::Scene relief, smooth;
  Vec2 tiles;
  struct View {
    std::string name;
    scene::Camera camera;
  };
  std::vector<View> views;
};

/// What is plain stands in both scenes alike.
void addPlain(Stage& stage, const scene::Mesh& mesh, const scene::Material& material) {
  scene::addTo(stage.relief, mesh, material);
  scene::addTo(stage.smooth, mesh, material);
}

scene::Camera orthographic(const Vec3& towardsEye, const Vec3& target, float halfHeight) {
  scene::Camera camera = lookAt(target + 3.0f * towardsEye, target, 40);
  camera.orthographicHalfHeight = halfHeight;
  return camera;
}

/// A plane that wears the patch, seen so near that its border is out of sight, and, if wanted, a
/// ball over it that throws a shadow and colour on it.
Stage planeStage(const meso::Patch& patch, bool withBall) {
  constexpr int kTiles = 16;
  constexpr float kTile = 0.1f, kWidth = kTiles * kTile;
  Stage stage;
  stage.name = withBall ? "plane under a ball" : "plane";
  stage.tiles = Vec2(kTiles, kTiles);
  const double scale = kTile / double(patch.size.x());
  const ParametricSurface plane = [=](double u, double v) {
    return SurfacePlace{Vec3d(kWidth * (u - 0.5), 0, kWidth * (v - 0.5)), Vec3d(0, 1, 0), scale};
  };
  stage.relief = displaced(patch, plane, kTiles, kTiles);
  scene::addTo(stage.smooth, scene::gridPlane(kWidth, kWidth, 128, 128),
               diffuseMaterial(Rgb::Ones()));
  if (withBall)
    addPlain(stage, scene::translated(scene::icosphere(0.13f, 5), Vec3(0, 0.19f, 0)),
             diffuseMaterial(Rgb(0.75f, 0.72f, 0.3f)));
  const Vec3 target(0, withBall ? 0.08f : 0.0f, 0);
  stage.views = {{"frontal", orthographic(towards(100, 78), target, 0.3f)},
                 {"three-quarter", orthographic(towards(70, 42), target, 0.3f)},
                 {"grazing", orthographic(towards(115, 20), target, 0.17f)}};
  return stage;
}

/// A ball that wears the patch by a Mercator map, which keeps its squares square, on a plain
/// ground. Whole tiles reach as near to the poles as they can; plain caps lie beyond.
Stage sphereStage(const meso::Patch& patch) {
  constexpr int kAround = 24, kAlong = 12;
  constexpr double kRadius = 0.38;
  Stage stage;
  stage.name = "ball on a ground";
  stage.tiles = Vec2(kAround, kAlong);
  const double period = double(patch.size.y()) / double(patch.size.x());
  const double top = 0.5 * kAlong * 2 * kPi / kAround * period;  // of the map, radians
  const ParametricSurface sphere = [=](double u, double v) {
    const double longitude = 2 * kPi * u, mercator = top * (1 - 2 * v);
    const double sine = std::tanh(mercator), cosine = 1 / std::cosh(mercator);
    const Vec3d normal(cosine * std::sin(longitude), sine, cosine * std::cos(longitude));
    return SurfacePlace{kRadius * normal, normal,
                        2 * kPi * kRadius * cosine / (kAround * double(patch.size.x()))};
  };
  stage.relief = displaced(patch, sphere, kAround, kAlong);
  scene::Mesh smooth;
  constexpr int kColumns = 192, kRows = 96;
  for (int y = 0; y <= kRows; ++y)
    for (int x = 0; x <= kColumns; ++x) {
      const SurfacePlace place = sphere(double(x) / kColumns, double(y) / kRows);
      smooth.positions.push_back(place.position.cast<float>());
      smooth.normals.push_back(place.normal.cast<float>());
      smooth.uvs.push_back(Vec2(float(x) / kColumns, float(y) / kRows));
    }
  for (std::uint32_t y = 0; y < kRows; ++y)
    for (std::uint32_t x = 0; x < kColumns; ++x) {
      const std::uint32_t a = y * (kColumns + 1) + x, b = a + 1, c = a + kColumns + 1, d = c + 1;
      smooth.triangles.push_back({a, c, b});
      smooth.triangles.push_back({b, c, d});
    }
  scene::addTo(stage.smooth, smooth, diffuseMaterial(Rgb::Ones()));
  const float share = float(0.5 * (1 - std::tanh(top)));  // of the sphere's area, one cap
  const scene::Mesh cap = scene::flipped(scene::bowl(float(kRadius), share, 96, 12));
  addPlain(stage, cap, diffuseMaterial(Rgb::Constant(0.4f)));
  addPlain(stage, scene::rotated(cap, Vec3(1, 0, 0), float(kPi)),
           diffuseMaterial(Rgb::Constant(0.4f)));
  addPlain(stage, scene::translated(scene::gridPlane(4, 4, 160, 160), Vec3(0, -0.4f, 0)),
           diffuseMaterial(Rgb(0.5f, 0.52f, 0.55f)));
  stage.views = {
      {"frontal", lookAt(Vec3(0, 0.25f, 2.2f), Vec3::Zero(), 24)},
      {"from above", lookAt(Vec3(0.8f, 1.5f, 1.2f), Vec3::Zero(), 26)},
      {"close, past the limb", lookAt(Vec3(-1.05f, 0.05f, 0.75f), Vec3(-0.2f, 0, 0.32f), 20)}};
  return stage;
}

struct Light {
  std::string name;
  sh::RgbCoefficients coefficients;
};

/// None is negative in any direction, so that neither side has to cut anything off and the path
/// tracer draws directions well.
std::vector<Light> lightsOf(const Studio& studio) {
  const Rgb power(2.6f, 2.5f, 2.3f);
  sh::RgbCoefficients narrow = smallestLight(towards(160, 40), power);
  sh::applyWindow(sh::minimalRinging(narrow), narrow);
  return {{"narrow", narrow},
          {"110° disc", fiveBands(discLight(towards(10, 35), 110, power))},
          {"workshop", fiveBands(studio.hdri("workshop"))}};
}

/// Pixels whose middle shows mesh 0 of a scene.
std::vector<char> pixelsOf(const scene::Scene& scene, const scene::Camera& camera, int side) {
  const trace::RayScene rays = orDie(trace::RayScene::build(scene));
  std::vector<char> mask(std::size_t(side) * side, 0);
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      const scene::Ray ray = scene::cameraRay(camera, side, side, float(x) + 0.5f, float(y) + 0.5f);
      const auto hit = rays.closest(ray.origin, ray.direction);
      mask[std::size_t(y) * side + x] = hit && hit->mesh == 0;
    }
  return mask;
}

std::vector<Rgb> chosen(const image::Image& picture, const std::vector<char>& mask) {
  std::vector<Rgb> out;
  for (std::size_t k = 0; k < mask.size(); ++k)
    if (mask[k]) out.push_back(picture.pixels[k]);
  return out;
}

/// Means over squares of `block` pixels that the mask holds whole: what is left of a picture when
/// its texture is blurred away.
std::vector<Rgb> blockMeans(const image::Image& picture, const std::vector<char>& mask, int block) {
  std::vector<Rgb> out;
  for (int y = 0; y + block <= picture.height; y += block)
    for (int x = 0; x + block <= picture.width; x += block) {
      Rgb sum = Rgb::Zero();
      bool whole = true;
      for (int j = 0; j < block; ++j)
        for (int i = 0; i < block; ++i) {
          const std::size_t k = std::size_t(y + j) * picture.width + x + i;
          whole = whole && mask[k];
          sum += picture.pixels[k];
        }
      if (whole) out.push_back(sum / float(block * block));
    }
  return out;
}

struct Truth {
  reference::Picture picture;
  std::vector<char> mask;
  double noise = 0.0;  ///< relative, of the path tracer, by its variance, over the mask
};

Truth truthOf(const Stage& stage, const trace::RayScene& rays, const scene::Camera& camera,
              const sh::RgbCoefficients& light, int side, int paths) {
  reference::PathTraceOptions options;
  options.samples = paths, options.bounces = kBounces;
  Truth truth;
  truth.picture = orDie(reference::picture(stage.relief, rays, light::Environment::harmonics(light),
                                           camera, side, side, options));
  truth.mask = pixelsOf(stage.smooth, camera, side);
  double variance = 0.0, power = 0.0;
  for (std::size_t k = 0; k < truth.mask.size(); ++k)
    if (truth.mask[k])
      variance += truth.picture.variance.pixels[k].sum(),
          power += truth.picture.mean.pixels[k].square().sum();
  truth.noise = std::sqrt(variance / power);
  return truth;
}

struct Distance {
  double relativeRmse, own, blurred, bias, rmse, flip;  ///< own: without the path tracer's noise
};

Distance distance(const image::Image& ours, const Truth& truth, int block) {
  const auto pixels =
      orDie(image::compare(chosen(ours, truth.mask), chosen(truth.picture.mean, truth.mask)));
  const auto blocks = orDie(image::compare(blockMeans(ours, truth.mask, block),
                                           blockMeans(truth.picture.mean, truth.mask, block)));
  const auto whole = orDie(tone::compare(ours, truth.picture.mean));
  const double own = std::sqrt(
      std::max(0.0, pixels.relativeRmse * pixels.relativeRmse - truth.noise * truth.noise));
  return {pixels.relativeRmse, own,         blocks.relativeRmse,
          pixels.relativeBias, pixels.rmse, whole.flip};
}

/// All lights from all views, or each view with a light of its own.
enum class Pairs { All, Diagonal };

void compareStage(const Studio& studio, const Stage& stage, const BuiltRtt& built,
                  const std::string& patchName, const std::string& file, Pairs pairs) {
  const int side = studio.pixels(kSide), block = side / 20;
  bi_scale::SpreadOptions options;
  options.meshes = {0};
  options.placement = bi_scale::Placement::OwnUvs;
  options.tiles = stage.tiles;
  options.transfer.directions = studio.directions();
  options.transfer.bounces = kBounces;
  options.matrixEncoding = options.vectorEncoding = transfer::Encoding::Float32;
  const auto start = std::chrono::steady_clock::now();
  const bi_scale::Spread spreadOut = spread(stage.smooth, built.rtt, options);
  const double baking =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  std::size_t triangles = 0;
  for (const scene::Mesh& mesh : stage.relief.meshes) triangles += mesh.triangles.size();
  fmt::print(
      "{}, {}: {:.2f} million triangles path-traced; {} vertices with matrices, baked in {:.1f} "
      "s\n\n"
      "| view | light | noise | RMSE | relative RMSE | beyond noise | bias | blurred | FLIP | "
      "macro off: beyond noise | bias | blurred | FLIP |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|---|---|\n",
      stage.name, patchName, double(triangles) * 1e-6,
      transfer::receiversOf(spreadOut.asset.transfer.meshes[0])->size(), baking);
  const trace::RayScene rays = orDie(trace::RayScene::build(stage.relief));
  const std::vector<Light> lights = lightsOf(studio);
  Sheet sheet;
  sheet.columnLabels = {"path-traced relief", "bi-scale", "error x4", "without macro", "error x4"};
  for (std::size_t v = 0; v < stage.views.size(); ++v)
    for (std::size_t l = 0; l < lights.size(); ++l) {
      if (pairs == Pairs::Diagonal && v != l) continue;
      const Stage::View& view = stage.views[v];
      const Truth truth = truthOf(stage, rays, view.camera, lights[l].coefficients, side,
                                  studio.paths(v == l ? 64 : 32));
      shade::Showing on, off;
      off.mesoStructure = transfer::Kind::Unshadowed;
      const Shot shot{view.camera, side, side, 64};
      const image::Image with = photograph(spreadOut.asset, lights[l].coefficients, on, shot);
      const image::Image without = photograph(spreadOut.asset, lights[l].coefficients, off, shot);
      const Distance a = distance(with, truth, block), b = distance(without, truth, block);
      fmt::print(
          "| {} | {} | {:.1f}% | {:.4f} | {:.1f}% | {:.1f}% | {:+.1f}% | {:.1f}% | {:.3f} | "
          "{:.1f}% | "
          "{:+.1f}% | {:.1f}% | {:.3f} |\n",
          view.name, lights[l].name, 100 * truth.noise, a.rmse, 100 * a.relativeRmse, 100 * a.own,
          100 * a.bias, 100 * a.blurred, a.flip, 100 * b.own, 100 * b.bias, 100 * b.blurred,
          b.flip);
      std::fflush(stdout);
      if (v == l) {
        const auto error = [&](const image::Image& ours) {
          return image::difference(ours, truth.picture.mean, 4.0f);
        };
        sheet.rowLabels.push_back(lights[l].name.substr(0, 3) == "110" ? "disc" : lights[l].name);
        sheet.rows.push_back({develop(truth.picture.mean, 0.3f), develop(with, 0.3f), error(with),
                              develop(without, 0.3f), error(without)});
      }
    }
  fmt::print("\n");
  studio.save(compose(sheet), file);
}

/// The same plane with finer RTTs: what the tables' resolution costs and what remains.
void whatItIsMadeOf(const Studio& studio, const meso::Patch& patch, const std::string& patchName) {
  const int side = studio.pixels(kSide);
  const Stage stage = planeStage(patch, false);
  const trace::RayScene rays = orDie(trace::RayScene::build(stage.relief));
  const sh::RgbCoefficients light = lightsOf(studio)[0].coefficients;
  std::vector<Truth> truths;
  std::string head = "| positions | views | read by their heights |", rule = "|---|---|---|",
              noise = "| noise | | |";
  for (const Stage::View& view : stage.views) {
    truths.push_back(truthOf(stage, rays, view.camera, light, side, studio.paths(64)));
    head += " " + view.name + " |", rule += "---|";
    noise += fmt::format(" {:.1f}% |", 100 * truths.back().noise);
  }
  fmt::print(
      "Plane without a ball, {}, narrow light: relative RMSE beyond the noise, by the RTT's "
      "resolution\n\n{}\n{}\n",
      patchName, head, rule);
  struct Resolution {
    int positions, views, supersample;
    bool corrected;
  };
  for (const Resolution& r : {Resolution{64, 8, 2, false},
                              {64, 8, 2, true},
                              {128, 8, 1, true},
                              {64, 16, 1, true},
                              {128, 16, 1, true}}) {
    meso::RttOptions options = rttOptions(studio);
    options.width = options.height = studio.quick ? r.positions / 2 : r.positions;
    options.views = r.views, options.supersample = r.supersample;
    options.bounces = kBounces;
    options.directions = 64;
    BuiltRtt built = build(patch, options);
    if (!r.corrected) built.rtt.heights.clear();
    bi_scale::SpreadOptions wear;
    wear.placement = bi_scale::Placement::OwnUvs, wear.tiles = stage.tiles;
    wear.transfer.directions = 1024, wear.transfer.bounces = 0;
    const bi_scale::Spread worn = spread(stage.smooth, built.rtt, wear);
    shade::Showing off;
    off.mesoStructure = transfer::Kind::Unshadowed;
    fmt::print("| {}x{} | {}x{} | {} |", options.width, options.height, r.views, r.views,
               r.corrected ? "yes" : "no");
    for (std::size_t v = 0; v < truths.size(); ++v) {
      const image::Image ours =
          photograph(worn.asset, light, off, {stage.views[v].camera, side, side, 64});
      const Distance d = distance(ours, truths[v], side / 20);
      fmt::print(" {:.1f}% (bias {:+.1f}%, FLIP {:.3f}) |", 100 * d.own, 100 * d.bias, d.flip);
    }
    fmt::print("\n");
    std::fflush(stdout);
  }
  fmt::print("{}\n\n", noise);
}

/// Of few enough facets that hundreds of periods fit into a path tracer.
meso::Patch coarseWeave() {
  meso::WeaveOptions options;
  options.around = 16, options.along = 24;
  return meso::weave(options);
}

}  // namespace

void biscaleTruth(const Studio& studio) {
  meso::StuccoOptions stucco;
  stucco.resolution = 64;
  const meso::Patch cloth = coarseWeave(), wall = meso::stucco(stucco);
  meso::RttOptions options = rttOptions(studio);
  options.bounces = kBounces;
  const BuiltRtt clothRtt = build(cloth, options), wallRtt = build(wall, options);
  fmt::print("RTTs of {}x{} positions, {}x{} views: weave {:.1f} s, stucco {:.1f} s\n\n",
             options.width, options.height, options.views, options.views, clothRtt.seconds,
             wallRtt.seconds);
  compareStage(studio, planeStage(cloth, true), clothRtt, "weave", "biscale-truth-plane",
               Pairs::All);
  compareStage(studio, sphereStage(cloth), clothRtt, "weave", "biscale-truth-ball", Pairs::All);
  compareStage(studio, planeStage(wall, true), wallRtt, "stucco", "biscale-truth-stucco",
               Pairs::Diagonal);
}

void biscaleResolution(const Studio& studio) {
  whatItIsMadeOf(studio, coarseWeave(), "weave");
}

}  // namespace lambent::figures
