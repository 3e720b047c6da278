// This work is based on:
// - sloan2002precomputed: T_DU and T_GU, transfer that neither shadows nor bounces (§4): a diffuse
//   vector is the clamped cosine about the normal, a glossy matrix the identity.
// - ramamoorthi2001efficient: eq. 8, Â_l of the clamped cosine.
// - sloan2003biscale: §3, of M_p the rotation into the tangent frame is left.
//
// macro::bake yields the same numbers for TransferKind::Unshadowed.

#include "lambent/shade/transfer_choice.h"

#include <algorithm>
#include <cassert>
#include <string>
#include <unordered_map>

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "lambent/asset/names.h"
#include "lambent/encode/half.h"
#include "lambent/sh/rotation.h"
#include "lambent/sh/zonal.h"
#include "lambent/shade/lit_mesh.h"
#include "lambent/shade/macro_transport.h"

namespace lambent::shade {

using encode::EncodedMesh;
using encode::Encoding;
using encode::Numbers;
using transport::TransferKind;

namespace {

constexpr std::size_t kGrain = 256;  ///< receivers that a thread takes at a time

bool recordsTransfer(const EncodedMesh& mesh) {
  return mesh.biScale || !mesh.vectors.empty() || !mesh.matrices.empty();
}

bool holds(const asset::Asset& asset, const EncodedMesh& mesh, TransferKind kind) {
  switch (kind) {
    case TransferKind::Unshadowed:
      break;
    case TransferKind::Shadowed:
      if (mesh.biScale) return holds(*mesh.biScale, MacroTransport::Shadowed);
      return asset.transfer.kind == kind || !mesh.shadowed.empty();
    case TransferKind::Interreflected:
      if (mesh.biScale) return holds(*mesh.biScale, MacroTransport::Interreflected);
      return asset.transfer.kind == kind;
  }
  return true;
}

/// What a mesh shows: the wanted, or the nearest below that it holds.
TransferKind kindOf(const asset::Asset& asset, const EncodedMesh& mesh, TransferChoice choice) {
  TransferKind kind = choice == TransferChoice::Unshadowed ? TransferKind::Unshadowed
                      : choice == TransferChoice::Shadowed ? TransferKind::Shadowed
                                                           : TransferKind::Interreflected;
  if (kind == TransferKind::Interreflected && !holds(asset, mesh, kind))
    kind = TransferKind::Shadowed;
  if (kind == TransferKind::Shadowed && !holds(asset, mesh, kind)) kind = TransferKind::Unshadowed;
  return kind;
}

/// All but the numbers of vectors and matrices.
EncodedMesh shapeOf(const EncodedMesh& mesh) {
  EncodedMesh shape;
  shape.layout = mesh.layout;
  shape.width = mesh.width;
  shape.height = mesh.height;
  shape.positions = mesh.positions;
  shape.normals = mesh.normals;
  shape.covered = mesh.covered;
  shape.bands = mesh.bands;
  shape.channels = mesh.channels;
  shape.albedo = mesh.albedo;
  shape.outBands = mesh.outBands;
  shape.inBands = mesh.inBands;
  shape.matrixChannels = mesh.matrixChannels;
  shape.glossy = mesh.glossy;
  shape.lobeExponent = mesh.lobeExponent;
  if (const auto& from = mesh.biScale) {
    encode::EncodedBiScale& to = shape.biScale.emplace();
    to.rtt = from->rtt;
    to.tangents = from->tangents;
    to.idMap = from->idMap;
    to.tiles = from->tiles;
    to.scale = from->scale;
    to.bands = from->bands;
  }
  return shape;
}

/// Texels that are not covered speak for the covered one whose position they were given.
void dilate(const EncodedMesh& mesh, std::vector<Rgb>& values) {
  const auto key = [&](std::size_t texel) {
    return std::string(reinterpret_cast<const char*>(mesh.positions[texel].data()), sizeof(Vec3));
  };
  std::unordered_map<std::string, std::size_t> coveredAt;
  for (std::size_t t = 0; t < mesh.covered.size(); ++t)
    if (mesh.covered[t]) coveredAt.emplace(key(t), t);
  for (std::size_t t = 0; t < mesh.covered.size(); ++t) {
    if (mesh.covered[t]) continue;
    if (const auto source = coveredAt.find(key(t)); source != coveredAt.end())
      values[t] = values[source->second];
  }
}

/// ρ as it belongs inside the vectors: one for each receiver, or one for all.
std::vector<Rgb> reflectances(const asset::Asset& asset, std::uint32_t index) {
  const EncodedMesh& mesh = asset.transfer.meshes[index];
  const scene::Material& material =
      asset.scene.materials[std::size_t(asset.scene.meshes[index].material)];
  if (mesh.albedo == transport::Albedo::BaseColor) return {material.diffuse};
  std::vector<Rgb> rho = receiverBaseColors(asset.scene, index, mesh);
  if (rho.empty()) return {material.diffuse};
  dilate(mesh, rho);
  for (Rgb& colour : rho) colour = material.diffuse * colour;
  return rho;
}

/// ρ/π Â_l y_i(N), for a mesh whose `channels` are set here.
void setUnshadowedVectors(EncodedMesh& mesh, const std::vector<Rgb>& rho, Encoding encoding) {
  const auto isGrey = [](const Rgb& c) { return c[0] == c[1] && c[1] == c[2]; };
  mesh.channels = std::all_of(rho.begin(), rho.end(), isGrey) ? 1 : 3;
  const std::size_t n = std::size_t(sh::coefficientCount(mesh.bands));
  const std::size_t each = n * std::size_t(mesh.channels);
  const sh::ZonalMoments cosine = sh::clampedCosine(mesh.bands);
  std::vector<float> vectors(mesh.receiverCount() * each);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, mesh.receiverCount(), kGrain),
                    [&](const auto& range) {
                      std::vector<double> incident(n);
                      for (std::size_t p = range.begin(); p < range.end(); ++p) {
                        sh::turnTo(cosine, Vec3d(mesh.normals[p].cast<double>().normalized()),
                                   std::span<double>(incident));
                        const Rgb& reflectance = rho[rho.size() == 1 ? 0 : p];
                        float* to = vectors.data() + p * each;
                        for (int c = 0; c < mesh.channels; ++c) {
                          const double factor = reflectance[c] / kPi;
                          for (const double e : incident)
                            *to++ = float(factor * (0.0f + float(e)));  // no −0
                        }
                      }
                    });
  mesh.vectors = encode::encode(vectors, encoding, n);
}

