#include "lambent/macro/collect.h"

#include <algorithm>
#include <optional>

#include "lambent/transport/texel_seams.h"

namespace lambent::macro {

using transfer::Floats;
using transfer::Kind;
using transfer::SharedReceivers;

namespace {

bool isGrey(const Rgb& colour) {
  return colour[0] == colour[1] && colour[1] == colour[2];
}

/// The receivers whose transfer a mesh's stored places hold: texels that are not covered copy
/// another's.
std::vector<std::uint32_t> sourcesOf(const PlacedReceivers::PerMesh& place) {
  if (place.layout != Layout::Vertices) return place.receiverOfTexel;
  std::vector<std::uint32_t> sources(place.count);
  for (std::uint32_t k = 0; k < place.count; ++k) sources[k] = place.first + k;
  return sources;
}

SharedReceivers receiversOf(const PlacedReceivers& all, const PlacedReceivers::PerMesh& place,
                            const std::vector<std::uint32_t>& sources) {
  transfer::Receivers receivers;
  for (const std::uint32_t r : sources) {
    receivers.positions.push_back(all.positions[r]);
    receivers.normals.push_back(all.normals[r]);
  }
  if (place.layout == Layout::Texels)
    receivers.where = transfer::AtTexels{place.width, place.height, place.covered};
  return std::make_shared<const transfer::Receivers>(std::move(receivers));
}

transfer::BiScale<Floats> biScaleOf(const Simulation& s, const PlacedReceivers::PerMesh& place,
                                    SharedReceivers receivers, const Totals& totals,
                                    const Totals* shadowed) {
  transfer::BiScale<Floats> biScale;
  biScale.receivers = std::move(receivers);
  biScale.tangents = place.local->tangents;
  biScale.bands = s.inBands;
  if (s.options.kind == Kind::Unshadowed || place.count == 0) return biScale;
  const std::size_t first = s.matrixIndex[place.first] * s.matrixStride();
  const auto set = [&](Kind kind, const Totals& from, int channels) {
    biScale.matrices.set(kind, {s.inBands, s.inBands, channels,
                                inTangentFrames(s, place, from.matrices + first, channels)});
  };
  const bool bounces = s.options.kind == Kind::Interreflected;
  set(s.options.kind, totals, bounces ? s.channels : 1);
  if (shadowed) set(Kind::Shadowed, *shadowed, 1);
  return biScale;
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

/// Whether a textured mesh sends light on without changing its colour, wherever a ray strikes.
bool hasGreyColours(const scene::Scene& scene, const scene::Mesh& mesh) {
  const scene::Material& material = scene.materials[mesh.material];
  if (!isGrey(material.diffuse) || !isGrey(material.glossy)) return false;
  if (!std::all_of(mesh.colors.begin(), mesh.colors.end(), isGrey)) return false;
  const std::vector<std::uint8_t>& rgba = scene.textures[material.baseColorTexture].rgba;
  for (std::size_t t = 0; t + 3 < rgba.size(); t += 4)
    if (rgba[t] != rgba[t + 1] || rgba[t] != rgba[t + 2]) return false;
  return true;
}

}  // namespace

int channelsFor(const scene::Scene& scene, const PlacedReceivers& receivers, Kind kind) {
  if (kind == Kind::Unshadowed) return 1;
  for (const scene::Mesh& mesh : scene.meshes) {
    const scene::Material& material = scene.materials[mesh.material];
    const bool pane = material.transmitted.maxCoeff() > 0.0f;
    if (!material.isMirror() && !pane) continue;
    const bool painted = material.baseColorTexture >= 0 || !mesh.colors.empty();
    if (painted || !isGrey(material.mirror) || !isGrey(material.transmitted)) return 3;
  }
  if (kind != Kind::Interreflected) return 1;
  const auto allGrey = [](std::span<const Rgb> colours) {
    return std::all_of(colours.begin(), colours.end(), isGrey);
  };
  for (std::size_t m = 0; m < receivers.meshes.size(); ++m) {
    if (scene.meshes[m].layer) continue;  // nothing meets it and takes its colour
    const PlacedReceivers::PerMesh& own = receivers.meshes[m];
    if (own.textured && !hasGreyColours(scene, scene.meshes[m])) return 3;
    const auto ofMesh = [&](const std::vector<Rgb>& colours) {
      return std::span(colours).subspan(own.first, own.count);
    };
    if (!allGrey(ofMesh(receivers.diffuse)) || !allGrey(ofMesh(receivers.glossy))) return 3;
  }
  return 1;
}

transfer::MeshTransfer<Floats> transferOf(const Simulation& s, std::uint32_t meshIndex,
                                          const Totals& totals, const Totals* shadowed) {
  const scene::Mesh& mesh = s.scene.meshes[meshIndex];
  const scene::Material& material = s.scene.materials[mesh.material];
  const PlacedReceivers::PerMesh& place = s.receivers.meshes[meshIndex];
  if (place.layout == Layout::None) return transfer::NoTransfer{};
  const std::vector<std::uint32_t> sources = sourcesOf(place);
  SharedReceivers receivers = receiversOf(s.receivers, place, sources);
  if (place.local) return biScaleOf(s, place, std::move(receivers), totals, shadowed);

  const transfer::Albedo albedo =
      material.baseColorTexture >= 0 ? transfer::Albedo::BaseColor : transfer::Albedo::Included;
  std::vector<Rgb> rho(sources.size(), material.diffuse);
  if (albedo == transfer::Albedo::Included)
    for (std::size_t k = 0; k < sources.size(); ++k) rho[k] = s.receivers.diffuse[sources[k]];
  const bool grey = std::all_of(rho.begin(), rho.end(), isGrey);
  std::optional<transport::TexelSeams> seams;
  if (place.layout == Layout::Texels) seams.emplace(mesh, place);
  const auto closeSeams = [&](std::vector<float>& rows) {
    if (seams && !sources.empty()) seams->close({rows.data(), rows.size() / sources.size()});
  };
  /// `told`: the channels that the totals tell apart.
  const auto responseOf = [&](const Totals& from, int told) {
    transfer::SurfaceResponse<Floats> response;
    const int channels = told == 1 && grey ? 1 : 3;
    if (place.isDiffuse) {
      std::vector<float> vectors = vectorsOf(s, sources, rho, from, told, channels);
      closeSeams(vectors);
      response.diffuse = {albedo, {s.inBands, channels, std::move(vectors)}};
    }
    if (place.isGlossy) {
      std::vector<float> matrices = matricesOf(s, sources, from, told);
      closeSeams(matrices);
      response.glossy = {{material.glossy, material.lobeExponent},
                         {s.outBands, s.inBands, told, std::move(matrices)}};
    }
    return response;
  };
  transfer::Surface<Floats> surface{std::move(receivers), {}};
  surface.responses.set(s.options.kind, responseOf(totals, s.channels));
  if (shadowed)
    surface.responses.set(Kind::Shadowed,
                          responseOf(*shadowed, channelsFor(s.scene, s.receivers, Kind::Shadowed)));
  return surface;
}

}  // namespace lambent::macro
