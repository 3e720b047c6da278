// sloan2003biscale's Figures 1, 3, 4, 5 and 6, and its vase.
#include <fmt/format.h>

#include <cmath>

#include "figures/biscale.h"
#include "figures/relief.h"
#include "figures/scenes.h"
#include "figures/sheet.h"
#include "lambent/scene/shapes.h"

namespace lambent::figures {

namespace {

using bi_scale::Placement;
using shade::Showing;
using transfer::Kind;

const scene::Material kAny = diffuseMaterial(Rgb::Constant(0.5f));

/// What the shape as a whole does to light.
Showing macro(Kind kind) {
  Showing showing;
  showing.mesoStructure = kind;
  return showing;
}

Mat3 turnedY(float degrees) {
  const float a = degrees * float(kPi) / 180.0f;
  Mat3 turn;
  turn << std::cos(a), 0, std::sin(a), 0, 1, 0, -std::sin(a), 0, std::cos(a);
  return turn;
}

/// A square of 1 m that wears `tiles` periods of the patch each way.
asset::Asset square(const transfer::SimulatedRtt& rtt, float tiles) {
  bi_scale::SpreadOptions options;
  options.placement = Placement::OwnUvs;
  options.tiles = Vec2(tiles, tiles);
  options.transfer.directions = 1024, options.transfer.bounces = 0;
  return spread(scene::sceneOf(scene::gridPlane(1, 1, 8, 8), kAny), rtt, options).asset;
}

/// Head-on and oblique views of the square, which fills them.
struct SquareView {
  scene::Camera camera;
  int height;
};
std::vector<SquareView> squareViews(int width) {
  return {{lookAt(Vec3(0, 2.4f, 0.01f), Vec3::Zero(), 24), width},
          {lookAt(Vec3(0, 1.05f, 2.4f), Vec3(0, 0, 0.02f), 16.5f), width * 55 / 100}};
}

/// An environment whose radiance, in the mean over the sphere, is as bright as `mean`.
sh::RgbCoefficients asBright(const light::Environment& environment, float mean) {
  sh::RgbCoefficients light = fiveBands(environment);
  double sum = 0.0;
  for (int c = 0; c < 3; ++c) sum += light.channel(c)[0] / (3 * std::sqrt(4 * kPi));
  for (int c = 0; c < 3; ++c)
    for (float& value : light.channel(c)) value *= float(mean / sum);
  return light;
}

/// A surface that wears the patch by synthesis, with both kinds of matrices.
asset::Asset dressed(const Studio& studio, const scene::Scene& scene,
                     const transfer::SimulatedRtt& rtt, float patchWidth) {
  bi_scale::SpreadOptions options;
  options.patchWidth = patchWidth;
  options.transfer.directions = studio.quick ? 1024 : 4096;
  options.transfer.bounces = 3;
  options.transfer.keepShadowed = true;
  options.mesoVertices = studio.quick ? 100000 : 300000;
  if (studio.quick) options.atlas.size = 1024;
  const bi_scale::Spread out = spread(scene, rtt, options);
  const bi_scale::SpreadReport& report = out.reports.front();
  fmt::print("{}: {} vertices, {:.0f} patches, {} meso-vertices, {} charts\n", rtt.name,
             report.vertices, report.patches, report.mesoVertices, report.charts);
  std::fflush(stdout);
  return out.asset;
}

/// A boulder of 10,242 vertices: a ball with broad dents, a cleft and lumps.
scene::Scene rock() {
  scene::Mesh mesh = scene::icosphere(1.0f, 5);
  struct Dent {
    Vec3 towards;
    float depth, width;
  };
  const std::vector<Dent> dents = {
      {towards(70, 25), 0.62f, 0.36f},   {towards(130, 50), 0.30f, 0.40f},
      {towards(20, -10), 0.34f, 0.36f},  {towards(95, -30), 0.30f, 0.30f},
      {towards(200, 20), 0.36f, 0.45f},  {towards(280, 35), 0.38f, 0.40f},
      {towards(320, -20), 0.34f, 0.42f}, {towards(0, 80), 0.25f, 0.40f},
      {towards(160, -5), -0.28f, 0.30f}, {towards(50, 60), -0.18f, 0.25f},
      {towards(250, -15), -0.22f, 0.35f}};
  for (Vec3& p : mesh.positions) {
    const Vec3 n = p;
    float radius = 1.0f;
    for (const Dent& dent : dents) {
      const float angle = std::acos(std::clamp(n.dot(dent.towards), -1.0f, 1.0f)) / dent.width;
      radius -= dent.depth * std::exp(-angle * angle);
    }
    for (int octave = 0; octave < 3; ++octave) {
      const float f = 3.1f * float(1 << octave);
      radius += 0.05f / float(1 << octave) *
                (std::sin(f * n.x() + 1.3f * octave) * std::cos(f * n.y() + 0.7f) +
                 std::sin(f * n.z() + 2.1f * octave) * std::cos(f * n.x()));
    }
    p = Vec3(n.x() * 1.15f, n.y() * 0.85f, n.z()) * radius;
  }
  scene::computeNormals(mesh);
  return scene::sceneOf(std::move(mesh), kAny);
}

/// A vase of 73 × 61 vertices, as many as the seed's: a surface of revolution whose v runs from the
/// middle of its inside over the lip and down its outside, by arc length.
scene::Scene vase() {
  constexpr int kColumns = 72, kRows = 60;
  std::vector<Vec2> profile;          // radius, height
  const auto outside = [](float t) {  // t: 0 at the lip, 1 at the foot
    const float belly = std::exp(-std::pow((t - 0.58f) / 0.24f, 2.0f));
    return 0.20f + 0.26f * belly + 0.10f * std::exp(-std::pow(t / 0.12f, 2.0f)) +
           0.05f * std::exp(-std::pow((t - 1.0f) / 0.06f, 2.0f));
  };
  constexpr int kFine = 400;
  for (int k = 0; k < kFine; ++k) {
    const float t = 0.55f * (1.0f - float(k) / kFine);
    profile.emplace_back(outside(t) - 0.035f, 1.2f * (1.0f - t));
  }
  for (int k = 0; k <= kFine / 10; ++k) {  // the lip, half round
    const float a = float(kPi) * float(k) / (kFine / 10);
    profile.emplace_back(outside(0) - 0.0175f - 0.0175f * std::cos(a),
                         1.2f + 0.0175f * std::sin(a));
  }
  for (int k = 1; k <= 2 * kFine; ++k) {
    const float t = float(k) / (2 * kFine);
    profile.emplace_back(outside(t), 1.2f * (1.0f - t));
  }
  std::vector<float> length(profile.size(), 0.0f);
  for (std::size_t k = 1; k < profile.size(); ++k)
    length[k] = length[k - 1] + (profile[k] - profile[k - 1]).norm();
  scene::Mesh mesh;
  mesh.name = "vase";
  std::size_t at = 0;
  for (int y = 0; y <= kRows; ++y) {
    const float wanted = length.back() * float(y) / kRows;
    while (at + 2 < length.size() && length[at + 1] < wanted) ++at;
    const Vec2 step = profile[at + 1] - profile[at];
    const Vec2 p = profile[at] + step * ((wanted - length[at]) / step.norm());
    const Vec2 out = Vec2(-step.y(), step.x()).normalized();  // v runs down: out is to its left
    for (int x = 0; x <= kColumns; ++x) {
      const float a = 2.0f * float(kPi) * float(x) / kColumns;
      mesh.positions.emplace_back(p.x() * std::sin(a), p.y(), p.x() * std::cos(a));
      mesh.normals.push_back(
          Vec3(out.x() * std::sin(a), out.y(), out.x() * std::cos(a)).normalized());
      mesh.uvs.emplace_back(float(x) / kColumns, float(y) / kRows);
    }
  }
  for (std::uint32_t y = 0; y < kRows; ++y)
    for (std::uint32_t x = 0; x < kColumns; ++x) {
      const std::uint32_t a = y * (kColumns + 1) + x, b = a + 1, c = a + kColumns + 1, d = c + 1;
      mesh.triangles.push_back({a, c, b});
      mesh.triangles.push_back({b, c, d});
    }
  scene::Scene scene = scene::sceneOf(std::move(mesh), kAny);
  scene::addTo(scene, scene::gridPlane(5, 5, 100, 100), diffuseMaterial(Rgb(0.55f, 0.53f, 0.5f)));
  return scene;
}

}  // namespace

void biscaleFigure4(const Studio& studio) {
  const int side = studio.pixels(260);
  const asset::Asset asset = square(rttNamed(studio, "weave"), 3);
  const Rgb power(2.6f, 2.5f, 2.3f);
  const Vec3 a = towards(215, 40), c = towards(20, 30);
  const std::vector<sh::RgbCoefficients> lights = {
      smallestLight(a, power), discLight(a, 110, power).project(5), smallestLight(c, power),
      discLight(c, 110, power).project(5), asBright(studio.hdri("forest"), 0.3f)};
  Sheet sheet;
  sheet.columnLabels = {"(a) smallest", "(b) 110 deg", "(c) smallest", "(d) 110 deg",
                        "(e) environment"};
  sheet.rowLabels = {"head-on", "oblique"};
  for (const SquareView& view : squareViews(side)) {
    std::vector<image::Image> row;
    for (const sh::RgbCoefficients& light : lights)
      row.push_back(develop(
          photograph(asset, light, macro(Kind::Unshadowed), {view.camera, side, view.height, 16}),
          0.6f));
    sheet.rows.push_back(std::move(row));
  }
  studio.save(compose(sheet), "biscale-figure4");
}

void biscaleFigure5(const Studio& studio) {
  const int side = studio.pixels(220);
  const sh::RgbCoefficients light =
      discLight(towards(200, 38), 40, Rgb(2.4f, 2.3f, 2.1f)).project(5);
  Sheet sheet;
  sheet.rowLabels = {"top", "oblique"};
  sheet.rows.resize(2);
  for (const std::string name : {"weave", "holes", "bin", "plaster", "stucco", "flower"}) {
    const asset::Asset asset = square(rttNamed(studio, name), 2);
    sheet.columnLabels.push_back(name);
    for (std::size_t v = 0; v < 2; ++v) {
      const SquareView view = squareViews(side)[v];
      sheet.rows[v].push_back(develop(
          photograph(asset, light, macro(Kind::Unshadowed), {view.camera, side, view.height, 16}),
          0.5f));
    }
  }
  studio.save(compose(sheet), "biscale-figure5");
}

void biscaleFigure1(const Studio& studio) {
  const int side = studio.pixels(420);
  const scene::Scene bunny = studio.load("bunny.obj");
  const float size = scene::bounds(bunny).diagonal();
  const asset::Asset asset = dressed(studio, bunny, rttNamed(studio, "weave"), 0.055f * size);
  const sh::RgbCoefficients light = asBright(studio.hdri("esplanade"), 0.45f);
  const scene::Camera camera = scene::frameAutomatically(bunny, 1.0f);
  Sheet sheet;
  sheet.columnLabels = {"(a) no macro-scale transport", "(b) shadowed", "(c) interreflected"};
  sheet.rows.resize(1);
  for (const Kind transport : transfer::kKinds)
    sheet.rows[0].push_back(
        develop(photograph(asset, light, macro(transport), {camera, side, side, 16}), 0.3f));
  studio.save(compose(sheet), "biscale-figure1");
}

void biscaleFigure3(const Studio& studio) {
  const int side = studio.pixels(420);
  const scene::Scene boulder = rock();
  const asset::Asset asset = dressed(studio, boulder, rttNamed(studio, "stucco"), 0.4f);
  const light::Environment world =
      light::Environment::clampedCosine(Vec3(0, 1, 0), Rgb(0.2f, 0.26f, 0.35f)) +
      discLight(towards(-25, 55), 40, Rgb(2.8f, 2.6f, 2.2f));
  const scene::Camera camera = lookAt(Vec3(0.9f, 1.4f, 3.9f), Vec3(-0.15f, -0.1f, 0), 40);
  Sheet sheet;
  sheet.columnLabels = {"(a) none", "(b) shadows", "(c) and interreflection"};
  sheet.rows.resize(1);
  for (const Kind transport : transfer::kKinds)
    sheet.rows[0].push_back(develop(
        photograph(asset, world.project(5), macro(transport), {camera, side, side, 16}), 0.3f));
  studio.save(compose(sheet), "biscale-figure3");
}

void biscaleFigure6(const Studio& studio) {
  const int side = studio.pixels(270);
  struct Row {
    const char *label, *file, *patch, *light;
    float patches, turn;
    Vec3 zoomAt;  ///< of the bounding box, −½ … ½
  };
  const Row rows[] = {
      {"dragon", "dragon/dragon_vrip_res3.ply", "weave", "sky", 0.05f, 0, Vec3(-0.1f, 0.02f, 0.2f)},
      {"bunny", "bunny.obj", "bin", "lab", 0.06f, 0, Vec3(-0.05f, -0.05f, 0.2f)}};
  Sheet sheet;
  sheet.columnLabels = {"(a) no macro", "(b) macro", "(c) pasted on", "(d) by view"};
  for (const Row& row : rows) {
    const scene::Scene mesh = studio.load(row.file);
    const scene::Box box = scene::bounds(mesh);
    const asset::Asset asset =
        dressed(studio, mesh, rttNamed(studio, row.patch), row.patches * box.diagonal());
    const sh::RgbCoefficients light =
        asBright(studio.hdri(row.light).rotated(turnedY(row.turn)), 0.5f);
    const scene::Camera whole = scene::frameAutomatically(mesh, 1.0f);
    const Vec3 target = box.center() + row.zoomAt.cwiseProduct(box.upper - box.lower);
    const scene::Camera near = zoomed(whole, target, 3.6f);
    Showing pasted;
    pasted.viewDependent = false;
    const auto shoot = [&](const scene::Camera& camera, const Showing& options) {
      return develop(photograph(asset, light, options, {camera, side, side, 16}), 0.4f);
    };
    sheet.rowLabels.push_back(row.label);
    sheet.rows.push_back({shoot(whole, macro(Kind::Unshadowed)), shoot(whole, {}),
                          shoot(near, pasted), shoot(near, {})});
  }
  studio.save(compose(sheet), "biscale-figure6");
}

void biscaleVase(const Studio& studio) {
  const int side = studio.pixels(420);
  const scene::Scene stage = vase();
  bi_scale::SpreadOptions options;
  options.meshes = {0};
  options.placement = Placement::OwnUvs;
  options.tiles = Vec2(10, 9);
  options.transfer.directions = studio.directions();
  options.transfer.bounces = 3;
  const bi_scale::Spread worn = spread(stage, rttNamed(studio, "flower"), options);
  fmt::print("vase: {} vertices with matrices\n",
             transfer::receiversOf(worn.asset.transfer.meshes[0])->size());
  const sh::RgbCoefficients light = asBright(studio.hdri("workshop").rotated(turnedY(200)), 0.6f);
  Sheet sheet;
  sheet.columnLabels = {"without macro", "with", "from above"};
  const scene::Camera front = lookAt(Vec3(0, 1.5f, 3.4f), Vec3(0, 0.58f, 0), 27),
                      above = lookAt(Vec3(1.1f, 2.7f, 1.6f), Vec3(0, 0.8f, 0), 27);
  const auto shoot = [&](const scene::Camera& camera, const Showing& how) {
    return develop(photograph(worn.asset, light, how, {camera, side, side, 16}), 0.4f);
  };
  sheet.rows = {{shoot(front, macro(Kind::Unshadowed)), shoot(front, {}), shoot(above, {})}};
  studio.save(compose(sheet), "biscale-vase");
}

}  // namespace lambent::figures
