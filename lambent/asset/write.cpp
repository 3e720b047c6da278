// Asset → glTF with the extension LAMBENT_radiance_transfer (spec/LAMBENT_radiance_transfer).
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "lambent/asset/asset.h"
#include "lambent/asset/bi_scale_part.h"
#include "lambent/asset/check.h"
#include "lambent/asset/format.h"
#include "lambent/asset/rtt_part.h"
#include "lambent/asset/surface_part.h"
#include "lambent/file/atomic_file.h"
#include "lambent/file/json.h"
#include "lambent/scene_io/gltf_write.h"
#include "lambent/transfer/names.h"

namespace lambent::asset {

namespace {

using nlohmann::json;
using scene_io::GltfBuilder;
using transfer::Numbers;

json rootObject(const transfer::EncodedField& field) {
  json root = json::object();
  root["version"] = std::to_string(kFormatMajor) + "." + std::to_string(kFormatMinor);
  root["generator"] = "Lambent";
  root["transfer"] = transfer::nameOf(field.kind);
  root["bands"] = field.bands;
  root["frame"] = "scene";
  root["directions"] = field.directions;
  root["bounces"] = field.bounces;
  root["seed"] = std::to_string(field.seed);  // 64 bits: more than a JSON number holds everywhere
  root["passEnergy"] = field.passEnergy;
  return root;
}

/// None for a mirror.
std::optional<json> primitiveObject(const transfer::EncodedMesh& transfer, const scene::Mesh& mesh,
                                    transfer::Kind kind, GltfBuilder& gltf) {
  using Object = std::optional<json>;
  return std::visit(
      transfer::ForEachKind{
          [](const transfer::NoTransfer&) -> Object { return std::nullopt; },
          [&](const transfer::Surface<Numbers>& s) -> Object {
            return toJson(s, mesh, kind, gltf);
          },
          [&](const transfer::BiScale<Numbers>& b) -> Object { return toJson(b, mesh, gltf); }},
      transfer);
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
  for (const transfer::EncodedRtt& rtt : asset.transfer.rtts)
    file::arrayAt(root, "rtts").push_back(toJson(rtt, gltf));
  // What optimisers keep that drop an extension they do not know: scene_io then says what was lost.
  if (json& extras = file::objectAt(gltf.json()["asset"], "extras"); extras.is_object())
    extras["lambent"] = {{"baked", root["version"]}};
  file::objectAt(gltf.json(), "extensions")[std::string(kExtensionName)] = std::move(root);
  for (std::size_t i = 0; i < asset.transfer.meshes.size(); ++i) {
    // Before the look-up: it appends to the document.
    std::optional<json> object =
        primitiveObject(asset.transfer.meshes[i], asset.scene.meshes[i], asset.transfer.kind, gltf);
    if (!object) continue;
    json& primitive = gltf.json()["meshes"][i]["primitives"][0];
    file::objectAt(primitive, "extensions")[std::string(kExtensionName)] = std::move(*object);
  }
  Result<std::vector<std::byte>> glb = gltf.glb();
  if (!glb) return Error{glb.error().kind, path.string() + ": " + glb.error().message};
  return file::writeAtomically(path, std::span<const std::byte>(*glb));
}

}  // namespace lambent::asset
