#include "lambent/transport/texel_charts.h"

#include <gtest/gtest.h>

#include "lambent/scene/shapes.h"

namespace lambent::transport {
namespace {

/// Charts of n×n squares, side by side with `gap` texels between them, of a grid of `texels`.
scene::Mesh squares(int n, float gap, int texels) {
  scene::Mesh all;
  const float pitch = 1.0f / float(n), half = 0.5f * gap / float(texels);
  std::vector<scene::Mesh> parts;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      scene::Mesh part = scene::translated(scene::gridPlane(1, 1, 2, 2),
                                           Vec3(2.0f * float(i), 0, 2.0f * float(j)));
      for (Vec2& uv : part.uvs)
        uv = Vec2(pitch * float(i) + half, pitch * float(j) + half) + (pitch - 2.0f * half) * uv;
      parts.push_back(std::move(part));
    }
  return scene::merge(parts);
}

Findings findingsOf(const scene::Mesh& mesh, int texels) {
  const scene::Scene scene = scene::sceneOf(mesh);
  const auto receivers = placeReceivers(scene, {{{0, texels, texels}}, {}}, 0.0f);
  EXPECT_TRUE(receivers) << receivers.error().message;
  return chartFindings(scene, *receivers);
}

TEST(TexelCharts, AreWhatHangsTogether) {
  const scene::Mesh mesh = squares(3, 1.0f, 30);
  const std::vector<std::uint32_t> charts = chartsOf(mesh);
  for (std::size_t t = 0; t < charts.size(); ++t) EXPECT_EQ(charts[t], t / 8);
  EXPECT_TRUE(tinyCharts(mesh, 30, 30).empty());
}

TEST(TexelCharts, AreThoseOfTheTexelUvs) {
  scene::Mesh mesh = squares(4, 2.0f, 32);
  mesh.texelUvs = mesh.uvs;
  for (Vec2& uv : mesh.uvs) uv = Vec2(0.5f, 0.5f) + 7.0f * uv;  // fit for nothing but a texture
  EXPECT_TRUE(findingsOf(mesh, 32).empty());
  EXPECT_EQ(chartsOf(mesh), chartsOf(squares(4, 2.0f, 32)));
}

TEST(TexelCharts, WithoutAGutterIsSaid) {
  EXPECT_TRUE(findingsOf(squares(4, 2.0f, 32), 32).empty());
  EXPECT_TRUE(findingsOf(scene::gridPlane(1, 1, 8, 8), 8).empty());
  EXPECT_TRUE(findingsOf(scene::uvSphere(1, 32, 16), 64).empty());
  const Findings found = findingsOf(squares(4, 0.0f, 32), 32);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].code, "uvs-without-gutter");
}

TEST(TexelCharts, ATinyChartGetsTheFreeTexelsAroundIt) {
  scene::Mesh large = scene::gridPlane(1, 1, 1, 1), small = scene::gridPlane(1, 1, 1, 1);
  for (Vec2& uv : large.uvs) uv = 0.5f * uv;
  for (Vec2& uv : small.uvs) uv = Vec2(0.75f, 0.75f) + 0.01f * uv;
  const scene::Mesh parts[] = {large, scene::translated(small, Vec3(0, -3, 0))};
  const scene::Mesh both = scene::merge(parts);
  ASSERT_EQ(tinyCharts(both, 16, 16).size(), 1u);
  const scene::Scene scene = scene::sceneOf(both);
  const auto receivers = placeReceivers(scene, {{{0, 16, 16}}, {}}, 0.0f);
  ASSERT_TRUE(receivers);
  const std::uint32_t own = receivers->meshes[0].receiverOfTexel[12 * 16 + 12];
  EXPECT_NEAR(receivers->positions[own].y(), -3.0f, 1e-6f);
  EXPECT_EQ(receivers->meshes[0].receiverOfTexel[11 * 16 + 11], own);
  EXPECT_TRUE(chartFindings(scene, *receivers).empty());

  // Where others have all of the texels, there is none for it.
  for (Vec2& uv : large.uvs) uv = 2.0f * uv;
  const scene::Mesh full[] = {large, scene::translated(small, Vec3(0, -3, 0))};
  const Findings found = findingsOf(scene::merge(full), 16);
  ASSERT_FALSE(found.empty());
  EXPECT_EQ(found[0].code, "uvs-tiny-charts");
}

}  // namespace
}  // namespace lambent::transport
