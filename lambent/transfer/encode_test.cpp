#include "lambent/transfer/encode.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace lambent::transfer {
namespace {

SharedReceivers exampleReceivers() {
  Receivers receivers;
  AtTexels grid{2, 3, {}};
  for (int i = 0; i < 6; ++i) {
    receivers.positions.emplace_back(float(i), 0.5f, -float(i));
    receivers.normals.emplace_back(0.0f, 1.0f, 0.0f);
    grid.covered.push_back(i & 1);
  }
  receivers.where = grid;
  return std::make_shared<const Receivers>(receivers);
}

/// A bare surface with both parts under two kinds, a mirror, meso-structure and its patch.
SimulatedField exampleField() {
  std::mt19937 random(3);
  std::normal_distribution<float> normal;
  const auto numbers = [&](std::size_t count) {
    Floats values(count);
    for (float& value : values) value = normal(random);
    return values;
  };
  SimulatedField field;
  field.kind = Kind::Interreflected;
  field.bands = 3;
  field.directions = 128;
  field.bounces = 2;
  field.seed = 0xfedcba9876543210u;
  field.passEnergy = {1.0, 0.25, 1.0 / 3.0};
  Surface<Floats> surface{exampleReceivers(), {}};
  for (const Kind kind : {Kind::Interreflected, Kind::Shadowed}) {
    const int channels = kind == Kind::Shadowed ? 1 : 3;
    surface.responses.set(
        kind, {Diffuse<Floats>{Albedo::BaseColor, {3, channels, numbers(6u * channels * 9)}},
               Glossy<Floats>{{Rgb(0.1f, 0.2f, 0.3f), 12.5f}, {2, 3, 1, numbers(6u * 4 * 9)}}});
  }
  BiScale<Floats> biScale;
  biScale.receivers = exampleReceivers();
  biScale.tangents = {Vec3(1, 0, 0), Vec3(0, 0, 1)};
  biScale.patch = {0, 2.5f, IdMap{1, 2, {1, 2, 3, 4}}};
  biScale.bands = 2;
  biScale.matrices.set(Kind::Shadowed, {2, 2, 1, numbers(6 * 16)});
  biScale.matrices.set(Kind::Interreflected, {2, 2, 3, numbers(6 * 3 * 16)});
  field.meshes = {surface, NoTransfer{}, biScale};
  Rtt<Floats> rtt;
  rtt.name = "weave";
  rtt.width = 3, rtt.height = 2, rtt.views = 2, rtt.bands = 2;
  rtt.size = Vec2(0.3f, 0.2f);
  rtt.depth = 0.05f;
  rtt.values = numbers(4 * rtt.planeSize());
  field.rtts = {rtt};
  return field;
}

/// visit(numbers of a, of b, in one block) for all numbers; everything else is to be the same.
template <class M, class N, class Visit>
void compare(const Field<M>& a, const Field<N>& b, const Visit& visit) {
  EXPECT_EQ(a.kind, b.kind);
  EXPECT_EQ(a.bands, b.bands);
  EXPECT_EQ(a.directions, b.directions);
  EXPECT_EQ(a.bounces, b.bounces);
  EXPECT_EQ(a.seed, b.seed);
  EXPECT_EQ(a.passEnergy, b.passEnergy);
  ASSERT_EQ(a.meshes.size(), b.meshes.size());
  const auto& surface = std::get<Surface<M>>(a.meshes[0]);
  const auto& other = std::get<Surface<N>>(b.meshes[0]);
  EXPECT_EQ(surface.receivers, other.receivers);  // shared, and not copied
  for (const Kind kind : kKinds) {
    ASSERT_EQ(surface.responses.holds(kind), other.responses.holds(kind));
    const auto* x = surface.responses.find(kind);
    const auto* y = other.responses.find(kind);
    if (!x) continue;
    EXPECT_EQ(x->diffuse->albedo, y->diffuse->albedo);
    EXPECT_EQ(x->diffuse->vectors.bands, y->diffuse->vectors.bands);
    EXPECT_EQ(x->diffuse->vectors.channels, y->diffuse->vectors.channels);
    EXPECT_TRUE((x->glossy->lobe.reflectance == y->glossy->lobe.reflectance).all());
    EXPECT_EQ(x->glossy->lobe.exponent, y->glossy->lobe.exponent);
    EXPECT_EQ(x->glossy->matrices.outBands, y->glossy->matrices.outBands);
    EXPECT_EQ(x->glossy->matrices.inBands, y->glossy->matrices.inBands);
    EXPECT_EQ(x->glossy->matrices.channels, y->glossy->matrices.channels);
    visit(x->diffuse->vectors.numbers, y->diffuse->vectors.numbers);
    visit(x->glossy->matrices.numbers, y->glossy->matrices.numbers);
  }
  EXPECT_TRUE(std::holds_alternative<NoTransfer>(a.meshes[1]));
  EXPECT_TRUE(std::holds_alternative<NoTransfer>(b.meshes[1]));
  const auto& biScale = std::get<BiScale<M>>(a.meshes[2]);
  const auto& patched = std::get<BiScale<N>>(b.meshes[2]);
  EXPECT_EQ(biScale.receivers, patched.receivers);
  EXPECT_EQ(biScale.tangents, patched.tangents);
  EXPECT_EQ(biScale.patch.rtt, patched.patch.rtt);
  EXPECT_EQ(biScale.patch.scale, patched.patch.scale);
  EXPECT_EQ(biScale.patch.idMap()->ids, patched.patch.idMap()->ids);
  EXPECT_EQ(biScale.bands, patched.bands);
  for (const Kind kind : kKinds) {
    ASSERT_EQ(biScale.matrices.holds(kind), patched.matrices.holds(kind));
    if (!biScale.matrices.holds(kind)) continue;
    EXPECT_EQ(biScale.matrices.find(kind)->channels, patched.matrices.find(kind)->channels);
    visit(biScale.matrices.find(kind)->numbers, patched.matrices.find(kind)->numbers);
  }
  ASSERT_EQ(a.rtts.size(), b.rtts.size());
  EXPECT_EQ(a.rtts[0].name, b.rtts[0].name);
  EXPECT_EQ(a.rtts[0].size, b.rtts[0].size);
  EXPECT_EQ(a.rtts[0].depth, b.rtts[0].depth);
  EXPECT_EQ(a.rtts[0].views, b.rtts[0].views);
  visit(a.rtts[0].values, b.rtts[0].values);
}

TEST(EncodedField, Float32KeepsEveryBit) {
  const SimulatedField field = exampleField();
  compare(field, decode(encode(field, Encoding::Float32)),
          [](const Floats& a, const Floats& b) { EXPECT_EQ(a, b); });
}

TEST(EncodedField, Float16IsWithinHalfAUnitInTheLastPlace) {
  const SimulatedField field = exampleField();
  const EncodedField encoded = encode(field, Encoding::Float16);
  compare(field, encoded, [](const Floats& a, const Numbers& b) {
    EXPECT_TRUE(b.single.empty());
    EXPECT_EQ(a.size(), b.size());
  });
  compare(field, decode(encoded), [](const Floats& a, const Floats& b) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i)
      EXPECT_LE(std::abs(b[i] - a[i]), std::max(std::abs(a[i]) * 0x1p-11f, 0x1p-25f));
  });
}

