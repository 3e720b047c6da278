#include "lambent/macro/collect.h"

#include <algorithm>

namespace lambent::macro {

using transport::Albedo;

namespace {

bool isGrey(const Rgb& colour) {
  return colour[0] == colour[1] && colour[1] == colour[2];
}

/// The receivers whose transfer a mesh's stored places hold: texels that are not covered copy
/// another's.
std::vector<std::uint32_t> sourcesOf(const Receivers::PerMesh& place) {
  if (place.layout != Layout::Vertices) return place.receiverOfTexel;
  std::vector<std::uint32_t> sources(place.count);
  for (std::uint32_t k = 0; k < place.count; ++k) sources[k] = place.first + k;
  return sources;
}

LocalTransfer localOf(const Simulation& s, const Receivers::PerMesh& place, const Totals& totals,
                      const Totals* shadowed) {
  LocalTransfer local;
  local.tangents = place.local->tangents;
  local.bands = s.inBands;
  if (s.options.kind == TransferKind::Unshadowed || place.count == 0) return local;
  const std::size_t first = s.matrixIndex[place.first] * s.matrixStride();
  if (s.options.kind == TransferKind::Shadowed) {
    local.shadowed = inTangentFrames(s, place, totals.matrices + first, 1);
    return local;
  }
  local.channels = s.channels;
  local.interreflected = inTangentFrames(s, place, totals.matrices + first, local.channels);
  if (shadowed) local.shadowed = inTangentFrames(s, place, shadowed->matrices + first, 1);
  return local;
}

/// ρ/π E of every source, whose accumulators tell the first `told` channels apart:
/// [source][channel][n²].
std::vector<float> vectorsOf(const Simulation& s, const std::vector<std::uint32_t>& sources,
                             const std::vector<Rgb>& rho, const Totals& totals, int told,
                             int channels) {
  std::vector<float> vectors;
  vectors.reserve(sources.size() * std::size_t(channels) * s.inCount);
  for (std::size_t k = 0; k < sources.size(); ++k) {
    const float* e = totals.rows + sources[k] * s.rowStride;
    for (int c = 0; c < channels; ++c) {
      const double factor = rho[k][c] / kPi;
      const float* channel = e + (told == 1 ? 0 : c) * s.inCount;
      for (std::size_t j = 0; j < s.inCount; ++j)
        vectors.push_back(static_cast<float>(factor * channel[j]));
    }
  }
  return vectors;
}

/// M of every source: [source][channel][N²][n²].
std::vector<float> matricesOf(const Simulation& s, const std::vector<std::uint32_t>& sources,
                              const Totals& totals, int channels) {
  std::vector<float> matrices;
  matrices.reserve(sources.size() * std::size_t(channels) * s.outCount * s.inCount);
  for (const std::uint32_t r : sources) {
    const float* matrix = totals.matrices + s.matrixIndex[r] * s.matrixStride();
    for (int c = 0; c < channels; ++c)
      for (std::size_t i = 0; i < s.outCount; ++i) {
        const float* row = matrix + i * s.rowStride + c * s.inCount;
        matrices.insert(matrices.end(), row, row + s.inCount);
      }
  }
  return matrices;
}

}  // namespace

int channelsFor(const scene::Scene& scene, const Receivers& receivers, TransferKind kind) {
  if (kind == TransferKind::Unshadowed) return 1;
  for (const scene::Mesh& mesh : scene.meshes) {
    const scene::Material& material = scene.materials[mesh.material];
    if (!material.isMirror()) continue;
    const bool painted = material.baseColorTexture >= 0 || !mesh.colors.empty();
    if (painted || !isGrey(material.mirror)) return 3;
  }
  if (kind != TransferKind::Interreflected) return 1;
  const auto allGrey = [](const std::vector<Rgb>& colours) {
    return std::all_of(colours.begin(), colours.end(), isGrey);
  };
  return allGrey(receivers.diffuse) && allGrey(receivers.glossy) ? 1 : 3;
}

MeshTransfer transferOf(const Simulation& s, std::uint32_t meshIndex, const Totals& totals,
                        const Totals* shadowed) {
  const scene::Mesh& mesh = s.scene.meshes[meshIndex];
  const scene::Material& material = s.scene.materials[mesh.material];
  const Receivers::PerMesh& place = s.receivers.meshes[meshIndex];
  MeshTransfer out;
  out.layout = place.layout;
  if (place.layout == Layout::None) return out;
  out.width = place.width, out.height = place.height;
  out.covered = place.covered;
  const std::vector<std::uint32_t> sources = sourcesOf(place);
  for (const std::uint32_t r : sources) {
    out.positions.push_back(s.receivers.positions[r]);
    out.normals.push_back(s.receivers.normals[r]);
  }
  if (place.local) {
    out.local = localOf(s, place, totals, shadowed);
    return out;
  }
  const int shadowedChannels = channelsFor(s.scene, s.receivers, TransferKind::Shadowed);
  out.albedo = material.baseColorTexture >= 0 ? Albedo::BaseColor : Albedo::Included;
  if (place.isDiffuse) {
    std::vector<Rgb> rho(sources.size(), material.diffuse);
    if (out.albedo == Albedo::Included)
      for (std::size_t k = 0; k < sources.size(); ++k) rho[k] = s.receivers.diffuse[sources[k]];
    const bool grey = std::all_of(rho.begin(), rho.end(), isGrey);
    out.bands = s.inBands;
    out.channels = s.channels == 1 && grey ? 1 : 3;
    out.vectors = vectorsOf(s, sources, rho, totals, s.channels, out.channels);
    if (shadowed) {
      out.shadowed.channels = shadowedChannels == 1 && grey ? 1 : 3;
      out.shadowed.vectors =
          vectorsOf(s, sources, rho, *shadowed, shadowedChannels, out.shadowed.channels);
    }
  }
  if (place.isGlossy) {
    out.inBands = s.inBands, out.outBands = s.outBands;
    out.matrixChannels = s.channels;
    out.glossy = material.glossy;
    out.lobeExponent = material.lobeExponent;
    out.matrices = matricesOf(s, sources, totals, out.matrixChannels);
    if (shadowed) {
      out.shadowed.matrixChannels = shadowedChannels;
      out.shadowed.matrices = matricesOf(s, sources, *shadowed, shadowedChannels);
    }
  }
  return out;
}

}  // namespace lambent::macro
