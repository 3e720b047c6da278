// The pyramid over a patch's positions, the reads that a footprint asks for, and the products of
// bytes.

#include <cmath>

#include <gtest/gtest.h>

#include "lambent/math/directions.h"
#include "lambent/shade/dispatch.h"
#include "lambent/shade/patch_place.h"
#include "lambent/shade/rtt_footprint.h"
#include "lambent/shade/rtt_lookup.h"
#include "lambent/shade/test_patches.h"
#include "lambent/shade/transfer_matrices.h"

namespace lambent::shade {
namespace {

double meanOf(const RttLevel& level, std::size_t perPosition, std::size_t number) {
  double sum = 0;
  const std::size_t positions = std::size_t(level.width) * level.height;
  for (std::size_t p = 0; p < positions; ++p) sum += level.values[p * perPosition + number];
  return sum / double(positions);
}

TEST(RttPyramid, FirstLevelIsTheTexture) {
  const transfer::SimulatedRtt rtt = test::bumpyRtt(5, 3, 3, 3);
  const RttPyramid pyramid = makePyramid(rtt, 1);
  ASSERT_EQ(pyramid.levels.size(), 1u);
  EXPECT_EQ(pyramid.stride(), 28);
  for (int i = 0; i < 9; ++i)
    for (int y = 0; y < 3; ++y)
      for (int x = 0; x < 5; ++x)
        for (int v = 0; v < 9; ++v)
          for (int c = 0; c < 3; ++c)
            ASSERT_EQ(pyramid.at(0, x, y)[v * 28 + 3 * i + c],
                      rtt.values[rtt.index(i, x, y, v % 3, v / 3) + std::size_t(c)]);
}

TEST(RttPyramid, EveryLevelHasTheTexturesMean) {
  for (const auto& [width, height] : {std::pair{16, 16}, {13, 7}, {1, 9}, {12, 5}}) {
    const RttPyramid pyramid = makePyramid(test::bumpyRtt(width, height, 2, 2));
    const std::size_t perPosition = pyramid.viewCount() * pyramid.stride();
    EXPECT_EQ(pyramid.levels.back().width, 1);
    EXPECT_EQ(pyramid.levels.back().height, 1);
    for (const RttLevel& level : pyramid.levels)
      for (std::size_t n = 0; n < perPosition; ++n)
        ASSERT_NEAR(meanOf(level, perPosition, n), meanOf(pyramid.levels[0], perPosition, n), 2e-6)
            << width << "×" << height << " at " << level.width;
  }
}

// The patch goes on beyond its border: moved by two positions, the next level moves by one.
TEST(RttPyramid, IsPeriodic) {
  const transfer::SimulatedRtt rtt = test::bumpyRtt(8, 8, 1, 2);
  transfer::SimulatedRtt moved = rtt;
  for (int i = 0; i < 4; ++i)
    for (int y = 0; y < 8; ++y)
      for (int x = 0; x < 8; ++x)
        for (std::size_t c = 0; c < 3; ++c)
          moved.values[moved.index(i, (x + 6) % 8, (y + 2) % 8, 0, 0) + c] =
              rtt.values[rtt.index(i, x, y, 0, 0) + c];
  const RttPyramid a = makePyramid(rtt), b = makePyramid(moved);
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 4; ++x)
      for (int n = 0; n < a.stride(); ++n)
        ASSERT_FLOAT_EQ(b.at(1, (x + 3) % 4, (y + 1) % 4)[n], a.at(1, x, y)[n]);
}

Rgb read(const RttPyramid& pyramid, const Vec2& q, float level) {
  const std::vector<float> light(std::size_t(pyramid.stride()), 3.5449077f);
  RttProbes probes;
  probes.level = level;
  return respond(pyramid, q, probes, viewsAround(pyramid.views, Vec3::UnitZ()), light.data());
}

TEST(RttLookup, IsNearestOnTheFirstLevelAndSmoothAcrossTheBorderOnOthers) {
  const RttPyramid pyramid = makePyramid(test::paintedRtt(
      8, 4, 1, [](int x, int y, int, int) { return Rgb(float(x * x), float(y), 1.0f); }));
  EXPECT_NEAR(read(pyramid, Vec2(0.999f, 0.26f), 0.0f)[0], 49.0f, 1e-4f);
  EXPECT_NEAR(read(pyramid, Vec2(0.999f, 0.26f), 0.0f)[1], 1.0f, 1e-5f);
  EXPECT_NEAR(read(pyramid, Vec2(0.0f, 0.0f), 0.0f)[0], 0.0f, 1e-5f);
  // On level 1 the columns are ½, 6½, 20½, 42½ in red; at q = 0 the last and the first meet.
  EXPECT_NEAR(read(pyramid, Vec2(0.125f, 0.3f), 1.0f)[0], 0.5f, 1e-4f);
  EXPECT_NEAR(read(pyramid, Vec2(0.0f, 0.3f), 1.0f)[0], 21.5f, 1e-4f);
  EXPECT_NEAR(read(pyramid, Vec2(0.99999f, 0.3f), 1.0f)[0], 21.5f, 1e-2f);
  // Between levels their mix; beyond the last the last.
  EXPECT_NEAR(read(pyramid, Vec2(0.125f, 0.3f), 0.25f)[0], 0.75f * 1.0f + 0.25f * 0.5f, 1e-4f);
  EXPECT_NEAR(read(pyramid, Vec2(0.1f, 0.3f), 17.0f)[0], 17.5f, 1e-4f);
}

TEST(RttLookup, MixesTheFourViewsAround) {
  for (const int views : {1, 2, 7, 8})
    for (const Vec3& d : {Vec3(0, 0, 1), Vec3(0.3f, -0.4f, 0.5f), Vec3(-1, 0.01f, 0.0f)}) {
      const RttViews around = viewsAround(views, d.normalized());
      float sum = 0;
      for (int v = 0; v < 4; ++v) {
        EXPECT_GE(around.weight[v], 0.0f);
        EXPECT_LT(around.index[v], views * views);
        sum += around.weight[v];
      }
      EXPECT_NEAR(sum, 1.0f, 1e-6f);
    }
  // Straight above: the middle one of 7×7.
  const RttViews middle = viewsAround(7, Vec3::UnitZ());
  for (int v = 0; v < 4; ++v) EXPECT_TRUE(middle.weight[v] < 1e-5f || middle.index[v] == 24) << v;
}

const Vec3 kViewers[] = {Vec3(0, 0, 1), Vec3(0.3f, -0.4f, 0.5f), Vec3(-0.7f, 0.5f, 0.4f),
                         Vec3(0.2f, 0.9f, 0.3f)};

/// What a point of a pattern over a plane looks like, and its relief as views of it see it.
double pattern(const Vec2& q) {
  const double turn = 2 * kPi;
  return 1 + 0.5 * std::sin(turn * (2 * q.x() + q.y())) +
         0.3 * std::cos(turn * (q.x() - 3 * q.y()));
}

Vec2 slopeOf(const Vec3& v) {
  return v.head<2>() / v.z();
}

/// A level plane so far above the middle, depths of a patch that is 0.4 by 0.2 of its periods deep.
transfer::SimulatedRtt planeAt(std::uint8_t height) {
  const int side = 64, views = 5;
  const Vec2 relief(0.4f, 0.2f);
  const Vec2 above = (float(height) / 255.0f - 0.5f) * relief;
  transfer::SimulatedRtt rtt =
      test::paintedRtt(side, side, views, [&](int x, int y, int vx, int vy) {
        const Vec3 v = math::hemisphereFromSquare(
            Vec2((float(vx) + 0.5f) / views, (float(vy) + 0.5f) / views));
        const Vec2 q((float(x) + 0.5f) / side, (float(y) + 0.5f) / side);
        return Rgb(Rgb::Constant(float(pattern(q + above.cwiseProduct(slopeOf(v))))));
      });
  rtt.depth = 0.02f;
  rtt.size = Vec2(0.05f, 0.1f);
  rtt.heights.assign(rtt.positionCount() * rtt.viewCount(), height);
  return rtt;
}

float closelySeen(const RttPyramid& pyramid, const Vec2& q, const Vec3& toViewer, bool corrected) {
  const std::vector<float> light(std::size_t(pyramid.stride()), 3.5449077f);
  RttProbes probes;
  probes.between = 1.0f;
  const RttViews views = viewsAround(pyramid.views, toViewer.normalized(),
                                     corrected ? pyramid.relief : Vec2(Vec2::Zero()));
  return respond(pyramid, q, probes, views, light.data())[0];
}

TEST(RttParallax, APlaneIsShiftedByItsHeight) {
  for (const int height : {0, 70, 255}) {
    const RttPyramid pyramid = makePyramid(planeAt(std::uint8_t(height)));
    double before = 0.0;
    for (const Vec3& viewer : kViewers)
      for (int i = 0; i < 40; ++i) {
        const Vec2 q(float(i) / 40, float(i * 7 % 40) / 40);
        const Vec2 above = (float(height) / 255.0f - 0.5f) * pyramid.relief;
        const double truth = pattern(q + above.cwiseProduct(slopeOf(viewer)));
        EXPECT_NEAR(closelySeen(pyramid, q, viewer, true), truth, 0.02);
        before = std::max(before, std::abs(closelySeen(pyramid, q, viewer, false) - truth));
      }
    EXPECT_GT(before, 0.2) << "the views would agree without a correction";
  }
}

TEST(RttParallax, AFlatPatchIsReadAsEver) {
  transfer::SimulatedRtt rtt = test::bumpyRtt(8, 6, 4, 2);
  const RttPyramid without = makePyramid(rtt);
  rtt.heights.assign(rtt.positionCount() * rtt.viewCount(), 255);
  rtt.depth = 0.0f;
  const RttPyramid flat = makePyramid(rtt);
  for (const Vec3& viewer : kViewers)
    for (int i = 0; i < 50; ++i) {
      const Vec2 q(float(i) / 50, float(i * 9 % 50) / 50);
      EXPECT_EQ(closelySeen(flat, q, viewer, true), closelySeen(without, q, viewer, false));
    }
}

// Positions and heights moved by some across the border, and read as much further on.
TEST(RttParallax, RunsOverThePatchsBorder) {
  const int side = 16, views = 4, by = 5;
  transfer::SimulatedRtt rtt = test::bumpyRtt(side, side, views, 2);
  rtt.depth = 0.35f;
  for (int p = 0; p < side * side; ++p)
    for (int v = 0; v < views * views; ++v)
      rtt.heights.push_back(std::uint8_t(127 + 120 * std::sin(2 * kPi * (p % side) / side) *
                                                   std::cos(2 * kPi * (p / side) / side)));
  transfer::SimulatedRtt moved = rtt;
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x)
      for (int v = 0; v < views * views; ++v) {
        const int toX = (x + by) % side, toY = (y + by) % side;
        moved.heights[std::size_t((toY * side + toX) * views * views + v)] =
            rtt.heights[std::size_t((y * side + x) * views * views + v)];
        for (int i = 0; i < 4; ++i)
          for (std::size_t c = 0; c < 3; ++c)
            moved.values[moved.index(i, toX, toY, v % views, v / views) + c] =
                rtt.values[rtt.index(i, x, y, v % views, v / views) + c];
      }
  const RttPyramid a = makePyramid(rtt), b = makePyramid(moved);
  double changed = 0.0;
  for (const Vec3& viewer : kViewers)
    for (int i = 0; i < 64; ++i) {
      const Vec2 q(float(i) / 64 + 0.003f, float(i * 11 % 64) / 64 + 0.003f);
      Vec2 there = q + Vec2::Constant(float(by) / side);
      there -= Vec2(there.array().floor());
      EXPECT_NEAR(closelySeen(b, there, viewer, true), closelySeen(a, q, viewer, true), 1e-4);
      changed = std::max(changed, std::abs(double(closelySeen(a, q, viewer, true)) -
                                           closelySeen(a, q, viewer, false)));
    }
  EXPECT_GT(changed, 0.01);
}

