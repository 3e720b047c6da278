// Meso-structure: shaders/rtt_look_up.glsl, rtt_response.glsl and patch_place.glsl against
// shade::respond and shade::patchPlace, for every way that numbers are stored.

#include <array>
#include <vector>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "lambent/shade/macro_transport.h"
#include "lambent/shade/patch_place.h"
#include "lambent/shade/rtt_lookup.h"
#include "tests/shaders/test_glsl.h"

#include "tests/shaders/glsl_begin.h"

#define LAMBENT_FILTER 1
#define LAMBENT_RELIEF 1
#define LAMBENT_ID_MAP 1
#define LAMBENT_LIGHT_PLACE int
#define LAMBENT_RTT_PLACE int
#define LAMBENT_INTERPOLATED 0
#define LAMBENT_GROUPS 7
#define LAMBENT_EACH_GROUP(DO) DO(0) DO(1) DO(2) DO(3) DO(4) DO(5) DO(6)

#define LAMBENT_NUMBERS 0
#define LAMBENT_RESPONSE \
  READ(0)                \
  ADD(0) READ(1) ADD(1) READ(2) ADD(2) READ(3) ADD(3) READ(4) ADD(4) READ(5) ADD(5) READ(6) ADD(6)
namespace lambent::glsl::floats {
#include "tests/shaders/meso_texts.h"
}
#undef LAMBENT_NUMBERS
#undef LAMBENT_RESPONSE

#define LAMBENT_NUMBERS 1
#define LAMBENT_RESPONSE \
  READ(0) ADD(0) ADD(1) READ(1) ADD(2) ADD(3) READ(2) ADD(4) ADD(5) READ(3) ADD(6)
namespace lambent::glsl::halves {
#include "tests/shaders/meso_texts.h"
}
#undef LAMBENT_NUMBERS
#undef LAMBENT_RESPONSE

#define LAMBENT_NUMBERS 2
#define LAMBENT_RESPONSE READ(0) ADD(0) ADD(1) ADD(2) ADD(3) READ(1) ADD(4) ADD(5) ADD(6)
namespace lambent::glsl::bytes {
#include "tests/shaders/meso_texts.h"
}

#include "tests/shaders/glsl_end.h"

