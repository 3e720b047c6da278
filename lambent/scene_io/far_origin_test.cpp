#include "lambent/scene_io/far_origin.h"

#include <fmt/format.h>

#include "lambent/scene/shapes.h"
#include "lambent/scene_io/gltf_write.h"
#include "lambent/scene_io/test_files.h"

namespace lambent::scene_io {
namespace {

DoubleBox boxOf(const Vec3d& lower, const Vec3d& upper) {
  DoubleBox box;
  box.extend(lower);
  box.extend(upper);
  return box;
}

TEST(FarOrigin, OnlyWhatFloatsWouldLoseIsMoved) {
  EXPECT_EQ(farOrigin(DoubleBox()), Vec3d::Zero());
  EXPECT_EQ(farOrigin(boxOf({-1, -1, -1}, {1, 1, 1})), Vec3d::Zero());
  EXPECT_EQ(farOrigin(boxOf({900, 0, 0}, {901, 1, 1})), Vec3d::Zero());
  EXPECT_EQ(farOrigin(boxOf({1500, 0, 0}, {1501, 1, 1})), Vec3d(1501, 0, 0));
  // A town of ten kilometres; heights stay.
  EXPECT_EQ(farOrigin(boxOf({440000, 100, 5410000}, {450000, 300, 5420000})),
            Vec3d(445000, 0, 5415000));
  // A country around its own origin.
  EXPECT_EQ(farOrigin(boxOf({-4e5, 0, -4e5}, {4e5, 3e3, 4e5})), Vec3d::Zero());
  // What is small needs a finer place than whole metres.
  const Vec3d small = farOrigin(boxOf({20.0, 0, 0}, {20.001, 0.001, 0.001}));
  EXPECT_NEAR(small.x(), 20.0005, 0.0005);
}

TEST(FarOrigin, FloatsAreMovedExactly) {
  const float place = 448251.53125f;
  const Vec3d origin = farOrigin(boxOf({place, 0, 0}, {place + 2.0, 2, 2}));
  EXPECT_EQ(double(float(double(place) - origin.x())) + origin.x(), double(place));
}

/// A tetrahedron with its first corner at `at`.
std::string tetrahedron(const Vec3d& at, std::string_view unused = {}) {
  std::string text(unused);
  const Vec3d corners[] = {{0, 0, 0}, {1.25, 0, 0}, {0, 1.5, 0}, {0, 0, 1.75}};
  for (const Vec3d& c : corners) {
    const Vec3d p = at + c;
    text += fmt::format("v {:.3f} {:.3f} {:.3f}\n", p.x(), p.y(), p.z());
  }
  return text + "f -4 -2 -3\nf -4 -3 -1\nf -4 -1 -2\nf -3 -2 -1\n";
}

TEST(FarOrigin, AnObjFarAwayHasTheSameShape) {
  const TemporaryFolder folder;
  const Vec3d at(448251.5, 128.25, 5411930.75);
  const auto near = load(folder.write("near.obj", tetrahedron(Vec3d::Zero())));
  // A vertex without a face does not say where the scene is.
  const auto far = load(folder.write("far.obj", tetrahedron(at, "v 0 0 0\n")));
  ASSERT_TRUE(near) << near.error().message;
  ASSERT_TRUE(far) << far.error().message;
  EXPECT_EQ(countOf(near->findings, "far-origin"), 0u);
  EXPECT_EQ(near->scene.origin, Vec3d::Zero());
  EXPECT_EQ(far->scene.origin.y(), 0.0);  // heights are near enough
  const scene::Mesh &a = near->scene.meshes[0], &b = far->scene.meshes[0];
  ASSERT_EQ(a.positions.size(), b.positions.size());
  for (std::size_t i = 0; i < a.positions.size(); ++i) {
    const Vec3d p = b.positions[i].cast<double>() + far->scene.origin;
    EXPECT_LT((p - at - a.positions[i].cast<double>()).norm(), 1e-6);
    EXPECT_LT((a.normals[i] - b.normals[i]).norm(), 1e-6f);
  }
  bool told = false;
  for (const Finding& finding : far->findings) told = told || finding.code == "far-origin";
  EXPECT_TRUE(told);
}

TEST(FarOrigin, IsKeptInFilesThatAreWritten) {
  const TemporaryFolder folder;
  scene::Scene scene;
  scene::addTo(scene, scene::uvSphere(1.0f, 12, 8), scene::Material());
  scene.origin = Vec3d(448251.123456789, -3.0, 5411930.987654321);
  ASSERT_TRUE(saveGlb(scene, folder / "far.glb"));
  const auto loaded = load(folder / "far.glb");
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_EQ(loaded->scene.origin, scene.origin);
  EXPECT_EQ(loaded->scene.meshes[0].positions, scene.meshes[0].positions);
}

}  // namespace
}  // namespace lambent::scene_io