// Between levels as well: as positions grow beyond the shifts, the correction goes.
TEST(RttParallax, FadesOutWithTheLevels) {
  const RttPyramid pyramid = makePyramid(planeAt(255));
  const Vec3 viewer = kViewers[2].normalized();
  const std::vector<float> light(std::size_t(pyramid.stride()), 3.5449077f);
  const auto at = [&](const Vec2& q, float level, const Vec2& relief) {
    RttProbes probes;
    probes.level = level;
    return respond(pyramid, q, probes, viewsAround(pyramid.views, viewer, relief), light.data())[0];
  };
  const Vec2 q(0.31f, 0.77f);
  for (float level = 0.02f; level < 6.0f; level += 0.02f)
    ASSERT_NEAR(at(q, level, pyramid.relief), at(q, level - 0.02f, pyramid.relief), 0.05);
  EXPECT_NEAR(at(q, 6.0f, pyramid.relief), at(q, 6.0f, Vec2::Zero()), 1e-5);
}

double varianceOf(const RttProbes& probes, double positions, double width) {
  double sum = width * width / 12;
  for (int i = 0; i < probes.count; ++i) {
    const double at = (i - 0.5 * (probes.count - 1)) * probes.step.norm() * positions;
    sum += at * at / probes.count;
  }
  return sum;
}

