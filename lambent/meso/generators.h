// Patches by formula: the meso-structures of sloan2003biscale, Figures 4-6, and more. All repeat
// themselves exactly. A period that is not square stretches the pattern; lengths "in periods" are along x.
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

/// Stockinette, the plain knit: courses of yarn along x, whose loops each come through one of the
/// course below from behind, so that their legs make columns of Vs. Seen from its right side;
/// through the gaps between yarns shows the backing.
struct KnitOptions {
  Vec2 size = Vec2(0.1f, 0.1f);  ///< metres: the period
  int stitches = 3;              ///< side by side in a period, ≥ 1
  int courses = 4;               ///< above each other in a period, ≥ 1
  float yarn = 0.27f;            ///< its diameter, in widths of a stitch: it touches from 0.25 on
  int plies = 3;                 ///< strands that the yarn is twisted from; 0: smooth
  float plyDepth = 0.10f;        ///< of the grooves between strands, in radii
  float turns = 6.0f;            ///< of the strands past each other over a stitch (rounded)
  Rgb color = Rgb(0.52f, 0.20f, 0.24f);
  Rgb backing = Rgb(0.06f, 0.04f, 0.04f);
  Rgb glossy = Rgb::Zero();
  float lobeExponent = 12.0f;   ///< of its gloss
  int around = 24, along = 96;  ///< facets around the yarn, and along a stitch
};
Patch knit(const KnitOptions& options = {});

/// Bricks in running bond with rounded edges: every other course is moved by half a brick.
struct BrickOptions {
  Vec2 size = Vec2(0.1f, 0.1f);  ///< metres: the period
  int courses = 4;               ///< in a period, even, ≥ 2
  int bricks = 2;                ///< of a course in a period, ≥ 1
  float joint = 0.14f;           ///< width of the mortar, in courses
  float rounding = 0.12f;        ///< radius of edges and corners, in courses
  float depth = 0.16f;           ///< in courses
  Rgb brick = Rgb(0.50f, 0.19f, 0.12f);
  Rgb mortar = Rgb(0.56f, 0.53f, 0.48f);
  int resolution = 192;  ///< samples a side
};
Patch bricks(const BrickOptions& options = {});

/// Scales as a fish's, that lie over each other like tiles; their tips point towards −y.
struct ScaleOptions {
  Vec2 size = Vec2(0.1f, 0.1f);  ///< metres: the period
  int rows = 4;                  ///< in a period, even, ≥ 2
  int across = 3;                ///< scales of a row in a period, ≥ 1
  float depth = 0.3f;            ///< in rows
  Rgb tip = Rgb(0.30f, 0.52f, 0.46f);
  Rgb root = Rgb(0.10f, 0.20f, 0.24f);
  int resolution = 192;  ///< samples a side
};
Patch scales(const ScaleOptions& options = {});

/// Round pebbles close to each other on the ground, no two alike.
struct PebbleOptions {
  Vec2 size = Vec2(0.1f, 0.1f);          ///< metres: the period
  int count = 20;                        ///< in a period, ≥ 1
  float gap = 0.14f;                     ///< between neighbours; in pebbles, as all that follows
  float depth = 0.30f;                   ///< of the highest
  Rgb light = Rgb(0.72f, 0.68f, 0.62f);  ///< pebbles lie between the two
  Rgb dark = Rgb(0.40f, 0.37f, 0.35f);
  Rgb ground = Rgb(0.12f, 0.09f, 0.07f);
  std::uint64_t seed = 0;
  int resolution = 256;  ///< samples a side
};
Patch pebbles(const PebbleOptions& options = {});

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

/// "weave", "knit", "holes", "bin", "bricks", "scales", "pebbles", "flower", "stucco", "plaster".
std::vector<std::string_view> generatorNames();
/// The patch of that name with its defaults, but for the period and the seed of random processes.
/// None if there is no such generator.
std::optional<Patch> generate(std::string_view name, const Vec2& size, std::uint64_t seed = 0);

}  // namespace lambent::meso
