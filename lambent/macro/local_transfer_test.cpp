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
  options.kind = TransferKind::Shadowed;
  options.bands = 4;
  options.directions = 1024;
  const Placement placement{{}, {framesOf(scene, 0)}};
  const TransferField field = bakeOrDie(scene, options, placement);
  const MeshTransfer& mesh = field.meshes[0];
  ASSERT_TRUE(mesh.local);
  EXPECT_TRUE(mesh.vectors.empty());
  EXPECT_TRUE(mesh.matrices.empty());
  EXPECT_TRUE(mesh.local->interreflected.empty());
  ASSERT_EQ(mesh.local->shadowed.size(), mesh.receiverCount() * 256);
  for (std::size_t r = 0; r < mesh.receiverCount(); ++r) {
    const Vec3d n = mesh.normals[r].cast<double>(), t = mesh.local->tangents[r].cast<double>();
    Mat3d tangentFromWorld;
    tangentFromWorld << t.transpose(), n.cross(t).transpose(), n.transpose();
    const std::vector<double> expected = sh::rotationMatrix(4, tangentFromWorld);
    for (int k = 0; k < 256; ++k) EXPECT_NEAR(mesh.local->shadowed[r * 256 + k], expected[k], 2e-5);
  }
}

TEST(LocalTransfer, UnshadowedNeedsNoMatrices) {
  const scene::Scene scene = scene::sceneOf(scene::icosphere(1.0f, 1), grey(0.5f));
  BakeOptions options;
  options.kind = TransferKind::Unshadowed;
  const Placement placement{{}, {framesOf(scene, 0)}};
  const TransferField field = bakeOrDie(scene, options, placement);
  ASSERT_TRUE(field.meshes[0].local);
  EXPECT_TRUE(field.meshes[0].local->shadowed.empty());
  EXPECT_EQ(field.meshes[0].local->tangents, placement.local[0].tangents);
}

TEST(LocalTransfer, InAClosedBlackRoomIsZero) {
  const scene::Scene scene = scene::sceneOf(scene::room(Vec3(2, 2, 2), 2), grey(0.0f));
  BakeOptions options;
  options.kind = TransferKind::Shadowed;
  options.directions = 1024;
  const Placement placement{{}, {framesOf(scene, 0)}};
  const TransferField field = bakeOrDie(scene, options, placement);
  for (const float value : field.meshes[0].local->shadowed) EXPECT_NEAR(value, 0.0f, 1e-6f);
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
  const TransferField diffuse = bakeOrDie(scene, options);
  const TransferField biScale = bakeOrDie(scene, options, {{}, {framesOf(scene, 0)}});
  const MeshTransfer& vectors = diffuse.meshes[0];
  const LocalTransfer& matrices = *biScale.meshes[0].local;
  const std::vector<float>& all =
      options.kind == TransferKind::Shadowed ? matrices.shadowed : matrices.interreflected;
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
  options.kind = TransferKind::Shadowed;
  const double five = flatPatchError(cornerScene(0.7f), options);
  EXPECT_LT(five, 0.012);
  options.kind = TransferKind::Interreflected;
  EXPECT_LT(flatPatchError(cornerScene(0.7f), options), 0.012);
  options.bands = 9;
  EXPECT_LT(flatPatchError(cornerScene(0.7f), options), 0.5 * five);
}

TEST(LocalTransfer, SendsOnWhatADiffuseSurfaceSends) {
  const scene::Scene scene = cornerScene(0.7f);
  BakeOptions options;
  options.directions = 1024;
  options.bands = 3;
  options.kind = TransferKind::Interreflected;
  const TransferField diffuse = bakeOrDie(scene, options);
  const TransferField biScale =
      bakeOrDie(scene, options, {{}, {framesOf(scene, 0), framesOf(scene, 2)}});
  ASSERT_FALSE(biScale.meshes[1].local);
  ASSERT_EQ(biScale.meshes[1].vectors.size(), diffuse.meshes[1].vectors.size());
  for (std::size_t k = 0; k < diffuse.meshes[1].vectors.size(); ++k)
    EXPECT_NEAR(biScale.meshes[1].vectors[k], diffuse.meshes[1].vectors[k], 1e-5f);
}

TEST(LocalTransfer, KeepsTheShadowedMatricesBesideIfAsked) {
  const scene::Scene scene = cornerScene(0.7f);
  BakeOptions options;
  options.directions = 512;
  options.bands = 3;
  options.kind = TransferKind::Shadowed;
  const Placement placement{{}, {framesOf(scene, 0)}};
  const TransferField shadowed = bakeOrDie(scene, options, placement);
  options.kind = TransferKind::Interreflected;
  options.keepShadowed = true;
  const TransferField both = bakeOrDie(scene, options, placement);
  EXPECT_EQ(both.meshes[0].local->shadowed, shadowed.meshes[0].local->shadowed);
  options.bounces = 0;
  const TransferField none = bakeOrDie(scene, options, placement);
  EXPECT_EQ(none.meshes[0].local->shadowed, shadowed.meshes[0].local->shadowed);
  // Bounces add light: the mean row of band 0 under uniform light grows.
  double direct = 0.0, all = 0.0;
  for (std::size_t r = 0; r < both.meshes[0].receiverCount(); ++r) {
    direct += both.meshes[0].local->shadowed[r * 81];
    all += both.meshes[0].local->interreflected[r * 81];
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
