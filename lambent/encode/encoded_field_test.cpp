#include "lambent/encode/encoded_field.h"

#include <gtest/gtest.h>

#include <algorithm>
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

TEST(Snorm8, ErrsByHalfAStepOfTheBlocksLargestAtMost) {
  std::mt19937 random(5);
  std::normal_distribution<float> normal;
  std::vector<float> values(4 * 100);
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = normal(random) * std::pow(10.0f, float(i / 100) - 2.0f);
  const Numbers numbers = encode(values, Encoding::Snorm8, 100);
  ASSERT_EQ(numbers.size(), values.size());
  ASSERT_EQ(numbers.scales.size(), 4u);
  const std::vector<float> decoded = decode(numbers);
  for (std::size_t i = 0; i < values.size(); ++i)
    EXPECT_LE(std::abs(decoded[i] - values[i]), numbers.scales[i / 100] / 254.0f * 1.0001f);
  for (int b = 0; b < 4; ++b)  // the largest of a block comes back as it was
    EXPECT_NEAR(*std::max_element(decoded.begin() + 100 * b, decoded.begin() + 100 * b + 100,
                                  [](float x, float y) { return std::abs(x) < std::abs(y); }) /
                    *std::max_element(values.begin() + 100 * b, values.begin() + 100 * b + 100,
                                      [](float x, float y) { return std::abs(x) < std::abs(y); }),
                1.0f, 1e-6f);
  // A stretch that begins and ends within blocks.
  std::vector<float> part(150);
  decode(numbers, 70, part);
  EXPECT_TRUE(std::equal(part.begin(), part.end(), decoded.begin() + 70));
  // A uniform quantiser errs by step/√12.
  const double step = numbers.scales[3] / 127.0;
  const std::span<const float> last(values.data() + 300, 100);
  double squared = 0.0;
  for (const float v : last) squared += double(v) * v;
  EXPECT_NEAR(encodingError(last, encode(last, Encoding::Snorm8, 100)),
              step / std::sqrt(12.0) / std::sqrt(squared / 100.0), 2e-3);
}

TEST(Snorm8, OfZerosIsZeros) {
  const std::vector<float> zeros(30, 0.0f);
  EXPECT_EQ(decode(encode(zeros, Encoding::Snorm8, 10)), zeros);
  EXPECT_EQ(encodingError(zeros, encode(zeros, Encoding::Snorm8, 10)), 0.0);
}

TEST(EncodedRtt, ComesBackInSinglePrecision) {
  meso::RadianceTransferTexture rtt;
  rtt.name = "weave";
  rtt.width = 3, rtt.height = 2, rtt.views = 2, rtt.bands = 2;
  rtt.size = Vec2(0.3f, 0.2f);
  rtt.depth = 0.05f;
  for (std::size_t i = 0; i < 4 * rtt.planeSize(); ++i) rtt.values.push_back(0.1f * float(i % 17));
  const meso::RadianceTransferTexture back = decode(encode(rtt, Encoding::Float32));
  EXPECT_EQ(back.name, rtt.name);
  EXPECT_EQ(back.values, rtt.values);
  EXPECT_EQ(back.size, rtt.size);
  EXPECT_EQ(back.depth, rtt.depth);
  EXPECT_EQ(back.views, 2);
  EXPECT_EQ(encode(rtt, Encoding::Snorm8).values.scales.size(), 4u);
  EXPECT_LT(encodingError(rtt.values, encode(rtt, Encoding::Snorm8).values), 4e-3);
  EXPECT_LT(encodingError(rtt.values, encode(rtt, Encoding::Float16).values), 4e-4);
}

TEST(EncodedField, KeepsLocalTransfer) {
  transport::TransferField field = exampleField();
  transport::LocalTransfer& local = field.meshes[1].local.emplace();
  local.tangents = {Vec3(1, 0, 0), Vec3(0, 0, 1)};
  local.bands = 2;
  local.channels = 3;
  for (int i = 0; i < 2 * 16; ++i) local.shadowed.push_back(float(i));
  for (int i = 0; i < 2 * 3 * 16; ++i) local.interreflected.push_back(-float(i));
  const EncodedField encoded = encode(field, Encoding::Float32);
  EXPECT_FALSE(encoded.meshes[0].biScale);
  ASSERT_TRUE(encoded.meshes[1].biScale);
  const transport::TransferField back = decode(encoded);
  ASSERT_TRUE(back.meshes[1].local);
  EXPECT_EQ(back.meshes[1].local->tangents, local.tangents);
  EXPECT_EQ(back.meshes[1].local->bands, 2);
  EXPECT_EQ(back.meshes[1].local->channels, 3);
  EXPECT_EQ(back.meshes[1].local->shadowed, local.shadowed);
  EXPECT_EQ(back.meshes[1].local->interreflected, local.interreflected);
}

}  // namespace
}  // namespace lambent::encode
