#include "lambent/encode/encoded_field.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace lambent::encode {
namespace {

transport::TransferField exampleField() {
  std::mt19937 random(3);
  std::normal_distribution<float> normal;
  transport::TransferField field;
  field.kind = transport::TransferKind::Interreflected;
  field.bands = 3;
  field.directions = 128;
  field.bounces = 2;
  field.seed = 0xfedcba9876543210u;
  field.passEnergy = {1.0, 0.25, 1.0 / 3.0};
  transport::MeshTransfer mesh;
  mesh.layout = transport::Layout::Texels;
  mesh.width = 2;
  mesh.height = 3;
  for (int i = 0; i < 6; ++i) {
    mesh.positions.emplace_back(normal(random), normal(random), normal(random));
    mesh.normals.emplace_back(0.0f, 1.0f, 0.0f);
    mesh.covered.push_back(i & 1);
  }
  mesh.bands = 3;
  mesh.channels = 3;
  mesh.albedo = transport::Albedo::BaseColor;
  mesh.outBands = 2;
  mesh.inBands = 3;
  mesh.matrixChannels = 1;
  mesh.glossy = Rgb(0.1f, 0.2f, 0.3f);
  mesh.lobeExponent = 12.5f;
  for (int i = 0; i < 6 * 3 * 9; ++i) mesh.vectors.push_back(normal(random));
  for (int i = 0; i < 6 * 4 * 9; ++i) mesh.matrices.push_back(normal(random));
  field.meshes = {mesh, transport::MeshTransfer{}};
  return field;
}

void expectSameShape(const transport::MeshTransfer& a, const transport::MeshTransfer& b) {
  EXPECT_EQ(a.layout, b.layout);
  EXPECT_EQ(a.width, b.width);
  EXPECT_EQ(a.height, b.height);
  EXPECT_EQ(a.positions, b.positions);
  EXPECT_EQ(a.normals, b.normals);
  EXPECT_EQ(a.covered, b.covered);
  EXPECT_EQ(a.bands, b.bands);
  EXPECT_EQ(a.channels, b.channels);
  EXPECT_EQ(a.albedo, b.albedo);
  EXPECT_EQ(a.outBands, b.outBands);
  EXPECT_EQ(a.inBands, b.inBands);
  EXPECT_EQ(a.matrixChannels, b.matrixChannels);
  EXPECT_TRUE((a.glossy == b.glossy).all());
  EXPECT_EQ(a.lobeExponent, b.lobeExponent);
}

TEST(EncodedField, Float32KeepsEveryBit) {
  const transport::TransferField field = exampleField();
  const transport::TransferField back = decode(encode(field, Encoding::Float32));
  EXPECT_EQ(back.kind, field.kind);
  EXPECT_EQ(back.bands, field.bands);
  EXPECT_EQ(back.directions, field.directions);
  EXPECT_EQ(back.bounces, field.bounces);
  EXPECT_EQ(back.seed, field.seed);
  EXPECT_EQ(back.passEnergy, field.passEnergy);
  ASSERT_EQ(back.meshes.size(), field.meshes.size());
  for (std::size_t i = 0; i < field.meshes.size(); ++i) {
    expectSameShape(back.meshes[i], field.meshes[i]);
    EXPECT_EQ(back.meshes[i].vectors, field.meshes[i].vectors);
    EXPECT_EQ(back.meshes[i].matrices, field.meshes[i].matrices);
  }
}

TEST(EncodedField, Float16IsWithinHalfAUnitInTheLastPlace) {
  const transport::TransferField field = exampleField();
  const EncodedField encoded = encode(field, Encoding::Float16);
  EXPECT_TRUE(encoded.meshes[0].vectors.single.empty());
  EXPECT_EQ(encoded.meshes[0].vectors.size(), field.meshes[0].vectors.size());
  EXPECT_TRUE(encoded.meshes[1].vectors.empty());
  const transport::TransferField back = decode(encoded);
  for (std::size_t i = 0; i < field.meshes.size(); ++i)
    expectSameShape(back.meshes[i], field.meshes[i]);
  for (std::size_t i = 0; i < field.meshes[0].vectors.size(); ++i) {
    const float exact = field.meshes[0].vectors[i], near = back.meshes[0].vectors[i];
    EXPECT_LE(std::abs(near - exact), std::max(std::abs(exact) * 0x1p-11f, 0x1p-25f));
  }
}

TEST(EncodedField, EncodingTwiceChangesNothing) {
  const EncodedField once = encode(exampleField(), Encoding::Float16);
  const EncodedField twice = encode(decode(once), Encoding::Float16);
  EXPECT_EQ(once.meshes[0].vectors.half, twice.meshes[0].vectors.half);
  EXPECT_EQ(once.meshes[0].matrices.half, twice.meshes[0].matrices.half);
}

}  // namespace
}  // namespace lambent::encode
