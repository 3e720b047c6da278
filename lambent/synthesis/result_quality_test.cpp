// Measures of results whose lay-out is known.
#include "lambent/synthesis/result_quality.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "lambent/math/random.h"
#include "lambent/scene/shapes.h"
#include "lambent/scene/texel_map.h"
#include "lambent/synthesis/patch_look.h"
#include "lambent/synthesis/test_patches.h"
#include "lambent/synthesis/whole_pieces.h"

namespace lambent::synthesis {
namespace {

constexpr float kPeriod = 0.25f;
constexpr int kMap = 160;

/// A patch that sends the same everywhere, by its albedo.
template <class Albedo>
transfer::SimulatedRtt matt(const Albedo& albedo, int side = 48) {
  transfer::SimulatedRtt rtt;
  rtt.width = rtt.height = side, rtt.views = 1, rtt.bands = 1;
  rtt.values.resize(rtt.planeSize());
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      const Rgb a = albedo((float(x) + 0.5f) / float(side), (float(y) + 0.5f) / float(side));
      for (int k = 0; k < 3; ++k) rtt.values[rtt.index(0, x, y, 0, 0) + std::size_t(k)] = a[k];
    }
  return rtt;
}

/// Two discs of 0.26 and 0.17 periods on dark ground.
Rgb discs(float u, float v) {
  const bool on =
      std::hypot(u - 0.3f, v - 0.3f) < 0.26f || std::hypot(u - 0.75f, v - 0.72f) < 0.17f;
  return on ? Rgb(0.7f, 0.6f, 0.5f) : Rgb(0.1f, 0.08f, 0.08f);
}

/// The same seen after a quarter turn about the middle.
Rgb cross(float u, float v) {
  const float x = std::abs(u - 0.5f), y = std::abs(v - 0.5f);
  return std::min(x, y) < 0.08f && std::max(x, y) < 0.35f ? Rgb(0.8f, 0.7f, 0.3f)
                                                          : Rgb(0.1f, 0.2f, 0.3f);
}

/// A square metre whose front is up, with frames along x, and the place of the patch at a point of it.
struct Sheet {
  scene::Mesh mesh = scene::gridPlane(1.0f, 1.0f, 8, 8);
  std::vector<Vec3> tangents = std::vector<Vec3>(mesh.positions.size(), Vec3::UnitX());
  transfer::IdMap map;

