// glTF with the extension LAMBENT_radiance_transfer → Asset. The file may come from anywhere:
// every count, bound and number is checked, and nothing larger than the file's own buffers is
// allocated for its transfer.
#include <charconv>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>

#include "lambent/asset/bi_scale_part.h"
#include "lambent/asset/check.h"
#include "lambent/asset/check_gltf.h"
#include "lambent/asset/format.h"
#include "lambent/asset/read.h"
#include "lambent/asset/receivers_part.h"
#include "lambent/asset/rtt_part.h"
#include "lambent/asset/surface_part.h"
#include "lambent/scene_io/gltf_json.h"
#include "lambent/scene_io/gltf_read.h"
#include "lambent/transfer/names.h"

namespace lambent::asset {

namespace {

using nlohmann::json;
using scene_io::GltfFile;
using transfer::EncodedField;
using transfer::EncodedMesh;
using transfer::Kind;

const std::string kExtension(kExtensionName);

const json* extensionOf(const json& object) {
  const json* extensions = scene_io::find(object, "extensions");
  return extensions ? scene_io::find(*extensions, kExtension) : nullptr;
}

/// "1.0" → checked against what this reader knows.
void checkVersion(const std::string& version, JsonFields& fields) {
  int major = -1, minor = -1;
  const char* end = version.data() + version.size();
  auto [dot, error] = std::from_chars(version.data(), end, major);
  if (error == std::errc() && dot != end && *dot == '.') {
    const auto rest = std::from_chars(dot + 1, end, minor);
    if (rest.ec != std::errc() || rest.ptr != end) minor = -1;
  }
  const std::string ours = std::to_string(kFormatMajor) + "." + std::to_string(kFormatMinor);
  if (major < 0 || minor < 0)
    fields.complain("version", "is not of the form \"" + ours + "\"");
  else if (major > kFormatMajor)
    fields.complain("version", version + " is newer than " + ours +
                                   ", which this Lambent reads: use a newer Lambent");
  else if (major < kFormatMajor)
    fields.complain("version", version + " is older than " + ours + ": bake the scene anew");
}

EncodedField rootOf(JsonFields root) {
  EncodedField field;
  checkVersion(root.string("version"), root);  // first: the rest may mean something else
  const auto kind = transfer::kindNamed(root.string("transfer"));
  if (!kind) root.complain("transfer", "is not unshadowed, shadowed or interreflected");
  field.kind = kind.value_or(field.kind);
  if (root.string("frame") != "scene") root.complain("frame", "is not \"scene\"");
  constexpr int kMost = std::numeric_limits<std::int32_t>::max();
  field.bands = int(root.integer("bands", 1, sh::kMaxBands));
  field.directions = int(root.integer("directions", 0, kMost));
  field.bounces = int(root.integer("bounces", 0, kMost));
  const std::string seed = root.string("seed");
  const auto parsed = std::from_chars(seed.data(), seed.data() + seed.size(), field.seed);
  if (parsed.ec != std::errc() || parsed.ptr != seed.data() + seed.size())
    root.complain("seed", "is not a string of decimal digits, below 2^64");
  field.passEnergy = root.numbers("passEnergy", 1u << 20);
  if (root.has("generator")) root.string("generator");
  return field;
}

/// Takes TEXCOORD_1, which checkGltf found sound, where a grid lies on it.
Status readTexelUvs(const GltfFile& file, const json& primitive, const json& object,
                    scene::Mesh& mesh) {
  if (scene_io::integer(scene_io::find(object, "grid"), "texCoord") != 1) return Status::ok();
  const json* attributes = scene_io::find(primitive, "attributes");
  const Result<std::vector<float>> uvs =
      file.accessorFloats(scene_io::integer(attributes, "TEXCOORD_1").value_or(-1), 2);
  if (!uvs) return uvs.error();
  mesh.texelUvs.resize(uvs->size() / 2);
  for (std::size_t v = 0; v < mesh.texelUvs.size(); ++v)
    mesh.texelUvs[v] = Vec2(uvs->data() + 2 * v);
  std::erase_if(mesh.others,
                [](const scene::VertexNumbers& numbers) { return numbers.name == "TEXCOORD_1"; });
  return Status::ok();
}

EncodedMesh meshFrom(JsonFields object, AccessorReader& accessors, const scene::Mesh& mesh,
                     Kind kind) {
  transfer::SharedReceivers receivers = receiversFrom(object, accessors, mesh);
  if (!object.has("biScale")) return surfaceFrom(object, accessors, std::move(receivers), kind);
  for (const char* other : {"vectors", "matrices"})
    if (object.has(other))
      object.complain("biScale", "a bi-scale mesh has no " + std::string(other) + " beside it");
  if (object.has("shadowed")) object.complain("shadowed", "has no place beside biScale");
  return biScaleFrom(object, accessors, std::move(receivers));
}

}  // namespace

Result<Asset> read(const std::filesystem::path& path, const ReadOptions& options) {
  const std::string name = path.string();
  Result<GltfFile> file = GltfFile::open(
      path, {.allowOutside = options.allowOutside, .memoryLimit = options.memoryLimit});
  if (!file) {
    const std::filesystem::path kind = path.extension();
    std::error_code ignored;
    if (kind != ".glb" && kind != ".gltf" && std::filesystem::exists(path, ignored))
      return report::badInput(name + ": is not an asset: bake it first with `lambent bake`");
    return file.error();
  }
  const json& document = file->json();
  const json* root = extensionOf(document);
  if (!root)
    return report::badInput(name + ": is an ordinary glTF file: bake it first with `lambent bake`");

  Fault fault;
  Asset asset;
  asset.transfer = rootOf(JsonFields(*root, "extensions." + kExtension, fault));
  if (!fault.empty()) return report::badInput(name + ": " + fault);

  if (Status status = checkGltf(*file); !status) return status.error();
  Result<scene_io::LoadedGltf> loaded = scene_io::loadGltf(*file, {.keepAllVertices = true});
  if (!loaded) return loaded.error();
  asset.scene = std::move(loaded->loaded.scene);

  AccessorReader accessors(*file);
  if (const json* rtts = scene_io::find(*root, "rtts")) {
    const std::string place = "extensions." + kExtension + ".rtts";
    if (!rtts->is_array()) return report::badInput(name + ": " + place + ": is not an array");
    for (std::size_t i = 0; i < rtts->size(); ++i) {
      const std::string here = place + "[" + std::to_string(i) + "]";
      transfer::EncodedRtt rtt = rttFrom(JsonFields((*rtts)[i], here, fault), accessors);
      if (!fault.empty()) return report::badInput(name + ": " + fault);
      if (const auto wrong = faultOf(rtt))
        return report::badInput(name + ": " + here + ": " + *wrong);
      asset.transfer.rtts.push_back(std::move(rtt));
    }
  }
  for (std::size_t i = 0; i < asset.scene.meshes.size(); ++i) {
    const auto& origin = loaded->origins[i];
    const json& primitive =
        document["meshes"][std::size_t(origin.mesh)]["primitives"][std::size_t(origin.primitive)];
    const json* object = extensionOf(primitive);
    if (!object) {
      asset.transfer.meshes.emplace_back();
      continue;
    }
    const std::string place = "meshes[" + std::to_string(origin.mesh) + "].primitives[" +
                              std::to_string(origin.primitive) + "].extensions." + kExtension;
    scene::Mesh& mesh = asset.scene.meshes[i];
    if (Status status = readTexelUvs(*file, primitive, *object, mesh); !status)
      return status.error();
    JsonFields fields(*object, place, fault);
    if (fields.has("biScale")) {
      JsonFields biScale = fields.object("biScale");
      mesh.layer = biScale.has("layer") && biScale.boolean("layer");
    }
    EncodedMesh transfer = meshFrom(fields, accessors, mesh, asset.transfer.kind);
    if (!fault.empty()) return report::badInput(name + ": " + fault);
    if (const auto wrong = faultOf(transfer, mesh, asset.transfer))
      return report::badInput(name + ": " + place + "." + *wrong);  // it begins with the member
    asset.transfer.meshes.push_back(std::move(transfer));
  }
  return asset;
}

Result<Asset> read(const std::filesystem::path& path) {
  return read(path, ReadOptions());
}

}  // namespace lambent::asset
