#include "lambent/view/placement.h"

#include <cmath>

#include <Eigen/Geometry>

#include "lambent/light/windowing.h"
#include "lambent/math/directions.h"
#include "lambent/scene/camera.h"

namespace lambent::view {

namespace {

Eigen::Quaterniond quaternion(const Rotation& r) {
  return Eigen::Quaterniond(r[3], r[0], r[1], r[2]);
}

}  // namespace

Mat3d matrixOf(const Rotation& rotation) {
  return quaternion(rotation).toRotationMatrix();
}

Rotation turned(const Rotation& rotation, const Vec3d& axis, double radians) {
  const Eigen::Quaterniond q =
      (Eigen::Quaterniond(Eigen::AngleAxisd(radians, axis)) * quaternion(rotation)).normalized();
  return {q.x(), q.y(), q.z(), q.w()};
}

Mat4 worldFromAsset(const ViewState& state) {
  Mat4 matrix = Mat4::Identity();
  matrix.topLeftCorner<3, 3>() = matrixOf(state.objectRotation).cast<float>();
  matrix.topRightCorner<3, 1>() = state.objectTranslation;
  return matrix;
}

Mat3 worldFromEnvironment(const ViewState& state) {
  return matrixOf(state.environmentRotation).cast<float>();
}

void turnObject(ViewState& state, const Vec3d& pivot, const Vec3d& axis, double radians) {
  const Vec3d translation = state.objectTranslation.cast<double>();
  const Vec3d arm = Eigen::AngleAxisd(radians, axis) * (translation - pivot);
  state.objectTranslation = (pivot + arm).cast<float>();
  state.objectRotation = turned(state.objectRotation, axis, radians);
}

Vec3 directionOf(const Disc& disc) {
  return math::directionFromAzimuthElevation(disc.azimuth * kRadiansPerDegree,
                                             disc.elevation * kRadiansPerDegree)
      .cast<float>();
}

void aim(Disc& disc, const Vec3& direction) {
  const Vec3d d = direction.cast<double>().normalized();
  const auto [azimuth, elevation] = math::azimuthElevationOf(d);
  disc.elevation = elevation / kRadiansPerDegree;
  if (std::hypot(d.x(), d.z()) > 1e-9) disc.azimuth = azimuth / kRadiansPerDegree;
}

light::Environment environmentOf(const Disc& disc) {
  return light::Environment::disc(directionOf(disc), disc.diameter * kRadiansPerDegree,
                                  disc.radiance);
}

scene::Camera cameraOf(const LookAt& look) {
  const Vec3d back = (look.position - look.target).cast<double>().normalized();
  const Vec3d right = look.up.cast<double>().cross(back).normalized();
  scene::Camera camera;
  Eigen::Matrix4d world = Eigen::Matrix4d::Identity();
  world.topLeftCorner<3, 3>() << right, back.cross(right), back;
  world.topRightCorner<3, 1>() = look.position.cast<double>();
  camera.worldFromCamera = world.cast<float>();
  camera.verticalFov = float(look.verticalFov * kRadiansPerDegree);
  if (look.orthographicHalfHeight)
    camera.orthographicHalfHeight = float(*look.orthographicHalfHeight);
  return camera;
}

scene::Camera worldCamera(const ViewState& state, const scene::Scene& scene, float aspect) {
  if (state.camera) return cameraOf(*state.camera);
  return scene.cameras.empty() ? scene::frameAutomatically(scene, aspect) : scene.cameras.front();
}

scene::Camera assetCamera(const ViewState& state, const scene::Camera& worldCamera) {
  // Rigid: the inverse is (Rᵀ, −Rᵀ t). In double, so that a file's matrix survives an object at
  // rest, and a distant object loses nothing.
  const Mat3d assetFromWorld = matrixOf(state.objectRotation).transpose();
  const Eigen::Matrix4d world = worldCamera.worldFromCamera.cast<double>();
  Eigen::Matrix4d asset = world;
  asset.topLeftCorner<3, 3>() = assetFromWorld * world.topLeftCorner<3, 3>();
  asset.topRightCorner<3, 1>() =
      assetFromWorld * (world.topRightCorner<3, 1>() - state.objectTranslation.cast<double>());
  scene::Camera camera = worldCamera;
  camera.worldFromCamera = asset.cast<float>();
  return camera;
}

light::Environment assetEnvironment(const ViewState& state, const light::Environment& environment) {
  const Mat3d assetFromWorld = matrixOf(state.objectRotation).transpose();
  const Mat3d assetFromEnvironment = assetFromWorld * matrixOf(state.environmentRotation);
  light::Environment sum = assetFromEnvironment.isIdentity(1e-9)
                               ? environment
                               : environment.rotated(assetFromEnvironment.cast<float>());
  for (const Disc& disc : state.discs)
    sum = sum + environmentOf(disc).rotated(assetFromWorld.cast<float>());
  return sum;
}

std::optional<shade::Air> assetAir(const ViewState& state,
                                   std::shared_ptr<const sky::AirTable> table,
                                   const Mat3d& environmentFromSun) {
  if (!state.air) return std::nullopt;
  const Mat3d assetFromWorld = matrixOf(state.objectRotation).transpose();
  shade::Air air;
  air.table = std::move(table);
  air.sunFromAsset =
      (assetFromWorld * matrixOf(state.environmentRotation) * environmentFromSun).transpose();
  air.metresPerUnit = state.air->metresPerUnit;
  air.ground = -(assetFromWorld * state.objectTranslation.cast<double>()).cast<float>();
  if (state.air->shafts) air.shafts.emplace();
  return air;
}

shade::Showing showingOf(const ViewState& state) {
  shade::Showing showing = shade::Showing::of(state.transfer);
  if (!state.macro) showing.mesoStructure = transfer::Kind::Unshadowed;
  if (state.lobe) showing.lobeExponent = float(*state.lobe);
  showing.softLobes = light::softensLobes(state.window);
  showing.viewDependent = state.viewDependent;
  return showing;
}

shade::PictureOptions pictureOptions(const ViewState& state, int width, int height) {
  shade::PictureOptions options;
  options.width = width, options.height = height;
  options.samples = state.samples;
  options.background = state.background;
  options.showing = showingOf(state);
  return options;
}

scene::Box movedBox(const Mat4& dstFromSrc, const scene::Box& box) {
  scene::Box moved;
  if (box.empty()) return moved;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 p((corner & 1 ? box.upper : box.lower).x(), (corner & 2 ? box.upper : box.lower).y(),
                 (corner & 4 ? box.upper : box.lower).z());
    moved.extend(dstFromSrc.topLeftCorner<3, 3>() * p + dstFromSrc.topRightCorner<3, 1>());
  }
  return moved;
}

}  // namespace lambent::view
