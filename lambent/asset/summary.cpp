#include "lambent/asset/summary.h"

#include <algorithm>

#include "lambent/asset/check.h"

namespace lambent::asset {

using transfer::Kind;
using transfer::Numbers;
using Response = transfer::SurfaceResponse<Numbers>;

namespace {

void describe(const transfer::Surface<Numbers>& surface, Kind kind, MeshSummary& summary) {
  if (const Response* own = surface.responses.find(kind)) {
    if (own->diffuse)
      summary.vectors = VectorsSummary{.bands = own->diffuse->vectors.bands,
                                       .channels = own->diffuse->vectors.channels,
                                       .encoding = own->diffuse->vectors.numbers.encoding,
                                       .albedo = own->diffuse->albedo,
                                       .bytes = transfer::bytesOf(own->diffuse->vectors.numbers)};
    if (own->glossy)
      summary.matrices = MatricesSummary{.outBands = own->glossy->matrices.outBands,
                                         .inBands = own->glossy->matrices.inBands,
                                         .channels = own->glossy->matrices.channels,
                                         .encoding = own->glossy->matrices.numbers.encoding,
                                         .glossy = own->glossy->lobe.reflectance,
                                         .lobeExponent = own->glossy->lobe.exponent,
                                         .bytes = transfer::bytesOf(own->glossy->matrices.numbers)};
  }
  const Response* kept = kind == Kind::Shadowed ? nullptr : surface.responses.find(Kind::Shadowed);
  if (!kept) return;
  ShadowedSummary& shadowed = summary.shadowed.emplace();
  if (kept->diffuse) {
    shadowed.channels = kept->diffuse->vectors.channels;
    shadowed.bytes += transfer::bytesOf(kept->diffuse->vectors.numbers);
  }
  if (kept->glossy) {
    shadowed.matrixChannels = kept->glossy->matrices.channels;
    shadowed.bytes += transfer::bytesOf(kept->glossy->matrices.numbers);
  }
}

void describe(const transfer::BiScale<Numbers>& biScale, Kind, MeshSummary& summary) {
  const transfer::IdMap* map = biScale.patch.idMap();
  BiScaleSummary& to = summary.biScale.emplace();
  to.rtt = biScale.patch.rtt;
  to.bands = biScale.bands;
  to.scale = biScale.patch.scale;
  if (map) to.idMapWidth = map->width, to.idMapHeight = map->height;
  to.tiles = biScale.patch.tiles();
  to.shadowed = biScale.matrices.holds(Kind::Shadowed);
  to.interreflected = biScale.matrices.holds(Kind::Interreflected);
  to.encoding = transfer::Encoding::Float32;
  biScale.matrices.each([&](Kind kind, const transfer::Matrices<Numbers>& matrices) {
    if (kind == Kind::Interreflected) to.channels = matrices.channels;
    to.encoding = matrices.numbers.encoding;
    to.bytes += transfer::bytesOf(matrices.numbers);
  });
}

void describe(const transfer::NoTransfer&, Kind, MeshSummary&) {}

/// Of a mesh with meso-structure.
void describeTint(const scene::Scene& scene, const scene::Mesh& mesh, BiScaleSummary& to) {
  to.tintedVertices = !mesh.colors.empty();
  to.layer = mesh.layer;
  const int texture = scene::materialOf(scene, mesh).baseColorTexture;
  if (texture < 0 || std::size_t(texture) >= scene.textures.size()) return;
  to.tintWidth = scene.textures[std::size_t(texture)].width;
  to.tintHeight = scene.textures[std::size_t(texture)].height;
}

MeshSummary summaryOf(const scene::Scene& scene, const scene::Mesh& mesh,
                      const transfer::EncodedMesh& transfer, Kind kind) {
  const scene::Material& material = scene.materials[std::size_t(mesh.material)];
  MeshSummary summary;
  summary.name = mesh.name;
  summary.material = material.name;
  summary.mirror = material.isMirror();
  summary.vertices = mesh.positions.size();
  summary.triangles = mesh.triangles.size();
  if (const transfer::Receivers* receivers = transfer::receiversOf(transfer)) {
    summary.layout = transfer::layoutOf(*receivers);
    summary.receivers = receivers->size();
    if (const transfer::AtTexels* grid = receivers->texels()) {
      summary.width = grid->width, summary.height = grid->height;
      summary.texCoord = mesh.texelUvs.empty() ? 0 : 1;
      summary.covered = std::uint64_t(std::count(grid->covered.begin(), grid->covered.end(), 1));
    }
  }
  std::visit([&](const auto& kindOfTransfer) { describe(kindOfTransfer, kind, summary); },
             transfer);
  if (summary.biScale) describeTint(scene, mesh, *summary.biScale);
  return summary;
}

}  // namespace

RttSummary summarize(const transfer::EncodedRtt& rtt) {
  return {rtt.name, rtt.width, rtt.height,          rtt.views,          rtt.bands,
          rtt.size, rtt.depth, rtt.values.encoding, bytesOf(rtt.values)};
}

Summary summarize(const Asset& asset) {
  const scene::Scene& scene = asset.scene;
  const transfer::EncodedField& field = asset.transfer;
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
  summary.bytes = bytesOf(asset);
  summary.memoryBytes = summary.bytes.total();
  for (std::size_t i = 0; i < scene.meshes.size() && i < field.meshes.size(); ++i) {
    const MeshSummary& mesh =
        summary.meshes.emplace_back(summaryOf(scene, scene.meshes[i], field.meshes[i], field.kind));
    summary.vertices += mesh.vertices;
    summary.triangles += mesh.triangles;
    summary.receivers += mesh.receivers;
    // In memory, vertex receivers have places of their own too.
    if (mesh.layout == "vertices") summary.memoryBytes += mesh.receivers * 2 * sizeof(Vec3);
  }
  for (const transfer::EncodedRtt& rtt : field.rtts) summary.rtts.push_back(summarize(rtt));
  for (const scene::Texture& texture : scene.textures) summary.memoryBytes += texture.rgba.size();
  return summary;
}

}  // namespace lambent::asset
