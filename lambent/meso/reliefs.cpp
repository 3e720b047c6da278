// Height fields by formula: holes, bin, flower.
//
// This work is based on:
// - sloan2003biscale: §4.2 and Figure 5, where images of "holes" and "bin" were painted by hand.
#include <algorithm>
#include <cassert>
#include <cmath>

#include "lambent/meso/generators.h"
#include "lambent/meso/profile.h"
#include "lambent/meso/relief.h"

namespace lambent::meso {

Patch relief(const char* name, const Vec2& size, int resolution,
             const std::function<Relief(double x, double y)>& at) {
  assert(resolution >= 2);
  HeightField field;
  field.width = field.height = resolution;
  for (int y = 0; y < resolution; ++y)
    for (int x = 0; x < resolution; ++x) {
      const Relief r = at((x + 0.5) / resolution, (y + 0.5) / resolution);
      field.heights.push_back(static_cast<float>(r.height * double(size.x())));
      field.colors.push_back(r.color);
    }
  scene::Material material;
  material.name = name;
  material.diffuse = Rgb::Ones();  // the samples have the colour
  return patchOf(field, size, material, name);
}

Patch holes(const HolesOptions& options) {
  return relief("holes", options.size, options.resolution, [&](double x, double y) -> Relief {
    const double middle = std::hypot(x - 0.5, y - 0.5);
    const double corner = std::hypot(fromWhole(x), fromWhole(y));
    const double r = std::min(middle, corner);
    // A steep wall with a rounded lip above it.
    const double wall = smooth(options.radius - options.wall, options.radius, r);
    const double lip = smooth(options.radius, options.radius + 1.5 * options.wall, r);
    return {options.depth * (-1.0 + 0.92 * wall + 0.08 * lip),
            mixed(options.floor, options.plate, smooth(0.0, 0.35, wall))};
  });
}

Patch bin(const BinOptions& options) {
  assert(options.compartments >= 1);
  return relief("bin", options.size, options.resolution, [&](double x, double y) -> Relief {
    // Signed distance to a square with round corners in the middle of each cell.
    const double n = options.compartments;
    const double half = 0.5 * (1.0 - options.wall) - options.corner;
    const double dx = std::abs(fromWhole(x * n - 0.5)) - half;
    const double dy = std::abs(fromWhole(y * n - 0.5)) - half;
    const double outside = std::hypot(std::max(dx, 0.0), std::max(dy, 0.0)) +
                           std::min(std::max(dx, dy), 0.0) - options.corner;
    const double slope = 0.12 * options.wall;
    const double wall = smooth(-slope, slope, outside);
    // The wall's back is a half round, the floor a shallow dish.
    const double ridge = std::clamp(outside / (0.5 * options.wall), 0.0, 1.0);
    const double back = 0.16 * std::sqrt(1.0 - std::pow(1.0 - ridge, 2));
    const double dish = 0.05 * smooth(-half - options.corner, 0.0, outside);
    return {options.depth / n * (-1.0 + 0.79 * wall + back + dish * (1.0 - wall)),
            mixed(options.floor, options.walls, smooth(0.05, 0.4, wall))};
  });
}

Patch flower(const FlowerOptions& options) {
  assert(options.petals >= 3);
  /// The height (0 … 1) of one flower of unit radius, and how much of it is heart.
  struct Bloom {
    double height, heart;
  };
  const auto bloom = [&](double x, double y, double turn) -> Bloom {
    const double r = std::hypot(x, y), angle = std::atan2(y, x) + turn;
    const double within = std::abs(fromWhole(angle / (2.0 * kPi) * options.petals)) * 2.0;  // 0 … 1
    const double reach = 0.55 + 0.45 * std::sqrt(1.0 - within * within);
    const double rim = 1.0 - smooth(0.8 * reach, reach, r);
    const double furrow = 1.0 - 0.5 * std::pow(within, 6);
    const double vein = 1.0 - 0.12 * std::exp(-std::pow(within / 0.07, 2)) * smooth(0.2, 0.4, r);
    const double cup = 0.45 + 0.55 * smooth(0.15, 0.75, r);
    const double petal = rim * furrow * vein * cup;
    const double heart = 1.0 - smooth(0.20, 0.25, r);
    const double knob = 0.55 + 0.45 * std::sqrt(std::max(0.0, 1.0 - std::pow(r / 0.25, 2)));
    return {std::max(petal, heart * knob), heart};
  };
  return relief("flower", options.size, options.resolution, [&](double x, double y) -> Relief {
    const double large = options.radius, little = 0.55 * options.radius;
    const Bloom a = bloom((x - 0.5) / large, (y - 0.5) / large, 0.0);
    const Bloom b = bloom(fromWhole(x) / little, fromWhole(y) / little, kPi / options.petals);
    const double height = std::max(a.height, 0.6 * b.height);
    const Rgb color = mixed(mixed(options.ground, options.petal, smooth(0.02, 0.18, height)),
                            options.heart, std::max(a.heart, b.heart));
    return {options.depth * height, color};
  });
}

std::vector<std::string_view> generatorNames() {
  return {"weave",  "knit",    "holes",  "bin",    "bricks",
          "scales", "pebbles", "flower", "stucco", "plaster"};
}

std::optional<Patch> generate(std::string_view name, const Vec2& size, std::uint64_t seed) {
  const auto sized = [&](auto options) {
    options.size = size;
    return options;
  };
  const auto seeded = [&](auto options) {
    options.size = size, options.seed = seed;
    return options;
  };
  if (name == "weave") return weave(sized(WeaveOptions{}));
  if (name == "knit") return knit(sized(KnitOptions{}));
  if (name == "holes") return holes(sized(HolesOptions{}));
  if (name == "bin") return bin(sized(BinOptions{}));
  if (name == "bricks") return bricks(sized(BrickOptions{}));
  if (name == "scales") return scales(sized(ScaleOptions{}));
  if (name == "pebbles") return pebbles(seeded(PebbleOptions{}));
  if (name == "flower") return flower(sized(FlowerOptions{}));
  if (name == "stucco") return stucco(seeded(StuccoOptions{}));
  if (name == "plaster") return plaster(seeded(PlasterOptions{}));
  return std::nullopt;
}

}  // namespace lambent::meso
