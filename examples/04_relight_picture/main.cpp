// 4. Pictures: one asset, one light that turns, a few frames.
//
// usage: 04_relight_picture [ASSET.glb [SOURCE [FOLDER]]]
// Without an asset it bakes a small scene of its own and writes it as scene.glb first.
#include <lambent/asset/asset.h>
#include <lambent/image/io.h>
#include <lambent/macro/bake.h>
#include <lambent/reference/relit_picture.h>
#include <lambent/scene/camera.h>
#include <lambent/scene/shapes.h>
#include <lambent/sh/rotation.h>
#include <lambent/sources/source.h>
#include <lambent/tone/tone_curve.h>
#include <lambent/transfer/encode.h>

#include <Eigen/Geometry>
#include <cstdio>
#include <filesystem>
#include <string>

using namespace lambent;

namespace {

Result<asset::Asset> bakeSmallScene() {
  scene::Material clay;
  clay.diffuse = Rgb(0.75f, 0.6f, 0.5f);
  scene::Scene scene;
  scene::addTo(scene, scene::gridPlane(5, 5, 60, 60), {});
  scene::addTo(scene, scene::translated(scene::torus(1, 0.4f, 64, 32), Vec3(0, 0.4f, 0)), clay);
  auto rays = trace::RayScene::build(scene);
  if (!rays) return rays.error();
  const auto receivers = transport::placeReceivers(scene, {}, rays->offset());
  if (!receivers) return receivers.error();
  macro::BakeOptions options;
  options.directions = 2048;
  auto field = macro::bake(scene, *rays, *receivers, options, {});
  if (!field) return field.error();
  return asset::Asset{scene, transfer::encode(field->value, transfer::Encoding::Float16)};
}

Status run(int argc, char** argv) {
  const std::filesystem::path folder = argc > 3 ? argv[3] : ".";
  auto asset = argc > 1 ? asset::read(argv[1]) : bakeSmallScene();
  if (!asset) return asset.error();
  if (argc <= 1) {
    // An ordinary glTF file, which other viewers open too.
    Status written = asset::write(*asset, folder / "scene.glb");
    if (!written) return written;
  }
  const auto sky = sources::parseSource(argc > 2 ? argv[2] : "disc:20,35,25,8+uniform:0.25");
  if (!sky) return sky.error();
  const light::Environment& environment = sky->value;

  shade::PictureOptions options;
  options.width = 320;
  options.height = 240;
  options.samples = 4;
  const auto camera = scene::frameAutomatically(asset->scene, 320.0f / 240.0f);
  const sh::RgbCoefficients light = environment.project(asset->transfer.bands);
  for (int frame = 0; frame < 4; ++frame) {
    // Turning the light is a product with a small matrix. (Mirrors and backgrounds look the
    // environment up directly: it turns along.)
    const Mat3 turn = Eigen::AngleAxisf(float(frame * kPi / 2), Vec3::UnitY()).toRotationMatrix();
    const auto picture = reference::relitPicture(*asset, sh::rotate(turn, light),
                                                 environment.rotated(turn), camera, options);
    if (!picture) return picture.error();
    const std::filesystem::path path = folder / ("frame" + std::to_string(frame) + ".png");
    const auto developed = tone::toneMap(*picture, 0.0f, tone::Curve::Filmic);
    Status written = image::write(developed, path);
    if (!written) return written;
    std::printf("%s\n", path.string().c_str());
  }
  return Status::ok();
}

}  // namespace

int main(int argc, char** argv) {
  const Status status = run(argc, argv);
  if (!status) std::fprintf(stderr, "%s\n", status.error().message.c_str());
  return status ? 0 : 1;
}
