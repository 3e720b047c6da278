#include "lambent/asset/check.h"

#include <algorithm>
#include <cmath>

#include "lambent/asset/names.h"
#include "lambent/asset/rtt_file.h"
#include "lambent/sh/coefficients.h"

namespace lambent::asset {

namespace {

using encode::EncodedMesh;
using encode::Encoding;
using encode::Numbers;
using transport::Layout;

bool bandsInRange(int bands) {
  return bands >= 1 && bands <= sh::kMaxBands;
}
bool channelsInRange(int channels) {
  return channels == 1 || channels == 3;
}
std::uint64_t squared(int bands) {
  return std::uint64_t(bands) * std::uint64_t(bands);
}
std::string text(std::uint64_t value) {
  return std::to_string(value);
}

/// `name` is for messages: what is kept beside has the same shape, but for its channels.
std::optional<std::string> faultOfVectors(const EncodedMesh& t, const std::string& name,
                                          const Numbers& vectors, int channels) {
  if (!bandsInRange(t.bands))
    return name + ": bands is " + std::to_string(t.bands) + ", not 1 to 10";
  if (!channelsInRange(channels))
    return name + ": channels is " + std::to_string(channels) + ", not 1 or 3";
  const std::uint64_t coefficients = squared(t.bands);
  const std::uint64_t each = std::uint64_t(channels) * coefficients;
  if (vectors.size() != t.receiverCount() * each)
    return name + ": " + text(vectors.size()) + " numbers where " + text(t.receiverCount()) +
           " receivers × " + text(std::uint64_t(channels)) + " channels × " + text(coefficients) +
           " coefficients need " + text(t.receiverCount() * each);
  if (const auto at = firstNonFinite(vectors))
    return name + ": not a finite number at receiver " + text(*at / each) + ", channel " +
           text(*at % each / coefficients) + ", coefficient " + text(*at % coefficients);
  return std::nullopt;
}

std::optional<std::string> faultOfMatrices(const EncodedMesh& t, const std::string& name,
                                           const Numbers& matrices, int channels) {
  if (!bandsInRange(t.outBands) || !bandsInRange(t.inBands))
    return name + ": outBands is " + std::to_string(t.outBands) + " and inBands " +
           std::to_string(t.inBands) + ", not 1 to 10";
  if (!channelsInRange(channels))
    return name + ": channels is " + std::to_string(channels) + ", not 1 or 3";
  const std::uint64_t rows = squared(t.outBands), columns = squared(t.inBands);
  const std::uint64_t each = std::uint64_t(channels) * rows * columns;
  if (matrices.size() != t.receiverCount() * each)
    return name + ": " + text(matrices.size()) + " numbers where " + text(t.receiverCount()) +
           " receivers × " + text(std::uint64_t(channels)) + " channels × " + text(rows) +
           " rows × " + text(columns) + " columns need " + text(t.receiverCount() * each);
  if (const auto at = firstNonFinite(matrices))
    return name + ": not a finite number at receiver " + text(*at / each) + ", channel " +
           text(*at % each / (rows * columns)) + ", row " + text(*at / columns % rows) +
           ", column " + text(*at % columns);
  return std::nullopt;
}

std::optional<std::string> faultOfLobe(const EncodedMesh& t) {
  if (!t.glossy.isFinite().all() || (t.glossy < 0.0f).any())
    return "matrices: glossy must be three finite numbers, none below 0";
  if (!std::isfinite(t.lobeExponent) || t.lobeExponent < 0.0f)
    return "matrices: lobeExponent must be finite and not below 0";
  return std::nullopt;
}

/// What is kept beside is whole: a reader that switches to it must not mix it with the other.
std::optional<std::string> faultOfShadowed(const EncodedMesh& t,
                                           const encode::EncodedField& field) {
  if (field.kind != transport::TransferKind::Interreflected)
    return "shadowed: kept beside interreflected transfer alone, and this asset's is " +
           std::string(nameOf(field.kind));
  if (t.vectors.empty() != t.shadowed.vectors.empty() ||
      t.matrices.empty() != t.shadowed.matrices.empty())
    return std::string("shadowed: must hold vectors and matrices where the primitive does");
  if (!t.vectors.empty())
    if (auto fault = faultOfVectors(t, "shadowed.vectors", t.shadowed.vectors, t.shadowed.channels))
      return fault;
  if (t.matrices.empty()) return std::nullopt;
  return faultOfMatrices(t, "shadowed.matrices", t.shadowed.matrices, t.shadowed.matrixChannels);
}

std::optional<std::string> faultOfGrid(const EncodedMesh& t, const scene::Mesh& mesh) {
  if (t.width < 1 || t.height < 1 || t.width > kLargestGrid || t.height > kLargestGrid)
    return "grid: " + std::to_string(t.width) + "×" + std::to_string(t.height) +
           " texels, not 1 to " + std::to_string(kLargestGrid) + " each way";
  const std::uint64_t texels = std::uint64_t(t.width) * std::uint64_t(t.height);
  if (t.positions.size() != texels)
    return "grid: " + text(t.positions.size()) + " positions for " + text(texels) + " texels";
  if (t.normals.size() != texels)
    return "grid: " + text(t.normals.size()) + " normals for " + text(texels) + " texels";
  if (t.covered.size() != texels)
    return "grid: " + text(t.covered.size()) + " coverage flags for " + text(texels) + " texels";
  if (mesh.uvs.size() != mesh.positions.size())
    return std::string("grid: the primitive has no TEXCOORD_0 to look texels up with");
  if (const auto at = firstNonFinite(t.positions))
    return "grid: not a finite position at texel " + text(*at);
  if (const auto at = firstNonFinite(t.normals))
    return "grid: not a finite normal at texel " + text(*at);
  const auto odd = std::find_if(t.covered.begin(), t.covered.end(), [](auto c) { return c > 1; });
  if (odd != t.covered.end())
    return "grid: covered is " + std::to_string(*odd) + ", not 0 or 1, at texel " +
           text(std::uint64_t(odd - t.covered.begin()));
  return std::nullopt;
}

std::optional<std::string> faultOfLocalMatrices(const EncodedMesh& t, const Numbers& numbers,
                                                const std::string& name, int channels) {
  if (numbers.empty()) return std::nullopt;
  const std::uint64_t matrix = squared(t.biScale->bands) * squared(t.biScale->bands);
  const std::uint64_t needed = t.receiverCount() * std::uint64_t(channels) * matrix;
  if (numbers.size() != needed)
    return "biScale." + name + ": " + text(numbers.size()) + " numbers where " +
           text(t.receiverCount()) + " receivers × " + text(std::uint64_t(channels)) +
           " channels × " + text(matrix) + " need " + text(needed);
  if (numbers.encoding == Encoding::Snorm8 && numbers.block != matrix)
    return "biScale." + name + ": snorm8 needs one scale for each matrix";
  if (const auto at = firstNonFinite(numbers))
    return "biScale." + name + ": not a finite number at receiver " +
           text(*at / (std::uint64_t(channels) * matrix));
  return std::nullopt;
}

std::optional<std::string> faultOfBiScale(const EncodedMesh& t, const scene::Mesh& mesh,
                                          const encode::EncodedField& field) {
  const encode::EncodedBiScale& b = *t.biScale;
  if (t.layout != Layout::Vertices) return std::string("biScale: receivers must be vertices");
  if (!t.vectors.empty() || !t.matrices.empty() || !t.shadowed.empty())
    return std::string("biScale: a bi-scale mesh has no vectors or matrices beside it");
  if (b.rtt < 0 || std::size_t(b.rtt) >= field.rtts.size())
    return "biScale.rtt: is " + std::to_string(b.rtt) + ", and the asset has " +
           text(field.rtts.size());
  if (!bandsInRange(b.bands))
    return "biScale.bands: is " + std::to_string(b.bands) + ", not 1 to 10";
  if (const int other = field.rtts[std::size_t(b.rtt)].bands; other != b.bands)
    return "biScale.bands: is " + std::to_string(b.bands) + ", and its RTT's " +
           std::to_string(other);
  if (!(b.scale > 0.0f) || !std::isfinite(b.scale))
    return std::string("biScale.scale: must be finite and above 0");
  if (b.tangents.size() != mesh.positions.size())
    return "biScale.tangents: " + text(b.tangents.size()) + " for " + text(mesh.positions.size()) +
           " vertices";
  for (std::size_t i = 0; i < b.tangents.size(); ++i)
    if (!(std::abs(b.tangents[i].norm() - 1.0f) < 1e-3f) ||
        !(std::abs(b.tangents[i].dot(mesh.normals[i])) < 1e-2f))
      return "biScale.tangents: that of vertex " + text(i) +
             " is not of unit length at right angles to the normal";
  if (mesh.uvs.size() != mesh.positions.size())
    return std::string("biScale: the primitive has no TEXCOORD_0 to find the patch by");
  if (b.idMap) {
    const std::uint64_t texels = std::uint64_t(b.idMap->width) * std::uint64_t(b.idMap->height);
    if (b.idMap->width < 1 || b.idMap->height < 1 || b.idMap->width > kLargestGrid ||
        b.idMap->height > kLargestGrid || b.idMap->ids.size() != 2 * texels)
      return "biScale.idMap: " + text(b.idMap->ids.size()) + " numbers for " +
             std::to_string(b.idMap->width) + "×" + std::to_string(b.idMap->height) + " texels";
  } else if (!b.tiles.allFinite() || b.tiles.x() == 0.0f || b.tiles.y() == 0.0f) {
    return std::string("biScale.tiles: must be finite and not 0");
  }
  if (auto fault = faultOfLocalMatrices(t, b.shadowed, "shadowed", 1)) return fault;
  if (!b.interreflected.empty() && !channelsInRange(b.channels))
    return "biScale.interreflected: channels is " + std::to_string(b.channels) + ", not 1 or 3";
  return faultOfLocalMatrices(t, b.interreflected, "interreflected", b.channels);
}

/// What checkGltf asks of a file's vertices: of those with transfer, and of those without.
std::optional<std::string> faultOfSurface(const scene::Mesh& mesh, bool carriesTransfer) {
  if (carriesTransfer && (mesh.positions.empty() || mesh.normals.size() != mesh.positions.size()))
    return text(mesh.normals.size()) + " normals for " + text(mesh.positions.size()) +
           " vertices with transfer";
  const auto finite = [](const auto& values) {
    return std::all_of(values.begin(), values.end(),
                       [](const auto& v) { return v.array().isFinite().all(); });
  };
  if (!finite(mesh.positions) || !finite(mesh.normals) || !finite(mesh.uvs) || !finite(mesh.colors))
    return std::string("a position, normal, texture coordinate or colour is not finite");
  return std::nullopt;
}

/// Vertex receivers are not stored: they are the primitive's vertices.
std::optional<std::string> faultOfVertices(const EncodedMesh& t, const scene::Mesh& mesh) {
  if (t.positions.size() != mesh.positions.size() || t.normals.size() != mesh.normals.size())
    return text(t.receiverCount()) + " receivers for " + text(mesh.positions.size()) + " vertices";
  for (std::size_t i = 0; i < t.positions.size(); ++i)
    if (t.positions[i] != mesh.positions[i] || !t.normals[i].isApprox(mesh.normals[i], 1e-3f))
      return "receiver " + text(i) + " does not stand at vertex " + text(i);
  return std::nullopt;
}

}  // namespace

std::string meshLabel(const scene::Scene& scene, std::size_t mesh) {
  const std::string& name = scene.meshes[mesh].name;
  return "mesh " + std::to_string(mesh) + (name.empty() ? "" : " (\"" + name + "\")");
}

std::optional<std::size_t> firstNonFinite(const Numbers& numbers) {
  if (numbers.encoding == Encoding::Float16) {
    const auto at = std::find_if(numbers.half.begin(), numbers.half.end(),
                                 [](std::uint16_t h) { return (h & 0x7c00u) == 0x7c00u; });
    if (at == numbers.half.end()) return std::nullopt;
    return std::size_t(at - numbers.half.begin());
  }
  if (numbers.encoding == Encoding::Snorm8) {
    const auto at = std::find_if(numbers.scales.begin(), numbers.scales.end(),
                                 [](float f) { return !std::isfinite(f); });
    if (at == numbers.scales.end()) return std::nullopt;
    return std::size_t(at - numbers.scales.begin()) * numbers.block;
  }
  const auto at = std::find_if(numbers.single.begin(), numbers.single.end(),
                               [](float f) { return !std::isfinite(f); });
  if (at == numbers.single.end()) return std::nullopt;
  return std::size_t(at - numbers.single.begin());
}

std::optional<std::size_t> firstNonFinite(std::span<const Vec3> vectors) {
  for (std::size_t i = 0; i < vectors.size(); ++i)
    if (!vectors[i].allFinite()) return i;
  return std::nullopt;
}

std::optional<std::string> faultOf(const EncodedMesh& transfer, const scene::Mesh& mesh,
                                   const encode::EncodedField& field) {
  switch (transfer.layout) {
    case Layout::None:
      if (!transfer.vectors.empty() || !transfer.matrices.empty() || !transfer.shadowed.empty() ||
          transfer.biScale)
        return std::string("transfer without receivers");
      return std::nullopt;
    case Layout::Vertices:
      if (auto fault = faultOfVertices(transfer, mesh)) return fault;
      break;
    case Layout::Texels:
      if (auto fault = faultOfGrid(transfer, mesh)) return fault;
      break;
  }
  if (!transfer.vectors.empty())
    if (auto fault = faultOfVectors(transfer, "vectors", transfer.vectors, transfer.channels))
      return fault;
  if (!transfer.matrices.empty()) {
    if (auto fault =
            faultOfMatrices(transfer, "matrices", transfer.matrices, transfer.matrixChannels))
      return fault;
    if (auto fault = faultOfLobe(transfer)) return fault;
  }
  if (!transfer.shadowed.empty())
    if (auto fault = faultOfShadowed(transfer, field)) return fault;
  if (transfer.biScale)
    if (auto fault = faultOfBiScale(transfer, mesh, field)) return fault;
  for (const auto& [name, needed] :
       {std::pair("vectors.bands", transfer.vectors.empty() ? 0 : transfer.bands),
        std::pair("matrices.inBands", transfer.matrices.empty() ? 0 : transfer.inBands),
        std::pair("biScale.bands", transfer.biScale ? transfer.biScale->bands : 0)})
    if (needed > field.bands)
      return std::string(name) + ": takes light of " + std::to_string(needed) +
             " bands, more than the asset's " + std::to_string(field.bands);
  return std::nullopt;
}

Status checkSize(const PartBytes& bytes) {
  if (bytes.total() < (std::uint64_t(1) << 32)) return Status::ok();
  const auto mebibytes = [](std::uint64_t count) { return text(count >> 20) + " MiB"; };
  return report::failed("a .glb holds at most 4 GiB, and this asset takes " +
                        mebibytes(bytes.total()) + " (" + mebibytes(bytes.vectors) +
                        " of vectors, " + mebibytes(bytes.matrices) + " of matrices, " +
                        mebibytes(bytes.rtts + bytes.idMaps) +
                        " of RTTs and id maps): bake with float16, fewer bands or fewer receivers");
}

Status checkForWriting(const Asset& asset) {
  const encode::EncodedField& field = asset.transfer;
  if (field.meshes.size() != asset.scene.meshes.size())
    return report::failed("transfer for " + text(field.meshes.size()) + " meshes in a scene of " +
                          text(asset.scene.meshes.size()));
  if (!bandsInRange(field.bands))
    return report::failed("bands is " + std::to_string(field.bands) + ", not 1 to 10");
  for (double energy : field.passEnergy)
    if (!std::isfinite(energy))
      return report::failed("the energy of a pass is not a finite number");
  for (std::size_t i = 0; i < field.rtts.size(); ++i)
    if (auto fault = faultOf(field.rtts[i]))
      return report::failed("rtt " + text(i) + ": " + *fault);
  for (std::size_t i = 0; i < field.meshes.size(); ++i)
    if (auto fault = faultOfSurface(asset.scene.meshes[i], field.meshes[i].layout != Layout::None))
      return report::failed(meshLabel(asset.scene, i) + ": " + *fault);
  for (std::size_t i = 0; i < field.meshes.size(); ++i)
    if (auto fault = faultOf(field.meshes[i], asset.scene.meshes[i], field))
      return report::failed(meshLabel(asset.scene, i) + ": " + *fault);
  return checkSize(summarize(asset).bytes);
}

}  // namespace lambent::asset
