#include "figures/pictures.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <functional>

#include "figures/scenes.h"
#include "figures/sheet.h"
#include "lambent/image/compare.h"
#include "lambent/scene/shapes.h"
#include "lambent/sh/window.h"
#include "lambent/shade/shade.h"
#include "lambent/shade/transfer_matrices.h"

namespace lambent::figures {

namespace {

using macro::BakeOptions;

BakeOptions optionsFor(const Studio& studio, transfer::Kind kind, int bounces = 2) {
  BakeOptions options;
  options.kind = kind;
  options.directions = studio.directions();
  options.bounces = bounces;
  return options;
}

scene::Camera portrait(const scene::Scene& scene) {
  return scene::frameAutomatically(scene, 1.0f);
}

Mat3 turnedY(float degrees) {
  const float a = degrees * float(kPi) / 180.0f;
  Mat3 turn;
  turn << std::cos(a), 0, std::sin(a), 0, 1, 0, -std::sin(a), 0, std::cos(a);
  return turn;
}

/// A dim sky and a disc: light that casts shadows an eye can judge.
light::Environment skyAndSun() {
  return light::Environment::clampedCosine(Vec3(0, 1, 0), Rgb(0.35f, 0.45f, 0.6f)) +
         light::Environment::disc(Vec3(0.6f, 0.65f, 0.35f).normalized(), 30 * kPi / 180,
                                  Rgb(14.0f, 12.5f, 10.0f));
}

double secondsOf(const std::function<void()>& work) {
  int runs = 0;
  const auto start = std::chrono::steady_clock::now();
  double elapsed = 0.0;
  do {
    work();
    ++runs;
    elapsed = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  } while (elapsed < 0.5);
  return elapsed / runs;
}

}  // namespace

void figure3(const Studio& studio) {
  const int side = studio.pixels(400);
  Sheet sheet;
  sheet.columnLabels = {"unshadowed", "shadowed", "interreflected", "path-traced"};
  scene::Scene stage = madeOf(studio.load("bunny.obj"), diffuseMaterial(Rgb(0.85f, 0.5f, 0.4f)));
  const scene::Camera camera = portrait(stage);
  const light::Environment environment = skyAndSun();
  const sh::RgbCoefficients light = environment.project(5);
  std::vector<image::Image> row;
  for (const transfer::Kind kind :
       {transfer::Kind::Unshadowed, transfer::Kind::Shadowed, transfer::Kind::Interreflected})
    row.push_back(develop(photograph(bake(stage, optionsFor(studio, kind, 4)).asset, light,
                                     environment, camera, side, side),
                          -0.4f));
  row.push_back(develop(pathTrace(stage, light::Environment::harmonics(light), camera, side, side,
                                  studio.paths(1024), 4),
                        -0.4f));
  sheet.rows.push_back(row);
  studio.save(compose(sheet), "figure3");
}

void figure9(const Studio& studio) {
  const int side = studio.pixels(360);
  const scene::Scene scene = ringOnGround();
  BakeOptions options = optionsFor(studio, transfer::Kind::Interreflected, 1);
  options.directions = studio.quick ? 2048 : 16384;
  const int texels = studio.quick ? 128 : 256;
  const transport::Placement placement{{{0, texels, texels}}, {}};
  const Baked baked = bake(scene, options, placement);
  fmt::print("ring: 5 bands, {}x{} texels, {} directions, {:.1f} s\n", texels, texels,
             options.directions, baked.seconds);
  options.bands = 10;
  const Baked fine = bake(scene, options, placement);
  const scene::Camera camera = lookAt(Vec3(0, 4.2f, 4.4f), Vec3(0, 0, 0.1f), 36);
  const light::Environment world =
      light::Environment::uniform(Rgb(0.25f, 0.3f, 0.38f)) +
      light::Environment::disc(Vec3(-0.75f, 0.6f, 0.3f).normalized(), 16 * kPi / 180,
                               Rgb(60.0f, 54.0f, 44.0f));
  Sheet sheet;
  sheet.rowLabels = {"0 deg", "120 deg"};
  sheet.columnLabels = {"baked, 5 bands", "baked, 10 bands", "path-traced, 5 bands",
                        "path-traced, all"};
  for (const float degrees : {0.0f, 120.0f}) {
    const light::Environment turned = world.rotated(turnedY(degrees));
    const sh::RgbCoefficients light = turned.project(5);
    const light::Environment banded = light::Environment::harmonics(light);
    sheet.rows.push_back(
        {develop(photograph(baked.asset, light, turned, camera, side, side), -0.6f),
         develop(photograph(fine.asset, turned.project(10), turned, camera, side, side), -0.6f),
         develop(pathTrace(scene, banded, camera, side, side, studio.paths(1024), 1), -0.6f),
         develop(pathTrace(scene, turned, camera, side, side, studio.paths(4096), 1), -0.6f)});
  }
  studio.save(compose(sheet), "figure9");
}

void figure10(const Studio& studio) {
  const int side = studio.pixels(200);
  const scene::Scene scene = polygonOverGround();
  BakeOptions options = optionsFor(studio, transfer::Kind::Shadowed);
  options.bands = 10;
  options.directions = studio.quick ? 4096 : 32768;
  const int texels = studio.quick ? 96 : 192;
  const Baked baked = bake(scene, options, {{{0, texels, texels}}, {}});
  const scene::Camera camera = lookAt(Vec3(2.2f, 2.6f, 2.6f), Vec3(0, 0.15f, 0), 42);
  struct Column {
    std::string label;
    int bands;
    enum { None, Hann, MinimalRinging } window;
  };
  const Column columns[] = {{"n=2", 2, Column::None},      {"n=3", 3, Column::None},
                            {"n=4", 4, Column::None},      {"n=5", 5, Column::None},
                            {"n=6", 6, Column::None},      {"n=10", 10, Column::None},
                            {"n=5 Hann", 5, Column::Hann}, {"n=5 min.", 5, Column::MinimalRinging}};
  Sheet sheet;
  for (const Column& column : columns) sheet.columnLabels.push_back(column.label);
  sheet.columnLabels.push_back("path-traced");
  for (const double radius : {2.5, 5.0, 10.0, 20.0, 40.0, 80.0}) {
    sheet.rowLabels.push_back(fmt::format("{:g} deg", radius));
    const double alpha = radius * kPi / 180;
    // The same irradiance at any size, straight from 35° off the zenith.
    const double radiance = 1.0 / (kPi * std::pow(std::sin(std::min(alpha, kPi / 2)), 2));
    const light::Environment disc = light::Environment::disc(
        Vec3(-0.45f, 0.82f, -0.35f).normalized(), 2 * alpha, Rgb::Constant(float(2.6 * radiance)));
    std::vector<image::Image> row;
    for (const Column& column : columns) {
      sh::RgbCoefficients light = disc.project(column.bands);
      if (column.window == Column::Hann) sh::applyWindow(sh::hann(5, 5), light);
      if (column.window == Column::MinimalRinging)
        sh::applyWindow(sh::minimalRinging(light), light);
      row.push_back(develop(
          photograph(baked.asset, sh::withBands(light, 10), disc, camera, side, side), 0.0f));
    }
    row.push_back(develop(pathTrace(scene, disc, camera, side, side, studio.paths(256), 0), 0.0f));
    sheet.rows.push_back(std::move(row));
  }
  studio.save(compose(sheet), "figure10");
}

void figure11(const Studio& studio) {
  const int side = studio.pixels(400);
  Sheet sheet;
  sheet.columnLabels = {"(a) unshadowed", "(b) interreflected", "(c) unshadowed",
                        "(d) interreflected"};
  const light::Environment environment = studio.hdri("workshop").rotated(turnedY(270));
  const sh::RgbCoefficients light = environment.project(5);
  for (const char* file : {"bunny.obj", "dragon/dragon_vrip_res3.ply"}) {
    const scene::Scene mesh = studio.load(file);
    const scene::Camera camera = portrait(mesh);
    std::vector<image::Image> row;
    for (const scene::Material& material :
         {diffuseMaterial(Rgb(0.7f, 0.75f, 0.65f)), glossyMaterial(Rgb(0.8f, 0.62f, 0.35f), 16)})
      for (const transfer::Kind kind :
           {transfer::Kind::Unshadowed, transfer::Kind::Interreflected}) {
        const scene::Scene scene = madeOf(mesh, material);
        row.push_back(develop(photograph(bake(scene, optionsFor(studio, kind, 2)).asset, light,
                                         environment, camera, side, side),
                              0.0f));
      }
    sheet.rowLabels.push_back(std::string(file).substr(0, 1) == "b" ? "bunny" : "dragon");
    sheet.rows.push_back(std::move(row));
  }
  studio.save(compose(sheet), "figure11");
}

void figure12(const Studio& studio) {
  const int side = studio.pixels(400);
  scene::Scene teapot = studio.load("teapot.obj");
  for (scene::Mesh& mesh : teapot.meshes) mesh = smoothlySubdivided(welded(mesh), 2);
  const scene::Camera camera = portrait(teapot);
  const light::Environment environment = studio.hdri("workshop").rotated(turnedY(270));
  const sh::RgbCoefficients light = environment.project(5);
  Sheet sheet;
  sheet.columnLabels = {"shadowed", "1 bounce", "2 bounces", "4 bounces", "path-traced"};
  sheet.rowLabels = {"diffuse", "glossy"};
  for (const scene::Material& material :
       {diffuseMaterial(Rgb(0.85f, 0.8f, 0.75f)), glossyMaterial(Rgb(0.85f, 0.8f, 0.75f), 12)}) {
    const scene::Scene scene = madeOf(teapot, material);
    std::vector<image::Image> row;
    for (const int bounces : {0, 1, 2, 4})
      row.push_back(develop(
          photograph(bake(scene, optionsFor(studio, transfer::Kind::Interreflected, bounces)).asset,
                     light, environment, camera, side, side),
          0.0f));
    row.push_back(develop(pathTrace(scene, light::Environment::harmonics(light), camera, side, side,
                                    studio.paths(512), 4),
                          0.0f));
    sheet.rows.push_back(std::move(row));
  }
  studio.save(compose(sheet), "figure12");
}

void table1(const Studio& studio) {
  struct Row {
    std::string name;
    scene::Scene scene;
    int texels;
    std::string shape, seedTime, seedRate;
  };
  scene::Scene teapot = studio.load("teapot.obj");
  for (scene::Mesh& mesh : teapot.meshes) mesh = smoothlySubdivided(welded(mesh), 4);
  const scene::Material diffuse = diffuseMaterial(Rgb::Constant(0.7f));
  const scene::Material glossy = glossyMaterial(Rgb::Constant(0.7f), 16);
  const scene::Scene bunny = studio.load("bunny.obj");
  const scene::Scene dragon = studio.load("dragon/dragon_vrip_res2.ply");
  const std::vector<Row> rows = {
      {"bunny", madeOf(bunny, diffuse), 0, "25-vector", "1.1 h (head, 50k)", "129"},
      {"ring", ringOnGround(), 256, "25-vector", "8 m (ring, 256x256)", "94"},
      {"bunny", madeOf(bunny, glossy), 0, "25x25-matrix", "2.5 h (buddha, 50k)", "3.6/16/125"},
      {"dragon", madeOf(dragon, diffuse), 0, "25-vector", "2.4 h (tyra, 100k)", "83"},
      {"dragon", madeOf(dragon, glossy), 0, "25x25-matrix", "2.4 h (tyra, 100k)", "2.2/9.4/83"},
      {"teapot", madeOf(teapot, glossy), 0, "25x25-matrix", "4.4 h (teapot, 150k)", "1.7/7.7/49"}};
  fmt::print(
      "| model | receivers | transfer | preprocessing | the paper's | shading, one CPU thread | "
      "the paper's frames |\n|---|---|---|---|---|---|---|\n");
  const sh::RgbCoefficients light = studio.hdri("venice").project(5);
  for (const Row& row : rows) {
    const BakeOptions options = optionsFor(studio, transfer::Kind::Interreflected, 1);
    transport::Placement placement;
    if (row.texels > 0) placement.texels = {{0, row.texels, row.texels}};
    const Baked baked = bake(row.scene, options, placement);
    const auto& surface =
        std::get<transfer::Surface<transfer::Numbers>>(baked.asset.transfer.meshes[0]);
    const auto& response = *surface.responses.find(baked.asset.transfer.kind);
    double seconds = 0.0;
    if (response.diffuse) {
      const shade::DiffuseShader shader(response.diffuse->vectors);
      std::vector<float> out(3 * shader.receiverCount());
      seconds = secondsOf([&] { shader.shade(light, out); });
    } else {
      seconds = secondsOf([&] { shade::applyMatrices(response.glossy->matrices, light); });
    }
    fmt::print("| {} | {} | {} | {:.1f} s | {} | {:.0f} Hz | {} Hz |\n", row.name,
               surface.receivers->size(), row.shape, baked.seconds, row.seedTime, 1.0 / seconds,
               row.seedRate);
    std::fflush(stdout);
  }
  fmt::print("\n");
}

}  // namespace lambent::figures
