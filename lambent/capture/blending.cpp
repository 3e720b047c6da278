// Weights that fall with distance d and end at a radius R which moves with the point: the distance
// of the nearest sample that is *not* taken. The unnormalised weight of sample k is
//   1/d_k (1 − d_k/R)²,
// zero with its slope where sample k is about to be replaced by another, since then d_k → R.
//
// This work is based on:
// - franke1980smooth: local inverse-distance weights, ((R − d)/(R d))². The square of the pole
//   makes plateaus about the samples, so that light changes in steps between them; a simple pole is
//   nearly linear between two samples.
// - sloan2002precomputed: §6.1, "coefficients at each p that blend contribution from each of the
//   resulting sampled radiance spheres".
//
// Where five samples or more are equally near and no other is nearer, the nearest four cannot be
// told from the others, and the weights jump: a few isolated points, on no surface but by accident.
#include "lambent/capture/blending.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace lambent::capture {
namespace {

constexpr int kTaken = 4;

/// With no sample beyond those taken, R is that far beyond the farthest.
constexpr float kBeyondAll = 2.0f;

/// The nearest samples of a point, nearest first, one more than are taken.
struct Nearest {
  int count = 0;
  std::array<float, kTaken + 1> distance{};
  std::array<std::uint16_t, kTaken + 1> sample{};

  void offer(float d, std::uint16_t k) {
    if (count == kTaken + 1 && !(d < distance[kTaken])) return;
    int at = count < kTaken + 1 ? count++ : kTaken;
    for (; at > 0 && d < distance[std::size_t(at) - 1]; --at) {
      distance[std::size_t(at)] = distance[std::size_t(at) - 1];
      sample[std::size_t(at)] = sample[std::size_t(at) - 1];
    }
    distance[std::size_t(at)] = d;
    sample[std::size_t(at)] = k;
  }
};

BlendWeights weightsOf(const Nearest& nearest) {
  const std::size_t taken = std::size_t(std::min(nearest.count, kTaken));
  const float radius =
      nearest.count > kTaken ? nearest.distance[kTaken] : kBeyondAll * nearest.distance[taken - 1];
  BlendWeights result;
  result.sample[0] = nearest.sample[0];
  // d_0 times the weight: finite at a sample.
  std::array<double, kTaken> weights{};
  double sum = 0;
  for (std::size_t k = 0; k < taken; ++k) {
    const double d = nearest.distance[k], rest = radius > 0 ? 1 - d / radius : 0;
    weights[k] = (k == 0 ? 1 : d > 0 ? nearest.distance[0] / d : 0) * rest * rest;
    sum += weights[k];
  }
  if (!(sum > 0)) return result;  // all equally near, or on a sample that is the only one
  for (std::size_t k = 0; k < taken; ++k) {
    result.weight[k] = float(weights[k] / sum);
    result.sample[k] = result.weight[k] > 0 ? nearest.sample[k] : std::uint16_t(0);
  }
  return result;
}

}  // namespace

std::vector<BlendWeights> blendWeights(std::span<const Vec3> points,
                                       std::span<const Vec3> samples) {
  assert(!samples.empty() && samples.size() <= std::numeric_limits<std::uint16_t>::max());
  std::vector<BlendWeights> result;
  result.reserve(points.size());
  for (const Vec3& point : points) {
    Nearest nearest;
    for (std::size_t k = 0; k < samples.size(); ++k)
      nearest.offer((point - samples[k]).norm(), std::uint16_t(k));
    result.push_back(weightsOf(nearest));
  }
  return result;
}

Blending blendOver(const asset::Asset& asset, std::vector<Vec3> samples) {
  Blending result;
  for (const transfer::EncodedMesh& mesh : asset.transfer.meshes) {
    const transfer::Receivers* receivers = transfer::receiversOf(mesh);
    result.meshes.push_back(receivers ? blendWeights(receivers->positions, samples)
                                      : std::vector<BlendWeights>{});
  }
  result.samples = std::move(samples);
  return result;
}

}  // namespace lambent::capture
