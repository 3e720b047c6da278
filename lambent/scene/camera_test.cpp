#include "lambent/scene/camera.h"

#include <cmath>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

namespace lambent::scene {
namespace {

Mat4 pose() {
  Eigen::Affine3d m = Eigen::Translation3d(1.0, -2.0, 3.5) *
                      Eigen::AngleAxisd(0.7, Vec3d(1.0, 2.0, -0.5).normalized());
  return m.matrix().cast<float>();
}

Box boxAround(const Vec3& center, float radius) {
  Box box;
  box.extend(center - Vec3::Constant(radius));
  box.extend(center + Vec3::Constant(radius));
  return box;
}

// A point on the ray through image point (x, y) must project to (x, y): CPU rays and GL pictures
// show the same picture.
void expectAgreement(const Camera& camera, int width, int height) {
  const Ray middle = cameraRay(camera, width, height, 0.5f * width, 0.5f * height);
  const Box box = boxAround(middle.origin + 5.0f * middle.direction, 1.0f);
  const Mat4 clip = clipFromWorld(camera, width, height, box);
  for (float x : {0.0f, 0.5f, 17.25f, 0.5f * width, float(width)}) {
    for (float y : {0.0f, 0.5f, 31.0f, 0.5f * height, float(height)}) {
      const Ray ray = cameraRay(camera, width, height, x, y);
      EXPECT_NEAR(ray.direction.norm(), 1.0f, 1e-6f);
      for (float t : {4.2f, 5.0f, 5.9f}) {
        const Eigen::Vector4f p = clip * Vec3(ray.origin + t * ray.direction).homogeneous();
        EXPECT_GT(p.w(), 0.0f);
        const Vec3 ndc = p.hnormalized();
        EXPECT_NEAR((ndc.x() + 1.0f) * 0.5f * width, x, 2e-3f);
        EXPECT_NEAR((1.0f - ndc.y()) * 0.5f * height, y, 2e-3f);
      }
    }
  }
  const auto depth = [&](const Vec3& p) { return (clip * p.homogeneous()).hnormalized().z(); };
  EXPECT_LT(depth(box.center() - 0.5f * middle.direction), depth(box.center()));
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 p((corner & 1 ? box.upper : box.lower).x(), (corner & 2 ? box.upper : box.lower).y(),
                 (corner & 4 ? box.upper : box.lower).z());
    EXPECT_LE(std::abs(depth(p)), 1.0f);
  }
}

TEST(Camera, PerspectiveRaysAgreeWithTheClipMatrix) {
  Camera camera;
  camera.worldFromCamera = pose();
  camera.verticalFov = 0.9f;
  expectAgreement(camera, 640, 480);
  expectAgreement(camera, 301, 517);
}

TEST(Camera, OrthographicRaysAgreeWithTheClipMatrix) {
  Camera camera;
  camera.worldFromCamera = pose();
  camera.orthographicHalfHeight = 1.3f;
  expectAgreement(camera, 640, 480);
  expectAgreement(camera, 301, 517);
}

TEST(Camera, TheCentreLooksAlongMinusZAndTheTopIsUp) {
  const Camera camera;
  EXPECT_TRUE(cameraRay(camera, 100, 50, 50.0f, 25.0f).direction.isApprox(-Vec3::UnitZ()));
  EXPECT_GT(cameraRay(camera, 100, 50, 50.0f, 0.0f).direction.y(), 0.0f);
  EXPECT_GT(cameraRay(camera, 100, 50, 100.0f, 25.0f).direction.x(), 0.0f);
}

TEST(Camera, ClipMatrixSurvivesACameraInsideTheBox) {
  Camera camera;
  const Mat4 clip = clipFromWorld(camera, 64, 64, boxAround(Vec3::Zero(), 2.0f));
  EXPECT_TRUE(clip.allFinite());
  EXPECT_TRUE(clipFromWorld(camera, 64, 64, Box()).allFinite());
  EXPECT_TRUE(clipFromWorld(camera, 64, 64, boxAround(Vec3(0, 0, 50), 1.0f)).allFinite());
}

TEST(Camera, AutomaticFramingShowsAllAndFillsThePicture) {
  Scene scene;
  scene.meshes.emplace_back();
  for (int i = 0; i < 200; ++i) {
    const float a = 0.37f * float(i), h = float(i % 17) / 17.0f;
    scene.meshes[0].positions.push_back(Vec3(3.0f * std::cos(a), 7.0f + h, 0.5f * std::sin(a)));
  }
  for (float aspect : {0.5f, 1.0f, 2.4f}) {
    const int height = 400, width = int(aspect * 400);
    const Camera camera = frameAutomatically(scene, aspect);
    const Mat4 clip = clipFromWorld(camera, width, height, bounds(scene));
    Vec2 lower(9, 9), upper(-9, -9);
    for (const Vec3& p : scene.meshes[0].positions) {
      const Vec3 ndc = (clip * p.homogeneous()).hnormalized();
      EXPECT_LT(ndc.cwiseAbs().maxCoeff(), 1.0f);
      lower = lower.cwiseMin(ndc.head<2>());
      upper = upper.cwiseMax(ndc.head<2>());
    }
    EXPECT_NEAR((upper - lower).maxCoeff(), 1.86f, 0.01f);
  }
  EXPECT_TRUE(frameAutomatically(Scene(), 1.0f).worldFromCamera.allFinite());
}

TEST(Camera, SubpixelPositionsAreStratifiedAndCentred) {
  EXPECT_TRUE(subpixelPositions(1)[0].isApprox(Vec2(0.5f, 0.5f)));
  for (int count : {2, 3, 4, 7, 16, 33, 64}) {
    const std::vector<Vec2> positions = subpixelPositions(count);
    ASSERT_EQ(int(positions.size()), count);
    std::vector<int> columns(count), rows(count);
    Vec2 sum = Vec2::Zero();
    for (const Vec2& p : positions) {
      ++columns.at(int(p.x() * count));
      ++rows.at(int(p.y() * count));
      sum += p;
    }
    EXPECT_TRUE((sum / float(count)).isApprox(Vec2(0.5f, 0.5f), 1e-5f));
    for (int i = 0; i < count; ++i) {
      EXPECT_EQ(columns[i], 1);
      EXPECT_EQ(rows[i], 1);
    }
  }
}

}  // namespace
}  // namespace lambent::scene