// As wide as the footprint is: N probes of a level's width w spread like a box of length a.
TEST(RttFootprint, ProbesSpreadAsFarAsTheFootprint) {
  for (const double a : {1.5, 3.0, 7.9, 20.0})
    for (const double ratio : {1.0, 0.7, 0.4, 0.26}) {
      const Vec2 along(0.6f, 0.8f), across(-0.8f, 0.6f);
      const RttProbes probes =
          probesOf(along * float(a / 64), across * float(a * ratio / 64), Vec2(64, 64));
      const double width = std::max(std::max(a * ratio, 1.0), a / kMostProbes);
      EXPECT_NEAR(probes.level, std::log2(width), 1e-4);
      const double least = probes.count == 1 ? 0.04 * width * width / 12 : 0.0;
      EXPECT_NEAR(varianceOf(probes, 64, width), a * a / 12, 1e-4 * a * a + least)
          << a << ", " << ratio;
      EXPECT_TRUE(probes.count == 1 || probes.step.normalized().dot(along) > 1.0f - 1e-5f);
    }
}

TEST(RttFootprint, NothingIsAveragedBelowOnePosition) {
  const RttProbes probes = probesOf(Vec2(0.9f / 64, 0), Vec2(0, 0.1f / 64), Vec2(64, 64));
  EXPECT_EQ(probes.count, 1);
  EXPECT_EQ(probes.level, 0.0f);
  EXPECT_EQ(probesOf(Vec2::Zero(), Vec2::Zero(), Vec2(64, 64)).count, 1);
}

