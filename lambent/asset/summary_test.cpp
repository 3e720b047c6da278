#include "lambent/asset/summary.h"

#include <gtest/gtest.h>

#include "lambent/asset/samples.h"

namespace lambent::asset {
namespace {

TEST(Summary, CountsWhatIsThere) {
  const Summary summary = summarize(everyLayout());
  EXPECT_EQ(summary.kind, transfer::Kind::Interreflected);
  EXPECT_EQ(summary.bands, 3);
  EXPECT_EQ(summary.seed, 0xfedcba9876543210u);
  EXPECT_EQ(summary.vertices, 16u);
  EXPECT_EQ(summary.triangles, 8u);
  EXPECT_EQ(summary.receivers, 4u + 6u + 4u);
  EXPECT_EQ(summary.materials, 4u);
  EXPECT_EQ(summary.cameras, 1u);
  ASSERT_EQ(summary.meshes.size(), 4u);

  const MeshSummary& perVertex = summary.meshes[0];
  EXPECT_EQ(perVertex.name, "per vertex");
  EXPECT_EQ(perVertex.material, "coloured");
  ASSERT_TRUE(perVertex.vectors);
  EXPECT_EQ(perVertex.vectors->bytes, 4u * 3u * 9u * 2u);
  EXPECT_EQ(perVertex.vectors->encoding, transfer::Encoding::Float16);
  EXPECT_FALSE(perVertex.matrices);

  const MeshSummary& perTexel = summary.meshes[1];
  EXPECT_EQ(perTexel.width, 3);
  EXPECT_EQ(perTexel.height, 2);
  EXPECT_EQ(perTexel.covered, 5u);
  EXPECT_EQ(perTexel.vectors->bytes, 6u * 9u * 2u);

  const MeshSummary& glossy = summary.meshes[2];
  ASSERT_TRUE(glossy.matrices);
  EXPECT_EQ(glossy.matrices->bytes, 4u * 4u * 9u * 4u);
  EXPECT_EQ(glossy.matrices->lobeExponent, 16.0f);

  EXPECT_TRUE(summary.meshes[3].mirror);
  EXPECT_EQ(summary.meshes[3].layout, "none");

  EXPECT_EQ(summary.bytes.vectors, 4u * 27u * 2u + 6u * 9u * 2u + 4u * 9u * 4u);
  EXPECT_EQ(summary.bytes.matrices, 4u * 36u * 4u);
  EXPECT_EQ(summary.bytes.receivers, 6u * (12u + 12u + 1u));
  EXPECT_EQ(summary.bytes.geometry, 4u * (4u * 32u + 2u * 12u) + 4u * 12u);
  EXPECT_EQ(summary.bytes.textures, 0u);
  // In memory, vertex receivers have places of their own too.
  EXPECT_EQ(summary.memoryBytes, summary.bytes.total() + 8u * 24u);
}

TEST(Summary, CountsWhatIsKeptBeside) {
  const Summary summary = summarize(keptShadowed());
  ASSERT_TRUE(summary.meshes[0].shadowed && summary.meshes[1].shadowed);
  EXPECT_EQ(summary.meshes[0].vectors->channels, 3);
  EXPECT_EQ(summary.meshes[0].shadowed->channels, 1);
  EXPECT_EQ(summary.meshes[0].shadowed->matrixChannels, 0);
  EXPECT_EQ(summary.meshes[0].shadowed->bytes, 4u * 9u * 2u);
  EXPECT_EQ(summary.meshes[1].shadowed->matrixChannels, 1);
  EXPECT_EQ(summary.meshes[1].shadowed->bytes, 4u * (9u + 81u) * 4u);
  EXPECT_EQ(summary.bytes.vectors, 4u * 36u * 2u + 4u * 36u * 4u);
  EXPECT_EQ(summary.bytes.matrices, 4u * 4u * 81u * 4u);
}

}  // namespace
}  // namespace lambent::asset
