// Transfer to bi-scale surfaces: matrices in tangent frames against what diffuse vectors say of the
// same light, and against closed forms.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "lambent/macro/test_bake.h"
#include "lambent/math/random.h"
#include "lambent/scene/shapes.h"
#include "lambent/sh/basis.h"
#include "lambent/sh/rotation.h"
#include "lambent/sh/zonal.h"

namespace lambent::macro {
namespace {

scene::Material grey(float albedo) {
  scene::Material material;
  material.diffuse = Rgb::Constant(albedo);
  return material;
}

/// Tangents of random heading.
LocalFrames framesOf(const scene::Scene& scene, std::uint32_t mesh, std::uint64_t seed = 1) {
  LocalFrames frames;
  frames.mesh = mesh;
  for (std::size_t v = 0; v < scene.meshes[mesh].positions.size(); ++v) {
    const Vec3& n = scene.meshes[mesh].normals[v];
    const Vec3 any = math::randomRotation(math::hashCombine(seed, v)).col(0);
    frames.tangents.push_back((any - n * n.dot(any)).normalized());
  }
  return frames;
}

/// B · M for the response of a flat patch, B_i = ρ/π Â_l y_i(+z): a diffuse transfer vector.
std::vector<double> flatPatch(const float* matrix, int bands, double albedo) {
  const int count = bands * bands;
  const sh::ZonalMoments cosine = sh::clampedCosine(bands);
  std::vector<double> y(count), result(count);
  sh::evaluate(bands, Vec3d(0, 0, 1), y);
  for (int i = 0; i < count; ++i)
    for (int j = 0; j < count; ++j)
      result[j] += albedo / kPi * cosine[sh::bandOf(i)] * y[i] * matrix[i * count + j];
  return result;
}

TEST(LocalTransfer, WhereNothingIsInTheWayIsTheRotationIntoTheFrame) {
  const scene::Scene scene = scene::sceneOf(scene::icosphere(1.0f, 1), grey(0.5f));
  BakeOptions options;
  options.kind = transfer::Kind::Shadowed;
  options.bands = 4;
  options.directions = 1024;
  const Placement placement{{}, {framesOf(scene, 0)}};
  const transfer::SimulatedField field = bakeOrDie(scene, options, placement);
  const auto& local = localOf(field, 0);
  EXPECT_FALSE(local.matrices.holds(transfer::Kind::Interreflected));
  const transfer::Receivers& receivers = *local.receivers;
  const transfer::Floats& shadowed = matricesOf(field, 0, transfer::Kind::Shadowed);
  ASSERT_EQ(shadowed.size(), receivers.size() * 256);
  for (std::size_t r = 0; r < receivers.size(); ++r) {
    const Vec3d n = receivers.normals[r].cast<double>(), t = local.tangents[r].cast<double>();
    Mat3d tangentFromWorld;
    tangentFromWorld << t.transpose(), n.cross(t).transpose(), n.transpose();
    const std::vector<double> expected = sh::rotationMatrix(4, tangentFromWorld);
    for (int k = 0; k < 256; ++k) EXPECT_NEAR(shadowed[r * 256 + k], expected[k], 2e-5);
  }
}

TEST(LocalTransfer, UnshadowedNeedsNoMatrices) {
  const scene::Scene scene = scene::sceneOf(scene::icosphere(1.0f, 1), grey(0.5f));
  BakeOptions options;
  options.kind = transfer::Kind::Unshadowed;
  const Placement placement{{}, {framesOf(scene, 0)}};
  const transfer::SimulatedField field = bakeOrDie(scene, options, placement);
  EXPECT_TRUE(localOf(field, 0).matrices.empty());
  EXPECT_EQ(localOf(field, 0).tangents, placement.local[0].tangents);
}

TEST(LocalTransfer, InAClosedBlackRoomIsZero) {
  const scene::Scene scene = scene::sceneOf(scene::room(Vec3(2, 2, 2), 2), grey(0.0f));
  BakeOptions options;
  options.kind = transfer::Kind::Shadowed;
  options.directions = 1024;
  const Placement placement{{}, {framesOf(scene, 0)}};
  const transfer::SimulatedField field = bakeOrDie(scene, options, placement);
  for (const float value : matricesOf(field, 0, transfer::Kind::Shadowed))
    EXPECT_NEAR(value, 0.0f, 1e-6f);
}

/// A floor under a ball and beside a wall.
scene::Scene cornerScene(float albedo) {
  scene::Scene scene;
  scene::addTo(scene, scene::gridPlane(2, 2, 10, 10), grey(albedo));
  scene::addTo(scene, scene::translated(scene::icosphere(0.4f, 3), Vec3(0, 0.5f, 0)), grey(albedo));
  scene::addTo(scene, scene::translated(scene::box(Vec3(0.2f, 1, 2), 8), Vec3(-1.1f, 0.5f, 0)),
               grey(albedo));
  return scene;
}

/// Relative RMS difference between B · M of a flat patch and diffuse vectors, over mesh 0.
double flatPatchError(const scene::Scene& scene, const BakeOptions& options) {
  const transfer::SimulatedField diffuse = bakeOrDie(scene, options);
  const transfer::SimulatedField biScale = bakeOrDie(scene, options, {{}, {framesOf(scene, 0)}});
  const BakedMesh vectors = meshOf(diffuse, 0);
  const transfer::Floats& all = matricesOf(biScale, 0, options.kind);
  const std::size_t count = options.bands * options.bands;
  double error = 0.0, whole = 0.0;
  for (std::size_t r = 0; r < vectors.receiverCount(); ++r) {
    const std::vector<double> flat =
        flatPatch(all.data() + r * count * count, options.bands,
                  scene.materials[scene.meshes[0].material].diffuse[0]);
    for (std::size_t j = 0; j < count; ++j) {
      const double expected = vectors.vectors[r * count + j];
      error += (flat[j] - expected) * (flat[j] - expected);
      whole += expected * expected;
    }
  }
  return std::sqrt(error / whole);
}

// Not exact where something is in the way: B keeps n bands of the cosine, so that what is blocked
// is taken away with the band-limited cosine instead of the cosine itself.
TEST(LocalTransfer, OfAFlatPatchIsDiffuseTransfer) {
  BakeOptions options;
  options.directions = 4096;
  options.kind = transfer::Kind::Shadowed;
  const double five = flatPatchError(cornerScene(0.7f), options);
  EXPECT_LT(five, 0.012);
  options.kind = transfer::Kind::Interreflected;
  EXPECT_LT(flatPatchError(cornerScene(0.7f), options), 0.012);
  options.bands = 9;
  EXPECT_LT(flatPatchError(cornerScene(0.7f), options), 0.5 * five);
}

TEST(LocalTransfer, SendsOnWhatADiffuseSurfaceSends) {
  const scene::Scene scene = cornerScene(0.7f);
  BakeOptions options;
  options.directions = 1024;
  options.bands = 3;
  options.kind = transfer::Kind::Interreflected;
  const transfer::SimulatedField diffuse = bakeOrDie(scene, options);
  const transfer::SimulatedField biScale =
      bakeOrDie(scene, options, {{}, {framesOf(scene, 0), framesOf(scene, 2)}});
  const BakedMesh beside = meshOf(biScale, 1), alone = meshOf(diffuse, 1);
  ASSERT_GT(alone.vectors.size(), 0u);
  ASSERT_EQ(beside.vectors.size(), alone.vectors.size());
  for (std::size_t k = 0; k < alone.vectors.size(); ++k)
    EXPECT_NEAR(beside.vectors[k], alone.vectors[k], 1e-5f);
}

TEST(LocalTransfer, KeepsTheShadowedMatricesBesideIfAsked) {
  const scene::Scene scene = cornerScene(0.7f);
  BakeOptions options;
  options.directions = 512;
  options.bands = 3;
  options.kind = transfer::Kind::Shadowed;
  const Placement placement{{}, {framesOf(scene, 0)}};
  const transfer::SimulatedField shadowed = bakeOrDie(scene, options, placement);
  options.kind = transfer::Kind::Interreflected;
  options.keepShadowed = true;
  const transfer::SimulatedField both = bakeOrDie(scene, options, placement);
  EXPECT_EQ(matricesOf(both, 0, transfer::Kind::Shadowed),
            matricesOf(shadowed, 0, transfer::Kind::Shadowed));
  options.bounces = 0;
  const transfer::SimulatedField none = bakeOrDie(scene, options, placement);
  EXPECT_EQ(matricesOf(none, 0, transfer::Kind::Shadowed),
            matricesOf(shadowed, 0, transfer::Kind::Shadowed));
  // Bounces add light: the mean row of band 0 under uniform light grows.
  double direct = 0.0, all = 0.0;
  for (std::size_t r = 0; r < localOf(both, 0).receivers->size(); ++r) {
    direct += matricesOf(both, 0, transfer::Kind::Shadowed)[r * 81];
    all += matricesOf(both, 0, transfer::Kind::Interreflected)[r * 81];
  }
  EXPECT_GT(all, 1.02 * direct);
}

TEST(LocalTransfer, RefusesFramesThatDoNotFit) {
  const scene::Scene scene = cornerScene(0.7f);
  BakeOptions options;
  options.directions = 64;
  const auto refused = [&](const Placement& placement) {
    const auto field = bakeScene(scene, options, placement);
    return !field && field.error().kind == ErrorKind::BadUsage;
  };
  Placement placement{{}, {framesOf(scene, 0)}};
  placement.local[0].mesh = 7;
  EXPECT_TRUE(refused(placement));
  placement.local[0].mesh = 1;
  EXPECT_TRUE(refused(placement));
  placement.local = {framesOf(scene, 0)};
  placement.texels = {{0, 8, 8}};
  EXPECT_TRUE(refused(placement));
  placement.texels = {};
  options.glossyBands = 3;
  EXPECT_TRUE(refused(placement));
}

}  // namespace
}  // namespace lambent::macro
