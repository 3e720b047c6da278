#include <cmath>

#include <gtest/gtest.h>

#include "lambent/scene/scene.h"

namespace lambent::scene {
namespace {

Texture texture2x1() {
  Texture t;
  t.width = 2;
  t.height = 1;
  t.rgba = {0, 128, 255, 255, 255, 128, 0, 255};
  return t;
}

TEST(Surface, TexelCentresGiveTheLinearisedTexel) {
  const Texture t = texture2x1();
  const Rgb left = sampleBaseColor(t, Vec2(0.25f, 0.5f));
  EXPECT_FLOAT_EQ(left.x(), 0.0f);
  EXPECT_NEAR(left.y(), 0.2158605f, 1e-6f);  // sRGB 128/255
  EXPECT_FLOAT_EQ(left.z(), 1.0f);
}

TEST(Surface, FilteringIsLinearInLight) {
  EXPECT_NEAR(sampleBaseColor(texture2x1(), Vec2(0.5f, 0.3f)).x(), 0.5f, 1e-6f);
}

TEST(Surface, WrappingRules) {
  Texture t = texture2x1();
  EXPECT_NEAR(sampleBaseColor(t, Vec2(0.0f, 0.5f)).x(), 0.5f, 1e-6f);
  EXPECT_NEAR(sampleBaseColor(t, Vec2(1.25f, 0.5f)).x(), 0.0f, 1e-6f);
  EXPECT_NEAR(sampleBaseColor(t, Vec2(-0.25f, 0.5f)).x(), 1.0f, 1e-6f);
  t.wrapU = Wrap::ClampToEdge;
  EXPECT_NEAR(sampleBaseColor(t, Vec2(0.0f, 0.5f)).x(), 0.0f, 1e-6f);
  EXPECT_NEAR(sampleBaseColor(t, Vec2(7.0f, 0.5f)).x(), 1.0f, 1e-6f);
  t.wrapU = Wrap::MirroredRepeat;
  EXPECT_NEAR(sampleBaseColor(t, Vec2(1.25f, 0.5f)).x(), 1.0f, 1e-6f);
  EXPECT_NEAR(sampleBaseColor(t, Vec2(-0.25f, 0.5f)).x(), 0.0f, 1e-6f);
  EXPECT_TRUE(sampleBaseColor(t, Vec2(NAN, INFINITY)).allFinite());
  EXPECT_TRUE(sampleBaseColor(t, Vec2(1e30f, -1e30f)).allFinite());
  EXPECT_TRUE((sampleBaseColor(Texture(), Vec2(0, 0)) == 1.0f).all());
}

Scene triangleScene() {
  Scene scene;
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}};
  mesh.normals = {Vec3(-1, 0, 1).normalized(), Vec3(1, 0, 1).normalized(), {0, 0, 1}};
  mesh.uvs = {{0.25f, 0.5f}, {0.75f, 0.5f}, {0.25f, 0.5f}};
  mesh.colors = {Rgb(1, 1, 1), Rgb(0.5f, 1, 1), Rgb(1, 1, 0)};
  mesh.triangles = {{0, 1, 2}};
  scene.meshes = {mesh};
  Material material;
  material.diffuse = Rgb(0.5f, 0.5f, 0.5f);
  material.glossy = Rgb(0.25f, 0.25f, 0.25f);
  material.mirror = Rgb(0.1f, 0.2f, 0.3f);
  material.lobeExponent = 9.0f;
  material.baseColorTexture = 0;
  scene.materials = {material};
  scene.textures = {texture2x1()};
  return scene;
}

TEST(Surface, BaseColourMultipliesAllThreeReflectances) {
  const SurfacePoint p = surfaceAt(triangleScene(), 0, 0, 1.0f, 0.0f);
  EXPECT_TRUE(p.position.isApprox(Vec3(2, 0, 0)));
  EXPECT_TRUE(p.diffuse.isApprox(Rgb(0.25f, 0.5f * 0.2158605f, 0.0f), 1e-5f));
  EXPECT_TRUE(p.glossy.isApprox(Rgb(0.125f, 0.25f * 0.2158605f, 0.0f), 1e-5f));
  EXPECT_TRUE(p.mirror.isApprox(Rgb(0.05f, 0.2f * 0.2158605f, 0.0f), 1e-5f));
  EXPECT_EQ(p.lobeExponent, 9.0f);
  const SurfacePoint q = surfaceAtVertex(triangleScene(), 0, 1);
  EXPECT_TRUE(q.diffuse.isApprox(p.diffuse));
  EXPECT_TRUE(q.normal.isApprox(p.normal));
  EXPECT_TRUE(q.geometricNormal.isApprox(q.normal));
}

TEST(Surface, NormalsAreInterpolatedAndUnit) {
  const SurfacePoint p = surfaceAt(triangleScene(), 0, 0, 0.5f, 0.0f);
  EXPECT_TRUE(p.normal.isApprox(Vec3::UnitZ(), 1e-6f));
  EXPECT_TRUE(p.geometricNormal.isApprox(Vec3::UnitZ()));
  const SurfacePoint q = surfaceAt(triangleScene(), 0, 0, 0.3f, 0.3f);
  EXPECT_NEAR(q.normal.norm(), 1.0f, 1e-6f);
}

TEST(Surface, NormalsStayOnTheFrontAndDegenerateOnesAreGuarded) {
  Scene scene = triangleScene();
  scene.meshes[0].normals.assign(3, Vec3(1, 0, -0.1f).normalized());
  EXPECT_GT(surfaceAt(scene, 0, 0, 0.3f, 0.3f).normal.z(), 0.0f);
  scene.meshes[0].normals = {{0, 0, 1}, {0, 0, -1}, {0, 0, 1}};
  EXPECT_TRUE(surfaceAt(scene, 0, 0, 0.5f, 0.0f).normal.isApprox(Vec3::UnitZ()));
  scene.meshes[0].positions.assign(3, Vec3(1, 1, 1));
  const SurfacePoint p = surfaceAt(scene, 0, 0, 0.5f, 0.0f);
  EXPECT_NEAR(p.normal.norm(), 1.0f, 1e-6f);
  EXPECT_NEAR(p.geometricNormal.norm(), 1.0f, 1e-6f);
}

TEST(Surface, BoundsCoverAllMeshes) {
  Scene scene = triangleScene();
  EXPECT_TRUE(bounds(Scene()).empty());
  EXPECT_TRUE(bounds(scene).upper.isApprox(Vec3(2, 2, 0)));
  EXPECT_FLOAT_EQ(bounds(scene).diagonal(), std::sqrt(8.0f));
}

}  // namespace
}  // namespace lambent::scene