template <class Number>
std::vector<Number> repeated(const std::vector<Number>& one, std::size_t times) {
  std::vector<Number> all(one.size() * times);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, times, kGrain), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i)
      std::copy(one.begin(), one.end(), all.begin() + std::ptrdiff_t(i * one.size()));
  });
  return all;
}

/// Light passes unchanged, from below the horizon too; what rows or columns are over is zero.
void setUnshadowedMatrices(EncodedMesh& mesh, Encoding encoding) {
  const std::size_t rows = std::size_t(sh::coefficientCount(mesh.outBands));
  const std::size_t columns = std::size_t(sh::coefficientCount(mesh.inBands));
  std::vector<float> identity(rows * columns);
  for (std::size_t i = 0; i < std::min(rows, columns); ++i) identity[i * columns + i] = 1.0f;
  const Numbers one = encode::encode(identity, encoding, identity.size());
  mesh.matrixChannels = 1;
  mesh.matrices = {.encoding = encoding,
                   .half = repeated(one.half, mesh.receiverCount()),
                   .single = repeated(one.single, mesh.receiverCount()),
                   .byte = repeated(one.byte, mesh.receiverCount()),
                   .scales = repeated(one.scales, mesh.receiverCount()),
                   .block = one.block};
}

/// The rotation of harmonics into the tangent frame of every receiver, as shadowed matrices.
void setRotations(EncodedMesh& mesh, int bands, Encoding encoding) {
  encode::EncodedBiScale& biScale = *mesh.biScale;
  biScale.bands = bands;
  const std::size_t n = std::size_t(sh::coefficientCount(bands)), each = n * n;
  Numbers& matrices = biScale.shadowed;
  matrices.encoding = encoding;
  if (encoding == Encoding::Float16)
    matrices.half.resize(mesh.receiverCount() * each);
  else
    matrices.single.resize(mesh.receiverCount() * each);
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, mesh.receiverCount(), kGrain), [&](const auto& range) {
        std::vector<float> rounded(each);
        for (std::size_t p = range.begin(); p < range.end(); ++p) {
          const Mat3 patchFromWorld =
              worldFromPatch(mesh.normals[p].normalized(), biScale.tangents[p]).transpose();
          const std::vector<double> rotation =
              sh::rotationMatrix(bands, patchFromWorld.cast<double>());
          for (std::size_t k = 0; k < each; ++k) rounded[k] = float(rotation[k]);
          if (encoding == Encoding::Float16)
            encode::halvesFromFloats(rounded, std::span(matrices.half).subspan(p * each, each));
          else
            std::copy(rounded.begin(), rounded.end(),
                      matrices.single.begin() + std::ptrdiff_t(p * each));
        }
      });
}

