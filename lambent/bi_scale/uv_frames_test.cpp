#include "lambent/bi_scale/uv_frames.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "lambent/scene/shapes.h"

namespace lambent::bi_scale {
namespace {

TEST(UvTangents, OfAPlaneFollowUAndItsBitangentTheOtherWayOfV) {
  const scene::Mesh plane = scene::gridPlane(2, 3, 4, 5);  // u along +x, v along +z, front +y
  const auto made = uvTangents(plane);
  ASSERT_TRUE(made);
  const auto& [tangents, findings] = *made;
  EXPECT_TRUE(findings.empty());
  for (const Vec3& t : tangents) {
    EXPECT_LT((t - Vec3(1, 0, 0)).norm(), 1e-6f);
    EXPECT_LT((Vec3(0, 1, 0).cross(t) - Vec3(0, 0, -1)).norm(), 1e-6f);
  }
  const Vec2 metres = metresPerUv(plane);
  EXPECT_NEAR(metres.x(), 2, 1e-5f);
  EXPECT_NEAR(metres.y(), 3, 1e-5f);
}

TEST(UvTangents, OfTheShapesAreUnitAtRightAnglesAndNotMirrored) {
  for (const scene::Mesh& mesh : {scene::uvSphere(2, 24, 12), scene::torus(1, 0.3f, 24, 12),
                                  scene::box(Vec3(1, 2, 3), 2), scene::cylinder(1, 2, 16, 3)}) {
    const auto made = uvTangents(mesh);
    ASSERT_TRUE(made);
    const auto& [tangents, findings] = *made;
    for (const Finding& finding : findings) EXPECT_NE(finding.code, "mirrored-uvs") << mesh.name;
    for (std::size_t v = 0; v < tangents.size(); ++v) {
      EXPECT_NEAR(tangents[v].norm(), 1, 1e-5f);
      EXPECT_NEAR(tangents[v].dot(mesh.normals[v]), 0, 1e-5f);
    }
  }
}

TEST(UvTangents, MirroredUvsAreTold) {
  scene::Mesh plane = scene::gridPlane(1, 1, 3, 3);
  for (Vec2& uv : plane.uvs) uv.x() = 1 - uv.x();
  const auto made = uvTangents(plane);
  ASSERT_TRUE(made);
  const Findings& findings = made->findings;
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_EQ(findings[0].code, "mirrored-uvs");
  EXPECT_EQ(findings[0].count, 18u);
}

TEST(UvTangents, UvsOfNoAreaGetSomeTangent) {
  scene::Mesh plane = scene::gridPlane(1, 1, 2, 2);
  for (Vec2& uv : plane.uvs) uv = Vec2(0.5f, 0.5f);
  const auto made = uvTangents(plane);
  ASSERT_TRUE(made);
  const auto& [tangents, findings] = *made;
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_EQ(findings[0].code, "degenerate-uvs");
  for (const Vec3& t : tangents) {
    EXPECT_NEAR(t.norm(), 1, 1e-5f);
    EXPECT_NEAR(t.y(), 0, 1e-5f);
  }
}

TEST(UvTangents, NeedUvs) {
  const scene::Mesh sphere = scene::icosphere(1, 1);
  const auto tangents = uvTangents(sphere);
  ASSERT_FALSE(tangents);
  EXPECT_EQ(tangents.error().kind, ErrorKind::BadInput);
}

}  // namespace
}  // namespace lambent::bi_scale
