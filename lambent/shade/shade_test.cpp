#include "lambent/shade/shade.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "lambent/sh/basis.h"
#include "lambent/sh/zonal.h"
#include "lambent/shade/dispatch.h"
#include "lambent/shade/lit_mesh.h"
#include "lambent/shade/test_assets.h"
#include "lambent/shade/transfer_matrices.h"

namespace lambent::shade {
namespace {

using sh::coefficientCount;
using test::seenFrom;
using transfer::Encoding;
using transfer::Kind;
using transfer::Numbers;
using Response = transfer::SurfaceResponse<Numbers>;
using Surface = transfer::Surface<Numbers>;

std::vector<float> randomNumbers(std::size_t count, std::uint32_t seed) {
  std::mt19937 engine(seed);
  std::vector<float> numbers(count);
  for (float& x : numbers) x = float(engine()) / float(1u << 31) - 1.0f;
  return numbers;
}

sh::RgbCoefficients randomLight(int bands, std::uint32_t seed) {
  sh::RgbCoefficients light(bands);
  light.values = randomNumbers(light.values.size(), seed);
  return light;
}

struct Shape {
  std::size_t receivers;
  int bands, channels;
  Encoding encoding;
};

transfer::Vectors<Numbers> someVectors(const Shape& shape) {
  return {shape.bands, shape.channels,
          transfer::encode(
              randomNumbers(shape.receivers * shape.channels * coefficientCount(shape.bands), 7),
              shape.encoding)};
}

/// ReceiverWeights at the origin that look along `normals`.
transfer::SharedReceivers looking(const std::vector<Vec3>& normals) {
  transfer::Receivers receivers;
  receivers.positions.assign(normals.size(), Vec3::Zero());
  receivers.normals = normals;
  return std::make_shared<const transfer::Receivers>(receivers);
}

std::vector<math::Isa> machineIsas() {
  std::vector<math::Isa> isas{math::Isa::Baseline};
  if (math::bestIsa() >= math::Isa::Avx2) isas.push_back(math::Isa::Avx2);
  if (math::bestIsa() >= math::Isa::Avx512) isas.push_back(math::Isa::Avx512);
  return isas;
}

/// M · L the slow way: every number decoded, everything in double.
std::vector<double> naiveDiffuse(const transfer::Vectors<Numbers>& vectors,
                                 const sh::RgbCoefficients& light) {
  const std::vector<float> numbers = transfer::decode(vectors.numbers);
  const int n = coefficientCount(vectors.bands), count = std::min(n, coefficientCount(light.bands));
  std::vector<double> out;
  for (std::size_t p = 0; p < numbers.size() / (vectors.channels * n); ++p)
    for (int c = 0; c < 3; ++c) {
      double sum = 0;
      for (int k = 0; k < count; ++k)
        sum += double(numbers[(p * vectors.channels + c % vectors.channels) * n + k]) *
               light.channel(c)[k];
      out.push_back(sum);
    }
  return out;
}

TEST(DiffuseShader, EqualsTheNaiveDotProduct) {
  for (const Encoding encoding : {Encoding::Float16, Encoding::Float32})
    for (const int channels : {1, 3})
      for (int bands = 1; bands <= 10; ++bands)
        for (const std::size_t receivers : {1u, 15u, 16u, 33u, 100u}) {
          const auto vectors = someVectors({receivers, bands, channels, encoding});
          const sh::RgbCoefficients light = randomLight(bands, 3);
          std::vector<float> out(3 * receivers);
          DiffuseShader(vectors).shade(light, out);
          const std::vector<double> expected = naiveDiffuse(vectors, light);
          for (std::size_t i = 0; i < out.size(); ++i)
            ASSERT_NEAR(out[i], expected[i], 2e-6 * coefficientCount(bands))
                << bands << " bands, " << channels << " channels, receiver " << i / 3;
        }
}

TEST(DiffuseShader, CutsOrPadsALightOfOtherBands) {
  for (const int lightBands : {1, 3, 8}) {
    const auto vectors = someVectors({40, 5, 3, Encoding::Float16});
    const sh::RgbCoefficients light = randomLight(lightBands, 5);
    std::vector<float> out(3 * 40);
    DiffuseShader(vectors).shade(light, out);
    const std::vector<double> expected = naiveDiffuse(vectors, light);
    for (std::size_t i = 0; i < out.size(); ++i) ASSERT_NEAR(out[i], expected[i], 5e-5);
  }
}

TEST(LitMesh, IsBlackWithoutDiffuseTransfer) {
  const LitMesh lit = lightMesh({}, Kind::Shadowed, randomLight(2, 1), {});
  EXPECT_TRUE((lit.diffuseAt(ReceiverWeights::one(0)) == 0.0f).all());
  EXPECT_TRUE((lit.glossyAt(ReceiverWeights::one(0), Vec3::UnitZ(), Vec3::UnitZ()) == 0.0f).all());
}

TEST(Kernels, EveryInstructionSetGivesTheSameDiffuseRadiance) {
  const int stride = 30, count = 25;
  const std::size_t blocks = 5;
  const std::vector<float> light = randomNumbers(3 * count, 1);
  for (const int channels : {1, 3}) {
    const std::vector<float> single = randomNumbers(blocks * stride * channels * kBlock, 2);
    const std::vector<std::uint16_t> half = transfer::encode(single, Encoding::Float16).half;
    const std::vector<float> rounded =
        transfer::decode(transfer::encode(single, Encoding::Float16));
    for (const math::Isa isa : machineIsas()) {
      std::vector<float> fromHalf(blocks * 3 * kBlock), fromSingle(fromHalf.size());
      kernelsFor(isa).diffuseHalf(half.data(), blocks, channels, stride, count, light.data(),
                                  fromHalf.data());
      kernelsFor(isa).diffuseSingle(single.data(), blocks, channels, stride, count, light.data(),
                                    fromSingle.data());
      for (std::size_t i = 0; i < fromHalf.size(); ++i) {
        const std::size_t block = i / (3 * kBlock), lane = i % (3 * kBlock) / 3;
        const int c = int(i % 3);
        double expectedHalf = 0, expectedSingle = 0;
        for (int k = 0; k < count; ++k) {
          const std::size_t at = ((block * stride + k) * channels + c % channels) * kBlock + lane;
          expectedHalf += double(rounded[at]) * light[3 * k + c];
          expectedSingle += double(single[at]) * light[3 * k + c];
        }
        ASSERT_NEAR(fromHalf[i], expectedHalf, 2e-5) << "isa " << int(isa) << " place " << i;
        ASSERT_NEAR(fromSingle[i], expectedSingle, 2e-5) << "isa " << int(isa) << " place " << i;
      }
    }
  }
}

TEST(Kernels, EveryInstructionSetDecodesEveryHalf) {
  // One coefficient and a light of 1: the kernel's output is its input.
  std::vector<std::uint16_t> halves(1 << 16);
  for (std::size_t i = 0; i < halves.size(); ++i) halves[i] = std::uint16_t(i);
  const std::vector<float> expected = transfer::decode([&] {
    transfer::Numbers numbers;
    numbers.encoding = Encoding::Float16;
    numbers.half = halves;
    return numbers;
  }());
  const float light[3] = {1.0f, 1.0f, 1.0f};
  for (const math::Isa isa : machineIsas()) {
    std::vector<float> out(3 * halves.size());
    kernelsFor(isa).diffuseHalf(halves.data(), halves.size() / kBlock, 1, 1, 1, light, out.data());
    for (std::size_t i = 0; i < halves.size(); ++i) {
      if (std::isnan(expected[i]))
        ASSERT_TRUE(std::isnan(out[3 * i]));
      else
        ASSERT_EQ(out[3 * i], expected[i]) << "half " << i << " isa " << int(isa);
    }
  }
}

transfer::Matrices<Numbers> someMatrices(std::size_t receivers, int outBands, int inBands,
                                         int channels, Encoding encoding) {
  return {outBands, inBands, channels,
          transfer::encode(randomNumbers(receivers * channels * coefficientCount(outBands) *
                                             coefficientCount(inBands),
                                         11),
                           encoding)};
}

TEST(ApplyMatrices, EqualsTheNaiveMatrixProduct) {
  for (const Encoding encoding : {Encoding::Float16, Encoding::Float32})
    for (const int channels : {1, 3})
      for (const auto& [outBands, inBands] : std::vector<std::pair<int, int>>{
               {1, 1}, {5, 5}, {5, 3}, {3, 5}, {10, 10}, {4, 4}, {2, 9}})
        for (const int lightBands : {inBands, 1, 10}) {
          const std::size_t receivers = 5;
          const auto matrices = someMatrices(receivers, outBands, inBands, channels, encoding);
          const sh::RgbCoefficients light = randomLight(lightBands, 9);
          const std::vector<float> out = applyMatrices(matrices, light);
          const std::vector<float> m = transfer::decode(matrices.numbers);
          const int rows = coefficientCount(outBands), columns = coefficientCount(inBands);
          ASSERT_EQ(out.size(), receivers * 3 * rows);
          for (std::size_t p = 0; p < receivers; ++p)
            for (int c = 0; c < 3; ++c)
              for (int i = 0; i < rows; ++i) {
                double expected = 0;
                for (int j = 0; j < std::min(columns, coefficientCount(lightBands)); ++j)
                  expected += double(m[((p * channels + c % channels) * rows + i) * columns + j]) *
                              light.channel(c)[j];
                ASSERT_NEAR(out[(p * 3 + c) * rows + i], expected, 1e-6 * columns + 1e-6)
                    << outBands << "×" << inBands << " channel " << c << " row " << i;
              }
        }
}

TEST(Kernels, EveryInstructionSetGivesTheSameTransferredRadiance) {
  const int rows = 25, columns = 9;
  const std::size_t receivers = 4;
  for (const int channels : {1, 3}) {
    const std::vector<float> single = randomNumbers(receivers * channels * rows * columns, 2);
    const std::vector<std::uint16_t> half = transfer::encode(single, Encoding::Float16).half;
    std::vector<float> light(3 * paddedColumns(columns));
    for (int c = 0; c < 3; ++c)
      for (int j = 0; j < columns; ++j) light[c * paddedColumns(columns) + j] = float(c + j) - 3;
    std::vector<float> scratch(channels * rows * columns + kBlock);
    std::vector<float> first(receivers * 3 * rows), firstHalf(first.size());
    const Kernels base = kernelsFor(math::Isa::Baseline);
    base.matrixSingle(single.data(), receivers, channels, rows, columns, light.data(),
                      scratch.data(), first.data());
    base.matrixHalf(half.data(), receivers, channels, rows, columns, light.data(), scratch.data(),
                    firstHalf.data());
    for (const math::Isa isa : machineIsas()) {
      std::vector<float> out(first.size());
      kernelsFor(isa).matrixSingle(single.data(), receivers, channels, rows, columns, light.data(),
                                   scratch.data(), out.data());
      for (std::size_t i = 0; i < out.size(); ++i) ASSERT_NEAR(out[i], first[i], 1e-4);
      kernelsFor(isa).matrixHalf(half.data(), receivers, channels, rows, columns, light.data(),
                                 scratch.data(), out.data());
      for (std::size_t i = 0; i < out.size(); ++i) ASSERT_NEAR(out[i], firstHalf[i], 1e-4);
    }
  }
}

/// A mesh whose vertices are the receivers.
asset::Asset assetOf(transfer::SharedReceivers receivers, Response response,
                     Kind kind = Kind::Shadowed) {
  asset::Asset asset;
  asset.transfer.kind = kind;
  asset.scene.materials.emplace_back();
  scene::Mesh mesh;
  mesh.positions = receivers->positions;
  mesh.normals = receivers->normals;
  asset.scene.meshes.push_back(mesh);
  Surface surface{std::move(receivers), {}};
  surface.responses.set(asset.transfer.kind, std::move(response));
  asset.transfer.meshes.push_back(std::move(surface));
  return asset;
}

Response& responseOf(asset::Asset& asset) {
  return *std::get<Surface>(asset.transfer.meshes[0]).responses.find(asset.transfer.kind);
}

const Rgb kGlossy(0.9f, 0.5f, 0.2f);

asset::Asset glossyPoint(const Vec3& normal, const transfer::Lobe& lobe, int bands,
                         const std::vector<float>& matrix, Kind kind) {
  asset::Asset asset =
      assetOf(looking({normal}),
              {{},
               transfer::Glossy<Numbers>{
                   lobe, {bands, bands, 1, transfer::encode(matrix, Encoding::Float32)}}},
              kind);
  asset.scene.materials[0].diffuse = Rgb::Zero();
  asset.scene.materials[0].glossy = lobe.reflectance;
  return asset;
}

/// A glossy receiver that sees its whole surroundings: the identity as transfer matrix.
asset::Asset openGlossyPoint(int bands, const Vec3& normal, float exponent,
                             const Rgb& reflectance = kGlossy) {
  const int n = coefficientCount(bands);
  std::vector<float> identity(std::size_t(n) * n, 0.0f);
  for (int i = 0; i < n; ++i) identity[std::size_t(i) * n + i] = 1.0f;
  return glossyPoint(normal, {reflectance, exponent}, bands, identity, Kind::Unshadowed);
}

// Equation 12 against what it stands for: k ∫ L(s) (r+1)/2π max(0, s·R)^r ds, by quadrature. With
// the identity for a transfer matrix L is the band-limited light itself.
TEST(ExitRadiance, GlossyIsTheIntegralOverTheLobe) {
  const Vec3 normal = Vec3(0.3f, 0.8f, -0.4f).normalized();
  const Vec3 eye(2.0f, 1.0f, 1.5f);
  const Vec3d v = eye.cast<double>().normalized(), n = normal.cast<double>();
  const Vec3d reflected = 2 * n.dot(v) * n - v;
  for (const int bands : {2, 5, 8})
    for (const float exponent : {0.0f, 4.0f, 16.0f, 64.0f}) {
      const asset::Asset asset = openGlossyPoint(bands, normal, 1.0f);
      const sh::RgbCoefficients light = randomLight(bands, 21);
      ReceiverView view = seenFrom(eye, exponent);
      view.showing.softLobes = false;
      const Rgb out = exitRadiance(asset, 0, light, view)[0];

      // Midpoints in cos θ and azimuth around R; the integrand is smooth on the hemisphere.
      const Vec3d t = reflected.unitOrthogonal(), b = reflected.cross(t);
      Eigen::Array3d integral = Eigen::Array3d::Zero();
      const int zs = 400, phis = 64;
      for (int i = 0; i < zs; ++i)
        for (int j = 0; j < phis; ++j) {
          const double z = (i + 0.5) / zs, phi = 2 * kPi * (j + 0.5) / phis;
          const double r = std::sqrt(1 - z * z);
          const Vec3d s = r * std::cos(phi) * t + r * std::sin(phi) * b + z * reflected;
          const double lobe = (exponent + 1) / (2 * kPi) * std::pow(z, double(exponent));
          integral += lobe * sh::reconstruct(light, s.cast<float>()).cast<double>();
        }
      integral *= 2 * kPi / (double(zs) * phis);
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(out[c], kGlossy[c] * integral[c], 2e-3)
            << bands << " bands, exponent " << exponent;
    }
}

TEST(ExitRadiance, SoftLobesShowNothingNegativeOfASmallLight) {
  const Vec3 towards = Vec3(0.4f, 0.7f, 0.2f).normalized();
  for (const int bands : {4, 5, 8}) {
    sh::RgbCoefficients light(bands);
    for (int c = 0; c < 3; ++c) sh::turnTo(sh::cap(bands, 0.01), towards, light.channel(c));
    for (const float exponent : {4.0f, 20.0f, 200.0f}) {
      float lowest[2] = {0, 0}, peak = 0;
      for (const bool soft : {false, true})
        for (int i = 0; i <= 180; ++i) {
          // Mirrored about the normal, the eye looks where the normal does.
          const Vec3 normal = (std::cos(i * kPi / 180) * towards +
                               std::sin(i * kPi / 180) * towards.unitOrthogonal())
                                  .cast<float>();
          const asset::Asset asset = openGlossyPoint(bands, normal, exponent, Rgb::Ones());
          ReceiverView view = seenFrom(normal);
          view.showing.softLobes = soft;
          const float out = exitRadiance(asset, 0, light, view)[0].x();
          lowest[soft] = std::min(lowest[soft], out);
          if (soft) peak = std::max(peak, out);
        }
      EXPECT_GE(lowest[1], -2e-3f * peak) << bands << " bands, exponent " << exponent;
      if (exponent > 10) {
        EXPECT_LT(lowest[0], -0.05f * peak) << bands << " bands, exponent " << exponent;
      }
    }
  }
}

/// Of a glossy receiver with nothing around it but a horizon, under an even light of radiance 1.
double shownUnderEvenLight(int bands, float exponent, double cosine, const Showing& showing,
                           Kind kind = Kind::Shadowed) {
  const int n = coefficientCount(bands);
  std::vector<double> horizon(n);
  sh::turnTo(sh::hemisphere(bands), Vec3d::UnitZ(), std::span<double>(horizon));
  const double constant = std::sqrt(1 / (4 * kPi));
  std::vector<float> matrix(std::size_t(n) * n, 0.0f);
  for (int i = 0; i < n; ++i) matrix[std::size_t(i) * n] = float(constant * horizon[i]);
  const asset::Asset asset =
      glossyPoint(Vec3::UnitZ(), {Rgb::Ones(), exponent}, bands, matrix, Kind::Shadowed);
  sh::RgbCoefficients light(bands);
  for (int c = 0; c < 3; ++c) light.channel(c)[0] = float(1 / constant);
  ReceiverView view = seenFrom(Vec3(float(std::sqrt(1 - cosine * cosine)), 0, float(cosine)));
  view.showing = showing;
  view.showing.surfaces = kind;
  return exitRadiance(asset, 0, light, view)[0].x();
}

// Softened lobes reach below the horizon: what they show is as bright as the material's lobe is, whose
// share above the horizon is by quadrature here, circle by circle about the lobe's axis.
TEST(ExitRadiance, SoftLobesLoseNoLightBelowTheHorizon) {
  const auto shareAbove = [](double exponent, double cosine) {
    constexpr int kSteps = 4000;
    double sum = 0;
    for (int i = 0; i < kSteps; ++i) {
      const double z = std::pow((i + 0.5) / kSteps, 1 / (exponent + 1));
      const double across = std::sqrt((1 - z * z) * (1 - cosine * cosine));
      sum += across > 0 ? std::acos(std::clamp(-z * cosine / across, -1.0, 1.0)) / kPi : 1;
    }
    return sum / kSteps;
  };
  for (const int bands : {2, 3, 4, 5, 6, 8, 10})
    for (const float exponent : {0.0f, 1.0f, 4.0f, 12.0f, 40.0f, 1000.0f})
      for (const double cosine : {0.05, 0.2, 0.4, 0.6, 0.8, 1.0}) {
        const double shown = shownUnderEvenLight(bands, exponent, cosine, {});
        EXPECT_NEAR(shown / shareAbove(std::min(double(exponent), 3.0 * bands), cosine), 1, 0.025)
            << bands << " bands, exponent " << exponent << ", cosine " << cosine;
      }
}

TEST(ExitRadiance, LobesAsTheyAreAndWithoutAHorizonAreNotMadeBrighter) {
  const sh::ZonalMoments lobe = sh::phongLobe(5, 20), horizon = sh::hemisphere(5);
  Showing whole;
  whole.softLobes = false;
  double expected = 0;
  for (int l = 0; l < 5; ++l)
    expected += (2 * l + 1) / (4 * kPi) * lobe[l] * horizon[l] * std::legendre(unsigned(l), 0.5);
  EXPECT_NEAR(shownUnderEvenLight(5, 20, 0.5, whole), expected, 1e-5);
  EXPECT_NEAR(shownUnderEvenLight(5, 20, 0.5, {}, Kind::Unshadowed), 1, 1e-5);
}

TEST(ExitRadiance, SeesAlongTheNormalWithoutAnEye) {
  const Vec3 normal = Vec3(0.3f, 0.8f, -0.4f).normalized();
  const asset::Asset asset = openGlossyPoint(4, normal, 10.0f);
  const sh::RgbCoefficients light = randomLight(4, 2);
  const Rgb along = exitRadiance(asset, 0, light)[0];
  const Rgb eye = exitRadiance(asset, 0, light, seenFrom(3.0f * normal))[0];
  EXPECT_TRUE(along.isApprox(eye, 1e-5f));
}

TEST(ExitRadiance, AppliesTheBaseColourOnlyWhereTheVectorsLackIt) {
  const auto vectors = someVectors({3, 2, 1, Encoding::Float32});
  asset::Asset asset = assetOf(looking(std::vector<Vec3>(3, Vec3::UnitZ())),
                               {transfer::Diffuse<Numbers>{{}, vectors}, {}});
  asset.scene.meshes[0].colors = {Rgb(0.5f, 1, 1), Rgb(1, 0.25f, 1), Rgb(1, 1, 0.125f)};
  const sh::RgbCoefficients light = randomLight(2, 4);
  std::vector<float> plain(9);
  DiffuseShader(vectors).shade(light, plain);
  const std::vector<Rgb> included = exitRadiance(asset, 0, light);
  responseOf(asset).diffuse->albedo = transfer::Albedo::BaseColor;
  const std::vector<Rgb> outside = exitRadiance(asset, 0, light);
  for (int p = 0; p < 3; ++p)
    for (int c = 0; c < 3; ++c) {
      EXPECT_FLOAT_EQ(included[p][c], plain[3 * p + c]);
      EXPECT_FLOAT_EQ(outside[p][c], plain[3 * p + c] * asset.scene.meshes[0].colors[p][c]);
    }
}

TEST(ExitRadiance, IsEmptyForAMirror) {
  asset::Asset asset = assetOf(looking({}), {});
  asset.scene.materials[0].mirror = Rgb::Ones();
  asset.transfer.meshes[0] = transfer::NoTransfer{};
  EXPECT_TRUE(exitRadiance(asset, 0, randomLight(3, 1)).empty());
}

// A unit uniform light on an open white diffuse surface leaves radiance 1; on a glossy one with
// k = 1 too, whatever the lobe: the furnace.
TEST(ExitRadiance, UniformLightLeavesWithItsOwnRadiance) {
  sh::RgbCoefficients uniform(5);
  for (int c = 0; c < 3; ++c) uniform.channel(c)[0] = float(std::sqrt(4 * kPi));
  const Vec3 normal = Vec3(1, 2, -2) / 3.0f;

  std::vector<float> cosine(25);
  sh::turnTo(sh::clampedCosine(5), normal, std::span<float>(cosine));
  for (float& x : cosine) x /= float(kPi);
  const asset::Asset diffuse = assetOf(
      looking({normal}),
      {transfer::Diffuse<Numbers>{{}, {5, 1, transfer::encode(cosine, Encoding::Float32)}}, {}});
  const Rgb out = exitRadiance(diffuse, 0, uniform)[0];
  EXPECT_TRUE(out.isApprox(Rgb::Ones(), 1e-5f));

  const asset::Asset glossy = openGlossyPoint(5, normal, 20.0f, Rgb::Ones());
  EXPECT_TRUE(exitRadiance(glossy, 0, uniform)[0].isApprox(Rgb::Ones(), 1e-5f));
}

TEST(Receivers, TexelWeightsAreBilinearAndClamped) {
  const ReceiverWeights inside =
      ReceiverWeights::ofTexels(4, 3, Vec2(0.5f, 0.5f));  // between texels 1 and 2
  EXPECT_EQ(inside.index, (std::array<std::uint32_t, 4>{5, 6, 9, 10}));
  EXPECT_NEAR(inside.weight[0], 0.5f, 1e-6f);
  EXPECT_NEAR(inside.weight[1], 0.5f, 1e-6f);
  EXPECT_NEAR(inside.weight[2] + inside.weight[3], 0.0f, 1e-6f);
  for (const Vec2& uv : {Vec2(-3, -3), Vec2(7, 9), Vec2(0, 1), Vec2(1, 0)}) {
    const ReceiverWeights at = ReceiverWeights::ofTexels(4, 3, uv);
    float sum = 0;
    for (int k = 0; k < 4; ++k) {
      EXPECT_LT(at.index[k], 12u);
      sum += at.weight[k];
    }
    EXPECT_NEAR(sum, 1.0f, 1e-6f);
  }
}

}  // namespace
}  // namespace lambent::shade
