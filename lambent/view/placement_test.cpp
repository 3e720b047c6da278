#include "lambent/view/placement.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "lambent/scene/camera.h"
#include "lambent/scene/shapes.h"

namespace lambent::view {
namespace {

ViewState moved() {
  ViewState state;
  state.objectRotation = turned({0, 0, 0, 1}, Vec3d(1, 2, -1).normalized(), 0.8);
  state.objectTranslation = Vec3(0.4f, -1, 2);
  state.environmentRotation = turned({0, 0, 0, 1}, Vec3d(0, 1, 0.3).normalized(), -1.9);
  state.discs = {{70, 20, 40, Rgb(5, 4, 3)}};
  return state;
}

TEST(Placement, TurnsAddUp) {
  const Vec3d axis = Vec3d(1, -2, 0.5).normalized();
  const Rotation twice = turned(turned({0, 0, 0, 1}, axis, 0.3), axis, 0.5);
  const Mat3d once = Eigen::AngleAxisd(0.8, axis).toRotationMatrix();
  EXPECT_TRUE(matrixOf(twice).isApprox(once, 1e-12));
  // The later turn is about an axis of the world: it stands on the left.
  const Rotation two = turned(turned({0, 0, 0, 1}, axis, 0.3), Vec3d::UnitY(), 0.5);
  EXPECT_TRUE(matrixOf(two).isApprox(
      Eigen::AngleAxisd(0.5, Vec3d::UnitY()) * Eigen::AngleAxisd(0.3, axis).toRotationMatrix(),
      1e-12));
}

TEST(Placement, AnObjectTurnsAboutItsPivot) {
  ViewState state = moved();
  const Vec3d pivot(0.1, 0.2, 0.3);
  const Eigen::Matrix4d before = worldFromAsset(state).cast<double>();
  turnObject(state, pivot, Vec3d::UnitX(), 0.7);
  const Eigen::Matrix4d after = worldFromAsset(state).cast<double>();
  const Eigen::Vector4d inAsset = before.inverse() * pivot.homogeneous();
  EXPECT_TRUE((after * inAsset).head<3>().isApprox(pivot, 1e-5));
  const Mat3d turn = after.topLeftCorner<3, 3>() * before.topLeftCorner<3, 3>().transpose();
  EXPECT_TRUE(turn.isApprox(Eigen::AngleAxisd(0.7, Vec3d::UnitX()).toRotationMatrix(), 1e-5));
}

TEST(Placement, ADiscIsWhereTheToolPutsIt) {
  // Azimuth from +x towards +z, elevation from the horizon.
  EXPECT_TRUE(directionOf({0, 0, 20, Rgb::Ones()}).isApprox(Vec3(1, 0, 0), 1e-6f));
  EXPECT_TRUE(directionOf({90, 0, 20, Rgb::Ones()}).isApprox(Vec3(0, 0, 1), 1e-6f));
  EXPECT_TRUE(directionOf({33, 90, 20, Rgb::Ones()}).isApprox(Vec3(0, 1, 0), 1e-6f));
  Disc disc;
  aim(disc, directionOf({-130, -20, 20, Rgb::Ones()}) * 3);
  EXPECT_NEAR(disc.azimuth, -130, 1e-4);
  EXPECT_NEAR(disc.elevation, -20, 1e-4);
  aim(disc, Vec3(0, 2, 0));
  EXPECT_NEAR(disc.azimuth, -130, 1e-4);  // the zenith has none: it keeps its own
  EXPECT_NEAR(disc.elevation, 90, 1e-6);
  const light::Environment light = environmentOf({70, 20, 40, Rgb(5, 4, 3)});
  const Vec3 middle = directionOf({70, 20, 40, Rgb::Ones()});
  EXPECT_TRUE((light.radiance(middle) == Rgb(5, 4, 3)).all());
  EXPECT_TRUE((light.radiance(directionOf({70, 41, 40, Rgb::Ones()})) == Rgb(0, 0, 0)).all());
}

TEST(Placement, TheCameraSeesTheAssetWhereItIs) {
  const ViewState state = moved();
  scene::Scene scene;
  scene::addTo(scene, scene::uvSphere(0.7f, 16, 8), {});
  const scene::Camera world = worldCamera(state, scene, 1.5f);
  const scene::Camera asset = assetCamera(state, world);
  EXPECT_TRUE(
      (worldFromAsset(state) * asset.worldFromCamera).isApprox(world.worldFromCamera, 1e-5f));
  // An object at rest leaves the file's own matrix as it is, bit for bit.
  scene.cameras.push_back(world);
  scene.cameras.back().name = "own";
  EXPECT_EQ(worldCamera({}, scene, 1.0f).name, "own");
  EXPECT_EQ(assetCamera({}, world).worldFromCamera, world.worldFromCamera);
}

TEST(Placement, EnvironmentAndDiscsTurnIntoTheAssetsFrame) {
  const ViewState state = moved();
  const light::Environment sky =
      light::Environment::clampedCosine(Vec3(0, 0.6f, 0.8f), Rgb(1, 2, 3));
  const light::Environment seen = assetEnvironment(state, sky);
  const Mat3 worldFromAssetTurn = worldFromAsset(state).topLeftCorner<3, 3>();
  for (const Vec3& s : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, -1), Vec3(0.6f, -0.64f, 0.48f)}) {
    const Vec3 world = worldFromAssetTurn * s;
    const Rgb expected = sky.radiance(worldFromEnvironment(state).transpose() * world) +
                         environmentOf(state.discs[0]).radiance(world);
    EXPECT_TRUE(seen.radiance(s).isApprox(expected, 1e-4f))
        << seen.radiance(s).transpose() << " / " << expected.transpose();
  }
}

