#include "lambent/capture/moving_scene.h"

#include <cmath>

#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <Eigen/LU>

#include "lambent/capture/surroundings.h"
#include "lambent/scene/shapes.h"
#include "lambent/scene_io/gltf_write.h"

namespace lambent::capture {
namespace {

Vec3 at(const Motion& motion, double time, const Vec3& bodyPoint = Vec3::Zero()) {
  return (worldFromBody(motion, time) * bodyPoint.homogeneous()).hnormalized();
}

TEST(Motion, StandsStillWithoutAPeriod) {
  Motion motion;
  motion.place = Vec3(1, 2, 3);
  EXPECT_TRUE(at(motion, 17).isApprox(Vec3(1, 2, 3)));
  EXPECT_TRUE(worldFromBody({}, 5).isIdentity(1e-6f));
}

TEST(Motion, OrbitsCounterClockwise) {
  Motion motion;
  motion.place = Vec3(2, 1, 0);
  motion.orbit = {Vec3::UnitY(), Vec3(0, 0, 0), 8, 0};
  // From +x a quarter turn about +y leads to −z.
  EXPECT_LT((at(motion, 2) - Vec3(0, 1, -2)).norm(), 1e-5f);
  EXPECT_LT((at(motion, 8e6) - Vec3(2, 1, 0)).norm(), 1e-4f);
  motion.orbit.phase = 0.5;
  EXPECT_LT((at(motion, 0) - Vec3(-2, 1, 0)).norm(), 1e-5f);
}

TEST(Motion, SpinsInPlaceAndSwings) {
  Motion motion;
  motion.spin = {Vec3::UnitZ(), Vec3::Zero(), 4, 0};
  motion.place = Vec3(5, 0, 0);
  motion.swing = {Vec3(0, 3, 0), 12, 0};
  EXPECT_LT((at(motion, 1, Vec3(1, 0, 0)) - Vec3(5, 1 + 1.5f, 0)).norm(), 1e-5f);
  EXPECT_LT((at(motion, 3) - Vec3(5, 3, 0)).norm(), 1e-5f);
}

TEST(Motion, IsRigid) {
  Motion motion;
  motion.spin = {Vec3(1, 2, 3).normalized(), Vec3(0, 1, 0), 3, 0.1};
  motion.orbit = {Vec3(1, 0, 1).normalized(), Vec3(2, 0, 0), 7, 0.6};
  motion.swing = {Vec3(1, 1, 1), 2, 0.2};
  for (const double time : {0.0, 0.7, 12.0}) {
    const Mat3 rotation = worldFromBody(motion, time).topLeftCorner<3, 3>();
    EXPECT_TRUE((rotation.transpose() * rotation).isIdentity(1e-5f));
    EXPECT_GT(rotation.determinant(), 0);
  }
}

TEST(MovingScene, IsFrozenIntoEmittingMeshes) {
  MovingScene scene;
  Body lamp{"lamp", scene::icosphere(1, 1), Rgb(3, 2, 1), {}};
  lamp.motion.swing = {Vec3(2, 0, 0), 4, 0};
  scene.bodies.push_back(lamp);
  const scene::Scene still = frozen(scene, 1);
  ASSERT_EQ(still.meshes.size(), 1u);
  EXPECT_LT((scene::bounds(still).center() - Vec3(2, 0, 0)).norm(), 1e-5f);
  const scene::Box box = bounds(scene, 1), exact = scene::bounds(still);
  EXPECT_TRUE((box.lower.array() <= exact.lower.array()).all());
  EXPECT_TRUE((box.upper.array() >= exact.upper.array()).all());
  EXPECT_LT(box.diagonal(), 2 * exact.diagonal());
  EXPECT_TRUE(bounds(MovingScene{}, 0).empty());
  const scene::Material& material = still.materials[std::size_t(still.meshes[0].material)];
  EXPECT_TRUE((material.emission == Rgb(3, 2, 1)).all());
  EXPECT_FALSE(material.isDiffuse());
}

TEST(MovingScene, ComesFromAFile) {
  scene::Scene file;
  scene::Material lamp, wall;
  lamp.name = "lamp";
  lamp.emission = Rgb(40, 20, 5);
  scene::addTo(file, scene::translated(scene::icosphere(1, 1), Vec3(0, 3, 0)), lamp);
  scene::addTo(file, scene::box(Vec3(1, 1, 1)), wall);
  const std::filesystem::path path =
      std::filesystem::path(testing::TempDir()) / "lambent_moving_scene_test.glb";
  ASSERT_TRUE(scene_io::saveGlb(file, path));
  const auto loaded = loadMovingScene(path);
  ASSERT_TRUE(loaded) << loaded.error().message;
  ASSERT_EQ(loaded->scene.bodies.size(), 2u);
  EXPECT_TRUE(loaded->scene.bodies[0].radiance.isApprox(Rgb(40, 20, 5), 1e-5f));
  EXPECT_TRUE((loaded->scene.bodies[1].radiance == 0).all());
  EXPECT_EQ(loaded->scene.bodies[1].name, file.meshes[1].name);

  scene::Scene dark = scene::sceneOf(scene::box(Vec3(1, 1, 1)));
  ASSERT_TRUE(scene_io::saveGlb(dark, path));
  const auto occluders = loadMovingScene(path);
  ASSERT_TRUE(occluders);
  EXPECT_EQ(occluders->findings.back().code, "no-lamps");
  std::filesystem::remove(path);
  EXPECT_FALSE(loadMovingScene(path));
}

TEST(MovingScene, StaysInItsPlaceAboutAnotherOrigin) {
  const scene::Box object{Vec3(-1, -1, -1), Vec3(1, 1, 1)};
  MovingScene scene = demoSurroundings(object);
  scene.origin = Vec3d(500'000, 0, -4'000'000);
  const Vec3d offset(16, -8, 4);
  const MovingScene moved = about(scene, scene.origin - offset);
  EXPECT_EQ(moved.origin, scene.origin - offset);
  ASSERT_EQ(moved.bodies.size(), scene.bodies.size());
  for (std::size_t i = 0; i < scene.bodies.size(); ++i)
    for (const double time : {0.0, 1.3, 17.0}) {
      Mat4 expected = worldFromBody(scene.bodies[i].motion, time);
      expected.topRightCorner<3, 1>() += offset.cast<float>();
      EXPECT_TRUE(worldFromBody(moved.bodies[i].motion, time).isApprox(expected, 1e-5f));
    }
}

TEST(Surroundings, NeverTouchTheObject) {
  const scene::Box box{Vec3(2, -1, 0), Vec3(5, 3, 1)};
  const MovingScene scene = demoSurroundings(box);
  for (double time = 0; time < 60; time += 0.5)
    for (const scene::Mesh& mesh : frozen(scene, time).meshes)
      for (const Vec3& p : mesh.positions)
        EXPECT_GT((p - box.center()).norm(), 0.5f * box.diagonal()) << mesh.name << " " << time;
}

}  // namespace
}  // namespace lambent::capture