/// A square of one metre on a map whose left part continues one place of a patch of `period` metres,
/// turned by 0.3 within the surface, and whose right part another.
struct TwoPieces {
  scene::Mesh mesh;
  transfer::Patch patch;
  PatchGradient gradient;

  static constexpr int kTexels = 40, kBorder = 20;  // the first column of the second piece

  explicit TwoPieces(float period) {
    mesh.positions = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0)};
    mesh.uvs = {Vec2(0, 1), Vec2(1, 1), Vec2(1, 0), Vec2(0, 0)};  // v runs down
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    gradient = {Vec3(std::cos(0.3f), std::sin(0.3f), 0) / period,
                Vec3(-std::sin(0.3f), std::cos(0.3f), 0) / period};
    transfer::IdMap map{kTexels, kTexels, {}};
    for (int y = 0; y < kTexels; ++y)
      for (int x = 0; x < kTexels; ++x) {
        const Vec2 q = of(Vec2(float(x) + 0.5f, float(y) + 0.5f) / float(kTexels), x >= kBorder);
        for (int c = 0; c < 2; ++c)
          map.ids.push_back(std::uint16_t(std::lround((q[c] - std::floor(q[c])) * 65536) & 0xffff));
      }
    patch.place = map;
  }
  Vec2 of(const Vec2& uv, bool second) const {
    const Vec3 at(uv.x(), 1 - uv.y(), 0);
    return Vec2(gradient.x.dot(at), gradient.y.dot(at)) +
           (second ? Vec2(0.37f, 0.61f) : Vec2(0, 0));
  }
  PatchPlaces at(const Vec2& uv) const {
    return patchPlaces(patch, uv, scene::uvSteps(mesh, uv.x() > 1 - uv.y() ? 0 : 1), gradient);
  }
};

