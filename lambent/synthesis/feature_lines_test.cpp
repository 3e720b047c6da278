#include "lambent/synthesis/feature_lines.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "lambent/scene/shapes.h"

namespace lambent::synthesis {
namespace {

std::vector<FeatureLine> linesOf(const scene::Mesh& mesh, const FeatureOptions& options = {}) {
  return featureLines(mesh, manifoldOf(mesh), options);
}

TEST(FeatureLines, OfABoxAreItsTwelveEdges) {
  const auto lines = linesOf(scene::box(Vec3(1, 2, 3), 4));
  ASSERT_EQ(lines.size(), 12u);
  for (const float length : {1.0f, 2.0f, 3.0f})
    EXPECT_EQ(std::count_if(lines.begin(), lines.end(),
                            [&](const auto& l) { return std::abs(l.length - length) < 1e-5; }),
              4);
  for (const FeatureLine& line : lines) EXPECT_EQ(line.steps.size(), 4u);
}

TEST(FeatureLines, OfASheetAreItsBordersFromCornerToCorner) {
  const auto lines = linesOf(scene::gridPlane(2, 1, 5, 3));
  ASSERT_EQ(lines.size(), 4u);
  double sum = 0.0;
  for (const FeatureLine& line : lines) sum += line.length;
  EXPECT_NEAR(sum, 6.0, 1e-5);
}

TEST(FeatureLines, GoRoundAndRunOnFromVertexToVertex) {
  const scene::Mesh mesh = scene::cylinder(1.0f, 2.0f, 24, 3);
  const Manifold m = manifoldOf(mesh);
  const auto lines = featureLines(mesh, m);
  ASSERT_EQ(lines.size(), 2u);
  for (const FeatureLine& line : lines) {
    EXPECT_EQ(line.steps.size(), 24u);
    const auto ends = [&](const FeatureLine::Step& s) {
      const std::uint32_t tail = m.vertexOfCorner[s.halfEdge];
      const std::uint32_t head = m.vertexOfCorner[Manifold::next(s.halfEdge)];
      return s.reversed ? std::pair(head, tail) : std::pair(tail, head);
    };
    for (std::size_t k = 0; k < line.steps.size(); ++k)
      EXPECT_EQ(ends(line.steps[k]).second, ends(line.steps[(k + 1) % line.steps.size()]).first);
  }
}

TEST(FeatureLines, WhatIsRoundHasNoneAndWhatIsShortIsNoise) {
  EXPECT_TRUE(linesOf(scene::icosphere(1, 3)).empty());
  EXPECT_TRUE(linesOf(scene::torus(1, 0.4f, 40, 20)).empty());
  // A pyramid of four edges on a large sheet.
  scene::Mesh dented = scene::gridPlane(20, 20, 40, 40);
  dented.positions[20 * 41 + 20].y() = 1.0f;
  EXPECT_GT(linesOf(dented, {.least = 0.1f}).size(), 4u);
  EXPECT_EQ(linesOf(dented, {.least = 0.6f}).size(), 4u) << "the borders alone";
}

}  // namespace
}  // namespace lambent::synthesis
