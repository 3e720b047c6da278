#include "lambent/scene/half_edges.h"

#include <gtest/gtest.h>

namespace lambent::scene {
namespace {

HalfEdges of(const std::vector<Triangle>& triangles) {
  return halfEdges(triangles, std::vector<std::uint8_t>(triangles.size(), 0));
}

TEST(HalfEdges, TwoTrianglesWoundAlikeHangTogether) {
  const HalfEdges edges = of({{0, 1, 2}, {2, 1, 3}});
  EXPECT_EQ(edges.twin[1], 3u);
  EXPECT_EQ(edges.twin[3], 1u);
  EXPECT_EQ(edges.borderEdges, 4u);
  EXPECT_EQ(edges.nonManifoldEdges + edges.inconsistentEdges, 0u);
}

TEST(HalfEdges, ThreeAtAnEdgeAndTwoAgainstEachOtherAreCut) {
  EXPECT_EQ(of({{0, 1, 2}, {1, 2, 3}}).inconsistentEdges, 1u);
  const HalfEdges fin = of({{0, 1, 2}, {2, 1, 3}, {1, 2, 4}});
  EXPECT_EQ(fin.nonManifoldEdges, 1u);
  EXPECT_EQ(fin.twin[1], HalfEdges::kNone);
}

TEST(HalfEdges, EitherSideOfALeafIsASheet) {
  const HalfEdges leaf = of({{0, 1, 2}, {2, 1, 3}, {0, 2, 1}, {1, 2, 3}});
  EXPECT_EQ(leaf.nonManifoldEdges, 0u);
  EXPECT_EQ(leaf.twin[1] / 3, 1u);  // the fronts
  EXPECT_EQ(leaf.twin[7] / 3, 3u);  // the backs
  EXPECT_EQ(leaf.twin[0] / 3, 2u);  // and round its border from one to the other
}

TEST(HalfEdges, TwoSheetsThatCrossAreCut) {
  EXPECT_EQ(of({{0, 1, 2}, {1, 0, 3}, {0, 1, 4}, {1, 0, 5}}).nonManifoldEdges, 1u);
}

TEST(HalfEdges, WhatIsLeftOutHasNoPart) {
  const std::vector<Triangle> triangles = {{0, 1, 2}, {2, 1, 3}, {1, 2, 4}};
  const HalfEdges edges = halfEdges(triangles, std::vector<std::uint8_t>{0, 0, 1});
  EXPECT_EQ(edges.twin[1], 3u);
  EXPECT_EQ(edges.twin[6], HalfEdges::kNone);
}

}  // namespace
}  // namespace lambent::scene
