// This work is based on:
// - sloan2002precomputed: T_DU and T_GU, transfer that neither shadows nor bounces (§4): a diffuse
//   vector is the clamped cosine about the normal, a glossy matrix the identity.
// - ramamoorthi2001efficient: eq. 8, Â_l of the clamped cosine.
// - sloan2003biscale: §3, of M_p the rotation into the tangent frame is left.
//
// A bake of Kind::Unshadowed yields the same numbers.

#include "lambent/shade/unshadowed.h"

#include <algorithm>
#include <cassert>
#include <string>
#include <unordered_map>

#include "lambent/sh/rotation.h"
#include "lambent/sh/zonal.h"
#include "lambent/shade/lit_mesh.h"
#include "lambent/shade/macro_transport.h"
#include "lambent/transfer/half.h"
#include "lambent/work/parallel_for.h"

namespace lambent::shade {

using transfer::Encoding;
using transfer::Kind;
using transfer::Numbers;
using transfer::Receivers;
using Response = transfer::SurfaceResponse<Numbers>;
using Surface = transfer::Surface<Numbers>;

namespace {

constexpr std::size_t kGrain = 256;  ///< receivers that a thread takes at a time

/// Texels that are not covered speak for the covered one whose position they were given.
void dilate(const Receivers& receivers, std::vector<Rgb>& values) {
  const transfer::AtTexels* grid = receivers.texels();
  if (!grid) return;
  const auto key = [&](std::size_t texel) {
    return std::string(reinterpret_cast<const char*>(receivers.positions[texel].data()),
                       sizeof(Vec3));
  };
  std::unordered_map<std::string, std::size_t> coveredAt;
  for (std::size_t t = 0; t < grid->covered.size(); ++t)
    if (grid->covered[t]) coveredAt.emplace(key(t), t);
  for (std::size_t t = 0; t < grid->covered.size(); ++t) {
    if (grid->covered[t]) continue;
    if (const auto source = coveredAt.find(key(t)); source != coveredAt.end())
      values[t] = values[source->second];
  }
}

/// ρ as it belongs inside the vectors: one for each receiver, or one for all.
std::vector<Rgb> reflectances(const asset::Asset& asset, std::uint32_t index,
                              const Receivers& receivers, transfer::Albedo albedo) {
  const scene::Material& material =
      asset.scene.materials[std::size_t(asset.scene.meshes[index].material)];
  if (albedo == transfer::Albedo::BaseColor) return {material.diffuse};
  std::vector<Rgb> rho = receiverBaseColors(asset.scene, index, receivers);
  if (rho.empty()) return {material.diffuse};
  dilate(receivers, rho);
  for (Rgb& colour : rho) colour = material.diffuse * colour;
  return rho;
}

/// ρ/π Â_l y_i(N).
transfer::Vectors<Numbers> unshadowedVectors(const Receivers& receivers, int bands,
                                             const std::vector<Rgb>& rho, Encoding encoding) {
  const auto isGrey = [](const Rgb& c) { return c[0] == c[1] && c[1] == c[2]; };
  transfer::Vectors<Numbers> made{bands, std::all_of(rho.begin(), rho.end(), isGrey) ? 1 : 3, {}};
  const std::size_t n = made.perVector(), each = n * std::size_t(made.channels);
  const sh::ZonalMoments cosine = sh::clampedCosine(bands);
  std::vector<float> vectors(receivers.size() * each);
  work::parallelRanges(receivers.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    std::vector<double> incident(n);
    for (std::size_t p = begin; p < end; ++p) {
      sh::turnTo(cosine, Vec3d(receivers.normals[p].cast<double>().normalized()),
                 std::span<double>(incident));
      const Rgb& reflectance = rho[rho.size() == 1 ? 0 : p];
      float* to = vectors.data() + p * each;
      for (int c = 0; c < made.channels; ++c) {
        const double factor = reflectance[c] / kPi;
        for (const double e : incident) *to++ = float(factor * (0.0f + float(e)));  // no −0
      }
    }
  });
  made.numbers = transfer::encode(vectors, encoding, n);
  return made;
}

template <class Number>
std::vector<Number> repeated(const std::vector<Number>& one, std::size_t times) {
  std::vector<Number> all(one.size() * times);
  work::parallelRanges(times, kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      std::copy(one.begin(), one.end(), all.begin() + std::ptrdiff_t(i * one.size()));
  });
  return all;
}

