#include "lambent/atlas/atlas.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <string>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "lambent/math/random.h"
#include "lambent/scene/diagnose.h"
#include "lambent/scene/shapes.h"
#include "lambent/work/thread_limit.h"

namespace lambent::atlas {
namespace {

double cross(const Vec2d& a, const Vec2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

double areaOf(const scene::Mesh& mesh, const scene::Triangle& t) {
  const Vec3d a = mesh.positions[t[0]].cast<double>(), b = mesh.positions[t[1]].cast<double>(),
              c = mesh.positions[t[2]].cast<double>();
  return 0.5 * (b - a).cross(c - a).norm();
}

double flatArea(const scene::Mesh& mesh, const scene::Triangle& t) {
  const Vec2d a = mesh.uvs[t[0]].cast<double>(), b = mesh.uvs[t[1]].cast<double>(),
              c = mesh.uvs[t[2]].cast<double>();
  return 0.5 * cross(b - a, c - a);
}

/// Squared L² stretch: half the sum of squared singular values, which is half the squares' sum.
double squaredStretch(const scene::Mesh& mesh, const scene::Triangle& t) {
  const Vec3d a = mesh.positions[t[0]].cast<double>(), b = mesh.positions[t[1]].cast<double>(),
              c = mesh.positions[t[2]].cast<double>();
  Eigen::Matrix<double, 3, 2> surface;
  surface << b - a, c - a;
  Eigen::Matrix2d plane;
  plane << (mesh.uvs[t[1]] - mesh.uvs[t[0]]).cast<double>(),
      (mesh.uvs[t[2]] - mesh.uvs[t[0]]).cast<double>();
  return 0.5 * (surface * plane.inverse()).squaredNorm();
}

/// Whether a triangle meets the square [x, x+1] × [y, y+1] drawn in by `rim` on all sides: neither
/// the axes nor the triangle's edges part them.
bool meets(const std::array<Vec2d, 3>& p, int x, int y, double rim) {
  const std::array<Vec2d, 4> corners = {Vec2d(x + rim, y + rim), Vec2d(x + 1 - rim, y + rim),
                                        Vec2d(x + 1 - rim, y + 1 - rim),
                                        Vec2d(x + rim, y + 1 - rim)};
  std::vector<Vec2d> axes = {Vec2d::UnitX(), Vec2d::UnitY()};
  for (int k = 0; k < 3; ++k) {
    const Vec2d edge = p[(k + 1) % 3] - p[k];
    axes.emplace_back(-edge.y(), edge.x());
  }
  for (const Vec2d& axis : axes) {
    double lowP = 1e30, highP = -1e30, lowC = 1e30, highC = -1e30;
    for (const Vec2d& q : p)
      lowP = std::min(lowP, axis.dot(q)), highP = std::max(highP, axis.dot(q));
    for (const Vec2d& q : corners)
      lowC = std::min(lowC, axis.dot(q)), highC = std::max(highC, axis.dot(q));
    if (highP < lowC || highC < lowP) return false;
  }
  return true;
}

/// For every texel the charts whose triangles meet it.
std::vector<std::set<std::uint32_t>> chartsOfTexels(const Atlas& atlas, int size) {
  std::vector<std::set<std::uint32_t>> texels(std::size_t(size) * size);
  for (std::size_t t = 0; t < atlas.mesh.triangles.size(); ++t) {
    std::array<Vec2d, 3> p;
    for (int k = 0; k < 3; ++k)
      p[k] = atlas.mesh.uvs[atlas.mesh.triangles[t][k]].cast<double>() * size;
    const auto [x0, x1] = std::minmax({int(p[0].x()), int(p[1].x()), int(p[2].x())});
    const auto [y0, y1] = std::minmax({int(p[0].y()), int(p[1].y()), int(p[2].y())});
    for (int y = y0; y <= std::min(size - 1, y1); ++y)
      for (int x = x0; x <= std::min(size - 1, x1); ++x)
        if (meets(p, x, y, 1e-4))
          texels[std::size_t(y) * size + x].insert(atlas.chartOfTriangle[t]);
  }
  return texels;
}

scene::Mesh withNormals(scene::Mesh mesh) {
  scene::computeNormals(mesh);
  return mesh;
}

/// Three rectangles that share one edge.
scene::Mesh fin() {
  scene::Mesh mesh;
  mesh.positions = {Vec3(0, 0, 0),  Vec3(0, 1, 0),  Vec3(1, 0, 0), Vec3(1, 1, 0),
                    Vec3(-1, 0, 0), Vec3(-1, 1, 0), Vec3(0, 0, 1), Vec3(0, 1, 1)};
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 0, 1}, {4, 1, 5}, {6, 0, 1}, {6, 1, 7}};
  return withNormals(mesh);
}

scene::Mesh moebius(int segments) {
  scene::Mesh mesh;
  for (int i = 0; i < segments; ++i)
    for (const float s : {-0.3f, 0.3f}) {
      const float a = 2.0f * float(kPi) * i / segments, h = 0.5f * a;
      const float r = 1.0f + s * std::cos(h);
      mesh.positions.emplace_back(r * std::cos(a), s * std::sin(h), r * std::sin(a));
    }
  for (std::uint32_t i = 0; i < std::uint32_t(segments); ++i) {
    const bool last = i + 1 == std::uint32_t(segments);
    const std::uint32_t a = 2 * i, b = a + 1, c = last ? 1 : a + 2, d = last ? 0 : a + 3;
    mesh.triangles.push_back({a, b, c});
    mesh.triangles.push_back({b, d, c});
  }
  return withNormals(mesh);
}

/// Triangles anywhere, of sizes from large to tiny.
scene::Mesh soup(int count) {
  scene::Mesh mesh;
  math::Random random(3, 1);
  for (int t = 0; t < count; ++t) {
    const float size = std::pow(10.0f, -3.0f * random.uniform());
    const Vec3 at(random.uniform(), random.uniform(), random.uniform());
    for (int k = 0; k < 3; ++k)
      mesh.positions.push_back(at +
                               size * Vec3(random.uniform(), random.uniform(), random.uniform()));
    const auto v = std::uint32_t(3 * t);
    mesh.triangles.push_back({v, v + 1, v + 2});
  }
  return withNormals(mesh);
}

/// A sphere, rough as a crumpled sheet.
scene::Mesh crumpled() {
  scene::Mesh mesh = scene::icosphere(1.0f, 3);
  math::Random random(5, 5);
  for (Vec3& p : mesh.positions) p *= 0.7f + 0.6f * random.uniform();
  return withNormals(mesh);
}

/// A plane with a triangle that is a line, one that is a point, and holes.
scene::Mesh holed() {
  scene::Mesh mesh = scene::gridPlane(1.0f, 1.0f, 12, 12);
  mesh.uvs.clear();
  std::vector<scene::Triangle> kept;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    if (t % 58 > 1) kept.push_back(mesh.triangles[t]);
  kept.push_back({0, 1, 2});
  kept.insert(kept.begin(), {5, 5, 5});
  mesh.triangles = kept;
  return mesh;
}

struct Case {
  std::string name;
  scene::Mesh mesh;
};

std::vector<Case> cases() {
  scene::Mesh spherePair[2] = {scene::icosphere(1.0f, 2),
                               scene::translated(scene::icosphere(0.01f, 2), Vec3(3, 0, 0))};
  scene::Mesh triangle;
  triangle.positions = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1e-3f, 0)};
  triangle.triangles = {{0, 1, 2}};
  return {{"sphere", scene::icosphere(1.0f, 3)},
          {"uv sphere", scene::uvSphere(2.0f, 24, 12)},
          {"torus", scene::torus(1.0f, 0.4f, 40, 20)},
          {"box", scene::box(Vec3(1, 2, 3), 4)},
          {"room", scene::room(Vec3(3, 2, 3), 1)},
          {"cylinder", scene::cylinder(0.5f, 2.0f, 24, 4)},
          {"ring", scene::ring(0.8f, 1.0f, 0.5f, 32, 2)},
          {"bowl", scene::bowl(1.0f, 0.5f, 24, 12)},
          {"plane", scene::gridPlane(1.0f, 3.0f, 4, 4)},
          {"two spheres", scene::merge(spherePair)},
          {"fin", fin()},
          {"moebius", moebius(40)},
          {"soup", soup(60)},
          {"crumpled", crumpled()},
          {"holed", holed()},
          {"triangle", withNormals(triangle)}};
}