namespace lambent::glsl {
namespace {

constexpr int kBands = 3, kViews = 4, kMany = 20'000;
constexpr int kStride = shade::rttStride(kBands);
static_assert(kStride == 4 * LAMBENT_GROUPS);

/// Levels of noise, none of which is the mean of another: a read of the wrong one shows. Numbers
/// are whole, from −127 to 127, divided by `scale`.
shade::RttPyramid anyPyramid(float scale) {
  math::Random random(1, 0);
  shade::RttPyramid pyramid;
  pyramid.views = kViews;
  pyramid.bands = kBands;
  for (int width = 13, height = 6;;
       width = std::max(1, width / 2), height = std::max(1, height / 2)) {
    shade::RttLevel& level = pyramid.levels.emplace_back();
    level.width = width;
    level.height = height;
    level.values.resize(std::size_t(width * height * kViews * kViews * kStride));
    for (std::size_t i = 0; i < level.values.size(); ++i)
      level.values[i] =
          i % kStride < 3 * kBands * kBands ? (float(random.below(255)) - 127.0f) / scale : 0.0f;
    for (int i = 0; i < width * height * kViews * kViews; ++i)
      level.heights.push_back(std::uint8_t(random.below(256)));
    if (width == 1 && height == 1) return pyramid;
  }
}

uint halfBits(float value) {  // of numbers that a half holds exactly, none of them tiny
  if (value == 0.0f) return 0;
  const uint bits = std::bit_cast<uint>(value);
  return (bits >> 16 & 0x8000) | ((bits >> 23 & 255) - 112) << 10 | (bits >> 13 & 1023);
}

/// As GlPatches and the page's RttTexture pack it.
std::vector<uvec4> packed(const shade::RttPyramid& pyramid, int numbers) {
  const int each = numbers == 0 ? 4 : numbers == 1 ? 8 : 16;  // numbers in a texel
  std::vector<uvec4> texels;
  for (const shade::RttLevel& level : pyramid.levels)
    for (std::size_t row = 0; row < level.values.size(); row += kStride)
      for (int first = 0; first < kStride; first += each) {
        uvec4& texel = texels.emplace_back();
        for (int i = 0; i < each && first + i < kStride; ++i) {
          const float value = level.values[row + std::size_t(first + i)];
          if (numbers == 0) texel[i] = std::bit_cast<uint>(value);
          if (numbers == 1) texel[i / 2] |= halfBits(value) << (16 * (i % 2));
          if (numbers == 2) texel[i / 4] |= uint(std::uint8_t(int(value))) << (8 * (i % 4));
        }
      }
  return texels;
}

/// Whether a place that is read at the first level, position for position, is on a border.
bool isOnABorder(const shade::RttPyramid& pyramid, const Vec2& q, const shade::RttProbes& probes) {
  if (probes.level >= 1.0f) return false;
  for (int i = 0; i < probes.count; ++i) {
    const Vec2 at = q + (float(i) - 0.5f * float(probes.count - 1)) * probes.step;
    const Vec2 cell =
        at.cwiseProduct(Vec2(float(pyramid.levels[0].width), float(pyramid.levels[0].height)));
    for (const float c : {cell.x(), cell.y()})
      if (std::abs(c - std::round(c)) < 1e-4f) return true;
  }
  return false;
}

/// The text's state, and what is called of it.
struct Text {
  vec4* incident;
  int *views, *levelCount;
  ivec4* levels;
  const uvec4** numbers;
  vec2* relief;
  const std::uint8_t** heights;
  void (*chooseViews)(vec3);
  vec3 (*nearest)(vec2);
  vec3 (*averaged)(vec2, mat3, vec3, float, vec3, vec3);
};

#define LAMBENT_TEXT(name)                                                                        \
  Text {                                                                                          \
    name::incident, &name::views, &name::levelCount, name::levels, &name::numbers, &name::relief, \
        &name::heights, name::chooseViews, name::nearest, name::averaged                          \
  }

void expectSame(const Text& text, int numbers, const Vec2& relief = Vec2::Zero()) {
  shade::RttPyramid pyramid = anyPyramid(numbers == 2 ? 1.0f : 128.0f);
  pyramid.relief = relief;
  *text.relief = from(relief);
  std::vector<std::uint8_t> heights;
  for (const shade::RttLevel& level : pyramid.levels)
    heights.insert(heights.end(), level.heights.begin(), level.heights.end());
  *text.heights = heights.data();
  const std::vector<uvec4> texels = packed(pyramid, numbers);
  *text.numbers = texels.data();
  *text.views = kViews;
  *text.levelCount = int(pyramid.levels.size());
  int first = 0;
  for (std::size_t k = 0; k < pyramid.levels.size(); ++k) {
    const shade::RttLevel& level = pyramid.levels[k];
    text.levels[k] = ivec4(level.width, level.height, first, 0);
    first += level.width * level.height;
  }
  const Vec2 positions(float(pyramid.levels[0].width), float(pyramid.levels[0].height));

  math::Random random(2, 0);
  std::array<int, 3> reads{};  // at the first level, between two, beyond the last
  int skipped = 0, onTheVerge = 0;
  for (int i = 0; i < kMany; ++i) {
    std::array<float, kStride> light{};
    const float scale = numbers == 2 ? 128.0f : 1.0f;
    for (int k = 0; k < 3 * kBands * kBands; ++k)
      light[std::size_t(k)] = between(random, -1, 1) / scale;
    for (int k = 0; k < kStride; ++k) text.incident[k / 4][k % 4] = light[std::size_t(k)];
    const Vec3 toViewer = anyDirection(random);  // at times below the horizon
    const shade::RttViews views = shade::viewsAround(kViews, toViewer);
    const shade::RttViews corrected = shade::viewsAround(kViews, toViewer, relief);
    text.chooseViews(from(toViewer));
    const Vec2 q = random.uniform2();

    const Mat3 frame = shade::worldFromPatch(anyDirection(random), anyDirection(random));
    const float width = std::exp2(between(random, -8, 0));
    const shade::PatchGradient gradient{anyDirection(random), anyDirection(random)};
    const shade::FootprintAxes axes = shade::footprintAxes(frame, toViewer, width);
    const shade::RttProbes probes = shade::probesOf(
        Vec2(gradient.x.dot(axes.longer), gradient.y.dot(axes.longer)),
        Vec2(gradient.x.dot(axes.shorter), gradient.y.dot(axes.shorter)), positions);
    if (isOnABorder(pyramid, q, probes) || isOnABorder(pyramid, q, {})) {
      ++skipped;
      continue;
    }
    ++reads[probes.level == 0 ? 0 : probes.level < float(pyramid.levels.size() - 1) ? 1 : 2];
    ASSERT_LT(apart(text.nearest(from(q)), shade::respond(pyramid, q, {}, views, light.data())),
              3e-6f);
    const float off = apart(text.averaged(from(q), from(frame), from(toViewer), width,
                                          from(gradient.x), from(gradient.y)),
                            shade::respond(pyramid, q, probes, corrected, light.data()));
    // A search may end on the other side of a position's border.
    if (relief != Vec2::Zero() && !(off < 1e-5f))
      ++onTheVerge;
    else
      ASSERT_LT(off, 1e-5f) << probes.count << " reads at level " << probes.level;
  }
  EXPECT_LT(skipped, kMany / 50);
  EXPECT_LT(onTheVerge, kMany / 200);
  for (const int each : reads) EXPECT_GT(each, kMany / 50);
}

TEST(RttLookUp, IsTheLibrarysForFloats) {
  expectSame(LAMBENT_TEXT(floats), 0);
}
TEST(RttLookUp, IsTheLibrarysForViewsThatAreCorrected) {
  expectSame(LAMBENT_TEXT(floats), 0, Vec2(0.4f, 0.25f));
}
TEST(RttLookUp, IsTheLibrarysForHalves) {
  expectSame(LAMBENT_TEXT(halves), 1);
}
TEST(RttLookUp, IsTheLibrarysForBytes) {
  expectSame(LAMBENT_TEXT(bytes), 2);
}

TEST(PatchPlace, IsTheLibrarys) {
  math::Random random(3, 0);
  const transfer::Tiles tiles{Vec2(7.5f, 3.25f)};
  transfer::IdMap map{17, 5, {}};
  for (std::size_t i = 0; i < 2 * map.texelCount(); ++i)
    map.ids.push_back(std::uint16_t(random.below(65536)));
  transfer::Patch tiled, mapped;
  tiled.place = tiles;
  mapped.place = map;
  floats::idMap = &map;
  for (int i = 0; i < kMany; ++i) {
    const Vec2 uv(between(random, -0.5f, 1.5f), between(random, -0.5f, 1.5f));
    ASSERT_EQ(apart(floats::mappedPlace(from(uv)), shade::patchPlace(mapped, uv)), 0.0f);
    ASSERT_EQ(apart(floats::tiledPlace(from(tiles.tiles), from(uv)), shade::patchPlace(tiled, uv)),
              0.0f);
  }
}

// Pieces of a patch that jump, over texels between which places go on.
TEST(PatchPlaces, AreTheLibrarys) {
  math::Random random(4, 0);
  const Vec2 alongX(0.013f, -0.004f), alongY(0.006f, 0.011f);
  transfer::IdMap map{19, 23, {}};
  for (int y = 0; y < map.height; ++y)
    for (int x = 0; x < map.width; ++x) {
      const Vec2 q =
          float(x) * alongX + float(y) * alongY + Vec2::Constant(x + y > 20 ? 0.4f : 0.9f);
      for (int c = 0; c < 2; ++c)
        map.ids.push_back(std::uint16_t(int((q[c] - std::floor(q[c])) * 65536.0f) & 0xffff));
    }
  transfer::Patch mapped;
  mapped.place = map;
  floats::idMap = &map;
  // Steps along two axes of the world, and the gradient that gives what the map has.
  const scene::UvSteps steps{Vec3(2, 0, 0), Vec3(0, 3, 0)};
  const shade::PatchGradient gradient{
      Vec3(alongX.x() * float(map.width) / 2, alongY.x() * float(map.height) / 3, 0),
      Vec3(alongX.y() * float(map.width) / 2, alongY.y() * float(map.height) / 3, 0)};
  std::array<int, 5> counts{};
  for (int i = 0; i < kMany; ++i) {
    const Vec2 uv(between(random, -0.1f, 1.1f), between(random, -0.1f, 1.1f));
    const shade::PatchPlaces expected = shade::patchPlaces(mapped, uv, steps, gradient);
    const floats::Places found = floats::mappedPlaces(from(uv), from(alongX), from(alongY));
    ASSERT_EQ(found.count, expected.count);
    ++counts[std::size_t(expected.count)];
    for (int k = 0; k < found.count; ++k) {
      ASSERT_LT(apart(found.q[k], expected.q[std::size_t(k)]), 1e-5f);
      ASSERT_NEAR(found.share[k], expected.share[std::size_t(k)], 1e-5f);
    }
  }
  EXPECT_GT(counts[1], kMany / 2);
  EXPECT_GT(counts[2], kMany / 50);
}

// Two pieces that meet between two columns of texels: a line as wide as it should be, whatever the
// size of a pixel.
TEST(Seams, LieWhereThePatchJumps) {
  constexpr int kBefore = 9;  // texels left of the seam
  const Vec2 alongX(0.013f, -0.004f), alongY(0.006f, 0.011f);
  transfer::IdMap map{19, 23, {}};
  for (int y = 0; y < map.height; ++y)
    for (int x = 0; x < map.width; ++x) {
      const Vec2 q =
          float(x) * alongX + float(y) * alongY + Vec2::Constant(x < kBefore ? 0.4f : 0.7f);
      for (int c = 0; c < 2; ++c)
        map.ids.push_back(std::uint16_t(int((q[c] - std::floor(q[c])) * 65536.0f) & 0xffff));
    }
  floats::idMap = &map;
  math::Random random(5, 0);
  for (const float pixel : {0.02f, 0.3f, 0.66f, 1.0f, 2.0f}) {  // texels
    const Vec2 right(pixel / float(map.width), 0), up(0, pixel / float(map.height));
    int seen = 0;
    for (int i = 0; i < kMany; ++i) {
      const float off = between(random, -5, 5);
      const Vec2 uv((float(kBefore) + off) / float(map.width), between(random, 0.2f, 0.8f));
      const float reach = floats::kSeamReach * pixel;
      if (std::abs(std::abs(off) - reach) < 1e-3f) continue;
      const bool near = floats::nearSeam(from(uv), from(alongX), from(alongY), from(right),
                                         from(up), floats::kSeamReach);
      ASSERT_EQ(near, std::abs(off) < reach) << off << " texels off, " << pixel << " a pixel";
      seen += near;
    }
    if (pixel > 0.1f) {
      EXPECT_GT(seen, kMany / 50);
    }
  }
}

}  // namespace
}  // namespace lambent::glsl
