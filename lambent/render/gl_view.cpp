#include "lambent/render/gl_view.h"

#include <Eigen/LU>

namespace lambent::render {
namespace {

/// clipFromWorld, shifted so that what stands at `place` of each pixel comes to stand at the
/// pixel's centre, which is where GL samples.
Mat4 shifted(const Mat4& clipFromWorld, const Vec2& place, int width, int height) {
  Mat4 result = clipFromWorld;
  result.row(0) += (0.5f - place.x()) * 2.0f / float(width) * clipFromWorld.row(3);
  result.row(1) -= (0.5f - place.y()) * 2.0f / float(height) * clipFromWorld.row(3);
  return result;
}

}  // namespace

Eigen::Vector4f eyeOf(const scene::Camera& camera) {
  const Eigen::Vector3f back = camera.worldFromCamera.block<3, 1>(0, 2).normalized();
  const Eigen::Vector3f position = camera.worldFromCamera.block<3, 1>(0, 3);
  if (camera.orthographicHalfHeight) return {back.x(), back.y(), back.z(), 0.0f};
  return {position.x(), position.y(), position.z(), 1.0f};
}

GlView viewThrough(const scene::Camera& camera, int width, int height, const scene::Box& box,
                   const Vec2& place, int samples) {
  GlView view;
  view.clipFromWorld =
      shifted(scene::clipFromWorld(camera, width, height, box), place, width, height);
  view.eye = eyeOf(camera);
  view.sampleWidth = shade::sampleWidth(camera, height, samples);
  const Mat3 linear = camera.worldFromCamera.topLeftCorner<3, 3>();
  view.mirrored = linear.determinant() < 0.0f;

  // Rays as scene::cameraRay shoots them, brought to the image plane at distance 1.
  const Mat3d cameraFromWorld = linear.cast<double>().inverse();
  const auto through = [&](float x, float y) {
    const Vec3d d = scene::cameraRay(camera, width, height, x, y).direction.cast<double>();
    return Vec3d(d / -(cameraFromWorld * d).z());
  };
  const float w = float(width), h = float(height);
  const Vec3d origin = through(0.0f, h);  // the lower left corner of the picture
  const Vec3d right = (through(w, h) - origin) / double(w);
  const Vec3d up = (through(0.0f, 0.0f) - origin) / double(h);
  view.right = right.cast<float>();
  view.up = up.cast<float>();
  view.corner = (origin + place.x() * right + (1.0 - place.y()) * up).cast<float>();
  return view;
}

}  // namespace lambent::render