Atlas automatic(const scene::Mesh& mesh, AtlasOptions options) {
  options.ownUvs = false;
  auto made = makeAtlas(mesh, options, {});
  if (!made) ADD_FAILURE() << made.error().message;
  return made ? std::move(made->value) : Atlas{};
}

class AtlasOf : public testing::TestWithParam<std::size_t> {
 protected:
  static const Case& theCase() {
    static const std::vector<Case> all = cases();
    return all[GetParam()];
  }
};

TEST_P(AtlasOf, IsTheSameSurface) {
  const scene::Mesh& mesh = theCase().mesh;
  const Atlas atlas = automatic(mesh, {.size = 256});
  ASSERT_EQ(atlas.mesh.triangles.size(), mesh.triangles.size());
  ASSERT_EQ(atlas.sourceVertex.size(), atlas.mesh.positions.size());
  ASSERT_EQ(atlas.mesh.uvs.size(), atlas.mesh.positions.size());
  ASSERT_EQ(atlas.mesh.normals.size(), atlas.mesh.positions.size());
  for (std::uint32_t v = 0; v < atlas.sourceVertex.size(); ++v) {
    if (v < mesh.positions.size()) {
      EXPECT_EQ(atlas.sourceVertex[v], v);
    }
    EXPECT_EQ(atlas.mesh.positions[v], mesh.positions[atlas.sourceVertex[v]]);
    EXPECT_EQ(atlas.mesh.normals[v], mesh.normals[atlas.sourceVertex[v]]);
  }
  std::vector<std::uint32_t> chartOfVertex(atlas.mesh.positions.size(), kNoChart);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    ASSERT_LT(atlas.chartOfTriangle[t], atlas.charts);
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t v = atlas.mesh.triangles[t][k];
      EXPECT_EQ(atlas.sourceVertex[v], mesh.triangles[t][k]);
      if (chartOfVertex[v] == kNoChart) chartOfVertex[v] = atlas.chartOfTriangle[t];
      EXPECT_EQ(chartOfVertex[v], atlas.chartOfTriangle[t]);
    }
  }
}