EncodedMesh unshadowed(const asset::Asset& asset, std::uint32_t index) {
  const EncodedMesh& stored = asset.transfer.meshes[index];
  EncodedMesh mesh = shapeOf(stored);
  if (stored.biScale) {
    const Numbers &shadowed = stored.biScale->shadowed,
                  &interreflected = stored.biScale->interreflected;
    const bool none = shadowed.empty() && interreflected.empty();
    const auto isSingle = [](const Numbers& numbers) {
      return numbers.empty() || numbers.encoding == Encoding::Float32;
    };
    setRotations(mesh, asset.transfer.rtts[std::size_t(stored.biScale->rtt)].bands,
                 !none && isSingle(shadowed) && isSingle(interreflected) ? Encoding::Float32
                                                                         : Encoding::Float16);
    return mesh;
  }
  if (!stored.vectors.empty())
    setUnshadowedVectors(mesh, reflectances(asset, index), stored.vectors.encoding);
  if (!stored.matrices.empty()) setUnshadowedMatrices(mesh, stored.matrices.encoding);
  return mesh;
}

}  // namespace

std::string_view nameOf(TransferChoice choice) {
  switch (choice) {
    case TransferChoice::Unshadowed:
      return "unshadowed";
    case TransferChoice::Shadowed:
      return "shadowed";
    case TransferChoice::Interreflected:
      return "interreflected";
    case TransferChoice::Best:
      break;
  }
  return "best";
}

std::optional<TransferChoice> transferChoiceNamed(std::string_view name) {
  for (const TransferChoice choice : {TransferChoice::Best, TransferChoice::Unshadowed,
                                      TransferChoice::Shadowed, TransferChoice::Interreflected})
    if (name == nameOf(choice)) return choice;
  return std::nullopt;
}

bool offers(const asset::Asset& asset, TransferChoice choice) {
  if (choice == TransferChoice::Best) return true;
  return std::all_of(asset.transfer.meshes.begin(), asset.transfer.meshes.end(),
                     [&](const EncodedMesh& mesh) {
                       return !recordsTransfer(mesh) ||
                              nameOf(choice) == asset::nameOf(kindOf(asset, mesh, choice));
                     });
}

Status checkTransfer(const asset::Asset& asset, TransferChoice choice) {
  if (offers(asset, choice)) return Status::ok();
  std::string held;
  for (const TransferChoice other :
       {TransferChoice::Unshadowed, TransferChoice::Shadowed, TransferChoice::Interreflected})
    if (offers(asset, other)) held += (held.empty() ? "" : ", ") + std::string(nameOf(other));
  return report::badUsage(fmt::format(
      "the asset holds no {} transfer (it holds: {}). Bake it with '{}', or ask for "
      "what is there",
      nameOf(choice), held,
      choice == TransferChoice::Shadowed ? "--keep-shadowed" : "--transfer interreflected"));
}

bool isStored(const asset::Asset& asset, std::uint32_t index, TransferChoice choice) {
  const EncodedMesh& mesh = asset.transfer.meshes[index];
  if (!recordsTransfer(mesh)) return true;
  const TransferKind kind = kindOf(asset, mesh, choice);
  if (!mesh.biScale) return kind == asset.transfer.kind;
  // A bi-scale mesh shows the best that it holds.
  return kind == kindOf(asset, mesh, TransferChoice::Best) &&
         (choice == TransferChoice::Best || kind != TransferKind::Unshadowed);
}

EncodedMesh chosenTransfer(const asset::Asset& asset, std::uint32_t index, TransferChoice choice) {
  assert(index < asset.transfer.meshes.size());
  const EncodedMesh& stored = asset.transfer.meshes[index];
  const TransferKind kind = kindOf(asset, stored, choice);
  if (!isStored(asset, index, choice) && kind == TransferKind::Unshadowed)
    return unshadowed(asset, index);
  EncodedMesh mesh = shapeOf(stored);
  if (stored.biScale) {
    if (kind == TransferKind::Shadowed) {
      mesh.biScale->shadowed = stored.biScale->shadowed;
    } else if (kind == TransferKind::Interreflected) {
      mesh.biScale->channels = stored.biScale->channels;
      mesh.biScale->interreflected = stored.biScale->interreflected;
    }
  } else if (kind == asset.transfer.kind) {
    mesh.vectors = stored.vectors;
    mesh.matrices = stored.matrices;
  } else {
    mesh.channels = stored.shadowed.channels;
    mesh.vectors = stored.shadowed.vectors;
    mesh.matrixChannels = stored.shadowed.matrixChannels;
    mesh.matrices = stored.shadowed.matrices;
  }
  return mesh;
}

ShownTransfer::ShownTransfer(const asset::Asset& asset, std::uint32_t mesh, TransferChoice choice,
                             std::optional<MacroTransport> macro)
    : stored_(&asset.transfer.meshes[mesh]) {
  if (stored_->biScale && macro) return;
  if (!isStored(asset, mesh, choice)) made_ = chosenTransfer(asset, mesh, choice);
}

}  // namespace lambent::shade
