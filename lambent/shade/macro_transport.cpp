// This work is based on:
// - sloan2003biscale: bi-scale radiance transfer, eq. 2 and the right vector M_p L of eq. 4. M_p
//   holds the rotation into the tangent frame; where there is no M_p, the rotation is what is left
//   of it.

#include "lambent/shade/macro_transport.h"

#include <algorithm>
#include <cassert>

#include <Eigen/Geometry>

#include "lambent/math/directions.h"
#include "lambent/sh/rotation.h"
#include "lambent/shade/transfer_matrices.h"
#include "lambent/work/parallel_for.h"

namespace lambent::shade {

Mat3 worldFromPatch(const Vec3& normal, const Vec3& tangent) {
  const Vec3 flat = tangent - normal.dot(tangent) * normal;
  const float length = flat.norm();
  if (!(length > 1e-6f)) return math::worldFromTangent(normal);
  Mat3 frame;
  frame.col(0) = flat / length;
  frame.col(1) = normal.cross(frame.col(0));
  frame.col(2) = normal;
  return frame;
}

namespace {

std::vector<float> turnedLight(const transfer::BiScale<transfer::Numbers>& biScale,
                               const sh::RgbCoefficients& light, int bands) {
  const transfer::Receivers& receivers = *biScale.receivers;
  const int used = std::min(bands, light.bands), count = sh::coefficientCount(bands);
  const sh::RgbCoefficients cut = sh::withBands(light, used);
  std::vector<float> out(receivers.size() * 3 * count);
  work::parallelFor(receivers.size(), [&](std::size_t p) {
    const Mat3 patchFromWorld =
        worldFromPatch(receivers.normals[p].normalized(), biScale.tangents[p]).transpose();
    for (int c = 0; c < 3; ++c)
      sh::rotate(used, patchFromWorld, cut.channel(c),
                 std::span(out).subspan((p * 3 + c) * count, sh::coefficientCount(used)));
  });
  return out;
}

/// Vectors of n coefficients as vectors of `count`: cut, or filled up with zeros.
std::vector<float> withCoefficients(std::vector<float> vectors, int n, int count) {
  if (n == count) return vectors;
  std::vector<float> out(vectors.size() / n * count);
  for (std::size_t i = 0; i < vectors.size() / n; ++i)
    std::copy_n(vectors.begin() + i * n, std::min(n, count), out.begin() + i * count);
  return out;
}

}  // namespace

std::vector<float> incidentLight(const transfer::BiScale<transfer::Numbers>& biScale,
                                 const sh::RgbCoefficients& light, int bands, transfer::Kind kind) {
  const transfer::Matrices<transfer::Numbers>* matrices = biScale.matrices.find(kind);
  if (!matrices) {
    assert(kind == transfer::Kind::Unshadowed);
    return turnedLight(biScale, light, bands);
  }
  return withCoefficients(applyMatrices(*matrices, light), sh::coefficientCount(biScale.bands),
                          sh::coefficientCount(bands));
}

}  // namespace lambent::shade
