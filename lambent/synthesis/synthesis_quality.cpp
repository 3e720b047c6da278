#include "lambent/synthesis/synthesis_quality.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <vector>

#include "lambent/synthesis/meso_offsets.h"
#include "lambent/synthesis/similar_places.h"
#include "lambent/work/parallel_for.h"

namespace lambent::synthesis {
namespace {

constexpr int kBlocks = 8;
constexpr float kBorder = 1.0f / 16.0f;
constexpr float kStrain = 0.3f;

struct Counts {
  double pairs = 0, coherent = 0, distance = 0;
  double vertices = 0, joints = 0, atBorder = 0, jointsAtBorder = 0;
  std::array<double, std::size_t(kBlocks* kBlocks)> use{};
  void add(const Counts& o) {
    pairs += o.pairs, coherent += o.coherent, distance += o.distance;
    vertices += o.vertices, joints += o.joints;
    atBorder += o.atBorder, jointsAtBorder += o.jointsAtBorder;
    for (std::size_t i = 0; i < use.size(); ++i) use[i] += o.use[i];
  }
};

}  // namespace

SynthesisQuality qualityOf(const MesoMesh& mesh, const Appearance& appearance,
                           const Vec2& patchSize, std::span<const Vec2> coordinates) {
  assert(!mesh.levels.empty() && coordinates.size() == mesh.levelEnd.back());
  const std::size_t level = mesh.levels.size() - 1;
  const std::vector<Vec2> offsets = offsetsOf(mesh, level, patchSize);
  const PatchLevel patch(appearance, patchSize, 0.0f, 0);
  const Vec2 texel = patchSize.cwiseQuotient(Vec2(appearance.width, appearance.height));
  const float halfTexel = 0.5f * texel.maxCoeff();

  constexpr std::uint32_t kChunk = 4096;
  const std::uint32_t count = mesh.levelEnd[level];
  std::vector<Counts> chunks((count + kChunk - 1) / kChunk);
  work::parallelFor(chunks.size(), [&](std::size_t chunk) {
    Counts& c = chunks[chunk];
    PatchLevel::Descriptor own;
    const auto end = std::min(count, std::uint32_t(chunk + 1) * kChunk);
    for (std::uint32_t i = std::uint32_t(chunk) * kChunk; i < end; ++i) {
      const Vec2& q = coordinates[i];
      patch.descriptor(q, own);
      std::size_t continued = 0;
      const std::size_t first = mesh.levels[level].begin[i];
      const auto neighbours = mesh.neighbours(level, i);
      for (std::size_t k = 0; k < neighbours.size(); ++k) {
        const Vec2 expected = coordinates[neighbours[k]] - offsets[first + k];
        const float off = wrapped(expected - q).cwiseProduct(patchSize).norm();
        const float way = offsets[first + k].cwiseProduct(patchSize).norm();
        continued += off <= std::max(halfTexel, kStrain * way);
        c.distance += double(patch.distance(expected, own));
      }
      c.pairs += double(neighbours.size());
      c.coherent += double(continued);
      const bool joint = 2 * continued < neighbours.size();
      const bool border = std::min(q.x(), q.y()) < kBorder || std::max(q.x(), q.y()) > 1 - kBorder;
      c.vertices += 1, c.joints += joint, c.atBorder += border, c.jointsAtBorder += joint && border;
      const int x = std::min(int(q.x() * kBlocks), kBlocks - 1);
      const int y = std::min(int(q.y() * kBlocks), kBlocks - 1);
      c.use[std::size_t(y * kBlocks + x)] += 1;
    }
  });
  Counts sum;
  for (const Counts& c : chunks) sum.add(c);
  SynthesisQuality quality;
  if (sum.pairs > 0) {
    quality.coherent = sum.coherent / sum.pairs;
    // Two places drawn at random are on average twice the variance apart.
    if (patch.variance() > 0.0f) {
      quality.mismatch = sum.distance / sum.pairs / (2.0 * double(patch.variance()));
    }
  }
  const auto [least, most] = std::minmax_element(sum.use.begin(), sum.use.end());
  quality.leastUsed = *least * kBlocks * kBlocks / sum.vertices;
  quality.mostUsed = *most * kBlocks * kBlocks / sum.vertices;
  quality.joints = sum.joints / sum.vertices;
  if (sum.joints > 0 && sum.atBorder > 0) {
    quality.jointsAtBorder = sum.jointsAtBorder / sum.joints / (sum.atBorder / sum.vertices);
  }
  return quality;
}

}  // namespace lambent::synthesis