TEST_P(AtlasOf, ChartsKeepTheirGutters) {
  for (const auto& [size, gutter] : {std::pair(128, 2), std::pair(200, 5)}) {
    const Atlas atlas = automatic(theCase().mesh, {.size = size, .gutter = gutter});
    const auto texels = chartsOfTexels(atlas, size);
    std::set<std::uint32_t> seen;
    for (int y = 0; y < size; ++y)
      for (int x = 0; x < size; ++x) {
        const auto& here = texels[std::size_t(y) * size + x];
        ASSERT_LE(here.size(), 1u) << "two charts share texel " << x << ", " << y;
        if (here.empty()) continue;
        seen.insert(*here.begin());
        ASSERT_GE(std::min({x, y, size - 1 - x, size - 1 - y}), gutter);
        for (int ny = y - gutter; ny <= y + gutter; ++ny)
          for (int nx = x - gutter; nx <= x + gutter; ++nx)
            for (const std::uint32_t other : texels[std::size_t(ny) * size + nx])
              ASSERT_EQ(other, *here.begin())
                  << "charts closer than " << gutter << " at " << x << ", " << y;
      }
    EXPECT_EQ(seen.size(), atlas.charts) << "a chart touches no texel";
  }
}

TEST_P(AtlasOf, LiesFlatOnceAndUnturned) {
  const Atlas atlas = automatic(theCase().mesh, {.size = 200});
  double used = 0.0;
  for (const Vec2& uv : atlas.mesh.uvs) {
    EXPECT_GE(uv.minCoeff(), 0.0f);
    EXPECT_LE(uv.maxCoeff(), 1.0f);
  }
  for (const scene::Triangle& t : atlas.mesh.triangles) {
    used += flatArea(atlas.mesh, t);
    if (areaOf(atlas.mesh, t) > 0.0) {
      EXPECT_GT(flatArea(atlas.mesh, t), 0.0);
    }
  }
  EXPECT_NEAR(used, atlas.usedArea, 1e-4);
  const Status sound = scene::checkUvs(atlas.mesh, 200, 200);
  EXPECT_TRUE(sound) << sound.error().message;
}

