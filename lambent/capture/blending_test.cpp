#include "lambent/capture/blending.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "lambent/capture/sample_points.h"
#include "lambent/math/random.h"
#include "lambent/scene/shapes.h"

namespace lambent::capture {
namespace {

/// Σ weight · value of the sample, for values that differ from sample to sample.
double blended(const BlendWeights& weights, const std::vector<double>& values) {
  double sum = 0;
  for (int k = 0; k < 4; ++k) sum += double(weights.weight[k]) * values[weights.sample[k]];
  return sum;
}

std::vector<Vec3> somePoints(int count, std::uint64_t seed) {
  math::Random random(seed, 0);
  std::vector<Vec3> points;
  for (int i = 0; i < count; ++i) {
    const float x = random.uniform(), y = random.uniform(), z = random.uniform();
    points.emplace_back(x, y, z);
  }
  return points;
}

TEST(Blending, OfOneSampleIsThatSample) {
  const std::vector<Vec3> samples = {Vec3(1, 2, 3)};
  for (const BlendWeights& w : blendWeights(std::vector<Vec3>{{1, 2, 3}, {0, 0, 0}}, samples)) {
    EXPECT_EQ(w.sample[0], 0);
    EXPECT_EQ(w.weight, (std::array<float, 4>{1, 0, 0, 0}));
  }
}

TEST(Blending, WeightsAreAPartitionOfUnity) {
  for (const int count : {1, 2, 3, 4, 5, 12}) {
    const std::vector<Vec3> samples = somePoints(count, 3);
    for (const BlendWeights& w : blendWeights(somePoints(300, 4), samples)) {
      float sum = 0;
      for (int k = 0; k < 4; ++k) {
        EXPECT_GE(w.weight[k], 0);
        EXPECT_LT(w.sample[k], count);
        sum += w.weight[k];
      }
      EXPECT_NEAR(sum, 1, 1e-6);
    }
  }
}

TEST(Blending, AtASampleIsThatSample) {
  for (const int count : {2, 4, 9}) {
    const std::vector<Vec3> samples = somePoints(count, 5);
    const std::vector<BlendWeights> weights = blendWeights(samples, samples);
    for (int k = 0; k < count; ++k) {
      EXPECT_EQ(weights[k].sample[0], k);
      EXPECT_NEAR(weights[k].weight[0], 1, 1e-6);
    }
  }
}

TEST(Blending, TheNearestSampleWeighsMost) {
  const std::vector<Vec3> samples = somePoints(20, 6), points = somePoints(200, 7);
  const std::vector<BlendWeights> weights = blendWeights(points, samples);
  for (std::size_t p = 0; p < points.size(); ++p) {
    const auto nearest = std::min_element(samples.begin(), samples.end(), [&](auto& a, auto& b) {
      return (a - points[p]).norm() < (b - points[p]).norm();
    });
    EXPECT_EQ(weights[p].sample[0], nearest - samples.begin());
    EXPECT_GE(weights[p].weight[0], weights[p].weight[1]);
  }
}

// Along a path the blend of any values moves by no more than the step, times a slope: no seam
// where the nearest four change. Halving the step halves the largest move.
TEST(Blending, HasNoSeams) {
  const scene::Scene torus = scene::sceneOf(scene::torus(1, 0.4f, 48, 24));
  for (const int count : {2, 3, 4, 5, 8, 30}) {
    const std::vector<Vec3> samples = samplePoints(torus, count).points;
    std::vector<double> values;
    math::Random random(8, 0);
    for (int k = 0; k < count; ++k) values.push_back(random.uniformDouble());
    const auto largestMove = [&](int steps) {
      std::vector<Vec3> path;
      for (int i = 0; i <= steps; ++i) {
        const float a = float(2 * kPi * i / steps), b = 7 * a + 0.3f;
        const float r = 1 + 0.4f * std::cos(b);
        path.emplace_back(r * std::cos(a), 0.4f * std::sin(b), r * std::sin(a));
      }
      const std::vector<BlendWeights> weights = blendWeights(path, samples);
      double largest = 0;
      for (int i = 1; i <= steps; ++i)
        largest = std::max(largest,
                           std::abs(blended(weights[i], values) - blended(weights[i - 1], values)));
      return largest;
    };
    const double coarse = largestMove(4000), fine = largestMove(32000);
    EXPECT_LT(fine, 0.2 * coarse) << count << " samples";
    EXPECT_LT(fine, 0.01) << count << " samples";
  }
}

TEST(Blending, BetweenTwoSamplesIsNearlyLinear) {
  const std::vector<Vec3> samples = {Vec3(-1, 0, 0), Vec3(1, 0, 0)};
  const std::vector<Vec3> points = {Vec3(0, 0, 0), Vec3(-0.5f, 0, 0), Vec3(0.5f, 0, 0),
                                    Vec3(0.3f, 2, 1)};
  const std::vector<BlendWeights> w = blendWeights(points, samples);
  EXPECT_NEAR(blended(w[0], {0, 1}), 0.5, 1e-6);
  EXPECT_NEAR(blended(w[1], {0, 1}), 0.25, 0.15);
  EXPECT_NEAR(blended(w[2], {0, 1}) + blended(w[1], {0, 1}), 1, 1e-6);
  EXPECT_GT(blended(w[3], {0, 1}), 0.5);
}

TEST(Blending, CoincidingSamplesAreFinite) {
  const std::vector<Vec3> samples(6, Vec3(1, 1, 1));
  for (const BlendWeights& w : blendWeights(std::vector<Vec3>{{1, 1, 1}, {0, 0, 0}}, samples)) {
    float sum = 0;
    for (const float weight : w.weight) sum += weight;
    EXPECT_NEAR(sum, 1, 1e-6);
  }
}

TEST(Blending, OverAnAssetHasAnEntryForEveryReceiver) {
  asset::Asset asset;
  transfer::Receivers receivers;
  receivers.positions = somePoints(11, 9);
  asset.transfer.meshes = {transfer::Surface<transfer::Numbers>{
                               std::make_shared<const transfer::Receivers>(receivers), {}},
                           transfer::NoTransfer{}};  // a mirror
  const Blending blending = blendOver(asset, somePoints(3, 10));
  ASSERT_EQ(blending.meshes.size(), 2u);
  EXPECT_EQ(blending.meshes[0].size(), 11u);
  EXPECT_TRUE(blending.meshes[1].empty());
  EXPECT_EQ(blending.samples.size(), 3u);
}

}  // namespace
}  // namespace lambent::capture
