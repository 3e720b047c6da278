#include "lambent/asset/check.h"

#include <algorithm>
#include <cmath>

#include "lambent/asset/bi_scale_part.h"
#include "lambent/asset/rtt_part.h"
#include "lambent/asset/surface_part.h"

namespace lambent::asset {

using transfer::EncodedField;
using transfer::EncodedMesh;
using transfer::Numbers;
using BiScale = transfer::BiScale<Numbers>;
using Surface = transfer::Surface<Numbers>;

namespace {

Wrong faultOfTransfer(const Surface& surface, const scene::Mesh&, const EncodedField& field) {
  return faultOf(surface, field);
}
Wrong faultOfTransfer(const BiScale& biScale, const scene::Mesh& mesh, const EncodedField& field) {
  return faultOf(biScale, mesh, field);
}

template <class Transfer>
Wrong faultOnReceivers(const Transfer& transfer, const scene::Mesh& mesh,
                       const EncodedField& field) {
  if (!transfer.receivers) return std::string("transfer without receivers");
  if (auto wrong = faultOf(*transfer.receivers, mesh)) return wrong;
  return faultOfTransfer(transfer, mesh, field);
}

/// What a loader sees to, asked again of scenes that were made in memory.
Wrong faultOfGeometry(const scene::Mesh& mesh, std::size_t materials) {
  const std::size_t vertices = mesh.positions.size();
  if (mesh.material < 0 || std::size_t(mesh.material) >= materials)
    return "there is no material " + std::to_string(mesh.material);
  if (mesh.normals.size() != vertices)
    return text(mesh.normals.size()) + " normals for " + text(vertices) + " vertices";
  if ((!mesh.uvs.empty() && mesh.uvs.size() != vertices) ||
      (!mesh.texelUvs.empty() && mesh.texelUvs.size() != vertices) ||
      (!mesh.colors.empty() && mesh.colors.size() != vertices))
    return std::string("texture coordinates or colours do not match the vertices");
  for (const scene::VertexNumbers& numbers : mesh.others)
    if (numbers.width < 1 || numbers.width > 4 ||
        numbers.values.size() != std::size_t(numbers.width) * vertices)
      return numbers.name + " does not match the vertices";
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (const std::uint32_t index : mesh.triangles[t])
      if (index >= vertices)
        return "triangle " + text(t) + " names vertex " + text(index) + ", but there are " +
               text(vertices);
  const auto finite = [](const auto& values) {
    return std::all_of(values.begin(), values.end(),
                       [](const auto& v) { return v.array().isFinite().all(); });
  };
  if (!finite(mesh.positions) || !finite(mesh.normals) || !finite(mesh.uvs) ||
      !finite(mesh.texelUvs) || !finite(mesh.colors))
    return std::string("a position, normal, texture coordinate or colour is not finite");
  return std::nullopt;
}

Wrong faultOfField(const EncodedField& field) {
  if (!bandsInRange(field.bands))
    return "bands is " + std::to_string(field.bands) + ", not 1 to 10";
  for (const double energy : field.passEnergy)
    if (!std::isfinite(energy)) return std::string("the energy of a pass is not a finite number");
  for (std::size_t i = 0; i < field.rtts.size(); ++i)
    if (auto wrong = faultOf(field.rtts[i])) return "rtt " + text(i) + ": " + *wrong;
  return std::nullopt;
}

/// In memory, bare surfaces can be kept in bytes too.
bool hasBytes(const EncodedMesh& mesh) {
  bool bytes = false;
  const auto look = [&](const Numbers& numbers) {
    bytes = bytes || numbers.encoding == transfer::Encoding::Snorm8;
  };
  if (const auto* surface = std::get_if<Surface>(&mesh))
    surface->responses.each([&](transfer::Kind, const auto& response) {
      if (response.diffuse) look(response.diffuse->vectors.numbers);
      if (response.glossy) look(response.glossy->matrices.numbers);
    });
  return bytes;
}

}  // namespace

std::string meshLabel(const scene::Scene& scene, std::size_t mesh) {
  const std::string& name = scene.meshes[mesh].name;
  return "mesh " + std::to_string(mesh) + (name.empty() ? "" : " (\"" + name + "\")");
}

std::optional<std::string> faultOf(const EncodedMesh& transfer, const scene::Mesh& mesh,
                                   const EncodedField& field) {
  using Found = std::optional<std::string>;
  if (mesh.layer && !std::holds_alternative<BiScale>(transfer))
    return "is a layer, and holds no meso-structure";
  return std::visit(
      transfer::ForEachKind{
          [](const transfer::NoTransfer&) -> Found { return std::nullopt; },
          [&](const auto& held) -> Found { return faultOnReceivers(held, mesh, field); }},
      transfer);
}

std::optional<std::string> faultOf(const Asset& asset) {
  const scene::Scene& scene = asset.scene;
  const EncodedField& field = asset.transfer;
  if (field.meshes.size() != scene.meshes.size())
    return "transfer for " + text(field.meshes.size()) + " meshes in a scene of " +
           text(scene.meshes.size());
  if (auto wrong = faultOfField(field)) return wrong;
  for (std::size_t i = 0; i < field.meshes.size(); ++i) {
    auto wrong = faultOfGeometry(scene.meshes[i], scene.materials.size());
    if (!wrong) wrong = faultOf(field.meshes[i], scene.meshes[i], field);
    if (wrong) return meshLabel(scene, i) + ": " + *wrong;
  }
  return std::nullopt;
}

PartBytes bytesOf(const Asset& asset) {
  PartBytes bytes;
  for (const scene::Mesh& mesh : asset.scene.meshes)
    bytes.geometry += bytesOf(mesh.positions).size() + bytesOf(mesh.normals).size() +
                      bytesOf(mesh.uvs).size() + bytesOf(mesh.texelUvs).size() +
                      bytesOf(mesh.colors).size() + bytesOf(mesh.triangles).size();
  for (const scene::Texture& texture : asset.scene.textures)
    bytes.textures += texture.encoded.size();
  const transfer::ForEachKind countOne{[](const transfer::NoTransfer&) {},
                                       [&](const auto& held) { count(held, bytes); }};
  for (const EncodedMesh& mesh : asset.transfer.meshes) std::visit(countOne, mesh);
  for (const transfer::EncodedRtt& rtt : asset.transfer.rtts) count(rtt, bytes);
  return bytes;
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
  if (const auto wrong = faultOf(asset)) return report::failed(*wrong);
  for (std::size_t i = 0; i < asset.transfer.meshes.size(); ++i)
    if (hasBytes(asset.transfer.meshes[i]))
      return report::failed(meshLabel(asset.scene, i) +
                            ": a file holds vectors and glossy matrices as float16 or float32");
  return checkSize(bytesOf(asset));
}

}  // namespace lambent::asset
