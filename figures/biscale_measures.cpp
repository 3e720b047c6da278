// What of bi-scale transfer is measured: filtering, encodings, two ways to an RTT.
#include <fmt/format.h>

#include <cmath>

#include "figures/biscale.h"
#include "figures/relief.h"
#include "figures/scenes.h"
#include "figures/sheet.h"
#include "lambent/meso/generators.h"
#include "lambent/scene/shapes.h"
#include "lambent/tone/compare.h"
#include "lambent/transfer/encode.h"

namespace lambent::figures {

namespace {

using bi_scale::Placement;

/// A ball of 10,242 vertices with dents all over, so that its matrices have something to say.
scene::Scene dentedBall() {
  scene::Mesh mesh = scene::icosphere(1.0f, 5);
  for (Vec3& p : mesh.positions) {
    const Vec3 n = p;
    p *= 1.0f +
         0.16f * std::sin(4.0f * n.x()) * std::sin(4.0f * n.y() + 0.5f) * std::cos(3.0f * n.z()) +
         0.05f * std::sin(9.0f * n.z() + 2.0f * n.x());
  }
  scene::computeNormals(mesh);
  return scene::sceneOf(std::move(mesh), diffuseMaterial(Rgb::Constant(0.5f)));
}

using BiScale = transfer::BiScale<transfer::Numbers>;

/// The most that the mesh's matrices hold.
transfer::Numbers& matricesOf(asset::Asset& asset) {
  auto& matrices = std::get<BiScale>(asset.transfer.meshes[0]).matrices;
  return matrices.find(transfer::Kind::Interreflected)->numbers;
}

asset::Asset withEncodings(const asset::Asset& from, transfer::Encoding rtt,
                           transfer::Encoding matrices) {
  asset::Asset out = from;
  out.transfer.rtts[0] = transfer::encode(transfer::decode(from.transfer.rtts[0]), rtt);
  transfer::Numbers& numbers = matricesOf(out);
  const std::size_t matrix = std::get<BiScale>(out.transfer.meshes[0])
                                 .matrices.find(transfer::Kind::Interreflected)
                                 ->perMatrix();
  numbers = transfer::encode(transfer::decode(numbers), matrices, matrix);
  return out;
}

double mebibytes(const transfer::Numbers& numbers) {
  return double(transfer::bytesOf(numbers)) / double(1 << 20);
}

image::Comparison compared(const image::Image& test, const image::Image& reference) {
  return orDie(tone::compare(test, reference));
}

}  // namespace

void biscaleFilter(const Studio& studio) {
  const int side = studio.pixels(256), many = studio.quick ? 64 : 256;
  const transfer::SimulatedRtt rtt = rttNamed(studio, "weave");
  bi_scale::SpreadOptions wear;
  wear.placement = Placement::OwnUvs, wear.tiles = Vec2(160, 160);
  wear.transfer.directions = 1024, wear.transfer.bounces = 0;
  const asset::Asset plane =
      spread(scene::sceneOf(scene::gridPlane(16, 16, 32, 32), diffuseMaterial(Rgb::Ones())), rtt,
             wear)
          .asset;
  wear.tiles = Vec2(24, 12);
  const asset::Asset ball =
      spread(scene::sceneOf(scene::uvSphere(0.4f, 96, 48), diffuseMaterial(Rgb::Ones())), rtt, wear)
          .asset;
  const sh::RgbCoefficients light =
      discLight(towards(200, 40), 60, Rgb(2.6f, 2.5f, 2.3f)).project(5);
  struct Scene {
    const char* name;
    const asset::Asset& asset;
    Vec3 eye, target;
    float fov;
  };
  const Scene scenes[] = {
      {"plane into the distance", plane, Vec3(0, 0.55f, 3), Vec3(0.3f, 0, 0), 40},
      {"far ball", ball, Vec3(2, 3, 9), Vec3(0, 0, 0), 14}};
  fmt::print(
      "| scene | look-up | samples a pixel | RMSE | relative RMSE | FLIP | crawl | of the "
      "reference |\n"
      "|---|---|---|---|---|---|---|---|\n");
  Sheet sheet;
  sheet.columnLabels = {"nearest, 1", "filtered, 1", "nearest, 4", "filtered, 4",
                        "nearest, " + std::to_string(many)};
  for (const Scene& scene : scenes) {
    // Half a pixel to the side, by a turn about the eye.
    const scene::Camera here = lookAt(scene.eye, scene.target, scene.fov);
    const float angle = 0.5f * here.verticalFov / float(side);
    const Vec3 right = here.worldFromCamera.block<3, 1>(0, 0);
    const scene::Camera there = lookAt(
        scene.eye, scene.target + right * (scene.target - scene.eye).norm() * angle, scene.fov);
    const auto shoot = [&](const scene::Camera& camera, bool filter, int samples) {
      shade::Showing options;
      options.mesoStructure = transfer::Kind::Unshadowed, options.filter = filter;
      return photograph(scene.asset, light, options, {camera, side, side, samples});
    };
    const image::Image truth = shoot(here, false, many), moved = shoot(there, false, many);
    const double motion = compared(moved, truth).rmse;
    std::vector<image::Image> row;
    for (const int samples : {1, 4})
      for (const bool filter : {false, true}) {
        const image::Image picture = shoot(here, filter, samples);
        const image::Comparison error = compared(picture, truth);
        const double crawl = compared(shoot(there, filter, samples), picture).rmse;
        fmt::print("| {} | {} | {} | {:.4f} | {:.1f}% | {:.3f} | {:.4f} | {:.4f} |\n", scene.name,
                   filter ? "filtered" : "nearest", samples, error.rmse, 100 * error.relativeRmse,
                   error.flip, crawl, motion);
        row.push_back(develop(picture, 0.4f));
      }
    row.push_back(develop(truth, 0.4f));
    sheet.rows.push_back(std::move(row));
  }
  fmt::print("\n");
  studio.save(compose(sheet), "biscale-filter");
}

void biscaleEncodings(const Studio& studio) {
  using transfer::Encoding;
  const int side = studio.pixels(400);
  const transfer::SimulatedRtt rtt = rttNamed(studio, "weave");
  bi_scale::SpreadOptions wear;
  wear.matrixEncoding = Encoding::Float32;
  wear.transfer.directions = studio.directions(), wear.transfer.bounces = 2;
  wear.mesoVertices = studio.quick ? 100000 : 300000;
  if (studio.quick) wear.atlas.size = 1024;
  const scene::Scene scene = dentedBall();
  bi_scale::Spread exact = spread(scene, rtt, wear);
  const BiScale& mesh = std::get<BiScale>(exact.asset.transfer.meshes[0]);
  const transfer::IdMap& map = *mesh.patch.idMap();
  const std::vector<float> matrices = transfer::decode(matricesOf(exact.asset));
  const sh::RgbCoefficients light = studio.hdri("workshop").project(5);
  const Shot shot{scene::frameAutomatically(scene, 1.0f), side, side, 16};
  const image::Image truth = photograph(exact.asset, light, {}, shot);
  const double idMap = double(map.ids.size() * 2) / double(1 << 20);
  const double geometry = double(exact.asset.scene.meshes[0].positions.size() * (12 + 12 + 8 + 16) +
                                 exact.asset.scene.meshes[0].triangles.size() * 12) /
                          double(1 << 20);
  fmt::print(
      "{} vertices ({} of the surface before its charts), RTT {}x{}x{}x{}, id map {}x{}\n\n"
      "| RTT | matrices | relative RMS of the RTT | of the matrices | the picture's relative RMSE "
      "| "
      "FLIP | RTT MiB | matrices MiB | id map MiB | file MiB "
      "|\n|---|---|---|---|---|---|---|---|---|---|\n",
      mesh.receivers->size(), scene.meshes[0].positions.size(), rtt.width, rtt.height, rtt.views,
      rtt.views, map.width, map.height);
  const auto name = [](Encoding encoding) {
    return encoding == Encoding::Float32   ? "32 bits"
           : encoding == Encoding::Float16 ? "16 bits"
                                           : "8 bits";
  };
  const std::filesystem::path file = studio.output / "biscale-encodings.glb";
  for (const auto& [ofRtt, ofMatrices] : {std::pair(Encoding::Float32, Encoding::Float32),
                                          {Encoding::Float16, Encoding::Float16},
                                          {Encoding::Float16, Encoding::Snorm8},
                                          {Encoding::Snorm8, Encoding::Float16},
                                          {Encoding::Snorm8, Encoding::Snorm8}}) {
    asset::Asset asset = withEncodings(exact.asset, ofRtt, ofMatrices);
    const transfer::Numbers& numbers = asset.transfer.rtts[0].values;
    const transfer::Numbers& matrix = matricesOf(asset);
    const image::Comparison error = compared(photograph(asset, light, {}, shot), truth);
    if (const Status saved = asset::write(asset, file); !saved) die(saved.error().message);
    const double bytes = double(std::filesystem::file_size(file)) / double(1 << 20);
    std::filesystem::remove(file);
    fmt::print(
        "| {} | {} | {:.4f}% | {:.4f}% | {:.4f}% | {:.4f} | {:.1f} | {:.1f} | {:.1f} | {:.1f} |\n",
        name(ofRtt), name(ofMatrices), 100 * transfer::encodingError(rtt.values, numbers),
        100 * transfer::encodingError(matrices, matrix), 100 * error.relativeRmse, error.flip,
        mebibytes(numbers), mebibytes(matrix), idMap, bytes);
    std::fflush(stdout);
  }
  fmt::print("\nGeometry, normals, UVs, tangents and indices: {:.1f} MiB of it.\n\n", geometry);
}

void biscaleRttMethods(const Studio& studio) {
  const auto distance = [](const std::vector<float>& a, const std::vector<float>& b) {
    double squared = 0.0, power = 0.0;
    for (std::size_t k = 0; k < a.size(); ++k)
      squared += (double(a[k]) - b[k]) * (double(a[k]) - b[k]), power += double(b[k]) * b[k];
    return std::sqrt(squared / power);
  };
  fmt::print(
      "| patch | method | seconds | million rays | relative RMSE against gathering with {} "
      "directions | against eq. 5 with 32 x 64 lights |\n|---|---|---|---|---|---|\n",
      studio.quick ? 1024 : 8192);
  for (const std::string name : {"weave", "stucco"}) {
    const meso::Patch patch = *meso::generate(name, Vec2(0.1f, 0.1f));
    // Two converged answers by different ways: how far they are apart is what neither can be held
    // to.
    meso::RttOptions options;
    options.width = options.height = 24;
    options.views = 4, options.supersample = 1;
    options.bounces = 3;
    meso::RttOptions converged = options;
    converged.directions = studio.quick ? 1024 : 8192, converged.seed = 1;
    meso::RttOptions imagesConverged = options;
    imagesConverged.method = meso::RttMethod::Images;
    imagesConverged.polarLights = studio.quick ? 16 : 32;
    imagesConverged.azimuthLights = studio.quick ? 32 : 64;
    const BuiltRtt exact = build(patch, converged), exactImages = build(patch, imagesConverged);
    const auto row = [&](const std::string& how, const BuiltRtt& built) {
      fmt::print("| {} | {} | {:.1f} | {:.1f} | {:.2f}% | {:.2f}% |\n", name, how, built.seconds,
                 double(built.cost.viewRays + built.cost.lightRays) * 1e-6,
                 100 * distance(built.rtt.values, exact.rtt.values),
                 100 * distance(built.rtt.values, exactImages.rtt.values));
      std::fflush(stdout);
    };
    for (const int directions : {128, 512, 2048}) {
      options.directions = directions;
      row(fmt::format("gather, {} directions", directions), build(patch, options));
    }
    options.method = meso::RttMethod::Images;
    for (const int polar : {8, 16}) {
      options.polarLights = polar, options.azimuthLights = 2 * polar;
      row(fmt::format("eq. 5, {} x {} lights", polar, 2 * polar), build(patch, options));
    }
    row(fmt::format("gather, {} directions", converged.directions), exact);
    row(fmt::format("eq. 5, {} x {} lights", imagesConverged.polarLights,
                    imagesConverged.azimuthLights),
        exactImages);
  }
  fmt::print("\n");
}

}  // namespace lambent::figures