  explicit Sheet(const std::function<Vec2(const Vec3&)>& placeAt) { fill(placeAt); }
  void fill(const std::function<Vec2(const Vec3&)>& placeAt) {
    map.width = map.height = kMap;
    map.ids.assign(2 * map.texelCount(), 0);
    const scene::TexelMap texels = scene::texelMap(mesh, kMap, kMap);
    for (std::size_t i = 0; i < texels.size(); ++i) {
      if (!texels.covered(i)) continue;
      const scene::Triangle& t = mesh.triangles[texels.triangle[i]];
      const Vec2 b = texels.barycentric[i];
      const Vec3 at = (1 - b.x() - b.y()) * mesh.positions[t[0]] + b.x() * mesh.positions[t[1]] +
                      b.y() * mesh.positions[t[2]];
      const Vec2 q = placeAt(at);
      for (int k = 0; k < 2; ++k)
        map.ids[2 * i + std::size_t(k)] = std::uint16_t(
            std::int64_t(std::llround(double(q[k] - std::floor(q[k])) * 65536.0)) & 0xffff);
    }
  }
  Worn worn() const { return {mesh, tangents, map, Vec2::Constant(kPeriod)}; }
};

/// The patch as it lies flat: +y of the patch is −z there.
Vec2 flat(const Vec3& p) {
  return Vec2(p.x(), -p.z()) / kPeriod;
}

/// The first measure alone.
double continuedOf(const Sheet& sheet, const transfer::SimulatedRtt& rtt) {
  const Worn worn = sheet.worn();
  return continuationOf(texelsOf(worn), worn.period, symmetriesOf(lookOf(rtt), true)).share;
}

TEST(ResultQuality, APatchLaidFlatIsWithoutFault) {
  const ResultQuality quality = resultQualityOf(Sheet(flat).worn(), matt(discs));
  EXPECT_EQ(quality.continued, 1.0);
  EXPECT_TRUE(quality.tears.empty());
  ASSERT_TRUE(quality.whole && quality.unlikeness && quality.repetition);
  EXPECT_EQ(*quality.wholeByArea, 1.0);
  EXPECT_EQ(*quality.whole, 1.0);
  EXPECT_LT(*quality.unlikeness, 2e-3);
  EXPECT_LT(*quality.misfit, 1e-5);
  EXPECT_GT(*quality.repetition, 0.5);  // four by four times the same two discs
}

TEST(ResultQuality, ATearIsFoundWhereItIs) {
  const Sheet sheet([](const Vec3& p) {
    return Vec2(flat(p) + (p.x() > 0.05f ? Vec2(0.1f, 0.37f) : Vec2(0, 0)));
  });
  const ResultQuality quality = resultQualityOf(sheet.worn(), matt(discs));
  ASSERT_EQ(quality.tears.size(), 1u);
  EXPECT_NEAR(quality.tears[0].middle.x(), 0.05f, 2.0f / kMap);
  EXPECT_NEAR(quality.tears[0].middle.z(), 0.0f, 1e-3f);
  EXPECT_NEAR(quality.tears[0].length, 0.25f * float(kPi), 1e-3f);  // of a line along the texels
  EXPECT_NEAR(quality.tearLength, 0.25 * kPi * kPeriod, 1e-3);
  EXPECT_NEAR(quality.continued, 1.0 - 1.0 / (2.0 * kMap), 1e-4);
  EXPECT_LT(*quality.whole, 1.0);
  EXPECT_GT(*quality.whole, 0.6);
  EXPECT_GT(*quality.unlikeness, 5e-3);
  EXPECT_GT(*quality.misfit, 1e-3);
  // Across the texels the estimate is as much too long as along them too short.
  const Sheet across([](const Vec3& p) {
    return Vec2(flat(p) + (p.x() + p.z() > 0.0f ? Vec2(0.1f, 0.37f) : Vec2(0, 0)));
  });
  const ResultQuality diagonal = resultQualityOf(across.worn(), matt(discs));
  EXPECT_NEAR(diagonal.tearLength, std::sqrt(2.0) * 1.11 * kPeriod, 0.02);
}

TEST(ResultQuality, StrainIsNoTear) {
  const Sheet sheet([](const Vec3& p) { return Vec2(1.25f * flat(p)); });
  EXPECT_EQ(continuedOf(sheet, matt(discs)), 1.0);
}

TEST(ResultQuality, APatchThatLiesLargerBreaksNoPiece) {
  const Sheet sheet([](const Vec3& p) { return Vec2(0.8f * flat(p)); });
  const ResultQuality quality = resultQualityOf(sheet.worn(), matt(discs));
  EXPECT_EQ(quality.continued, 1.0);
  EXPECT_EQ(*quality.whole, 1.0);
  EXPECT_EQ(*quality.wholeByArea, 0.0);
}

TEST(ResultQuality, APatchMayGoOnAsOneOfItsSymmetries) {
  const transfer::SimulatedRtt weave = matt(weaveAlbedo);
  const auto halves = [](const Vec2& shift) {
    return Sheet(
        [shift](const Vec3& p) { return Vec2(flat(p) + (p.x() > 0 ? shift : Vec2(0, 0))); });
  };
  EXPECT_EQ(continuedOf(halves(Vec2(0.25f, 0.25f)), weave), 1.0);
  EXPECT_EQ(continuedOf(halves(Vec2(0.5f, 0.0f)), weave), 1.0);
  EXPECT_LT(continuedOf(halves(Vec2(0.25f, 0.0f)), weave), 1.0);
  EXPECT_LT(continuedOf(halves(Vec2(0.25f, 0.25f)), matt(discs)), 1.0);
}

TEST(ResultQuality, FramesMayTurnAsThePatchDoes) {
  // Where x > 0 frames are turned by right angles, and places with them, about a point at which the
  // cross is as before. The weave is not: its warp becomes its weft.
  for (int quarters = 1; quarters < 4; ++quarters) {
    Sheet sheet(flat);
    // Doubled vertices, so that frames do not mix.
    const scene::Mesh whole = sheet.mesh;
    sheet.mesh.positions.clear(), sheet.mesh.normals.clear(), sheet.mesh.uvs.clear();
    sheet.mesh.triangles.clear(), sheet.tangents.clear();
    for (const scene::Triangle& t : whole.triangles) {
      float middle = 0.0f;
      for (const std::uint32_t v : t) middle += whole.positions[v].x();
      scene::Triangle own{};
      for (int k = 0; k < 3; ++k) {
        own[std::size_t(k)] = std::uint32_t(sheet.mesh.positions.size());
        sheet.mesh.positions.push_back(whole.positions[t[std::size_t(k)]]);
        sheet.mesh.normals.push_back(whole.normals[t[std::size_t(k)]]);
        sheet.mesh.uvs.push_back(whole.uvs[t[std::size_t(k)]]);
        // A frame turned by −90° sees what it saw turned by +90°.
        const Vec2 x = middle > 0 ? turned(Vec2::UnitX(), 4 - quarters) : Vec2(Vec2::UnitX());
        sheet.tangents.push_back(Vec3(x.x(), 0.0f, -x.y()));
      }
      sheet.mesh.triangles.push_back(own);
    }
    sheet.fill([&](const Vec3& p) {
      const Vec2 about(0.5f, 0.5f), q = flat(p) - about;
      return Vec2(about + (p.x() > 0 ? turned(q, quarters) : q));
    });
    EXPECT_EQ(continuedOf(sheet, matt(cross)), 1.0) << quarters;
    if (quarters != 2) {
      EXPECT_LT(continuedOf(sheet, matt(weaveAlbedo)), 1.0);
    }
    EXPECT_LT(continuedOf(sheet, matt(discs)), 1.0) << quarters;
  }
}

TEST(ResultQuality, BordersOfChartsAreCrossedAndOpenOnesAreNot) {
  // The right half lies elsewhere in the map, upside down.
  Sheet sheet(flat);
  const scene::Mesh whole = sheet.mesh;
  scene::Mesh halves[2];
  for (int side = 0; side < 2; ++side) {
    halves[side] = whole;
    halves[side].triangles.clear();
    for (const scene::Triangle& t : whole.triangles) {
      float middle = 0.0f;
      for (const std::uint32_t v : t) middle += whole.positions[v].x();
      if ((middle > 0) == (side == 1)) halves[side].triangles.push_back(t);
    }
    for (Vec2& uv : halves[side].uvs)
      uv = side == 0 ? Vec2(0.9f * uv.x(), 0.02f + 0.9f * uv.y())
                     : Vec2(1.45f - 0.9f * uv.x(), 0.94f - 0.9f * uv.y());
    scene::dropUnusedVertices(halves[side]);
  }
  sheet.mesh = scene::merge(halves);
  sheet.tangents.assign(sheet.mesh.positions.size(), Vec3::UnitX());
  sheet.fill(flat);
  const WornTexels texels = texelsOf(sheet.worn());
  double crossing = 0.0;
  for (const auto& step : texels.steps)
    if ((texels.positions[step.a].x() > 0) != (texels.positions[step.b].x() > 0))
      crossing += double(step.width);
  EXPECT_NEAR(crossing, 1.0, 0.02);
  double ends = 0.0;
  for (const std::uint8_t end : texels.atEnd) ends += end;
  EXPECT_NEAR(ends, 4.0 * 0.9 * kMap, 0.03 * 4.0 * kMap);
  const ResultQuality quality = resultQualityOf(sheet.worn(), matt(discs));
  EXPECT_EQ(quality.continued, 1.0);
  EXPECT_EQ(*quality.whole, 1.0);

  sheet.fill(
      [](const Vec3& p) { return Vec2(flat(p) + (p.x() > 0 ? Vec2(0, 0.4f) : Vec2(0, 0))); });
  const ResultQuality torn = resultQualityOf(sheet.worn(), matt(discs));
  ASSERT_EQ(torn.tears.size(), 1u);
  EXPECT_NEAR(torn.tears[0].middle.x(), 0.0f, 0.01f);
  EXPECT_NEAR(torn.tears[0].length, 0.25f * float(kPi), 0.03f);
}

TEST(ResultQuality, PlacesAtRandomAreWorst) {
  const Sheet sheet([](const Vec3& p) {
    return Vec2(
        math::Random(1, std::uint64_t(p.x() * 1e6f + 1e6f), std::uint64_t(p.z() * 1e6f + 1e6f))
            .uniform2());
  });
  const ResultQuality quality = resultQualityOf(sheet.worn(), matt(stuccoAlbedo));
  EXPECT_LT(quality.continued, 0.05);
  EXPECT_GT(*quality.unlikeness, 0.2);
  EXPECT_GT(*quality.misfit, 0.3);
  EXPECT_LT(*quality.repetition, 0.05);
}

TEST(ResultQuality, AScatteredPatchDoesNotRepeatItself) {
  // Tiles of a period, each from another place.
  const Sheet sheet([](const Vec3& p) {
    const Vec2 q = flat(p) + Vec2(40, 40), tile(q.array().floor());
    return Vec2(q + math::Random(5, std::uint64_t(tile.x()), std::uint64_t(tile.y())).uniform2());
  });
  const transfer::SimulatedRtt stucco = matt(stuccoAlbedo);
  const double scattered = *resultQualityOf(sheet.worn(), stucco).repetition;
  EXPECT_GT(*resultQualityOf(Sheet(flat).worn(), stucco).repetition, scattered + 0.3);
}

TEST(PatchPieces, AreTheDiscs) {
  const PatchPieces pieces = piecesOf(lookOf(matt(discs, 64)));
  ASSERT_EQ(pieces.areas.size(), 2u);
  EXPECT_NEAR(pieces.areas[0], kPi * 0.26 * 0.26, 0.006);
  EXPECT_NEAR(pieces.areas[1], kPi * 0.17 * 0.17, 0.006);
  EXPECT_GE(pieces.at(Vec2(0.3f, 1.3f)), 0);
  EXPECT_EQ(pieces.at(Vec2(0.0f, 0.0f)), PatchPieces::kBetween);
  // Stripes have no end.
  const auto stripes = [](float u, float) { return Rgb::Constant(u < 0.4f ? 0.8f : 0.1f); };
  EXPECT_TRUE(piecesOf(lookOf(matt(stripes))).areas.empty());
}

TEST(LookSymmetry, IsFound) {
  const auto count = [](const std::vector<LookSymmetry>& all, int quarters) {
    return std::count_if(all.begin(), all.end(),
                         [&](const LookSymmetry& s) { return s.quarters == quarters; });
  };
  const auto weave = symmetriesOf(lookOf(matt(weaveAlbedo, 64)), true);
  EXPECT_EQ(count(weave, 0), 8);
  EXPECT_EQ(count(weave, 1), 0);
  EXPECT_EQ(count(weave, 2), 8);
  const auto plus = symmetriesOf(lookOf(matt(cross, 64)), true);
  for (int quarters = 0; quarters < 4; ++quarters) EXPECT_EQ(count(plus, quarters), 1);
  EXPECT_EQ(symmetriesOf(lookOf(matt(discs, 64)), true).size(), 1u);
}

}  // namespace
}  // namespace lambent::synthesis
