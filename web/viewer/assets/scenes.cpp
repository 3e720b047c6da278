#include "web/viewer/assets/scenes.h"

#include <Eigen/Geometry>
#include <cmath>

#include "lambent/bi_scale/spread_patch.h"
#include "lambent/macro/bake.h"
#include "lambent/meso/build_rtt.h"
#include "lambent/meso/generators.h"
#include "lambent/scene/shapes.h"
#include "lambent/trace/ray_scene.h"
#include "lambent/transfer/encode.h"
#include "web/viewer/assets/turned.h"

namespace lambent::page {

using scene::Material, scene::Mesh, scene::Scene;

namespace {

Material matt(const char* name, const Rgb& color) {
  Material material;
  material.name = name;
  material.diffuse = color;
  return material;
}

void add(Scene& scene, const char* name, Mesh mesh, Material material) {
  mesh.name = name;
  scene::addTo(scene, std::move(mesh), std::move(material));
}

}  // namespace

Result<asset::Asset> stillLife() {
  Scene scene;
  add(scene, "plinth", plinth(1.5f, 0.16f, 104, 44), matt("plaster", Rgb(0.42f, 0.40f, 0.38f)));

  Material glaze = matt("glaze", Rgb(0.02f, 0.13f, 0.15f));
  glaze.glossy = Rgb(0.20f, 0.21f, 0.21f);
  glaze.lobeExponent = 12.0f;
  std::vector<ProfilePoint> jar = {{0.0f, 0.90f}, {0.075f, 0.90f}, {0.075f, 0.90f}};
  for (const ProfilePoint& p : smoothProfile({{0.085f, 0.975f},
                                              {0.12f, 1.00f},
                                              {0.135f, 0.965f},
                                              {0.105f, 0.89f},
                                              {0.16f, 0.77f},
                                              {0.32f, 0.57f},
                                              {0.335f, 0.37f},
                                              {0.24f, 0.13f},
                                              {0.185f, 0.035f},
                                              {0.18f, 0.004f}},
                                             23))
    jar.push_back(p);
  jar.insert(jar.end(), {{0.17f, 0.002f}, {0.17f, 0.002f}, {0.0f, 0.002f}});
  add(scene, "jar", scene::translated(turned(jar, 38), Vec3(-0.50f, 0, -0.60f)), glaze);

  const auto stone = [](float radius, const Vec3& shape, const Vec3& at, float turn) {
    Mesh mesh = scene::scaled(scene::icosphere(radius, 3), shape);
    mesh = scene::rotated(std::move(mesh), Vec3::UnitY(), turn);
    return scene::translated(std::move(mesh), at);
  };
  add(scene, "vermilion stone",
      stone(0.25f, Vec3(1.15f, 0.86f, 1.0f), Vec3(0.36f, 0.213f, -0.66f), 0.5f),
      matt("vermilion", Rgb(0.62f, 0.07f, 0.025f)));
  add(scene, "ochre stone",
      stone(0.145f, Vec3(1.1f, 0.8f, 1.0f), Vec3(0.72f, 0.114f, -0.22f), 1.2f),
      matt("ochre", Rgb(0.72f, 0.42f, 0.08f)));

  // A band with a rounded outside, which shows a little of every light, and a hollow inside, which
  // gathers light on the plinth.
  Material gold;
  gold.name = "gold";
  gold.diffuse = Rgb::Zero();
  gold.mirror = Rgb(0.95f, 0.72f, 0.36f);
  std::vector<ProfilePoint> band;
  constexpr int kSteps = 8;
  for (int i = 0; i <= kSteps; ++i) {
    const float t = -1.0f + 2.0f * float(i) / kSteps;
    band.push_back({0.302f - 0.030f * t * t, 0.068f - 0.066f * t});
  }
  for (int i = 0; i <= kSteps; ++i) {
    const float t = 1.0f - 2.0f * float(i) / kSteps;
    band.push_back({0.262f + 0.010f * t * t, 0.068f - 0.066f * t});
  }
  // It ends where it began, and is closed. In the middle of the plinth, whose circles of vertices
  // then follow the ring's shadow.
  add(scene, "ring", turned(band, 112), gold);

  const Result<trace::RayScene> rays = trace::RayScene::build(scene);
  if (!rays) return rays.error();
  macro::BakeOptions options;
  options.directions = 4096;
  options.glossyBands = 3;
  options.bounces = 3;
  const auto receivers = transport::placeReceivers(scene, {}, rays->offset());
  if (!receivers) return receivers.error();
  const auto field = macro::bake(scene, *rays, *receivers, options, {});
  if (!field) return field.error();
  return asset::Asset{scene, transfer::encode(field->value, transfer::Encoding::Float16)};
}

Result<asset::Asset> wovenKnot() {
  Scene scene;
  KnotOptions shape;
  shape.along = 150;
  shape.across = 16;
  Mesh mesh = knot(shape);
  const float lowest = scene::bounds(scene::sceneOf(mesh)).lower.y();
  add(scene, "knot", scene::translated(std::move(mesh), Vec3(0, -lowest + 0.002f, 0)),
      matt("cloth", Rgb::Constant(0.5f)));
  add(scene, "plinth", plinth(1.25f, 0.14f, 64, 24), matt("plaster", Rgb::Constant(0.66f)));

  meso::WeaveOptions cloth;
  cloth.warp = Rgb(0.06f, 0.11f, 0.24f);
  cloth.weft = Rgb(0.74f, 0.66f, 0.52f);
  cloth.backing = Rgb(0.02f, 0.02f, 0.03f);
  cloth.glossy = Rgb::Constant(0.10f);
  cloth.width = 0.90f;
  meso::RttOptions structure;
  structure.width = structure.height = 36;
  structure.views = 5;
  structure.bands = 4;
  structure.directions = 384;
  const auto built = meso::buildRtt(meso::weave(cloth), structure, {});
  if (!built) return built.error();

  bi_scale::SpreadOptions options;
  options.meshes = {0};
  options.placement = bi_scale::Placement::OwnUvs;
  const float around = float(2 * kPi) * shape.tube;
  const int tilesAround = 5;
  options.tiles =
      Vec2(std::round(lengthOf(shape) / around * float(tilesAround)), float(tilesAround));
  options.albedo = Rgb::Constant(0.35f);
  options.transfer.bands = structure.bands;
  options.transfer.directions = 4096;
  options.transfer.keepShadowed = true;
  auto spread = bi_scale::spreadPatch(
      std::move(scene), transfer::encode(built->value, transfer::Encoding::Snorm8), options);
  if (!spread) return spread.error();
  return std::move(spread->value.asset);
}

}  // namespace lambent::page
