#include "lambent/scene_io/diagnosis.h"

#include <cmath>

#include "lambent/scene/diagnose.h"
#include "lambent/scene/shapes.h"
#include "lambent/scene_io/test_files.h"

namespace lambent::scene_io {
namespace {

struct Finished {
  scene::Mesh mesh;
  Findings findings;
  bool kept = false;
};

Finished finish(scene::Mesh mesh, const FinishOptions& options = {}) {
  Finished result{std::move(mesh), {}, false};
  Diagnosis diagnosis;
  const Status status =
      finishMesh(result.mesh, options, "file.glb", "the mesh", diagnosis, &result.kept);
  EXPECT_TRUE(status);
  result.findings = diagnosis.findings();
  return result;
}

TEST(Diagnosis, SoundMeshesPassUntouched) {
  const scene::Mesh sphere = scene::uvSphere(1, 16, 12);
  const Finished f = finish(sphere);
  EXPECT_TRUE(f.findings.empty());
  EXPECT_TRUE(f.kept);
  EXPECT_EQ(f.mesh.normals, sphere.normals);
  EXPECT_EQ(f.mesh.triangles, sphere.triangles);
}

TEST(Diagnosis, DegenerateTrianglesAreKeptOutAndCounted) {
  scene::Mesh mesh = scene::gridPlane(1, 1, 4, 4);
  const std::size_t triangles = mesh.triangles.size();
  mesh.triangles.push_back({0, 0, 1});
  mesh.triangles.push_back({0, 1, 2});  // in a line
  mesh.positions.push_back(mesh.positions[0]);
  mesh.normals.push_back(Vec3::UnitY());
  mesh.uvs.push_back(Vec2::Zero());
  mesh.triangles.push_back({0, 25, 6});  // two corners in one place
  const Finished f = finish(mesh);
  EXPECT_EQ(countOf(f.findings, "degenerate-triangles"), 3u);
  EXPECT_EQ(countOf(f.findings, "unused-vertices"), 1u);
  EXPECT_EQ(f.mesh.triangles.size(), triangles);
  EXPECT_FALSE(f.kept);
  EXPECT_NE(f.findings[0].message.find("triangle 32"), std::string::npos);

  FinishOptions keep;
  keep.keepAllVertices = true;
  const Finished all = finish(mesh, keep);
  EXPECT_EQ(all.mesh.triangles.size(), triangles + 3);
  EXPECT_EQ(all.mesh.positions.size(), 26u);
  EXPECT_TRUE(all.kept);
}

TEST(Diagnosis, UnusedVerticesMayBeNaN) {
  scene::Mesh mesh = scene::gridPlane(1, 1, 1, 1);
  mesh.positions.push_back(Vec3::Constant(NAN));
  mesh.normals.push_back(Vec3::Zero());
  mesh.uvs.push_back(Vec2::Zero());
  const Finished f = finish(mesh);
  EXPECT_EQ(f.mesh.positions.size(), 4u);
  FinishOptions keep;
  keep.keepAllVertices = true;
  Diagnosis diagnosis;
  EXPECT_FALSE(finishMesh(mesh, keep, "file.glb", "the mesh", diagnosis));
}

TEST(Diagnosis, ZeroAndInfiniteNormalsAreMade) {
  scene::Mesh mesh = scene::icosphere(1, 2);
  const std::vector<Vec3> exact = mesh.normals;
  mesh.normals[3] = Vec3::Zero();
  mesh.normals[5] = Vec3(NAN, 0, 0);
  mesh.normals[7] *= 4.0f;
  const Finished f = finish(mesh);
  EXPECT_EQ(countOf(f.findings, "zero-normals"), 2u);
  for (std::size_t i = 0; i < exact.size(); ++i) EXPECT_GT(f.mesh.normals[i].dot(exact[i]), 0.99f);
}

TEST(Diagnosis, FlippedNormalsAreTurnedToTheFront) {
  scene::Mesh mesh = scene::icosphere(1, 2);
  const std::vector<Vec3> exact = mesh.normals;
  for (std::size_t i = 0; i < 40; ++i) mesh.normals[i] = -mesh.normals[i];
  const Finished f = finish(mesh);
  EXPECT_EQ(countOf(f.findings, "normals-flipped"), 40u);
  EXPECT_EQ(f.mesh.normals, exact);
}

TEST(Diagnosis, AWindingThatAllNormalsContradict) {
  // A body wound inside out with its normals outside: the winding is wrong, in any format.
  scene::Mesh body = scene::flipped(scene::icosphere(1, 2));
  for (Vec3& n : body.normals) n = -n;
  Finished f = finish(body);
  EXPECT_EQ(countOf(f.findings, "winding-reversed"), body.triangles.size());
  EXPECT_EQ(f.mesh.normals, body.normals);
  EXPECT_GT(scene::topology(f.mesh).signedVolume, 0.0);

  // An open sheet: glTF's front is the winding's, OBJ's and PLY's the normals'.
  scene::Mesh sheet = scene::gridPlane(1, 1, 2, 2);
  for (Vec3& n : sheet.normals) n = -n;
  f = finish(sheet);
  EXPECT_EQ(countOf(f.findings, "normals-flipped"), sheet.normals.size());
  EXPECT_TRUE(f.mesh.normals[0].isApprox(Vec3::UnitY()));
  FinishOptions options;
  options.front = Front::Normals;
  f = finish(sheet, options);
  EXPECT_EQ(countOf(f.findings, "winding-reversed"), sheet.triangles.size());
  EXPECT_TRUE(f.mesh.normals[0].isApprox(-Vec3::UnitY()));
}

TEST(Diagnosis, MixedWindingIsDecidedTriangleByTriangle) {
  const scene::Mesh right = scene::icosphere(1, 3);
  for (const std::size_t every : {2u, 5u, 20u}) {
    scene::Mesh mesh = right;
    std::size_t wrong = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); t += every, ++wrong)
      std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
    Finished f = finish(mesh);
    EXPECT_EQ(countOf(f.findings, "winding-reversed"), wrong);
    EXPECT_EQ(countOf(f.findings, "normals-flipped"), 0u);
    EXPECT_EQ(f.mesh.normals, right.normals);
    EXPECT_EQ(f.mesh.triangles, right.triangles);
    mesh.normals.clear();
    f = finish(mesh);
    EXPECT_EQ(countOf(f.findings, "winding-mixed"), wrong);
    for (std::size_t v = 0; v < right.normals.size(); ++v)
      EXPECT_GT(f.mesh.normals[v].dot(right.normals[v]), 0.99f);
  }
}

TEST(Diagnosis, InsideOutIsSaidAndLeft) {
  const scene::Mesh room = scene::room(Vec3(1, 1, 1));
  const Finished f = finish(room);
  EXPECT_EQ(countOf(f.findings, "inside-out"), 1u);
  EXPECT_EQ(f.mesh.triangles, room.triangles);
  EXPECT_EQ(f.mesh.normals, room.normals);
}

TEST(Diagnosis, TheSameInSeveralPlacesIsOneFinding) {
  Diagnosis diagnosis;
  diagnosis.add(Severity::Note, "code", 2, "things were so", "here");
  diagnosis.add(Severity::Note, "code", 3, "things were so", "there");
  const Findings findings = diagnosis.findings();
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_EQ(findings[0].count, 5u);
  EXPECT_EQ(findings[0].message, "5 things were so (first: here)");
}

}  // namespace
}  // namespace lambent::scene_io