/// Light passes unchanged, from below the horizon too; what rows or columns are over is zero.
transfer::Matrices<Numbers> identities(std::size_t receivers, int outBands, int inBands,
                                       Encoding encoding) {
  transfer::Matrices<Numbers> made{outBands, inBands, 1, {}};
  const std::size_t columns = std::size_t(sh::coefficientCount(inBands));
  const std::size_t rows = std::size_t(sh::coefficientCount(outBands));
  std::vector<float> identity(made.perMatrix());
  for (std::size_t i = 0; i < std::min(rows, columns); ++i) identity[i * columns + i] = 1.0f;
  const Numbers one = transfer::encode(identity, encoding, identity.size());
  made.numbers = {.encoding = encoding,
                  .half = repeated(one.half, receivers),
                  .single = repeated(one.single, receivers),
                  .byte = repeated(one.byte, receivers),
                  .scales = repeated(one.scales, receivers),
                  .block = one.block};
  return made;
}

}  // namespace

Response unshadowedResponse(const asset::Asset& asset, std::uint32_t mesh) {
  const Surface& surface = std::get<Surface>(asset.transfer.meshes[mesh]);
  const Receivers& receivers = *surface.receivers;
  Response made;
  const std::optional<Kind> most = surface.responses.most();
  if (!most) return made;
  const Response& stored = *surface.responses.find(*most);
  if (const auto& diffuse = stored.diffuse)
    made.diffuse = {diffuse->albedo,
                    unshadowedVectors(receivers, diffuse->vectors.bands,
                                      reflectances(asset, mesh, receivers, diffuse->albedo),
                                      diffuse->vectors.numbers.encoding)};
  if (const auto& glossy = stored.glossy)
    made.glossy = {glossy->lobe,
                   identities(receivers.size(), glossy->matrices.outBands, glossy->matrices.inBands,
                              glossy->matrices.numbers.encoding)};
  return made;
}

std::shared_ptr<const Response> responseUnder(const asset::Asset& asset, std::uint32_t mesh,
                                              Kind kind) {
  const Surface& surface = std::get<Surface>(asset.transfer.meshes[mesh]);
  if (const Response* held = surface.responses.find(kind))
    return {std::shared_ptr<const Response>(), held};  // the asset's own
  assert(kind == Kind::Unshadowed);
  return std::make_shared<const Response>(unshadowedResponse(asset, mesh));
}

transfer::Matrices<Numbers> rotationsIntoFrames(const transfer::BiScale<Numbers>& biScale,
                                                int bands) {
  bool single = !biScale.matrices.empty();
  biScale.matrices.each([&](Kind, const transfer::Matrices<Numbers>& held) {
    single = single && held.numbers.encoding == Encoding::Float32;
  });
  const Receivers& receivers = *biScale.receivers;
  transfer::Matrices<Numbers> made{bands, bands, 1, {}};
  const std::size_t each = made.perMatrix();
  made.numbers.encoding = single ? Encoding::Float32 : Encoding::Float16;
  if (single)
    made.numbers.single.resize(receivers.size() * each);
  else
    made.numbers.half.resize(receivers.size() * each);
  work::parallelRanges(receivers.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    std::vector<float> rounded(each);
    for (std::size_t p = begin; p < end; ++p) {
      const Mat3 patchFromWorld =
          worldFromPatch(receivers.normals[p].normalized(), biScale.tangents[p]).transpose();
      const std::vector<double> rotation = sh::rotationMatrix(bands, patchFromWorld.cast<double>());
      for (std::size_t k = 0; k < each; ++k) rounded[k] = float(rotation[k]);
      if (single)
        std::copy(rounded.begin(), rounded.end(),
                  made.numbers.single.begin() + std::ptrdiff_t(p * each));
      else
        transfer::halvesFromFloats(rounded, std::span(made.numbers.half).subspan(p * each, each));
    }
  });
  return made;
}

}  // namespace lambent::shade
