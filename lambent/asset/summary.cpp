#include "lambent/asset/summary.h"

#include <algorithm>

namespace lambent::asset {

namespace {

template <class T>
std::uint64_t bytesOf(const std::vector<T>& values) {
  return values.size() * sizeof(T);
}

std::uint64_t bytesOf(const encode::Numbers& numbers) {
  return bytesOf(numbers.half) + bytesOf(numbers.single) + bytesOf(numbers.byte) +
         bytesOf(numbers.scales);
}

std::uint64_t bytesOf(const scene::Mesh& mesh) {
  return bytesOf(mesh.positions) + bytesOf(mesh.normals) + bytesOf(mesh.uvs) +
         bytesOf(mesh.colors) + bytesOf(mesh.triangles);
}

MeshSummary summaryOf(const scene::Scene& scene, const scene::Mesh& mesh,
                      const encode::EncodedMesh& transfer) {
  const scene::Material& material = scene.materials[std::size_t(mesh.material)];
  MeshSummary summary;
  summary.name = mesh.name;
  summary.material = material.name;
  summary.mirror = material.isMirror();
  summary.vertices = mesh.positions.size();
  summary.triangles = mesh.triangles.size();
  summary.layout = transfer.layout;
  summary.width = transfer.width;
  summary.height = transfer.height;
  summary.receivers = transfer.receiverCount();
  summary.covered = std::uint64_t(std::count(transfer.covered.begin(), transfer.covered.end(), 1));
  if (!transfer.vectors.empty())
    summary.vectors = VectorsSummary{.bands = transfer.bands,
                                     .channels = transfer.channels,
                                     .encoding = transfer.vectors.encoding,
                                     .albedo = transfer.albedo,
                                     .bytes = bytesOf(transfer.vectors)};
  if (!transfer.matrices.empty())
    summary.matrices = MatricesSummary{.outBands = transfer.outBands,
                                       .inBands = transfer.inBands,
                                       .channels = transfer.matrixChannels,
                                       .encoding = transfer.matrices.encoding,
                                       .glossy = transfer.glossy,
                                       .lobeExponent = transfer.lobeExponent,
                                       .bytes = bytesOf(transfer.matrices)};
  if (const encode::EncodedShadowed& kept = transfer.shadowed; !kept.empty())
    summary.shadowed =
        ShadowedSummary{.channels = kept.vectors.empty() ? 0 : kept.channels,
                        .matrixChannels = kept.matrices.empty() ? 0 : kept.matrixChannels,
                        .bytes = bytesOf(kept.vectors) + bytesOf(kept.matrices)};
  if (const auto& b = transfer.biScale)
    summary.biScale = BiScaleSummary{
        .rtt = b->rtt,
        .bands = b->bands,
        .scale = b->scale,
        .idMapWidth = b->idMap ? b->idMap->width : 0,
        .idMapHeight = b->idMap ? b->idMap->height : 0,
        .tiles = b->tiles,
        .shadowed = !b->shadowed.empty(),
        .interreflected = !b->interreflected.empty(),
        .channels = b->channels,
        .encoding = b->interreflected.empty() ? b->shadowed.encoding : b->interreflected.encoding,
        .bytes = bytesOf(b->shadowed) + bytesOf(b->interreflected)};
  return summary;
}

}  // namespace

RttSummary summarize(const encode::EncodedRtt& rtt) {
  return {rtt.name, rtt.width, rtt.height,          rtt.views,          rtt.bands,
          rtt.size, rtt.depth, rtt.values.encoding, bytesOf(rtt.values)};
}

Summary summarize(const Asset& asset) {
  const scene::Scene& scene = asset.scene;
  const encode::EncodedField& field = asset.transfer;
  Summary summary;
  summary.kind = field.kind;
  summary.bands = field.bands;
  summary.directions = field.directions;
  summary.bounces = field.bounces;
  summary.seed = field.seed;
  summary.passEnergy = field.passEnergy;
  summary.materials = scene.materials.size();
  summary.textures = scene.textures.size();
  summary.cameras = scene.cameras.size();
  for (std::size_t i = 0; i < scene.meshes.size() && i < field.meshes.size(); ++i) {
    const encode::EncodedMesh& transfer = field.meshes[i];
    const MeshSummary& mesh =
        summary.meshes.emplace_back(summaryOf(scene, scene.meshes[i], transfer));
    summary.vertices += mesh.vertices;
    summary.triangles += mesh.triangles;
    summary.receivers += mesh.receivers;
    summary.bytes.geometry += bytesOf(scene.meshes[i]);
    summary.bytes.vectors += bytesOf(transfer.vectors) + bytesOf(transfer.shadowed.vectors);
    summary.bytes.matrices += bytesOf(transfer.matrices) + bytesOf(transfer.shadowed.matrices);
    const std::uint64_t places =
        bytesOf(transfer.positions) + bytesOf(transfer.normals) + bytesOf(transfer.covered);
    if (transfer.layout == transport::Layout::Texels) summary.bytes.receivers += places;
    summary.memoryBytes += places;
    if (const auto& b = transfer.biScale) {
      summary.bytes.matrices += bytesOf(b->shadowed) + bytesOf(b->interreflected);
      if (b->idMap) summary.bytes.idMaps += bytesOf(b->idMap->ids);
      summary.bytes.receivers += bytesOf(b->tangents);
      summary.memoryBytes += bytesOf(b->tangents);
    }
  }
  for (const encode::EncodedRtt& rtt : field.rtts) {
    summary.rtts.push_back(summarize(rtt));
    summary.bytes.rtts += summary.rtts.back().bytes;
  }
  std::uint64_t decoded = 0;
  for (const scene::Texture& texture : scene.textures) {
    summary.bytes.textures += bytesOf(texture.encoded);
    decoded += bytesOf(texture.rgba);
  }
  summary.memoryBytes += decoded + summary.bytes.total() - summary.bytes.receivers;
  return summary;
}

}  // namespace lambent::asset
