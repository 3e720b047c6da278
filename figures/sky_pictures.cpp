// A landscape under the sky (preetham2003modeling, Figures 5 and 8), and a day of it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "figures/scenes.h"
#include "figures/sheet.h"
#include "figures/sky.h"
#include "lambent/scene/shapes.h"
#include "lambent/sky/aerial_table.h"
#include "lambent/sky/haze.h"
#include "lambent/sky/medium.h"
#include "lambent/sky/sky_light.h"
#include "lambent/sky/sky_picture.h"
#include "lambent/sky/sky_request.h"
#include "lambent/tone/tone_curve.h"

namespace lambent::figures {
namespace {

/// 0 … 1, at the corners of a lattice.
double cornerAt(int x, int z) {
  std::uint32_t h = std::uint32_t(x) * 0x9e3779b1u ^ std::uint32_t(z) * 0x85ebca77u;
  h = (h ^ (h >> 15)) * 0x2c1b3c6du;
  h = (h ^ (h >> 12)) * 0x297a2d39u;
  return double(h ^ (h >> 15)) / 4294967296.0;
}

/// Smooth noise, −1 … 1, a lattice of 1.
double noiseAt(double x, double z) {
  const int i = int(std::floor(x)), j = int(std::floor(z));
  const auto ease = [](double t) { return t * t * t * (t * (6 * t - 15) + 10); };
  const double u = ease(x - i), v = ease(z - j);
  const double low = cornerAt(i, j) + u * (cornerAt(i + 1, j) - cornerAt(i, j));
  const double high = cornerAt(i, j + 1) + u * (cornerAt(i + 1, j + 1) - cornerAt(i, j + 1));
  return 2 * (low + v * (high - low)) - 1;
}

/// Ridges above a valley that runs along −z from the origin; m.
double terrainHeight(double x, double z) {
  double ridges = 0, share = 1, frequency = 1 / 9000.0;
  double weight = 1;
  for (int octave = 0; octave < 8; ++octave) {
    const double ridge =
        std::pow(1 - std::abs(noiseAt(x * frequency + 17.3 * octave, z * frequency)), 2);
    ridges += share * weight * ridge;
    weight = std::clamp(1.6 * ridge, 0.0, 1.0);
    share *= .5, frequency *= 2.03;
  }
  const double fromValley = std::abs(x - 900 * std::sin(z / 5200)) / 3600;
  const double rise = std::clamp(fromValley * fromValley, .04, 1.0);
  return 1750 * rise * ridges;
}

/// 24 km to each side and 56 km ahead of the origin, in quads of `spacing` m; grass, rock and snow.
scene::Scene terrain(double spacing) {
  const float sizeX = 48000, sizeZ = 64000;
  scene::Mesh mesh = scene::gridPlane(sizeX, sizeZ, int(sizeX / spacing), int(sizeZ / spacing));
  for (Vec3& p : mesh.positions) {
    p.z() -= 28000;
    p.y() = float(terrainHeight(p.x(), p.z()));
  }
  scene::computeNormals(mesh);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const float height = mesh.positions[i].y(), up = mesh.normals[i].y();
    const float rock = std::clamp((0.86f - up) / 0.14f + (height - 1500) / 900, 0.0f, 1.0f);
    const float snow =
        std::clamp((height - 1700) / 300, 0.0f, 1.0f) * std::clamp((up - 0.6f) / 0.15f, 0.0f, 1.0f);
    Rgb color = Rgb(0.060f, 0.085f, 0.030f) +
                rock * (Rgb(0.16f, 0.14f, 0.12f) - Rgb(0.060f, 0.085f, 0.030f));
    mesh.colors.push_back(color + snow * (Rgb(0.80f, 0.82f, 0.85f) - color));
  }
  return scene::sceneOf(std::move(mesh), diffuseMaterial(Rgb::Ones()));
}

/// Where a level camera looks.
struct Lookout {
  Vec3 eye;
  double bearing = 0, elevation = 0, verticalFov = .7;  // rad
  int width = 400, height = 225;
  scene::Camera camera() const {
    const double c = std::cos(elevation);
    const Vec3 towards(float(c * std::sin(bearing)), float(std::sin(elevation)),
                       float(-c * std::cos(bearing)));
    return lookAt(eye, eye + towards, float(verticalFov / kDegree));
  }
  sky::PictureShape shape() const {
    return {sky::PictureMap::Camera, width, height, bearing, elevation, verticalFov};
  }
};

Lookout lookout(const Studio& studio) {
  Lookout out;
  const double z = 3000;
  out.eye = Vec3(700, float(terrainHeight(700, z) + 650), float(z));
  out.elevation = 3 * kDegree, out.verticalFov = 34 * kDegree;
  out.width = studio.pixels(288), out.height = studio.pixels(162);
  return out;
}

image::Image toned(const image::Image& linear, double ev) {
  return tone::toneMap(linear, float(ev), tone::Curve::Filmic);
}

/// log₂ of .25 over the mean luminance.
double autoExposure(double candelas) {
  return std::log2(.25 * radiometry::kPhotopicEfficacy / candelas);
}
/// As light meters have it for ISO 100: log₂ (L · 100 / 12.5).
double exposureValue(double candelas) {
  return std::log2(8 * candelas);
}

double meanLuminance(const image::Image& picture) {
  double sum = 0;
  for (const Rgb& p : picture.pixels)
    sum += std::min(20.0, .2126 * double(p[0]) + .7152 * double(p[1]) + .0722 * double(p[2]));
  return radiometry::kPhotopicEfficacy * sum / double(picture.pixels.size());
}

image::Image depthOf(const scene::Scene& scene, const Lookout& view) {
  const trace::RayScene rays = orDie(trace::RayScene::build(scene));
  image::Image depth(view.width, view.height);
  const scene::Camera camera = view.camera();
  for (int y = 0; y < view.height; ++y)
    for (int x = 0; x < view.width; ++x) {
      const scene::Ray ray =
          scene::cameraRay(camera, view.width, view.height, float(x) + .5f, float(y) + .5f);
      const auto hit = rays.closest(ray.origin, ray.direction);
      depth.at(x, y) = Rgb::Constant(hit ? hit->distance : std::numeric_limits<float>::infinity());
    }
  return depth;
}

image::Image pathTraced(const scene::Scene& scene, const light::Environment& environment,
                        const Lookout& view, int paths, bool background) {
  const trace::RayScene rays = orDie(trace::RayScene::build(scene));
  reference::PathTraceOptions options;
  options.samples = paths, options.bounces = 1, options.background = background;
  return orDie(reference::picture(scene, rays, environment, view.camera(), view.width, view.height,
                                  options))
      .mean;
}

}  // namespace

