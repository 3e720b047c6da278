#include "lambent/scene/vertex_numbers.h"

#include <gtest/gtest.h>

#include "lambent/scene/shapes.h"
#include "lambent/scene/sheets.h"
#include "lambent/scene/split_edges.h"

namespace lambent::scene {
namespace {

/// A square of which each vertex has a number, a label and a tangent.
Mesh marked() {
  Mesh mesh = gridPlane(1, 1, 1, 1);
  VertexNumbers heat{"_HEAT", 1, {}}, label{"_LABEL", 1, {}, 5121}, tangent{"TANGENT", 4, {}};
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    heat.values.push_back(mesh.positions[v].x());
    label.values.push_back(float(v));
    tangent.values.insert(tangent.values.end(), {1, 0, 0, 1});
  }
  mesh.others = {heat, label, tangent};
  return mesh;
}

TEST(VertexNumbers, FollowVerticesThatAreDropped) {
  Mesh mesh = marked();
  mesh.triangles.erase(mesh.triangles.begin());
  const std::vector<std::uint32_t> old = dropUnusedVertices(mesh);
  ASSERT_EQ(old.size(), 3u);
  for (std::size_t v = 0; v < old.size(); ++v) {
    EXPECT_EQ(mesh.others[0].values[v], mesh.positions[v].x());
    EXPECT_EQ(mesh.others[1].values[v], float(old[v]));
  }
  EXPECT_EQ(mesh.others[2].values.size(), 12u);
}

TEST(VertexNumbers, AreThereWhereEdgesAreCut) {
  const Scene scene = sceneOf(marked());
  const SceneEdges edges = edgesOf(scene);
  const std::vector<std::uint8_t> marks(edges.size(), 1);
  const SplitScene split = splitEdges(scene, edges, marks);
  const Mesh& mesh = split.scene.meshes[0];
  ASSERT_GT(mesh.positions.size(), 4u);
  ASSERT_EQ(mesh.others[0].values.size(), mesh.positions.size());
  ASSERT_EQ(mesh.others[2].values.size(), 4 * mesh.positions.size());
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    EXPECT_EQ(mesh.others[0].values[v], mesh.positions[v].x());
    const float label = mesh.others[1].values[v];
    EXPECT_EQ(label, std::floor(label));
  }
}

TEST(VertexNumbers, TurnOverOnBacksAndInMirrors) {
  const Mesh sheet = withBacks(marked());
  const std::vector<float>& tangents = sheet.others[2].values;
  ASSERT_EQ(tangents.size(), 32u);
  EXPECT_EQ(tangents[16], -1.0f);
  EXPECT_EQ(tangents[19], -1.0f);
  EXPECT_EQ(sheet.others[0].values[4], sheet.others[0].values[0]);

  const Mesh mirrored = scaled(marked(), Vec3(-2, 1, 1));
  EXPECT_EQ(mirrored.others[2].values[0], -1.0f);
  EXPECT_EQ(mirrored.others[2].values[3], -1.0f);
}

TEST(VertexNumbers, SplitWithTheirVertices) {
  Mesh mesh = box(Vec3(1, 1, 1), 1);
  mesh.normals.clear();
  mesh.others = {{"_NUMBER", 1, {}}};
  for (std::size_t v = 0; v < mesh.positions.size(); ++v)
    mesh.others[0].values.push_back(mesh.positions[v].sum());
  creaseNormals(mesh, 0.1f);
  ASSERT_EQ(mesh.others[0].values.size(), mesh.positions.size());
  for (std::size_t v = 0; v < mesh.positions.size(); ++v)
    EXPECT_EQ(mesh.others[0].values[v], mesh.positions[v].sum());
}

}  // namespace
}  // namespace lambent::scene
