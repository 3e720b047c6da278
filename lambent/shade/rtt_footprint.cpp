// This work is based on:
// - williams1983pyramidal: the level whose texels are as large as a pixel's footprint.
// - mccormack1999feline: where the footprint is long, several reads along it, at the level of its
//   shorter axis.
//
// A sub-sample's footprint is taken as a box of a × b positions, a ≥ b ≥ 1 (below one there is
// nothing to average). It is read by N probes of width w = max(b, a/N), evenly spread. The spread
// of N box-shaped probes has variance w²/12 + s²(N+1)/(12(N−1)), with s from the first to the last;
// that of the footprint is a²/12. They are equal for s² = (a² − w²)(N−1)/(N+1): so nothing jumps
// where N changes.
//
// Where a position is larger than the footprint, one looks at it closely: below half a position reads
// lie between positions, or each would be seen as a tile.

#include "lambent/shade/rtt_footprint.h"

#include <algorithm>
#include <cmath>

namespace lambent::shade {

SampleWidth sampleWidth(const scene::Camera& camera, int pixelHeight, int samples) {
  const Vec3 up = camera.worldFromCamera.block<3, 1>(0, 1);
  const Vec3 back = camera.worldFromCamera.block<3, 1>(0, 2);
  const float share = 2.0f / (float(pixelHeight) * std::sqrt(float(samples)));
  if (camera.orthographicHalfHeight)
    return {0.0f, share * *camera.orthographicHalfHeight * up.norm()};
  return {share * std::tan(0.5f * camera.verticalFov) * up.norm() / back.norm(), 0.0f};
}

FootprintAxes footprintAxes(const Mat3& worldFromPatch, const Vec3& toViewer, float width) {
  const Vec2 flat = toViewer.head<2>();
  const float length = flat.norm();
  const Vec2 along = length > 1e-6f ? Vec2(flat / length) : Vec2(1.0f, 0.0f);
  const Vec3 longer = along.x() * worldFromPatch.col(0) + along.y() * worldFromPatch.col(1);
  const Vec3 shorter = along.x() * worldFromPatch.col(1) - along.y() * worldFromPatch.col(0);
  return {longer * (width / std::max(toViewer.z(), kLeastCosine)), shorter * width};
}

RttProbes probesOf(const Vec2& longer, const Vec2& shorter, const Vec2& positions) {
  Vec2 along = longer;
  float a = longer.cwiseProduct(positions).norm(), b = shorter.cwiseProduct(positions).norm();
  if (b > a) {  // a patch that is stretched across the view
    std::swap(a, b);
    along = shorter;
  }
  RttProbes probes;
  if (!(a > 1.0f)) {
    probes.between = std::min(2.0f - 2.0f * a, 1.0f);
    return probes;
  }
  const float width = std::max(std::max(b, 1.0f), a / float(kMostProbes));
  const float beyond = a * a - width * width;
  if (beyond > 0.04f * width * width) {
    probes.count = std::clamp(int(std::ceil(a / width)), 2, kMostProbes);
    const float n = float(probes.count);
    probes.step = along * (std::sqrt(beyond / (n * n - 1.0f)) / a);
  }
  probes.level = std::log2(width);
  return probes;
}

}  // namespace lambent::shade