void skyPreetham(const Studio& studio) {
  const scene::Scene land = terrain(studio.quick ? 240 : 100);
  const Lookout view = lookout(studio);
  Sheet sheet;
  sheet.columnLabels = {"turbidity 2", "turbidity 6"};
  for (const double elevation : {40., 6.}) {
    std::vector<image::Image> row;
    for (const double turbidity : {2., 6.}) {
      sky::SkyOptions options = skyOptions("clear", sky::Model::Preetham, 90 - elevation);
      options.atmosphere = sky::withTurbidity(options.atmosphere, turbidity);
      const image::Image picture =
          pathTraced(land, sky::environmentOf(skyOf(options), sky::worldFromSunAt(62 * kDegree)),
                     view, studio.paths(512), true);
      const double mean = meanLuminance(picture);
      row.push_back(toned(picture, autoExposure(mean)));
      fmt::print("Sun at {:g} degrees, turbidity {:g}: mean luminance {:.4g} cd/m2, EV {:.1f}\n",
                 elevation, turbidity, mean, exposureValue(mean));
    }
    sheet.rowLabels.push_back(fmt::format("Sun {:g} up", elevation));
    sheet.rows.push_back(std::move(row));
  }
  studio.save(compose(sheet), "sky-preetham");
}

void skyAerial(const Studio& studio) {
  const scene::Scene land = terrain(studio.quick ? 240 : 100);
  const Lookout view = lookout(studio);
  const image::Image depth = depthOf(land, view);
  std::vector<double> nm;
  for (double at = 380; at <= 740; at += 24) nm.push_back(at);
  Sheet sheet;
  sheet.columnLabels = {"Sun 35 up", "Sun 8 up"};
  sheet.rowLabels = {"no air", "constant density", "table", "exact"};
  sheet.rows.resize(sheet.rowLabels.size());
  for (const auto& [elevation, bearing] : {std::pair(35., 105.), std::pair(8., 50.)}) {
    sky::SkyOptions options = skyOptions("clear", sky::Model::Fast, 90 - elevation);
    options.altitude = double(view.eye.y());
    const sky::Sky sky = skyOf(options);
    const Mat3d worldFromSun = sky::worldFromSunAt(bearing * kDegree);
    const image::Image bare =
        pathTraced(land, sky::environmentOf(sky, worldFromSun), view, studio.paths(512), false);
    const auto scattering = orDie(
        sky::Scattering::solve(sky::mediumOf(options.atmosphere, nm), sky::Resolution::fast()));
    const sky::ViewerInAir viewer{options.altitude, options.sunElevation};
    const sky::AirTable table(scattering, options.atmosphere, viewer);
    sky::HazeOptions through;
    through.shape = view.shape(), through.worldFromSun = worldFromSun, through.backdrop = &sky;
    sky::ConstantAir none;
    const image::Image seen = orDie(sky::haze(bare, depth, table, through));
    const double ev = autoExposure(meanLuminance(seen));
    const sky::AerialPerspective ways[] = {
        none, sky::constantAir(scattering, options.atmosphere, viewer), table,
        sky::ExactAir(scattering, options.atmosphere, viewer)};
    image::Image exact;
    std::vector<image::Image> pictures;
    for (std::size_t way = 0; way < std::size(ways); ++way) {
      pictures.push_back(orDie(sky::haze(bare, depth, ways[way], through)));
      sheet.rows[way].push_back(toned(pictures.back(), ev));
    }
    fmt::print("Sun at {:g} degrees; against the exact integral over what stands in the air:",
               elevation);
    for (std::size_t way = 0; way + 1 < pictures.size(); ++way) {
      double difference = 0, power = 0;
      for (std::size_t i = 0; i < depth.pixels.size(); ++i) {
        if (!std::isfinite(depth.pixels[i][0])) continue;
        difference += (pictures[way].pixels[i] - pictures.back().pixels[i]).square().sum();
        power += pictures.back().pixels[i].square().sum();
      }
      fmt::print(" {} {:.2f}%", sheet.rowLabels[way], 100 * std::sqrt(difference / power));
    }
    fmt::print("; EV {:.1f}\n", exposureValue(meanLuminance(seen)));
  }
  studio.save(compose(sheet), "sky-aerial");
}

