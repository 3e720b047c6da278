// Asset → glTF with the extension LAMBENT_radiance_transfer (spec/LAMBENT_radiance_transfer).
#include <bit>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "lambent/asset/asset.h"
#include "lambent/asset/check.h"
#include "lambent/asset/names.h"
#include "lambent/file/atomic_file.h"
#include "lambent/scene_io/gltf_write.h"

namespace lambent::asset {

namespace {

using encode::EncodedMesh;
using encode::Encoding;
using encode::Numbers;
using nlohmann::json;
using scene_io::Component;
using scene_io::GltfBuilder;
using transport::Layout;

// glTF is little-endian, and numbers go there as they lie in memory.
static_assert(std::endian::native == std::endian::little);
static_assert(sizeof(Vec3) == 12);

template <class T>
std::span<const std::byte> bytesOf(const std::vector<T>& values) {
  return std::as_bytes(std::span(values));
}

/// {"accessor", "encoding"} and, for snorm8, "scales".
json numbersObject(GltfBuilder& gltf, const Numbers& numbers) {
  json object = {{"encoding", nameOf(numbers.encoding)}};
  switch (numbers.encoding) {
    case Encoding::Float16:
      object["accessor"] = gltf.addAccessor(bytesOf(numbers.half), Component::UnsignedShort,
                                            "SCALAR", numbers.size());
      break;
    case Encoding::Float32:
      object["accessor"] =
          gltf.addAccessor(bytesOf(numbers.single), Component::Float, "SCALAR", numbers.size());
      break;
    case Encoding::Snorm8:
      object["accessor"] =
          gltf.addAccessor(bytesOf(numbers.byte), Component::Byte, "SCALAR", numbers.size());
      object["scales"] = gltf.addAccessor(bytesOf(numbers.scales), Component::Float, "SCALAR",
                                          numbers.scales.size());
      break;
  }
  return object;
}

json numbersObject(GltfBuilder& gltf, const Numbers& numbers, json members) {
  members.update(numbersObject(gltf, numbers));
  return members;
}

json rttObject(GltfBuilder& gltf, const encode::EncodedRtt& rtt) {
  return {{"name", rtt.name},     {"width", rtt.width},
          {"height", rtt.height}, {"views", rtt.views},
          {"bands", rtt.bands},   {"size", {rtt.size.x(), rtt.size.y()}},
          {"depth", rtt.depth},   {"values", numbersObject(gltf, rtt.values)}};
}

json biScaleObject(GltfBuilder& gltf, const encode::EncodedBiScale& biScale) {
  json object = {{"rtt", biScale.rtt},
                 {"bands", biScale.bands},
                 {"scale", biScale.scale},
                 {"tangents", gltf.addAccessor(bytesOf(biScale.tangents), Component::Float, "VEC3",
                                               biScale.tangents.size())}};
  if (biScale.idMap)
    object["idMap"] = {
        {"width", biScale.idMap->width},
        {"height", biScale.idMap->height},
        {"texCoord", 0},
        {"accessor", gltf.addAccessor(bytesOf(biScale.idMap->ids), Component::UnsignedShort,
                                      "SCALAR", biScale.idMap->ids.size())}};
  else
    object["tiles"] = {biScale.tiles.x(), biScale.tiles.y()};
  if (!biScale.shadowed.empty()) object["shadowed"] = numbersObject(gltf, biScale.shadowed);
  if (!biScale.interreflected.empty())
    object["interreflected"] =
        numbersObject(gltf, biScale.interreflected, {{"channels", biScale.channels}});
  return object;
}

json rootObject(const encode::EncodedField& field) {
  json root;
  root["version"] = std::to_string(kFormatMajor) + "." + std::to_string(kFormatMinor);
  root["generator"] = "Lambent";
  root["transfer"] = nameOf(field.kind);
  root["bands"] = field.bands;
  root["frame"] = "scene";
  root["directions"] = field.directions;
  root["bounces"] = field.bounces;
  root["seed"] = std::to_string(field.seed);  // 64 bits: more than a JSON number holds everywhere
  root["passEnergy"] = field.passEnergy;
  return root;
}

json shadowedObject(GltfBuilder& gltf, const encode::EncodedShadowed& shadowed) {
  json object;
  if (!shadowed.vectors.empty())
    object["vectors"] = numbersObject(gltf, shadowed.vectors, {{"channels", shadowed.channels}});
  if (!shadowed.matrices.empty())
    object["matrices"] =
        numbersObject(gltf, shadowed.matrices, {{"channels", shadowed.matrixChannels}});
  return object;
}

json primitiveObject(GltfBuilder& gltf, const EncodedMesh& mesh) {
  json object;
  object["layout"] = nameOf(mesh.layout);
  if (!mesh.vectors.empty())
    object["vectors"] = numbersObject(
        gltf, mesh.vectors,
        {{"bands", mesh.bands}, {"channels", mesh.channels}, {"albedo", nameOf(mesh.albedo)}});
  if (!mesh.matrices.empty())
    object["matrices"] =
        numbersObject(gltf, mesh.matrices,
                      {{"outBands", mesh.outBands},
                       {"inBands", mesh.inBands},
                       {"channels", mesh.matrixChannels},
                       {"glossy", {mesh.glossy[0], mesh.glossy[1], mesh.glossy[2]}},
                       {"lobeExponent", mesh.lobeExponent}});
  if (!mesh.shadowed.empty()) object["shadowed"] = shadowedObject(gltf, mesh.shadowed);
  if (mesh.biScale) object["biScale"] = biScaleObject(gltf, *mesh.biScale);
  if (mesh.layout == Layout::Texels) {
    const std::size_t count = mesh.receiverCount();
    object["grid"] = {
        {"width", mesh.width},
        {"height", mesh.height},
        {"texCoord", 0},
        {"positions", gltf.addAccessor(bytesOf(mesh.positions), Component::Float, "VEC3", count)},
        {"normals", gltf.addAccessor(bytesOf(mesh.normals), Component::Float, "VEC3", count)},
        {"covered",
         gltf.addAccessor(bytesOf(mesh.covered), Component::UnsignedByte, "SCALAR", count)}};
  }
  return object;
}

}  // namespace

Status write(const Asset& asset, const std::filesystem::path& path) {
  if (path.extension() != ".glb")
    return report::badUsage(path.string() +
                            ": an asset is a binary glTF file: give its name the extension .glb");
  if (Status status = checkForWriting(asset); !status)
    return Error{status.error().kind, path.string() + ": not written: " + status.error().message};

  GltfBuilder gltf(asset.scene);
  gltf.useExtension(kExtensionName);
  json root = rootObject(asset.transfer);
  for (const encode::EncodedRtt& rtt : asset.transfer.rtts)
    root["rtts"].push_back(rttObject(gltf, rtt));
  gltf.json()["extensions"][std::string(kExtensionName)] = std::move(root);
  for (std::size_t i = 0; i < asset.transfer.meshes.size(); ++i) {
    const EncodedMesh& mesh = asset.transfer.meshes[i];
    if (mesh.layout == Layout::None) continue;
    json object = primitiveObject(gltf, mesh);  // before the look-up: it appends to the document
    gltf.json()["meshes"][i]["primitives"][0]["extensions"][std::string(kExtensionName)] =
        std::move(object);
  }
  Result<std::vector<std::byte>> glb = gltf.glb();
  if (!glb) return Error{glb.error().kind, path.string() + ": " + glb.error().message};
  return file::writeAtomically(path, std::span<const std::byte>(*glb));
}

}  // namespace lambent::asset