TEST(EncodedField, EncodingTwiceChangesNothing) {
  const EncodedField once = encode(exampleField(), Encoding::Float16);
  compare(once, encode(decode(once), Encoding::Float16),
          [](const Numbers& a, const Numbers& b) { EXPECT_EQ(a.half, b.half); });
}

TEST(EncodedField, BytesHaveAScaleForEachVectorMatrixAndPlane) {
  const EncodedField field = encode(exampleField(), {Encoding::Float16, Encoding::Snorm8});
  const auto& matrices = std::get<BiScale<Numbers>>(field.meshes[2]).matrices;
  EXPECT_EQ(matrices.find(Kind::Shadowed)->numbers.scales.size(), 6u);
  EXPECT_EQ(matrices.find(Kind::Interreflected)->numbers.scales.size(), 6u * 3);
  const auto* response =
      std::get<Surface<Numbers>>(field.meshes[0]).responses.find(Kind::Interreflected);
  EXPECT_EQ(response->diffuse->vectors.numbers.encoding, Encoding::Float16);
  const EncodedField bytes = encode(exampleField(), Encoding::Snorm8);
  response = std::get<Surface<Numbers>>(bytes.meshes[0]).responses.find(Kind::Interreflected);
  EXPECT_EQ(response->diffuse->vectors.numbers.scales.size(), 6u * 3);
  EXPECT_EQ(response->glossy->matrices.numbers.scales.size(), 6u);
  EXPECT_EQ(bytes.rtts[0].values.scales.size(), 4u);
}

TEST(ByKind, FindsTheMostThatIsHeld) {
  ByKind<int> held;
  EXPECT_TRUE(held.empty());
  EXPECT_FALSE(held.most());
  held.set(Kind::Shadowed, 7);
  EXPECT_EQ(held.most(), Kind::Shadowed);
  EXPECT_EQ(held.mostUpTo(Kind::Interreflected), Kind::Shadowed);
  EXPECT_FALSE(held.mostUpTo(Kind::Unshadowed));
  held.set(Kind::Interreflected, 9);
  EXPECT_EQ(held.most(), Kind::Interreflected);
  EXPECT_EQ(held.mostUpTo(Kind::Shadowed), Kind::Shadowed);
  EXPECT_EQ(*held.map([](int x) { return 2.0 * x; }).find(Kind::Interreflected), 18.0);
  held.drop(Kind::Shadowed);
  EXPECT_EQ(held.find(Kind::Shadowed), nullptr);
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
  Rtt<Floats> rtt;
  rtt.name = "weave";
  rtt.width = 3, rtt.height = 2, rtt.views = 2, rtt.bands = 2;
  rtt.size = Vec2(0.3f, 0.2f);
  rtt.depth = 0.05f;
  for (std::size_t i = 0; i < 4 * rtt.planeSize(); ++i) rtt.values.push_back(0.1f * float(i % 17));
  const Rtt<Floats> back = decode(encode(rtt, Encoding::Float32));
  EXPECT_EQ(back.name, rtt.name);
  EXPECT_EQ(back.values, rtt.values);
  EXPECT_EQ(back.size, rtt.size);
  EXPECT_EQ(back.depth, rtt.depth);
  EXPECT_EQ(back.views, 2);
  EXPECT_EQ(encode(rtt, Encoding::Snorm8).values.scales.size(), 4u);
  EXPECT_LT(encodingError(rtt.values, encode(rtt, Encoding::Snorm8).values), 4e-3);
  EXPECT_LT(encodingError(rtt.values, encode(rtt, Encoding::Float16).values), 4e-4);
}

}  // namespace
}  // namespace lambent::transfer
