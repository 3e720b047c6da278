// Properties of RTTs: periodicity, reproducibility, agreement of the two methods, hostile input.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "lambent/meso/build_rtt.h"
#include "lambent/meso/generators.h"
#include "lambent/meso/periodic_scene.h"
#include "lambent/meso/preview.h"
#include "lambent/meso/test_patches.h"
#include "lambent/sh/coefficients.h"
#include "lambent/sh/zonal.h"

namespace lambent::meso {
namespace {

double relativeError(const transfer::SimulatedRtt& a, const transfer::SimulatedRtt& b) {
  double difference = 0.0, scale = 0.0;
  for (std::size_t i = 0; i < a.values.size(); ++i) {
    difference += std::pow(double(a.values[i]) - b.values[i], 2);
    scale += double(b.values[i]) * b.values[i];
  }
  return std::sqrt(difference / scale);
}

Patch coarseWeave(const Rgb& albedo) {
  WeaveOptions options;
  options.warp = options.weft = options.backing = albedo;
  options.around = 20, options.along = 20;
  return weave(options);
}

TEST(BuildRtt, APatchMovedByHalfAPeriodGivesTheRttMovedByHalf) {
  RttOptions options = smallOptions(8, 3);
  options.directions = 256;
  const transfer::SimulatedRtt a = build(bumpyPatch(Rgb::Constant(0.7f)), options);
  const transfer::SimulatedRtt b = build(bumpyPatch(Rgb::Constant(0.7f), 24, 24), options);
  transfer::SimulatedRtt moved = b;
  for (int i = 0; i < 25; ++i)
    for (int p = 0; p < 64; ++p)
      for (int v = 0; v < 9; ++v)
        for (int c = 0; c < 3; ++c) {
          const int x = p % 8, y = p / 8;
          moved.values[moved.index(i, x, y, v % 3, v / 3) + c] =
              b.values[b.index(i, (x + 4) % 8, (y + 4) % 8, v % 3, v / 3) + c];
        }
  EXPECT_LT(relativeError(moved, a), 1e-3);
  EXPECT_GT(relativeError(b, a), 0.05);  // it is not the same everywhere
}

// Where the ray of a view through a position is as high as is kept, there the surface is.
TEST(BuildRtt, HeightsLieOnTheSurfaceThatIsSeen) {
  RttOptions options = smallOptions(24, 4);
  options.directions = 16, options.bounces = 0, options.supersample = 1;
  const Patch patch = bumpyPatch(Rgb::Constant(0.7f));
  const transfer::SimulatedRtt rtt = build(patch, options);
  ASSERT_EQ(rtt.heights.size(), rtt.positionCount() * rtt.viewCount());
  const Extent extent = extentOf(patch);
  const auto periods = [](double x) { return 2 * kPi * (x / 0.1 - 0.5 / 48); };
  double worst = 0.0;
  for (int y = 0; y < 24; ++y)
    for (int x = 0; x < 24; ++x)
      for (int view = 0; view < 16; ++view) {
        const Vec3 v = viewDirection(4, view % 4, view / 4);
        const double z =
            rtt.heights[std::size_t((y * 24 + x) * 16 + view)] / 255.0 * extent.depth() +
            extent.lowest;
        const Vec3 at = Vec3((float(x) + 0.5f) / 240, (float(y) + 0.5f) / 240, extent.middle()) +
                        v * ((float(z) - extent.middle()) / v.z());
        const double u = periods(at.x()), w = periods(at.y());
        const double surface =
            0.006 * (std::sin(u) + 0.6 * std::sin(2 * w + u) + 0.5 * std::cos(3 * u - w));
        worst = std::max(worst, std::abs(surface - z));
      }
  EXPECT_LT(worst, 0.02 * extent.depth());
}

TEST(BuildRtt, HeightsAreKeptWhereThereAreViewsToCorrect) {
  RttOptions options = smallOptions(4, 1);
  options.directions = 16, options.bounces = 0;
  EXPECT_TRUE(build(bumpyPatch(Rgb::Constant(0.7f)), options).heights.empty());
}

TEST(BuildRtt, GeometryMayLieAnywhereAndReachOverThePeriod) {
  RttOptions options = smallOptions(6, 2);
  options.directions = 128;
  const Patch patch = bumpyPatch(Rgb::Constant(0.7f));
  Patch far = patch;
  for (scene::Mesh& mesh : far.scene.meshes)
    for (Vec3& p : mesh.positions) p += Vec3(0.3f, -0.2f, 0.0f);  // whole periods
  EXPECT_LT(relativeError(build(far, options), build(patch, options)), 2e-3);
}

TEST(BuildRtt, TheSizeOfTheBlockDoesNotMatter) {
  // Rays that leave the block go on from its middle: a tiling, not a block.
  RttOptions options = smallOptions(6, 2);
  options.directions = 256;
  const Patch patch = slotPatch(0.06f, 0.03f, 0.8f, 0.5f);
  options.blockTriangles = 0;
  const transfer::SimulatedRtt small = build(patch, options);
  options.blockTriangles = 100000;
  EXPECT_LT(relativeError(small, build(patch, options)), 1e-4);
}

TEST(PeriodicScene, ALevelRayIsWatchedOverManyPeriods) {
  Patch patch = flatPatch(Rgb::Ones());
  addQuad(patch, {0.05f, 0, 0}, {0.05f, 0, 0.01f}, {0.05f, 0.01f, 0.01f}, {0.05f, 0.01f, 0});
  auto scene = PeriodicScene::build(patch, 0);
  ASSERT_TRUE(scene);
  EXPECT_EQ(scene->tilesAcross(), 3);
  // In x every period has the post; a ray between the posts' rows in y goes on and on.
  PeriodicHit hit;
  EXPECT_EQ(scene->trace(Vec3(0.06f, 0.005f, 0.005f), Vec3(1, 0, 0), hit), RayEnd::Lit);
  EXPECT_NEAR(hit.distance, 0.09f, 1e-5f);
  // Slightly rising along y it meets the post's plane in no period; it is out after 5 of them.
  EXPECT_EQ(scene->trace(Vec3(0.02f, 0.05f, 0.005f), Vec3(0, 1, 0.01f).normalized(), hit),
            RayEnd::Escaped);
  // A slant ray far below the top meets the floor several blocks away.
  EXPECT_EQ(scene->trace(Vec3(0.02f, 0.05f, 0.005f), Vec3(0, 1, -0.005f).normalized(), hit),
            RayEnd::Lit);
  EXPECT_NEAR(hit.distance, 1.0f, 1e-3f);
}

TEST(BuildRtt, TheSameBytesAtAnyNumberOfThreads) {
  RttOptions options = smallOptions(12, 2);
  options.directions = 128;
  options.threads = 1;
  const Patch patch = coarseWeave(Rgb(0.6f, 0.4f, 0.2f));
  const transfer::SimulatedRtt one = build(patch, options);
  options.threads = 4;
  EXPECT_EQ(one.values, build(patch, options).values);
}

TEST(BuildRtt, BothMethodsAgreeOnStucco) {
  StuccoOptions stuccoOptions;
  stuccoOptions.resolution = 64;
  const Patch patch = stucco(stuccoOptions);
  RttOptions options = smallOptions(10, 2);
  const transfer::SimulatedRtt gathered = build(patch, options);
  options.method = RttMethod::Images;
  const transfer::SimulatedRtt coarse = build(patch, options);
  options.polarLights = 24, options.azimuthLights = 48;
  const transfer::SimulatedRtt fine = build(patch, options);
  // 128 lights leave the error of their quadrature; with nine times as many it falls.
  EXPECT_LT(relativeError(coarse, gathered), 0.03);
  EXPECT_LT(relativeError(fine, gathered), 0.015);
}

TEST(BuildRtt, NoPlaceReflectsMoreThanItGets) {
  for (const RttMethod method : {RttMethod::Gather, RttMethod::Images}) {
    RttOptions options = smallOptions(8, 4);
    options.method = method;
    const transfer::SimulatedRtt rtt = build(coarseWeave(Rgb::Ones()), options);
    // 128 lights sum the cosine of a tilted surface to a few percent only.
    const double most = method == RttMethod::Gather ? 1.005 : 1.05;
    for (std::size_t k = 0; k < rtt.planeSize(); ++k) {
      EXPECT_LT(rtt.values[k] * std::sqrt(4 * kPi), most);
      EXPECT_GE(rtt.values[k], 0.0f);
    }
  }
}

TEST(BuildRtt, ObliqueViewsSeeTheSidesThatFaceThem) {
  // A ridge along y with a red side towards +x and a green side towards −x.
  Patch patch = patchWith(Rgb(0.9f, 0, 0), Rgb(0, 0.9f, 0));
  addQuad(patch, {0.05f, 0, 0.03f}, {0.1f, 0, 0}, {0.1f, 0.1f, 0}, {0.05f, 0.1f, 0.03f}, 0);
  addQuad(patch, {0, 0, 0}, {0.05f, 0, 0.03f}, {0.05f, 0.1f, 0.03f}, {0, 0.1f, 0}, 1);
  RttOptions options = smallOptions(16, 8);
  options.bounces = 0, options.directions = 128;
  const transfer::SimulatedRtt rtt = build(patch, options);
  double red[2] = {0, 0}, green[2] = {0, 0};
  for (int x = 0; x < 16; ++x)
    for (int side = 0; side < 2; ++side) {
      const std::size_t at = rtt.index(0, x, 8, side == 0 ? 7 : 0, 3);
      red[side] += rtt.values[at], green[side] += rtt.values[at + 1];
    }
  ASSERT_GT(viewDirection(8, 7, 3).x(), 0.5f);
  EXPECT_GT(red[0], 2 * green[0]);
  EXPECT_GT(green[1], 2 * red[1]);
}

TEST(BuildRtt, ShadowsFallAwayFromTheLight) {
  // A wall across x at 0.05; light from +x, 40 degrees up: dark on its −x side.
  Patch patch = flatPatch(Rgb::Constant(0.8f));
  addQuad(patch, {0.051f, 0, 0}, {0.051f, 0.1f, 0}, {0.051f, 0.1f, 0.02f}, {0.051f, 0, 0.02f});
  addQuad(patch, {0.049f, 0, 0}, {0.049f, 0, 0.02f}, {0.049f, 0.1f, 0.02f}, {0.049f, 0.1f, 0});
  RttOptions options = smallOptions(20, 1);
  const transfer::SimulatedRtt rtt = build(patch, options);
  const sh::RgbCoefficients light = discLight(5, Vec3(0.77f, 0, 0.64f).normalized(), 0.3);
  const double before = exitRadiance(rtt, Vec2(0.40f, 0.5f), Vec3(0, 0, 1), light)[0];
  const double after = exitRadiance(rtt, Vec2(0.62f, 0.5f), Vec3(0, 0, 1), light)[0];
  EXPECT_LT(before, 0.4 * after);
}

TEST(BuildRtt, RefusesWhatItCannotBuild) {
  const auto error = [&](const Patch& patch, const RttOptions& options) {
    auto rtt = buildRtt(patch, options, {});
    EXPECT_FALSE(rtt);
    return rtt ? Error{} : rtt.error();
  };
  const RttOptions small = smallOptions(2, 1);
  EXPECT_EQ(error(Patch{}, small).kind, ErrorKind::BadInput);
  const Patch flat = flatPatch(Rgb::Ones());
  Patch patch = flat;
  patch.size.x() = 0.0f;
  EXPECT_EQ(error(patch, small).kind, ErrorKind::BadInput);
  patch = flat;
  patch.scene.meshes[0].positions[1].z() = std::numeric_limits<float>::quiet_NaN();
  EXPECT_NE(error(patch, small).message.find("vertex 1"), std::string::npos);
  patch = flat;
  patch.scene.meshes[0].triangles[0][2] = 77;
  EXPECT_EQ(error(patch, small).kind, ErrorKind::BadInput);
  patch = flat;
  patch.scene.materials[0].mirror = Rgb::Ones();
  EXPECT_NE(error(patch, small).message.find("mirror"), std::string::npos);
  patch = flat;
  patch.scene.materials[0].diffuse = Rgb::Constant(1.5f);
  EXPECT_EQ(error(patch, small).kind, ErrorKind::BadInput);
  patch = flat;
  patch.size = Vec2(0.002f, 0.002f);  // the quad is fifty periods wide
  EXPECT_NE(error(patch, small).message.find("period"), std::string::npos);
  RttOptions options = small;
  options.views = 0;
  EXPECT_EQ(error(flat, options).kind, ErrorKind::BadUsage);
  options = small;
  options.bands = 11;
  EXPECT_EQ(error(flat, options).kind, ErrorKind::BadUsage);
}

TEST(BuildRtt, StopsWhenAsked) {
  auto rtt = buildRtt(flatPatch(Rgb::Ones()), smallOptions(8, 4),
                      [](const ProgressUpdate&) { return false; });
  ASSERT_FALSE(rtt);
  EXPECT_EQ(rtt.error().kind, ErrorKind::Cancelled);
}

TEST(BuildRtt, SaysThatAPatchIsInsideOut) {
  Patch patch = flatPatch(Rgb::Ones());
  for (scene::Triangle& t : patch.scene.meshes[0].triangles) std::swap(t[1], t[2]);
  const auto built = buildRtt(patch, smallOptions(3, 1), {});
  ASSERT_TRUE(built);
  ASSERT_FALSE(built->findings.empty());
  EXPECT_EQ(built->findings.back().code, "back-faces-seen");
}

TEST(BuildRtt, TellsOfTooFewViewsOfADeepPatch) {
  const auto told = [](const Patch& patch, int views) {
    RttOptions options;
    options.width = options.height = 2;
    options.views = views;
    options.bands = 1;
    options.bounces = 0;
    options.directions = 16;
    const auto built = buildRtt(patch, options, {});
    EXPECT_TRUE(built);
    return std::any_of(built->findings.begin(), built->findings.end(),
                       [](const Finding& finding) { return finding.code == "few-views"; });
  };
  EXPECT_TRUE(told(weave(), 4));
  EXPECT_FALSE(told(weave(), 1));
  EXPECT_FALSE(told(weave(), 8));
  EXPECT_FALSE(told(plaster(), 4));
}

}  // namespace
}  // namespace lambent::meso
