#include "figures/surfaces.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>

#include "figures/scenes.h"
#include "figures/sheet.h"
#include "lambent/macro/refine.h"
#include "lambent/math/random.h"
#include "lambent/scene/shapes.h"
#include "lambent/scene/sheets.h"
#include "lambent/sources/source.h"

namespace lambent::figures {

namespace {

struct Shown {
  std::string name;
  scene::Scene scene;
  scene::Camera camera;
};

void put(scene::Scene& scene, const Vec3& size, const Vec3& at, const Rgb& albedo) {
  scene::addTo(scene, scene::translated(scene::box(size), at), diffuseMaterial(albedo));
}

/// Two walls and a floor of large polygons, a table on legs, a chest, a ball, and a mirror on the
/// wall.
Shown roomWithMirror() {
  Shown room{"room", {}, lookAt(Vec3(3.4f, 2.1f, 3.6f), Vec3(-0.4f, 0.8f, -0.9f), 44)};
  scene::Scene& scene = room.scene;
  const Rgb wood(0.6f, 0.42f, 0.27f), cloth(0.3f, 0.42f, 0.6f);
  scene::addTo(scene, scene::gridPlane(6, 5, 1, 1), diffuseMaterial(Rgb(0.7f, 0.68f, 0.64f)));
  put(scene, Vec3(6, 2.8f, 0.2f), Vec3(0, 1.4f, -2.6f), Rgb(0.8f, 0.78f, 0.74f));
  put(scene, Vec3(0.2f, 2.8f, 5), Vec3(-3.1f, 1.4f, 0), Rgb(0.75f, 0.45f, 0.35f));
  put(scene, Vec3(1.6f, 0.06f, 0.9f), Vec3(-0.5f, 0.75f, -0.6f), wood);
  for (const float x : {-1.24f, 0.24f})
    for (const float z : {-0.99f, -0.21f})
      put(scene, Vec3(0.07f, 0.72f, 0.07f), Vec3(x, 0.36f, z), wood);
  put(scene, Vec3(1.2f, 0.5f, 0.5f), Vec3(-2.3f, 0.25f, 0.9f), cloth);
  scene::addTo(scene, scene::translated(scene::icosphere(0.22f, 4), Vec3(-0.2f, 1.0f, -0.7f)),
               diffuseMaterial(Rgb(0.7f, 0.6f, 0.15f)));
  put(scene, Vec3(1.9f, 1.5f, 0.05f), Vec3(-0.4f, 1.45f, -2.49f), Rgb(0.25f, 0.2f, 0.16f));
  scene::Mesh glass =
      scene::rotated(scene::gridPlane(1.75f, 1.35f, 1, 1), Vec3::UnitX(), float(kPi) / 2);
  scene::addTo(scene, scene::translated(std::move(glass), Vec3(-0.4f, 1.45f, -2.46f)),
               mirrorMaterial(Rgb(0.88f, 0.9f, 0.89f)));
  return room;
}

/// A leaf with a stalk, in the alpha of a square.
scene::Texture leafTexture() {
  scene::Texture leaf;
  leaf.name = "leaf";
  leaf.width = leaf.height = 128;
  leaf.wrapU = leaf.wrapV = scene::Wrap::ClampToEdge;
  for (int y = 0; y < leaf.height; ++y)
    for (int x = 0; x < leaf.width; ++x) {
      const float u = (float(x) + 0.5f) / 64.0f - 1.0f, v = (float(y) + 0.5f) / 128.0f;
      const float half = 0.85f * std::pow(std::sin(float(kPi) * std::min(v / 0.85f, 1.0f)), 0.8f);
      const bool stalk = std::abs(u) < 0.06f;
      const bool inside = std::abs(u) < half || stalk;
      const bool vein = stalk || std::abs(std::fmod(v + 0.35f * std::abs(u), 0.14f)) < 0.02f;
      leaf.rgba.push_back(std::uint8_t(vein ? 150 : 105));
      leaf.rgba.push_back(std::uint8_t(vein ? 185 : 150));
      leaf.rgba.push_back(std::uint8_t(vein ? 95 : 60));
      leaf.rgba.push_back(inside ? 255 : 0);
    }
  return leaf;
}

/// A trunk with branches, and leaves with two sides that are cut out of squares by their texture.
Shown treeWithLeaves() {
  Shown tree{"tree", {}, lookAt(Vec3(2.6f, 2.1f, 4.4f), Vec3(0, 1.35f, 0), 40)};
  scene::Scene& scene = tree.scene;
  scene::addTo(scene, scene::gridPlane(7, 7, 1, 1), diffuseMaterial(Rgb(0.55f, 0.5f, 0.42f)));
  const scene::Material bark = diffuseMaterial(Rgb(0.35f, 0.26f, 0.18f));
  const auto branch = [&](const Vec3& from, const Vec3& to, float radius) {
    const Vec3 along = to - from;
    Mat4 place = Mat4::Identity();
    place.topLeftCorner<3, 3>() =
        Eigen::Quaternionf::FromTwoVectors(Vec3::UnitY(), along).toRotationMatrix();
    place.topRightCorner<3, 1>() = 0.5f * (from + to);
    scene::addTo(scene, scene::transformed(scene::cylinder(radius, along.norm(), 10, 4), place),
                 bark);
  };
  branch(Vec3(0, 0, 0), Vec3(0, 1.3f, 0), 0.09f);
  math::Random random(11, 0);
  std::vector<scene::Mesh> leaves;
  for (int b = 0; b < 9; ++b) {
    const float azimuth = 2.4f * float(b), height = 0.8f + 0.06f * float(b);
    const Vec3 from(0, height, 0);
    const Vec3 to =
        from + Vec3(0.75f * std::cos(azimuth), 0.55f + 0.02f * float(b), 0.75f * std::sin(azimuth));
    branch(from, to, 0.03f);
    for (int k = 0; k < 16; ++k) {
      const Vec3 on = from + (0.35f + 0.65f * random.uniform()) * (to - from);
      const Vec3 off(random.uniform() - 0.5f, random.uniform() - 0.4f, random.uniform() - 0.5f);
      scene::Mesh card = scene::translated(scene::gridPlane(0.3f, 0.34f, 1, 1), Vec3(0, 0, 0.17f));
      card = scene::rotated(std::move(card), Vec3::UnitX(), 0.9f * random.uniform() - 0.1f);
      card = scene::rotated(std::move(card), Vec3::UnitY(), 6.28f * random.uniform());
      leaves.push_back(scene::translated(std::move(card), on + 0.25f * off));
    }
  }
  scene.textures.push_back(leafTexture());
  scene::Material green = diffuseMaterial(Rgb::Ones());
  green.baseColorTexture = 0, green.alphaMode = scene::AlphaMode::Mask, green.doubleSided = true;
  scene::addTo(scene, scene::withBacks(scene::merge(leaves)), green);
  return tree;
}

/// A ball of paper that lets light through, between two rings of wood, on a stone.
Shown paperLantern() {
  Shown lantern{"lantern", {}, lookAt(Vec3(1.5f, 1.5f, 2.4f), Vec3(0, 0.55f, 0), 38)};
  scene::Scene& scene = lantern.scene;
  scene::addTo(scene, scene::gridPlane(5, 5, 1, 1), diffuseMaterial(Rgb(0.6f, 0.58f, 0.55f)));
  scene::Material paper = diffuseMaterial(Rgb(0.45f, 0.43f, 0.38f));
  paper.transmitted = Rgb(0.42f, 0.36f, 0.26f), paper.doubleSided = true;
  scene::Mesh ball = scene::uvSphere(0.45f, 64, 32);
  std::erase_if(ball.triangles, [&](const scene::Triangle& t) {
    return std::abs(ball.positions[t[0]].y() + ball.positions[t[1]].y() +
                    ball.positions[t[2]].y()) > 3 * 0.41f;
  });
  scene::dropUnusedVertices(ball);
  ball.uvs.clear();
  scene::addTo(scene, scene::translated(scene::withBacks(std::move(ball)), Vec3(0, 0.62f, 0)),
               paper);
  const scene::Material wood = diffuseMaterial(Rgb(0.4f, 0.24f, 0.13f));
  for (const float y : {0.2f, 1.04f})
    scene::addTo(scene, scene::translated(scene::ring(0.15f, 0.2f, 0.06f, 48), Vec3(0, y, 0)),
                 wood);
  put(scene, Vec3(0.5f, 0.16f, 0.5f), Vec3(0, 0.08f, 0), Rgb(0.5f, 0.5f, 0.52f));
  scene::addTo(scene, scene::translated(scene::icosphere(0.12f, 3), Vec3(0, 0.5f, 0)),
               diffuseMaterial(Rgb(0.7f, 0.15f, 0.1f)));
  return lantern;
}

/// A boat under a sail that is filled by the wind and has two sides.
Shown twoSidedSail() {
  Shown boat{"sail", {}, lookAt(Vec3(-3.2f, 2.4f, 3.6f), Vec3(0, 1.2f, 0), 40)};
  scene::Scene& scene = boat.scene;
  scene::addTo(scene, scene::gridPlane(8, 8, 1, 1), diffuseMaterial(Rgb(0.3f, 0.42f, 0.45f)));
  put(scene, Vec3(2.6f, 0.35f, 0.9f), Vec3(0, 0.2f, 0), Rgb(0.55f, 0.36f, 0.22f));
  put(scene, Vec3(0.6f, 0.3f, 0.5f), Vec3(0.8f, 0.52f, 0), Rgb(0.75f, 0.72f, 0.66f));
  scene::addTo(scene, scene::translated(scene::cylinder(0.04f, 2.6f, 16, 8), Vec3(-0.35f, 1.6f, 0)),
               diffuseMaterial(Rgb(0.5f, 0.4f, 0.3f)));
  scene::Mesh sail = scene::gridPlane(1, 1, 16, 16);
  for (std::size_t v = 0; v < sail.positions.size(); ++v) {
    const float across = sail.positions[v].x() + 0.5f, up = sail.positions[v].z() + 0.5f;
    const float width = 1.5f * (1.0f - 0.85f * up);
    const float belly = 0.45f * std::sin(float(kPi) * across) * (1.0f - up) * std::sqrt(up + 0.05f);
    sail.positions[v] = Vec3(-0.3f + width * across, 0.75f + 2.0f * up, belly);
  }
  scene::computeNormals(sail);
  sail.uvs.clear();
  scene::Material cloth = diffuseMaterial(Rgb(0.82f, 0.3f, 0.2f));
  cloth.doubleSided = true;
  scene::addTo(scene, scene::withBacks(std::move(sail)), cloth);
  return boat;
}

}  // namespace

void surfaces(const Studio& studio) {
  const light::Environment sky = orDie(sources::parseSource("disc:115,40,25,3+uniform:0.5")).value;
  macro::BakeOptions options;
  options.directions = studio.directions();
  const sh::RgbCoefficients light = sky.project(options.bands);
  // What mirrors and veils show is lit as surfaces are: in as many bands.
  const light::Environment shown = light::Environment::harmonics(light);
  const int width = studio.pixels(400), height = studio.pixels(300);
  Sheet sheet;
  sheet.columnLabels = {"relit", "path-traced", "difference, times 4"};
  fmt::print(
      "| scene | receivers | noise of the truth | relative RMSE beyond noise | bias |\n"
      "|---|---|---|---|---|\n");
  for (const Shown& place : {roomWithMirror(), treeWithLeaves(), paperLantern(), twoSidedSail()}) {
    const trace::RayScene rays = orDie(trace::RayScene::build(place.scene));
    const auto receivers = orDie(transport::placeReceivers(place.scene, {}, rays.offset()));
    const scene::Scene cut =
        orDie(macro::refine(place.scene, rays, receivers, macro::RefineOptions(), {})).scene;
    const asset::Asset asset = bake(cut, options).asset;
    const image::Image ours = photograph(asset, light, shown, place.camera, width, height);
    reference::PathTraceOptions traced;
    traced.samples = studio.paths(512), traced.bounces = asset.transfer.bounces;
    const reference::Picture truth =
        orDie(reference::picture(place.scene, rays, shown, place.camera, width, height, traced));
    double noise = 0, power = 0, sum = 0, of = 0;
    image::Image apart = ours;
    for (std::size_t i = 0; i < truth.mean.pixels.size(); ++i) {
      noise += double(truth.variance.pixels[i].sum());
      power += double(truth.mean.pixels[i].square().sum());
      sum += double((ours.pixels[i] - truth.mean.pixels[i]).sum());
      of += double(truth.mean.pixels[i].sum());
    }
    std::size_t vertices = 0;
    for (const scene::Mesh& mesh : cut.meshes) vertices += mesh.positions.size();
    fmt::print("| {} | {} | {:.2f}% | {:.2f}% | {:+.2f}% |\n", place.name, vertices,
               100 * std::sqrt(noise / power), 100 * errorBeyondNoise(ours, truth), 100 * sum / of);
    std::fflush(stdout);
    const float ev = exposureOf(truth.mean);
    const float scale = std::exp2(ev);
    for (std::size_t i = 0; i < apart.pixels.size(); ++i)
      apart.pixels[i] =
          (0.5f + 4.0f * scale * (ours.pixels[i] - truth.mean.pixels[i])).max(0).min(1);
    apart.alpha.clear();
    sheet.rowLabels.push_back(place.name);
    sheet.rows.push_back({develop(ours, ev), develop(truth.mean, ev), apart});
  }
  studio.save(compose(sheet), "surfaces");
}

}  // namespace lambent::figures