TEST(Placement, TheAirTurnsIntoTheAssetsFrame) {
  ViewState state = moved();
  const Mat3d environmentFromSun =
      Eigen::AngleAxisd(0.4, Vec3d(0.2, 1, -0.3).normalized()).toRotationMatrix();
  EXPECT_FALSE(assetAir(state, nullptr, environmentFromSun));
  state.air = AirShown{30, true};
  const auto air = assetAir(state, nullptr, environmentFromSun);
  ASSERT_TRUE(air);
  EXPECT_EQ(air->metresPerUnit, 30);
  EXPECT_TRUE(air->shafts);
  // The origin of heights, and the zenith of the sky, in the world.
  const Mat4 world = worldFromAsset(state);
  const Vec3 origin = world.topLeftCorner<3, 3>() * air->ground + world.topRightCorner<3, 1>();
  EXPECT_LT(origin.norm(), 1e-5f);
  const Mat3 turn = world.topLeftCorner<3, 3>();
  const Vec3 zenith = turn * air->sunFromAsset.row(1).transpose().cast<float>();
  const Vec3 expected = worldFromEnvironment(state) * environmentFromSun.col(1).cast<float>();
  EXPECT_TRUE(zenith.isApprox(expected, 1e-5f));
}

TEST(Placement, AStateSaysWhatAPictureIs) {
  ViewState state;
  state.transfer = transfer::Kind::Shadowed;
  state.macro = state.background = state.viewDependent = false;
  state.lobe = 30;
  state.samples = 9;
  const shade::PictureOptions options = pictureOptions(state, 30, 20);
  EXPECT_EQ(options.width, 30);
  EXPECT_EQ(options.height, 20);
  EXPECT_EQ(options.samples, 9);
  EXPECT_EQ(options.showing.surfaces, transfer::Kind::Shadowed);
  EXPECT_EQ(options.showing.mesoStructure, transfer::Kind::Unshadowed);
  EXPECT_FALSE(options.showing.viewDependent);
  EXPECT_FALSE(options.background);
  EXPECT_EQ(options.showing.lobeExponent, 30.0f);
  EXPECT_FALSE(pictureOptions({}, 1, 1).showing.mesoStructure);
}

TEST(Placement, ABoxMovesWithItsCorners) {
  scene::Box box;
  box.extend(Vec3(-1, -2, -3)), box.extend(Vec3(1, 2, 3));
  ViewState state;
  state.objectRotation = turned({0, 0, 0, 1}, Vec3d::UnitY(), kPi / 2);
  state.objectTranslation = Vec3(10, 0, 0);
  const scene::Box turnedBox = movedBox(worldFromAsset(state), box);
  EXPECT_TRUE(turnedBox.lower.isApprox(Vec3(7, -2, -1), 1e-5f));
  EXPECT_TRUE(turnedBox.upper.isApprox(Vec3(13, 2, 1), 1e-5f));
  EXPECT_TRUE(movedBox(worldFromAsset(state), {}).empty());
}

}  // namespace
}  // namespace lambent::view
