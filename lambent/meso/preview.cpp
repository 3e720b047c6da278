// This work is based on:
// - sloan2003biscale: §5, "Accessing the RTT": nearest position, bilinear interpolation over views;
//   Figure 4, the patch on a square from two sides.
#include "lambent/meso/preview.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <vector>

#include <Eigen/Geometry>

#include "lambent/math/directions.h"
#include "lambent/sh/zonal.h"

namespace lambent::meso {

Rgb exitRadiance(const transfer::SimulatedRtt& rtt, const Vec2& q, const Vec3& view,
                 const sh::RgbCoefficients& light) {
  assert(light.bands == rtt.bands);
  const auto wrap = [](float t, int count) {
    return std::min(static_cast<int>((t - std::floor(t)) * static_cast<float>(count)), count - 1);
  };
  const int x = wrap(q.x(), rtt.width), y = wrap(q.y(), rtt.height);
  const Vec2 square = math::squareFromHemisphere(view) * static_cast<float>(rtt.views);
  const auto most = static_cast<float>(rtt.views - 1);
  const float u = std::clamp(square.x() - 0.5f, 0.0f, most);
  const float v = std::clamp(square.y() - 0.5f, 0.0f, most);
  const int u0 = static_cast<int>(u), v0 = static_cast<int>(v);
  const int u1 = std::min(u0 + 1, rtt.views - 1), v1 = std::min(v0 + 1, rtt.views - 1);
  const float s = u - static_cast<float>(u0), t = v - static_cast<float>(v0);
  struct Tap {
    int x, y;
    float weight;
  };
  Rgb sum = Rgb::Zero();
  for (const Tap& tap : {Tap{u0, v0, (1 - s) * (1 - t)}, Tap{u1, v0, s * (1 - t)},
                         Tap{u0, v1, (1 - s) * t}, Tap{u1, v1, s * t}}) {
    if (tap.weight == 0.0f) continue;
    for (int i = 0; i < sh::coefficientCount(rtt.bands); ++i) {
      const float* b = rtt.values.data() + rtt.index(i, x, y, tap.x, tap.y);
      for (int c = 0; c < 3; ++c) sum[c] += tap.weight * b[c] * light.channel(c)[i];
    }
  }
  return sum;
}

sh::RgbCoefficients discLight(int bands, const Vec3& towards, double halfAngle) {
  sh::RgbCoefficients light(bands);
  // A surface that faces the disc gets radiance · π sin²(half-angle).
  const double radiance = 1.0 / std::pow(std::sin(halfAngle), 2);
  std::vector<float> values(static_cast<std::size_t>(sh::coefficientCount(bands)));
  sh::turnTo(sh::cap(bands, halfAngle), towards, std::span<float>(values));
  for (int c = 0; c < 3; ++c)
    for (std::size_t i = 0; i < values.size(); ++i)
      light.channel(c)[i] = static_cast<float>(radiance) * values[i];
  return light;
}

image::Image pictureOf(const transfer::SimulatedRtt& rtt, const sh::RgbCoefficients& light,
                       const SquarePicture& options) {
  image::Image picture(options.pixels, options.pixels);
  const Vec3& view = options.view;
  // Upright is away from the surface as seen from the side, +y as seen from above.
  const Vec3 upright = view.z() > 0.999f ? Vec3::UnitY() : Vec3::UnitZ();
  const Vec3 right = upright.cross(view).normalized(), up = view.cross(right);
  // The square is drawn as large as fits.
  const float across = std::abs(right.x()) + std::abs(right.y());
  const float high = std::abs(up.x()) + std::abs(up.y());
  const float scale = std::max(across, high);
  const int n = options.samples;
  for (int y = 0; y < options.pixels; ++y)
    for (int x = 0; x < options.pixels; ++x) {
      Rgb sum = Rgb::Zero();
      for (int k = 0; k < n * n; ++k) {
        const float sx = (x + (k % n + 0.5f) / n) / options.pixels - 0.5f;
        const float sy = 0.5f - (y + (k / n + 0.5f) / n) / options.pixels;
        // The ray through this place of the picture meets z = 0 at q.
        const Vec3 p = scale * (sx * right + sy * up);
        const Vec3 q = p - p.z() / view.z() * view;
        if (std::abs(q.x()) > 0.5f || std::abs(q.y()) > 0.5f) continue;
        const Vec2 aspect(1.0f, rtt.size.x() / rtt.size.y());
        sum += exitRadiance(rtt, options.periods * q.head<2>().cwiseProduct(aspect), view, light);
      }
      picture.at(x, y) = sum / static_cast<float>(n * n);
    }
  return picture;
}

image::Image preview(const transfer::SimulatedRtt& rtt, int pixels) {
  constexpr int kGap = 4;
  const std::array<Vec3, 2> eyes = {Vec3(0, 0, 1), Vec3(0.2f, -0.72f, 0.66f).normalized()};
  const std::array<sh::RgbCoefficients, 3> lights = {
      discLight(rtt.bands, Vec3(-0.6f, 0.5f, 0.62f).normalized(), 0.35),
      discLight(rtt.bands, Vec3(0.85f, 0.1f, 0.5f).normalized(), 0.35),
      discLight(rtt.bands, Vec3(0, 0, 1), 0.5 * kPi)};
  image::Image sheet(3 * pixels + 2 * kGap, 2 * pixels + kGap);
  SquarePicture options;
  options.pixels = pixels;
  for (std::size_t row = 0; row < eyes.size(); ++row)
    for (std::size_t column = 0; column < lights.size(); ++column) {
      options.view = eyes[row];
      const image::Image picture = pictureOf(rtt, lights[column], options);
      for (int y = 0; y < pixels; ++y)
        for (int x = 0; x < pixels; ++x)
          sheet.at(static_cast<int>(column) * (pixels + kGap) + x,
                   static_cast<int>(row) * (pixels + kGap) + y) = picture.at(x, y).max(0.0f);
    }
  return sheet;
}

}  // namespace lambent::meso
