#include "lambent/sky/haze.h"

#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "lambent/work/runner.h"

namespace lambent::sky {
namespace {

constexpr double kNothingStands = 1e9;  // m

}  // namespace

Status checkHaze(const image::Image& color, const image::Image& depth, const HazeOptions& options) {
  const PictureShape& shape = options.shape;
  if (color.width != depth.width || color.height != depth.height)
    return report::badUsage(
        fmt::format("the depths are of {}x{} pixels, and the colours of {}x{}: they must be of the "
                    "same picture",
                    depth.width, depth.height, color.width, color.height));
  if (color.width != shape.width || color.height != shape.height)
    return report::badUsage(fmt::format("a picture of {}x{} pixels is not one of {}x{}",
                                        color.width, color.height, shape.width, shape.height));
  if (options.depth == DepthAlong::Axis && shape.map != PictureMap::Camera)
    return report::badUsage("depth along the axis is a camera's: a panorama has distances");
  if (!(options.metres > 0) || !std::isfinite(options.metres))
    return report::badUsage("a unit of depth is a number of metres above 0");
  return checkShape(shape);
}

Result<image::Image> haze(const image::Image& color, const image::Image& depth,
                          const AerialPerspective& air, const HazeOptions& options,
                          const Progress& progress) {
  if (Status fits = checkHaze(color, depth, options); !fits) return fits.error();
  const PictureShape& shape = options.shape;
  const Mat3d sunFromWorld = options.worldFromSun.transpose();
  const Vec3d axis =
      directionOf(shape, {shape.width / 2.0, shape.height / 2.0}).value_or(Vec3d::UnitX());
  image::Image out = color;
  if (options.backdrop) out.alpha.clear();

  const auto shade = [&](int x, int y) {
    const std::size_t at = std::size_t(y) * std::size_t(shape.width) + std::size_t(x);
    const std::optional<Vec3d> direction = directionOfPixel(shape, x, y);
    if (!direction) return;
    const Vec3d inSunFrame = sunFromWorld * *direction;
    double distance = double(depth.pixels[at][0]) * options.metres;
    const bool stands = distance > 0 && distance < kNothingStands;
    if (options.depth == DepthAlong::Axis) distance /= direction->dot(axis);
    double covered = stands ? 1 : 0;
    if (!color.alpha.empty()) covered *= double(color.alpha[at]);
    if (stands) {
      const AirBetween between = airBetween(air, inSunFrame, distance);
      out.pixels[at] = withinGamut(between.extinction * color.pixels[at].cast<double>() +
                                   covered * between.inScattered());
    }
    if (!options.backdrop) return;
    const Rgb sky = radianceRgb(colorSeen(*options.backdrop, options.below, inSunFrame));
    out.pixels[at] = (stands ? out.pixels[at] : Rgb::Zero()) + float(1 - covered) * sky;
  };
  const work::Runner runner(progress);
  const Status done =
      runner.run({"air", "pixels", std::uint64_t(shape.width)},
                 work::Chunks(std::size_t(shape.height)), [&](const work::Chunk& row) {
                   for (int x = 0; x < shape.width; ++x) shade(x, int(row.index));
                 });
  if (!done) return done.error();
  return out;
}

}  // namespace lambent::sky