TEST_P(AtlasOf, StretchesNoMoreThanItSays) {
  const float most = 1.02f;
  const Atlas atlas = automatic(theCase().mesh, {.size = 256, .maximumStretch = most});
  struct Sum {
    double squared = 0.0, area = 0.0, flat = 0.0;
    int triangles = 0;
    double stretch() const { return std::sqrt(squared / area * flat / area); }
  };
  std::map<std::uint32_t, Sum> charts;
  Sum whole;
  for (std::size_t t = 0; t < atlas.mesh.triangles.size(); ++t) {
    const scene::Triangle& triangle = atlas.mesh.triangles[t];
    const double area = areaOf(atlas.mesh, triangle);
    if (area == 0.0) continue;
    for (Sum* sum : {&charts[atlas.chartOfTriangle[t]], &whole}) {
      sum->squared += area * squaredStretch(atlas.mesh, triangle);
      sum->area += area;
      sum->flat += flatArea(atlas.mesh, triangle);
      ++sum->triangles;
    }
  }
  double worst = 1.0;
  const double density = whole.flat / whole.area;
  for (const auto& [chart, sum] : charts) {
    // Charts of a texel's size are at the mercy of rounding, and drawn larger.
    if (sum.flat < 16.0 / (256.0 * 256.0)) continue;
    EXPECT_NEAR(sum.flat / sum.area, density, 5e-3 * density);
    worst = std::max(worst, sum.stretch());
    if (sum.triangles > 1) {
      EXPECT_LE(sum.stretch(), most + 1e-3);
    }
  }
  EXPECT_NEAR(worst, atlas.worstStretch, 2e-3);
  EXPECT_NEAR(whole.stretch(), atlas.stretch, 2e-3);
  EXPECT_GE(atlas.stretch, 1.0 - 1e-6);
}

INSTANTIATE_TEST_SUITE_P(Meshes, AtlasOf, testing::Range(std::size_t(0), cases().size()),
                         [](const auto& mesh) {
                           std::string name = cases()[mesh.param].name;
                           std::replace(name.begin(), name.end(), ' ', '_');
                           return name;
                         });

TEST(Atlas, IsTheSameAtAnyNumberOfThreads) {
  const scene::Mesh mesh = scene::torus(1.0f, 0.3f, 48, 24);
  const Atlas many = automatic(mesh, {.size = 256});
  const work::ThreadLimit one(1);
  const Atlas alone = automatic(mesh, {.size = 256});
  EXPECT_EQ(many.mesh.uvs, alone.mesh.uvs);
  EXPECT_EQ(many.chartOfTriangle, alone.chartOfTriangle);
}

TEST(Atlas, DevelopableSurfacesDoNotStretch) {
  EXPECT_LT(automatic(scene::box(Vec3(1, 1, 1), 4), {.size = 256}).worstStretch, 1.0001);
  EXPECT_LT(automatic(scene::cylinder(1.0f, 1.0f, 48, 8), {.size = 256}).worstStretch, 1.005);
}

