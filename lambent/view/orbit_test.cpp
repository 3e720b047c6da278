#include "lambent/view/orbit.h"

#include <gtest/gtest.h>

#include <random>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "lambent/scene/camera.h"
#include "lambent/scene/shapes.h"
#include "lambent/view/placement.h"

namespace lambent::view {
namespace {

LookAt somewhere() {
  LookAt look;
  look.position = Vec3(2, 1.5f, 3);
  look.target = Vec3(0.5f, 0.2f, -0.3f);
  look.verticalFov = 50;
  return look;
}

double distanceOf(const LookAt& look) {
  return (look.position - look.target).norm();
}

/// Where a point of the world is in the picture, in heights of the picture from its middle.
Vec2 inPicture(const LookAt& look, const Vec3& point) {
  const scene::Camera camera = cameraOf(look);
  const Eigen::Matrix4d cameraFromWorld = camera.worldFromCamera.cast<double>().inverse();
  const Eigen::Vector4d p = cameraFromWorld * point.cast<double>().homogeneous();
  const double height = look.orthographicHalfHeight
                            ? 2.0 * *look.orthographicHalfHeight
                            : -2.0 * p.z() * std::tan(0.5 * double(camera.verticalFov));
  return Vec2(float(p.x() / height), float(p.y() / height));
}

TEST(Orbit, KeepsDistanceTargetAndHorizon) {
  LookAt look = somewhere();
  const double distance = distanceOf(look);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> angle(-1.5, 1.5);
  for (int step = 0; step < 200; ++step) {
    look = orbited(look, angle(random), angle(random));
    EXPECT_NEAR(distanceOf(look), distance, 1e-4 * distance);
    EXPECT_EQ(look.target, somewhere().target);
    EXPECT_NEAR(cameraOf(look).worldFromCamera(1, 0), 0.0, 1e-5);  // right stays level
    EXPECT_GT(cameraOf(look).worldFromCamera(1, 1), 0.0);          // never on its head
  }
}

TEST(Orbit, GoesToTheRightAndUpwards) {
  LookAt look;
  look.position = Vec3(0, 0, 4), look.target = Vec3::Zero();
  EXPECT_TRUE(orbited(look, kPi / 2, 0).position.isApprox(Vec3(4, 0, 0), 1e-5f));
  const Vec3 risen = orbited(look, 0, kPi / 6).position;
  EXPECT_TRUE(risen.isApprox(Vec3(0, 2, 4 * std::sqrt(0.75f)), 1e-5f)) << risen.transpose();
}

TEST(Orbit, StopsBeforeThePoles) {
  for (const double direction : {1.0, -1.0}) {
    LookAt look = somewhere();
    for (int step = 0; step < 50; ++step) look = orbited(look, 0.1, direction * 0.2);
    const Vec3 back = (look.position - look.target).normalized();
    EXPECT_NEAR(back.y(), direction * std::cos(kPi / 180), 1e-4);
    // and comes back from there
    EXPECT_NEAR(std::asin((orbited(look, 0, direction * -0.5).position - look.target).y() /
                          distanceOf(look)),
                direction * (kPi / 2 - kPi / 180 - 0.5), 1e-3);
  }
}

TEST(Orbit, ThereAndBackIsNothing) {
  const LookAt look = somewhere();
  EXPECT_TRUE(orbited(orbited(look, 0.7, 0.3), -0.7, -0.3).position.isApprox(look.position, 1e-5f));
}

TEST(Pan, MovesInTheViewPlaneWithThePointer) {
  for (const std::optional<double>& half : {std::optional<double>(), std::optional<double>(0.8)}) {
    LookAt look = somewhere();
    look.orthographicHalfHeight = half;
    const LookAt moved = panned(look, Vec2(0.25f, -0.1f));
    const Vec3 sight = (look.target - look.position).normalized();
    EXPECT_NEAR((moved.target - look.target).dot(sight), 0.0, 1e-5);
    EXPECT_TRUE((moved.position - look.position).isApprox(moved.target - look.target, 1e-5f));
    EXPECT_TRUE(inPicture(moved, look.target).isApprox(Vec2(0.25f, -0.1f), 1e-4f));
  }
}

TEST(Zoom, KeepsWhatIsUnderThePointer) {
  const Vec2 pointer(0.3f, 0.4f);
  for (const std::optional<double>& half : {std::optional<double>(), std::optional<double>(0.8)}) {
    LookAt look = somewhere();
    look.orthographicHalfHeight = half;
    // The point of the target's plane that the pointer is over.
    const LookAt aside = panned(look, -pointer);
    const Vec3 under = aside.target;
    ASSERT_TRUE(inPicture(look, under).isApprox(pointer, 1e-4f));
    for (const double factor : {0.5, 1.7}) {
      const LookAt near = zoomed(look, factor, pointer, 1e-3, 1e3);
      EXPECT_TRUE(inPicture(near, under).isApprox(pointer, 1e-4f));
      if (half)
        EXPECT_NEAR(*near.orthographicHalfHeight, *half * factor, 1e-9);
      else
        EXPECT_NEAR(distanceOf(near), factor * distanceOf(look), 1e-5);
    }
  }
}

TEST(Zoom, StopsNearAndFar) {
  LookAt look = somewhere();
  for (int i = 0; i < 100; ++i) look = zoomed(look, 0.5, Vec2(0.1f, 0), 0.5, 20);
  EXPECT_NEAR(distanceOf(look), 0.5, 1e-4);
  for (int i = 0; i < 100; ++i) look = zoomed(look, 2, Vec2(0.1f, 0), 0.5, 20);
  EXPECT_NEAR(distanceOf(look), 20, 1e-2);
}

TEST(Frame, ShowsTheWholeBoxAndNoMoreThanThat) {
  scene::Box box;
  box.extend(Vec3(-1, 0, 2)), box.extend(Vec3(3, 0.5f, 7));
  for (const double aspect : {0.4, 1.0, 2.5})
    for (const std::optional<double>& half : {std::optional<double>(), std::optional<double>(9)})
      for (const double turn : {0.0, 1.0, 2.5}) {
        LookAt look = orbited(somewhere(), turn, 0.2);
        look.orthographicHalfHeight = half;
        const LookAt all = framed(look, box, aspect);
        EXPECT_TRUE((all.position - all.target)
                        .normalized()
                        .isApprox((look.position - look.target).normalized(), 1e-4f));
        float farthest = 0.0f;
        for (int corner = 0; corner < 8; ++corner) {
          const Vec3 p((corner & 1 ? box.upper : box.lower).x(),
                       (corner & 2 ? box.upper : box.lower).y(),
                       (corner & 4 ? box.upper : box.lower).z());
          EXPECT_GT((p - all.position).dot(all.target - all.position), 0.0f);
          const Vec2 at = inPicture(all, p);
          farthest =
              std::max({farthest, std::abs(at.x()) / float(0.5 * aspect), std::abs(at.y()) / 0.5f});
        }
        EXPECT_LE(farthest, 0.9301f);
        EXPECT_GE(farthest, 0.92f);
      }
}

TEST(Frame, OfNothingChangesNothing) {
  EXPECT_TRUE(framed(somewhere(), scene::Box(), 1.0) == somewhere());
}

TEST(LookAt, IsTheCameraItWasMadeFrom) {
  scene::Scene scene;
  scene::addTo(scene, scene::uvSphere(0.7f, 16, 8), {});
  const scene::Box box = scene::bounds(scene);
  scene::Camera rolled = scene::frameAutomatically(scene, 1.5f);
  rolled.worldFromCamera.topLeftCorner<3, 3>() *=
      Eigen::AngleAxisf(0.4f, Vec3::UnitZ()).toRotationMatrix();
  scene::Camera flat = scene::frameAutomatically(scene, 1.5f);
  flat.orthographicHalfHeight = 2.0f;
  scene::Camera down;  // looks straight down
  down.worldFromCamera.topLeftCorner<3, 3>() << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  down.worldFromCamera(1, 3) = 5;
  scene::Camera away;  // looks away from the sphere
  away.worldFromCamera(2, 3) = -5;
  for (const scene::Camera& camera :
       {scene::frameAutomatically(scene, 1.5f), rolled, flat, down, away}) {
    const LookAt look = lookAtOf(camera, box);
    const scene::Camera back = cameraOf(look);
    EXPECT_TRUE(back.worldFromCamera.isApprox(camera.worldFromCamera, 1e-5f))
        << back.worldFromCamera << "\n"
        << camera.worldFromCamera;
    EXPECT_NEAR(back.verticalFov, camera.verticalFov, 1e-6);
    EXPECT_EQ(back.orthographicHalfHeight, camera.orthographicHalfHeight);
    // What a hand can do from there has no hole in it.
    EXPECT_TRUE(orbited(look, 0.1, 0.1).position.allFinite());
  }
  EXPECT_EQ(lookAtOf(scene::frameAutomatically(scene, 1.5f), box).up, Vec3(Vec3::UnitY()));
}

}  // namespace
}  // namespace lambent::view