void sky24Hours(const Studio& studio) {
  const int size = studio.pixels(124), text = 26;
  Sheet sheet;
  fmt::print("| time | Sun | luminance of the sky, cd/m² | EV |\n|---|---|---|---|\n");
  for (int hour = 0; hour < 24; ++hour) {
    if (hour % 6 == 0) sheet.rows.emplace_back();
    image::Image cell(size, size + text);
    std::fill(cell.pixels.begin(), cell.pixels.end(), Rgb::Ones().eval());
    sky::SkyRequest request;
    request.date = "2026-06-21", request.time = fmt::format("{:02}:00", hour);
    request.utcOffset = 2, request.latitude = 46, request.longitude = 6;
    const auto resolved = sky::resolve(request);
    std::string below = "night, below -18";
    if (resolved) {
      sky::SkyOptions options = resolved->value.options;
      options.cache = sky::cacheFolder();
      const sky::Sky sky = skyOf(options);
      const double luminance = sky::onHorizontal(sky).diffuse[1] / kPi;
      sky::SkyPictureOptions picture;
      picture.shape = {sky::PictureMap::Fisheye, size, size};
      picture.worldFromSun = resolved->value.worldFromSun, picture.sun = true;
      const image::ChannelImage drawn = orDie(sky::drawSky(sky, picture));
      image::Image colours(size, size);
      std::vector<float> alpha(colours.pixels.size(), 1);
      for (const auto& channel : drawn.channels)
        for (std::size_t i = 0; i < colours.pixels.size(); ++i) {
          if (channel.name == "R") colours.pixels[i][0] = channel.values[i];
          if (channel.name == "G") colours.pixels[i][1] = channel.values[i];
          if (channel.name == "B") colours.pixels[i][2] = channel.values[i];
          if (channel.name == "A") alpha[i] = channel.values[i];
        }
      const image::Image shown = toned(colours, autoExposure(luminance));
      for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
          const float a = alpha[std::size_t(y) * std::size_t(size) + std::size_t(x)];
          cell.at(x, y) = a * shown.at(x, y) + (1 - a) * Rgb::Ones();
        }
      const double sun = options.sunElevation / kDegree;
      below = fmt::format("Sun {:+.1f}, EV {:.1f}", sun, exposureValue(luminance));
      fmt::print("| {}:00 | {:+.1f}° | {:.3g} | {:.1f} |\n", hour, sun, luminance,
                 exposureValue(luminance));
    } else {
      for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
          const double r = std::hypot(x + .5 - size / 2., y + .5 - size / 2.) - size / 2.;
          cell.at(x, y) = Rgb::Constant(float(std::clamp(r + .5, .004, 1.0)));
        }
      fmt::print("| {}:00 | below −18° | | |\n", hour);
    }
    const std::string when = fmt::format("{:02}:00", hour);
    drawText(cell, (size - textWidth(when, 1)) / 2, size + 4, when, 1);
    drawText(cell, (size - textWidth(below, 1)) / 2, size + 15, below, 1);
    sheet.rows.back().push_back(std::move(cell));
  }
  studio.save(compose(sheet), "sky-24-hours");
}

}  // namespace lambent::figures
