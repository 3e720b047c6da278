#include "figures/studio.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <chrono>
#include <cmath>

#include "lambent/image/io.h"
#include "lambent/image/strip.h"
#include "lambent/reference/relit_picture.h"
#include "lambent/scene_io/load.h"
#include "lambent/sources/source.h"
#include "lambent/tone/tone_curve.h"
#include "lambent/transfer/encode.h"

namespace lambent::figures {

void die(const std::string& message) {
  fmt::print(stderr, "figures: {}\n", message);
  std::exit(1);
}

scene::Scene Studio::load(const std::string& file) const {
  return orDie(scene_io::load(inputs / file)).scene;
}

light::Environment Studio::hdri(const std::string& name) const {
  return orDie(sources::parseSource((inputs / "hdri" / (name + ".exr")).string())).value;
}

void Studio::save(const image::Image& picture, const std::string& name) const {
  const std::filesystem::path path = output / (name + ".png");
  if (const Status saved = image::write(picture, path); !saved) {
    fmt::print(stderr, "figures: {}\n", saved.error().message);
    std::exit(1);
  }
  fmt::print("wrote {}\n", path.string());
}

Baked bake(const scene::Scene& scene, const macro::BakeOptions& options,
           const transport::Placement& placement) {
  const auto start = std::chrono::steady_clock::now();
  const trace::RayScene rays = orDie(trace::RayScene::build(scene));
  const auto receivers = orDie(transport::placeReceivers(scene, placement, rays.offset()));
  const auto baked = orDie(macro::bake(scene, rays, receivers, options, {}));
  Baked out;
  out.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  out.asset = {scene, transfer::encode(baked.value, transfer::Encoding::Float32)};
  return out;
}

image::Image photograph(const asset::Asset& asset, const sh::RgbCoefficients& light,
                        const light::Environment& environment, const scene::Camera& camera,
                        int width, int height) {
  shade::PictureOptions options;
  options.width = width, options.height = height;
  options.showing.softLobes = false;  // what stands beside path tracing has the material's lobe
  return orDie(reference::relitPicture(asset, light, environment, camera, options));
}

image::Image pathTrace(const scene::Scene& scene, const light::Environment& environment,
                       const scene::Camera& camera, int width, int height, int paths, int bounces) {
  const trace::RayScene rays = orDie(trace::RayScene::build(scene));
  reference::PathTraceOptions options;
  options.samples = paths, options.bounces = bounces;
  return orDie(reference::picture(scene, rays, environment, camera, width, height, options)).mean;
}

image::Image develop(const image::Image& linear, float exposureEv) {
  const image::Image toned = tone::toneMap(linear, exposureEv, tone::Curve::Filmic);
  return image::over(toned, Rgb::Constant(0.75f));
}

double errorBeyondNoise(const image::Image& ours, const reference::Picture& truth) {
  double off = 0, power = 0;
  for (std::size_t i = 0; i < ours.pixels.size(); ++i) {
    if (!(truth.mean.alpha[i] > 0)) continue;
    off += double((ours.pixels[i] - truth.mean.pixels[i]).square().sum()) -
           double(truth.variance.pixels[i].sum());
    power += double(truth.mean.pixels[i].square().sum());
  }
  return std::sqrt(std::max(off, 0.0) / power);
}

float exposureOf(const image::Image& picture) {
  double sum = 0;
  for (const Rgb& pixel : picture.pixels) sum += double(pixel.mean());
  return float(std::log2(0.25 * double(picture.pixels.size()) / std::max(sum, 1e-12)));
}

scene::Camera lookAt(const Vec3& eye, const Vec3& target, float verticalFovDegrees) {
  const Vec3 back = (eye - target).normalized();
  const Vec3 right = Vec3(0, 1, 0).cross(back).normalized();
  const Vec3 up = back.cross(right);
  scene::Camera camera;
  camera.worldFromCamera.block<3, 1>(0, 0) = right;
  camera.worldFromCamera.block<3, 1>(0, 1) = up;
  camera.worldFromCamera.block<3, 1>(0, 2) = back;
  camera.worldFromCamera.block<3, 1>(0, 3) = eye;
  camera.verticalFov = verticalFovDegrees * float(kPi) / 180.0f;
  return camera;
}

scene::Camera zoomed(const scene::Camera& camera, const Vec3& target, float factor) {
  const Vec3 eye = camera.worldFromCamera.block<3, 1>(0, 3);
  return lookAt(eye, target, camera.verticalFov * 180.0f / float(kPi) / factor);
}

}  // namespace lambent::figures