double wrappedApart(const Vec2& a, const Vec2& b) {
  const Vec2 d = a - b;
  return (d - Vec2(d.array().round())).cwiseAbs().maxCoeff();
}

// The nearest texel's place would be off by half a texel, .1 of this patch's period.
TEST(PatchPlaces, AreExactWithinAPieceHoweverClosely) {
  const TwoPieces pieces(0.125f);
  for (int i = 0; i < 2000; ++i) {
    const Vec2 uv((0.7f + 18.5f * float(i) / 2000) / TwoPieces::kTexels,
                  0.31f + 0.0001f * float(i));
    const PatchPlaces places = pieces.at(uv);
    ASSERT_EQ(places.count, 1) << uv.transpose();
    EXPECT_NEAR(places.share[0], 1.0f, 1e-5f);
    EXPECT_LT(wrappedApart(places.q[0], pieces.of(uv, false)), 4e-5);
  }
}

TEST(PatchPlaces, FadeIntoEachOtherOverOneTexelAlongAStraightLine) {
  const TwoPieces pieces(0.125f);
  for (int row = 1; row < 300; ++row)
    for (int i = 0; i <= 50; ++i) {
      const float across = float(i) / 50;  // from the last centre of the first piece
      const Vec2 uv((TwoPieces::kBorder - 0.5f + across) / TwoPieces::kTexels,
                    0.03f + float(row) / 320);
      const PatchPlaces places = pieces.at(uv);
      double second = 0;
      for (int k = 0; k < places.count; ++k) {
        const bool is = wrappedApart(places.q[k], pieces.of(uv, true)) < 1e-4;
        ASSERT_TRUE(is || wrappedApart(places.q[k], pieces.of(uv, false)) < 1e-4);
        second += is ? places.share[k] : 0;
      }
      ASSERT_NEAR(second, across, 1e-4) << "the staircase of the texels' rows would show";
    }
}

TEST(PatchPlaces, TakeWhatHasNoSlopeAndWhatIsNoNumber) {
  const TwoPieces pieces(0.125f);
  for (const float u : {0.0f, 0.5f, 1.0f, -3.0f, std::nanf("")}) {
    double share = 0;
    const PatchPlaces places =
        patchPlaces(pieces.patch, Vec2(u, 0.5f), scene::UvSteps{}, PatchGradient{});
    for (int k = 0; k < places.count; ++k) share += places.share[k];
    EXPECT_NEAR(share, 1.0, 1e-5) << u;
  }
  scene::Mesh flat = pieces.mesh;
  flat.uvs.assign(4, Vec2(0.5f, 0.5f));
  EXPECT_EQ(scene::uvSteps(flat, 0).u, Vec3(0, 0, 0));
}

// A position that covers many pixels is no tile: seen closely, what lies between two changes evenly.
TEST(RttFootprint, ReadsLieBetweenPositionsThatAreSeenClosely) {
  const auto between = [](double a) {
    return probesOf(Vec2(float(a / 64), 0), Vec2(0, float(a / 128)), Vec2(64, 64)).between;
  };
  EXPECT_EQ(between(0.01), 1.0f);
  EXPECT_EQ(between(0.5), 1.0f);
  EXPECT_NEAR(between(0.75), 0.5f, 1e-5f);
  EXPECT_NEAR(between(0.9999), 0.0f, 1e-3f);
  EXPECT_EQ(between(1.5), 0.0f);
}

