// This work is based on:
// - sloan2003biscale: bi-scale radiance transfer, eq. 2 and the right vector M_p L of eq. 4. M_p
// holds
//   the rotation into the tangent frame; where there is no M_p, the rotation is what is left of it.

#include "lambent/shade/macro_transport.h"

#include <algorithm>
#include <cassert>

#include <tbb/parallel_for.h>
#include <Eigen/Geometry>

#include "lambent/math/directions.h"
#include "lambent/sh/rotation.h"
#include "lambent/shade/transfer_matrices.h"

namespace lambent::shade {

std::string_view nameOf(MacroTransport macro) {
  switch (macro) {
    case MacroTransport::Shadowed:
      return "shadowed";
    case MacroTransport::Interreflected:
      return "interreflected";
    case MacroTransport::Off:
      break;
  }
  return "off";
}

bool holds(const encode::EncodedBiScale& biScale, MacroTransport macro) {
  switch (macro) {
    case MacroTransport::Shadowed:
      return !biScale.shadowed.empty();
    case MacroTransport::Interreflected:
      return !biScale.interreflected.empty();
    case MacroTransport::Off:
      break;
  }
  return true;
}

MacroTransport bestOf(const encode::EncodedBiScale& biScale) {
  for (const MacroTransport macro : {MacroTransport::Interreflected, MacroTransport::Shadowed})
    if (holds(biScale, macro)) return macro;
  return MacroTransport::Off;
}

std::string heldBy(const encode::EncodedBiScale& biScale) {
  std::string names = "off";
  for (const MacroTransport macro : {MacroTransport::Shadowed, MacroTransport::Interreflected})
    if (holds(biScale, macro)) names += std::string(", ") + std::string(nameOf(macro));
  return names;
}

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

std::vector<float> turnedLight(const encode::EncodedMesh& mesh, const sh::RgbCoefficients& light,
                               int bands) {
  const int used = std::min(bands, light.bands), count = sh::coefficientCount(bands);
  const sh::RgbCoefficients cut = sh::withBands(light, used);
  std::vector<float> out(mesh.receiverCount() * 3 * count);
  tbb::parallel_for(std::size_t(0), mesh.receiverCount(), [&](std::size_t p) {
    const Mat3 patchFromWorld =
        worldFromPatch(mesh.normals[p].normalized(), mesh.biScale->tangents[p]).transpose();
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

std::vector<float> incidentLight(const encode::EncodedMesh& mesh, const sh::RgbCoefficients& light,
                                 int bands, std::optional<MacroTransport> macro) {
  assert(mesh.biScale);
  const encode::EncodedBiScale& biScale = *mesh.biScale;
  const MacroTransport chosen = macro.value_or(bestOf(biScale));
  assert(holds(biScale, chosen));
  if (chosen == MacroTransport::Off) return turnedLight(mesh, light, bands);
  const bool shadowed = chosen == MacroTransport::Shadowed;
  const int n = sh::coefficientCount(biScale.bands);
  std::vector<float> products =
      applyMatrices(shadowed ? biScale.shadowed : biScale.interreflected,
                    {mesh.receiverCount(), shadowed ? 1 : biScale.channels, n, n}, light);
  return withCoefficients(std::move(products), n, sh::coefficientCount(bands));
}

}  // namespace lambent::shade
