#include "lambent/shade/picture_frame.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <Eigen/LU>

#include "lambent/asset/check.h"
#include "lambent/work/parallel_for.h"

namespace lambent::shade {
namespace {

constexpr int kLargestSide = 16384;
constexpr int kMostSamples = 4096;
constexpr const char* kRemedy = ". Make the asset again";

}  // namespace

Status checkCamera(const scene::Camera& camera) {
  const Eigen::Matrix4f world = camera.worldFromCamera;
  if (!world.allFinite() || !(std::abs(world.topLeftCorner<3, 3>().determinant()) > 0.0f))
    return report::badInput(
        fmt::format("camera '{}': its matrix is not a placement in space", camera.name));
  return Status::ok();
}

Status checkCamera(const scene::Camera& camera, const PictureOptions& options) {
  if (options.air && camera.orthographicHalfHeight)
    return report::badUsage(fmt::format(
        "camera '{}' is orthographic: what it sees has no distance, and so no air before "
        "it. Take a perspective one",
        camera.name));
  return checkCamera(camera);
}

Status checkOptions(const PictureOptions& options) {
  if (options.width < 1 || options.height < 1 || options.width > kLargestSide ||
      options.height > kLargestSide)
    return report::badUsage(fmt::format("a picture of {}×{} pixels: each side can be 1 to {}",
                                        options.width, options.height, kLargestSide));
  if (options.samples < 1 || options.samples > kMostSamples)
    return report::badUsage(
        fmt::format("{} samples a pixel: 1 to {} can be", options.samples, kMostSamples));
  if (options.showing.lobeExponent &&
      !(*options.showing.lobeExponent >= 0.0f && *options.showing.lobeExponent < 1e6f))
    return report::badUsage(
        fmt::format("a lobe exponent of {}: 0 to 1e6 can be", *options.showing.lobeExponent));
  if (options.air && !(options.air->metresPerUnit > 0 && std::isfinite(options.air->metresPerUnit)))
    return report::badUsage(fmt::format("{} m in a unit of the scene: it must be positive",
                                        options.air->metresPerUnit));
  if (options.air && options.air->shafts) {
    const Shafts& shafts = *options.air->shafts;
    if (!options.sun)
      return report::badUsage("shafts of light without a Sun whose shadows are sharp");
    if (shafts.planes < 1 || shafts.planes > 1024 || shafts.samples < 1 || shafts.samples > 1024)
      return report::badUsage(
          fmt::format("shafts of light by {} planes and {} samples between two: 1 to 1024 can be",
                      shafts.planes, shafts.samples));
  }
  return Status::ok();
}

Status checkPicture(const asset::Asset& asset, const sh::RgbCoefficients& light,
                    const scene::Camera& camera, const PictureOptions& options) {
  if (Status s = checkOptions(options); !s) return s;
  if (light.bands < 1 || light.values.size() != 3u * sh::coefficientCount(light.bands))
    return report::badInput("a light without bands, or with too few numbers for them");
  if (Status s = checkCamera(camera, options); !s) return s;

  if (const auto wrong = asset::faultOf(asset)) return report::badInput(*wrong + kRemedy);
  const bool seen = std::any_of(asset.scene.meshes.begin(), asset.scene.meshes.end(),
                                [](const scene::Mesh& mesh) { return !mesh.triangles.empty(); });
  if (!seen) return report::badInput("the asset has no triangles: nothing to see");
  return checkHeld(asset, options.showing);
}

void finishPicture(image::Image& image, const light::Environment& environment,
                   const scene::Camera& camera, const PictureOptions& options) {
  const auto cut = [&] {
    for (Rgb& pixel : image.pixels) pixel = pixel.max(0.0f);
  };
  if (!options.background) return cut();
  const bool shafts = options.air && options.air->shafts;
  if (!shafts) cut();
  const std::vector<Vec2> positions = scene::subpixelPositions(options.samples);
  work::parallelFor(image.height, [&](int y) {
    for (int x = 0; x < image.width; ++x) {
      const std::size_t at = std::size_t(y) * image.width + x;
      const float uncovered = 1.0f - image.alpha[at];
      if (!(uncovered > 0.0f)) continue;
      Rgb sum = Rgb::Zero();
      for (const Vec2& p : positions) {
        const scene::Ray ray =
            scene::cameraRay(camera, image.width, image.height, x + p.x(), y + p.y());
        const Rgb radiance = environment.radiance(ray.direction);
        sum +=
            options.air ? options.air->seenBehind(ray.origin, ray.direction, radiance) : radiance;
      }
      image.pixels[at] += uncovered / float(positions.size()) * sum;
    }
  });
  if (shafts) cut();
  image.alpha.clear();
}

}  // namespace lambent::shade