TEST(Atlas, SmoothSurfacesNeedFewChartsOfLittleStretch) {
  const Atlas sphere = automatic(scene::icosphere(1.0f, 4), {.size = 400});
  EXPECT_LE(sphere.charts, 8u);
  EXPECT_LT(sphere.worstStretch, 1.01);
  EXPECT_GT(sphere.usedArea, 0.55);
  const Atlas torus = automatic(scene::torus(1.0f, 0.4f, 64, 32), {.size = 400});
  EXPECT_LE(torus.charts, 12u);
  EXPECT_LT(torus.worstStretch, 1.02);
  EXPECT_GT(torus.usedArea, 0.55);
}

TEST(Atlas, UsedAreaIsWhatTexelsSee) {
  const int size = 512;
  const Atlas atlas = automatic(scene::icosphere(1.0f, 3), {.size = size});
  const std::vector<std::uint32_t> texels = chartOfTexel(atlas, size);
  const auto touched =
      double(texels.size() - std::count(texels.begin(), texels.end(), kNoChart)) / texels.size();
  // Touched texels are the charts' area and half of what their borders pass through, about.
  EXPECT_GT(touched, atlas.usedArea);
  EXPECT_LT(touched, atlas.usedArea + 0.03);
}

TEST(Atlas, KeepsSoundUvsByteForByte) {
  for (const scene::Mesh& mesh :
       {scene::gridPlane(1, 1, 3, 3), scene::uvSphere(1, 16, 8), scene::box(Vec3(1, 1, 1), 2)}) {
    const auto made = makeAtlas(mesh, {.size = 256}, {});
    ASSERT_TRUE(made);
    const auto& [atlas, findings] = *made;
    EXPECT_TRUE(atlas.ownUvs);
    EXPECT_EQ(atlas.mesh.uvs, mesh.uvs);
    EXPECT_EQ(atlas.mesh.triangles, mesh.triangles);
    EXPECT_EQ(atlas.mesh.positions, mesh.positions);
    EXPECT_TRUE(findings.empty()) << findings.front().message;
    for (const std::uint32_t chart : atlas.chartOfTriangle) EXPECT_LT(chart, atlas.charts);
  }
}

TEST(Atlas, OwnUvsOfAPlaneHaveItsStretch) {
  // 1 m by 4 m on a square: singular values 1 and 4 where the mean scale is 2.
  const auto made = makeAtlas(scene::gridPlane(1.0f, 4.0f, 2, 2), {.size = 64}, {});
  ASSERT_TRUE(made);
  EXPECT_EQ(made->value.charts, 1u);
  EXPECT_NEAR(made->value.stretch, std::sqrt(0.5 * (1.0 + 16.0)) / 2.0, 1e-5);
  EXPECT_NEAR(made->value.usedArea, 1.0, 1e-6);
}

void expectRefused(const scene::Mesh& mesh, const std::string& code) {
  const auto made = makeAtlas(mesh, {.size = 128}, {});
  ASSERT_TRUE(made) << made.error().message;
  const auto& [atlas, findings] = *made;
  EXPECT_FALSE(atlas.ownUvs);
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_EQ(findings[0].code, code);
  EXPECT_TRUE(scene::checkUvs(atlas.mesh, 128, 128));
}

TEST(Atlas, SaysWhyOwnUvsWereNotTaken) {
  scene::Mesh mesh = scene::gridPlane(1, 1, 4, 4);
  mesh.uvs.clear();
  expectRefused(mesh, "no-uvs");

  scene::Mesh twice[2] = {scene::gridPlane(1, 1, 2, 2),
                          scene::translated(scene::gridPlane(1, 1, 2, 2), Vec3(0, 1, 0))};
  expectRefused(scene::merge(twice), "uvs-unsound");

  // Side by side, with a gap of a tenth of a texel.
  for (Vec2& uv : twice[0].uvs) uv.x() = 0.4f * uv.x();
  for (Vec2& uv : twice[1].uvs) uv.x() = 0.4008f + 0.4f * uv.x();
  expectRefused(scene::merge(twice), "uvs-without-gutter");

  scene::Mesh collapsed = scene::gridPlane(1, 1, 2, 2);
  for (std::size_t v = 0; v < collapsed.uvs.size(); ++v)
    if (collapsed.positions[v].x() > 0.25f) collapsed.uvs[v].x() = 0.5f;
  expectRefused(collapsed, "uvs-collapsed");
}

