// Patches by formula: the meso-structures of sloan2003biscale, Figures 4-6. All repeat themselves
// exactly. A period that is not square stretches the pattern; lengths "in periods" are along x.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lambent/meso/height_field.h"
#include "lambent/meso/patch.h"

namespace lambent::meso {

/// A plain weave of interleaved, deformed cylinders: threads along y (warp) and along x (weft) go
/// over and under each other in turn, with gaps through which the backing is seen.
struct WeaveOptions {
  Vec2 size = Vec2(0.1f, 0.1f);  ///< metres: the period
  int threads = 2;               ///< along each axis in a period, even, ≥ 2
  float width = 0.84f;           ///< of a thread, in spacings of threads: above 1 the gaps close
  float height = 0.29f;          ///< of a thread, in spacings
  int plies = 3;                 ///< strands that a thread is twisted from; 0: smooth
  float plyDepth = 0.07f;        ///< of the grooves between strands, in radii
  float turns = 1.5f;            ///< of the twist over a spacing (rounded so that it repeats)
  Rgb warp = Rgb(0.62f, 0.17f, 0.10f);
  Rgb weft = Rgb(0.72f, 0.56f, 0.32f);
  Rgb backing = Rgb(0.06f, 0.05f, 0.05f);
  Rgb glossy = Rgb::Zero();     ///< of the threads
  float lobeExponent = 12.0f;   ///< of their gloss
  int around = 40, along = 64;  ///< facets around a thread, and along a spacing
};
Patch weave(const WeaveOptions& options = {});

/// A plate with round holes in staggered rows.
struct HolesOptions {
  Vec2 size = Vec2(0.1f, 0.1f);  ///< metres: the period, two holes
  float radius = 0.26f;          ///< of a hole, in periods
  float depth = 0.16f;           ///< in periods
  float wall = 0.03f;            ///< how wide the slope of the rim is, in periods
  Rgb plate = Rgb(0.62f, 0.60f, 0.56f);
  Rgb floor = Rgb(0.45f, 0.10f, 0.07f);
  int resolution = 192;  ///< samples a side
};
Patch holes(const HolesOptions& options = {});

/// A tray of square compartments between rounded walls.
struct BinOptions {
  Vec2 size = Vec2(0.1f, 0.1f);  ///< metres: the period
  int compartments = 2;          ///< a side, ≥ 1
  float wall = 0.22f;            ///< width of a wall, in compartments
  float corner = 0.18f;          ///< radius of a compartment's corners, in compartments
  float depth = 0.36f;           ///< in compartments
  Rgb walls = Rgb(0.58f, 0.44f, 0.27f);
  Rgb floor = Rgb(0.32f, 0.38f, 0.46f);
  int resolution = 192;  ///< samples a side
};
Patch bin(const BinOptions& options = {});

/// Embossed flowers: one in the middle of the period, a smaller one at its corners.
struct FlowerOptions {
  Vec2 size = Vec2(0.1f, 0.1f);  ///< metres: the period
  int petals = 6;                ///< ≥ 3
  float radius = 0.42f;          ///< of the larger flower, in periods
  float depth = 0.08f;           ///< in periods
  Rgb petal = Rgb(0.74f, 0.70f, 0.62f);
  Rgb heart = Rgb(0.72f, 0.52f, 0.18f);
  Rgb ground = Rgb(0.42f, 0.47f, 0.42f);
  int resolution = 192;  ///< samples a side
};
Patch flower(const FlowerOptions& options = {});

/// Thrown stucco: dabs of many sizes in random places, over a grain (a 2D random process that
/// repeats itself).
struct StuccoOptions {
  Vec2 size = Vec2(0.1f, 0.1f);  ///< metres: the period
  int dabs = 120;                ///< in a period
  float radius = 0.085f;         ///< of the largest dab, in periods
  float depth = 0.07f;           ///< from the lowest to the highest point, in periods
  Rgb color = Rgb(0.74f, 0.70f, 0.62f);
  std::uint64_t seed = 0;
  int resolution = 256;  ///< samples a side
};
Patch stucco(const StuccoOptions& options = {});

/// Trowelled plaster: shallow strokes, ridges where they end, and grain.
struct PlasterOptions {
  Vec2 size = Vec2(0.1f, 0.1f);  ///< metres: the period
  int strokes = 36;              ///< in a period
  float depth = 0.05f;           ///< from the lowest to the highest point, in periods
  Rgb color = Rgb(0.72f, 0.66f, 0.58f);
  std::uint64_t seed = 0;
  int resolution = 256;  ///< samples a side
};
Patch plaster(const PlasterOptions& options = {});

/// "weave", "holes", "bin", "flower", "stucco", "plaster".
std::vector<std::string_view> generatorNames();
/// The patch of that name with its defaults, but for the period and the seed of random processes.
/// None if there is no such generator.
std::optional<Patch> generate(std::string_view name, const Vec2& size, std::uint64_t seed = 0);

}  // namespace lambent::meso