TEST(RttFootprint, AxesLieOnTheSurfaceTowardsTheViewer) {
  Mat3 frame;
  frame << 0, 0, 1, 1, 0, 0, 0, 1, 0;  // tangent +y, bitangent +z, normal +x
  const FootprintAxes axes = footprintAxes(frame, Vec3(0.6f, 0.0f, 0.8f), 0.01f);
  EXPECT_TRUE(axes.longer.isApprox(Vec3(0, 0.0125f, 0), 1e-5f));
  EXPECT_TRUE(axes.shorter.isApprox(Vec3(0, 0, 0.01f), 1e-5f));
}

TEST(RttFootprint, WidthOfASubSample) {
  scene::Camera camera;
  camera.verticalFov = 0.8f;
  const SampleWidth perspective = sampleWidth(camera, 100, 4);
  EXPECT_NEAR(perspective.at(5.0f), 5.0f * 2.0f * std::tan(0.4f) / 100 / 2, 1e-6f);
  camera.orthographicHalfHeight = 3.0f;
  const SampleWidth flat = sampleWidth(camera, 100, 1);
  EXPECT_NEAR(flat.at(5.0f), 0.06f, 1e-6f);
  EXPECT_EQ(flat.at(5.0f), flat.at(500.0f));
}

std::vector<float> numbersLike(std::size_t count) {
  std::vector<float> numbers(count);
  for (std::size_t i = 0; i < count; ++i) numbers[i] = std::sin(0.7f * float(i * i % 1009));
  return numbers;
}

TEST(ApplyMatrices, BytesWithScalesOfAnyRun) {
  const int rows = 9, columns = 16, receivers = 5;
  sh::RgbCoefficients light(4);
  light.values = numbersLike(48);
  for (const int channels : {1, 3})
    for (const int block : {16, 9 * 16, 3 * 9 * 16, 4, 2 * 9 * 16 * 5}) {
      if (receivers * channels * rows * columns % block != 0) continue;
      const transfer::Matrices<transfer::Numbers> matrices{
          3, 4, channels,
          transfer::encode(numbersLike(std::size_t(receivers) * channels * rows * columns),
                           transfer::Encoding::Snorm8, std::size_t(block))};
      const std::vector<float> m = transfer::decode(matrices.numbers);
      const std::vector<float> out = applyMatrices(matrices, light);
      for (int p = 0; p < receivers; ++p)
        for (int c = 0; c < 3; ++c)
          for (int i = 0; i < rows; ++i) {
            double expected = 0;
            for (int j = 0; j < columns; ++j)
              expected +=
                  double(m[std::size_t(((p * channels + c % channels) * rows + i) * columns + j)]) *
                  light.channel(c)[std::size_t(j)];
            ASSERT_NEAR(out[std::size_t((p * 3 + c) * rows + i)], expected, 2e-5)
                << channels << " channels, runs of " << block;
          }
    }
}

TEST(Kernels, EveryInstructionSetMultipliesBytes) {
  const int rows = 25, columns = 25, receivers = 3;
  std::vector<std::int8_t> bytes(std::size_t(receivers) * 3 * rows * columns);
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = std::int8_t(int(i * 37 % 255) - 127);
  std::vector<float> light(std::size_t(3 * paddedColumns(columns)));
  for (int c = 0; c < 3; ++c)
    for (int j = 0; j < columns; ++j)
      light[std::size_t(c * paddedColumns(columns) + j)] = float(j - 3 * c);
  std::vector<float> scratch(std::size_t(3 * rows * columns + kBlock));
  for (const math::Isa isa : {math::Isa::Baseline, math::Isa::Avx2, math::Isa::Avx512}) {
    if (isa > math::bestIsa()) continue;
    std::vector<float> out(std::size_t(receivers) * 3 * rows);
    kernelsFor(isa).matrixByte(bytes.data(), receivers, 3, rows, columns, light.data(),
                               scratch.data(), out.data());
    for (std::size_t row = 0; row < out.size(); ++row) {
      float expected = 0;
      for (std::size_t j = 0; j < std::size_t(columns); ++j)
        expected += float(bytes[row * columns + j]) * (float(j) - 3.0f * float(row / rows % 3));
      ASSERT_EQ(out[row], expected) << "isa " << int(isa);
    }
  }
}

}  // namespace
}  // namespace lambent::shade