TEST(Atlas, NotesNarrowGuttersOfUvsThatItTakes) {
  scene::Mesh twice[2] = {scene::gridPlane(1, 1, 2, 2),
                          scene::translated(scene::gridPlane(1, 1, 2, 2), Vec3(0, 1, 0))};
  for (Vec2& uv : twice[0].uvs) uv.x() = 0.25f * uv.x();
  for (Vec2& uv : twice[1].uvs) uv.x() = 0.25f + 1.0f / 128 + 0.25f * uv.x();
  const auto made = makeAtlas(scene::merge(twice), {.size = 128}, {});
  ASSERT_TRUE(made);
  const auto& [atlas, findings] = *made;
  EXPECT_TRUE(atlas.ownUvs);
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_EQ(findings[0].code, "uvs-narrow-gutter");
}

TEST(Atlas, TellsOfNonManifoldEdges) {
  const auto made = makeAtlas(fin(), {.size = 128, .ownUvs = false}, {});
  ASSERT_TRUE(made);
  const Findings& findings = made->findings;
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_EQ(findings[0].code, "non-manifold-edges");
  EXPECT_EQ(findings[0].count, 1u);
}

TEST(Atlas, RefusesWhatMakesNoSense) {
  scene::Mesh mesh = scene::icosphere(1.0f, 2);
  const auto kindOf = [&](const scene::Mesh& m, const AtlasOptions& options) {
    const auto atlas = makeAtlas(m, options, {});
    EXPECT_FALSE(atlas);
    return atlas ? ErrorKind::Failed : atlas.error().kind;
  };
  EXPECT_EQ(kindOf(mesh, {.size = 0}), ErrorKind::BadUsage);
  EXPECT_EQ(kindOf(mesh, {.size = 20000}), ErrorKind::BadUsage);
  EXPECT_EQ(kindOf(mesh, {.gutter = 0}), ErrorKind::BadUsage);
  EXPECT_EQ(kindOf(mesh, {.size = 4}), ErrorKind::BadUsage);
  EXPECT_EQ(kindOf(scene::Mesh{}, {}), ErrorKind::BadInput);
  const auto cancelled = makeAtlas(mesh, {}, [](const ProgressUpdate&) { return false; });
  ASSERT_FALSE(cancelled);
  EXPECT_EQ(cancelled.error().kind, ErrorKind::Cancelled);
}

TEST(Atlas, NoChartHasAVertexInsideThatIsToBeCut) {
  const scene::Mesh sphere = scene::icosphere(1.0f, 4);
  AtlasOptions options{.size = 512, .ownUvs = false};
  for (std::uint32_t t = 0; t < sphere.triangles.size(); t += 97) options.cutAt.push_back(3 * t);
  const Atlas atlas = automatic(sphere, options);
  for (const std::uint32_t corner : options.cutAt) {
    const std::uint32_t vertex = sphere.triangles[corner / 3][0];
    std::set<std::uint32_t> charts;
    for (std::uint32_t t = 0; t < sphere.triangles.size(); ++t)
      for (const std::uint32_t v : sphere.triangles[t])
        if (v == vertex) charts.insert(atlas.chartOfTriangle[t]);
    EXPECT_GT(charts.size(), 1u);
  }
  EXPECT_EQ(countGutters(atlas, options.size).sharedTexels, 0u);
  EXPECT_LE(atlas.charts, 6u + options.cutAt.size()) << "at most one more for each";
}

}  // namespace
}  // namespace lambent::atlas
