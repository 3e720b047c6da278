// glTF with the extension LAMBENT_radiance_transfer → Asset. The file may come from anywhere:
// every count, bound and number is checked, and nothing larger than the file's own buffers is
// allocated for its transfer.
#include <bit>
#include <charconv>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "lambent/asset/asset.h"
#include "lambent/asset/check.h"
#include "lambent/asset/check_gltf.h"
#include "lambent/asset/json_fields.h"
#include "lambent/asset/names.h"
#include "lambent/asset/rtt_file.h"
#include "lambent/scene_io/gltf_read.h"

namespace lambent::asset {

namespace {

using encode::EncodedField;
using encode::EncodedMesh;
using encode::Encoding;
using encode::Numbers;
using nlohmann::json;
using scene_io::AccessorView;
using scene_io::Component;
using scene_io::GltfFile;
using transport::Layout;

static_assert(std::endian::native == std::endian::little);

const std::string kExtension(kExtensionName);

const json* member(const json& object, const std::string& key) {
  if (!object.is_object()) return nullptr;
  const auto found = object.find(key);
  return found == object.end() ? nullptr : &*found;
}

const json* extensionOf(const json& object) {
  const json* extensions = member(object, "extensions");
  return extensions ? member(*extensions, kExtension) : nullptr;
}

/// Accessors of transfer, copied out. Keeps the sum of what was copied below the file's buffers:
/// accessors that overlap could otherwise ask for any amount of memory.
class AccessorReader {
 public:
  explicit AccessorReader(const GltfFile& file) : file_(file) {
    if (const json* buffers = member(file.json(), "buffers"); buffers && buffers->is_array())
      for (const json& buffer : *buffers)
        if (const json* length = member(buffer, "byteLength"); length && length->is_number())
          budget_ += length->get<double>();
  }

  template <class T>
  std::vector<T> read(JsonFields& fields, std::string_view key, Component component,
                      int componentCount) {
    static_assert(std::is_trivially_copyable_v<T> || std::is_same_v<T, Vec3>);
    const std::int64_t index = fields.integer(key, 0, std::numeric_limits<std::int32_t>::max());
    if (!read_.insert(index).second) {
      fields.complain(key, "accessor " + std::to_string(index) + " serves two members");
      return {};
    }
    const Result<AccessorView> view = file_.accessorView(index);
    if (!view) {
      // The message names the file; so will the one that this becomes a part of.
      std::string message = view.error().message;
      if (const std::string path = file_.path().string() + ": "; message.starts_with(path))
        message.erase(0, path.size());
      fields.complain(key, message);
      return {};
    }
    if (view->component != component || view->componentCount != componentCount) {
      fields.complain(key, "accessor " + std::to_string(index) + " has component type " +
                               std::to_string(int(view->component)) + " × " +
                               std::to_string(view->componentCount) + " where " +
                               std::to_string(int(component)) + " × " +
                               std::to_string(componentCount) + " is needed");
      return {};
    }
    budget_ -= double(view->count) * sizeof(T);
    if (budget_ < 0) {
      fields.complain(key, "accessors overlap: together they are larger than the file's buffers");
      return {};
    }
    std::vector<T> values(view->count);
    if (values.empty()) return values;
    auto* out = reinterpret_cast<std::byte*>(values.data());
    if (view->packed()) {
      std::memcpy(out, view->bytes.data(), view->count * sizeof(T));
    } else {
      for (std::size_t i = 0; i < view->count; ++i)
        std::memcpy(out + i * sizeof(T), view->bytes.data() + i * view->stride, sizeof(T));
    }
    return values;
  }

  Numbers numbers(JsonFields& fields, bool allowSnorm8 = false) {
    Numbers numbers;
    const auto encoding = encodingNamed(fields.string("encoding"));
    if (!encoding || (encoding == Encoding::Snorm8 && !allowSnorm8))
      fields.complain("encoding", allowSnorm8 ? "is none of float16, float32 and snorm8"
                                              : "is neither float16 nor float32");
    numbers.encoding = encoding.value_or(Encoding::Float32);
    if (numbers.encoding != Encoding::Snorm8 && fields.has("scales"))
      fields.complain("scales", "are for snorm8 alone");
    switch (numbers.encoding) {
      case Encoding::Float16:
        numbers.half = read<std::uint16_t>(fields, "accessor", Component::UnsignedShort, 1);
        break;
      case Encoding::Float32:
        numbers.single = read<float>(fields, "accessor", Component::Float, 1);
        break;
      case Encoding::Snorm8:
        numbers.byte = read<std::int8_t>(fields, "accessor", Component::Byte, 1);
        numbers.scales = read<float>(fields, "scales", Component::Float, 1);
        if (numbers.scales.empty() || numbers.byte.size() % numbers.scales.size() != 0)
          fields.complain("scales", "do not divide the numbers into equal runs");
        else
          numbers.block = numbers.byte.size() / numbers.scales.size();
        break;
    }
    if (numbers.empty()) fields.complain("accessor", "is empty");
    return numbers;
  }

 private:
  const GltfFile& file_;
  double budget_ = 0.0;  ///< bytes
  std::set<std::int64_t> read_;
};

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

int channelsOf(JsonFields& fields) {
  const auto channels = int(fields.integer("channels", 1, 3));
  if (channels == 2) fields.complain("channels", "is 2, not 1 or 3");
  return channels;
}

EncodedField rootOf(JsonFields root) {
  EncodedField field;
  checkVersion(root.string("version"), root);  // first: the rest may mean something else
  const auto kind = transferKindNamed(root.string("transfer"));
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

void readGrid(JsonFields grid, AccessorReader& accessors, EncodedMesh& mesh) {
  mesh.width = int(grid.integer("width", 1, kLargestGrid));
  mesh.height = int(grid.integer("height", 1, kLargestGrid));
  grid.integer("texCoord", 0, 0);
  mesh.positions = accessors.read<Vec3>(grid, "positions", Component::Float, 3);
  mesh.normals = accessors.read<Vec3>(grid, "normals", Component::Float, 3);
  mesh.covered = accessors.read<std::uint8_t>(grid, "covered", Component::UnsignedByte, 1);
}

Vec2 pairOf(JsonFields& fields, std::string_view key) {
  const std::vector<double> pair = fields.numbers(key, 2);
  if (pair.size() == 2) return Vec2(float(pair[0]), float(pair[1]));
  fields.complain(key, "is not an array of 2 numbers");
  return Vec2(1.0f, 1.0f);
}

encode::EncodedRtt rttOf(JsonFields object, AccessorReader& accessors) {
  encode::EncodedRtt rtt;
  if (object.has("name")) rtt.name = object.string("name");
  rtt.width = int(object.integer("width", 1, kLargestRtt));
  rtt.height = int(object.integer("height", 1, kLargestRtt));
  rtt.views = int(object.integer("views", 1, kLargestViews));
  rtt.bands = int(object.integer("bands", 1, sh::kMaxBands));
  rtt.size = pairOf(object, "size");
  rtt.depth = float(object.number("depth", 0.0, std::numeric_limits<float>::max()));
  JsonFields values = object.object("values");
  rtt.values = accessors.numbers(values, true);
  return rtt;
}

synthesis::IdMap idMapOf(JsonFields object, AccessorReader& accessors) {
  synthesis::IdMap map;
  map.width = int(object.integer("width", 1, kLargestGrid));
  map.height = int(object.integer("height", 1, kLargestGrid));
  object.integer("texCoord", 0, 0);
  map.ids = accessors.read<std::uint16_t>(object, "accessor", Component::UnsignedShort, 1);
  return map;
}

encode::EncodedBiScale biScaleOf(JsonFields object, AccessorReader& accessors) {
  encode::EncodedBiScale biScale;
  biScale.rtt = int(object.integer("rtt", 0, std::numeric_limits<std::int32_t>::max()));
  biScale.bands = int(object.integer("bands", 1, sh::kMaxBands));
  biScale.scale = float(object.number("scale", 0.0, std::numeric_limits<float>::max()));
  biScale.tangents = accessors.read<Vec3>(object, "tangents", Component::Float, 3);
  if (object.has("idMap") == object.has("tiles"))
    object.complain("idMap", "exactly one of idMap and tiles says where the patch stands");
  if (object.has("idMap")) biScale.idMap = idMapOf(object.object("idMap"), accessors);
  if (object.has("tiles")) biScale.tiles = pairOf(object, "tiles");
  if (object.has("shadowed")) {
    JsonFields matrices = object.object("shadowed");
    biScale.shadowed = accessors.numbers(matrices, true);
  }
  if (object.has("interreflected")) {
    JsonFields matrices = object.object("interreflected");
    biScale.channels = channelsOf(matrices);
    biScale.interreflected = accessors.numbers(matrices, true);
  }
  return biScale;
}

encode::EncodedShadowed shadowedOf(JsonFields object, AccessorReader& accessors) {
  encode::EncodedShadowed shadowed;
  if (object.has("vectors")) {
    JsonFields vectors = object.object("vectors");
    shadowed.channels = channelsOf(vectors);
    shadowed.vectors = accessors.numbers(vectors);
  }
  if (object.has("matrices")) {
    JsonFields matrices = object.object("matrices");
    shadowed.matrixChannels = channelsOf(matrices);
    shadowed.matrices = accessors.numbers(matrices);
  }
  return shadowed;
}

EncodedMesh meshOf(JsonFields object, AccessorReader& accessors, const scene::Mesh& mesh) {
  EncodedMesh transfer;
  const std::string layout = object.string("layout");
  if (layout == nameOf(Layout::Vertices)) {
    transfer.layout = Layout::Vertices;
    transfer.positions = mesh.positions;
    transfer.normals = mesh.normals;
  } else if (layout == nameOf(Layout::Texels)) {
    transfer.layout = Layout::Texels;
    readGrid(object.object("grid"), accessors, transfer);
  } else {
    object.complain("layout", "is neither vertices nor texels");
  }
  if (transfer.layout == Layout::Vertices && object.has("grid"))
    object.complain("grid", "is for the layout texels alone");
  if (object.has("vectors")) {
    JsonFields vectors = object.object("vectors");
    transfer.bands = int(vectors.integer("bands", 1, sh::kMaxBands));
    transfer.channels = channelsOf(vectors);
    const auto albedo = albedoNamed(vectors.string("albedo"));
    if (!albedo) vectors.complain("albedo", "is neither included nor baseColor");
    transfer.albedo = albedo.value_or(transfer.albedo);
    transfer.vectors = accessors.numbers(vectors);
  }
  if (object.has("matrices")) {
    JsonFields matrices = object.object("matrices");
    transfer.outBands = int(matrices.integer("outBands", 1, sh::kMaxBands));
    transfer.inBands = int(matrices.integer("inBands", 1, sh::kMaxBands));
    transfer.matrixChannels = channelsOf(matrices);
    const std::vector<double> glossy = matrices.numbers("glossy", 3);
    if (glossy.size() != 3) matrices.complain("glossy", "is not an array of 3 numbers");
    for (std::size_t c = 0; c < glossy.size(); ++c) transfer.glossy[int(c)] = float(glossy[c]);
    transfer.lobeExponent =
        float(matrices.number("lobeExponent", 0.0, std::numeric_limits<float>::max()));
    transfer.matrices = accessors.numbers(matrices);
  }
  if (object.has("shadowed")) transfer.shadowed = shadowedOf(object.object("shadowed"), accessors);
  if (object.has("biScale")) transfer.biScale = biScaleOf(object.object("biScale"), accessors);
  return transfer;
}

}  // namespace

Result<Asset> read(const std::filesystem::path& path) {
  const std::string name = path.string();
  Result<GltfFile> file = GltfFile::open(path);
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
  if (const json* rtts = member(*root, "rtts")) {
    const std::string place = "extensions." + kExtension + ".rtts";
    if (!rtts->is_array()) return report::badInput(name + ": " + place + ": is not an array");
    for (std::size_t i = 0; i < rtts->size(); ++i) {
      const std::string here = place + "[" + std::to_string(i) + "]";
      encode::EncodedRtt rtt = rttOf(JsonFields((*rtts)[i], here, fault), accessors);
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
    const scene::Mesh& mesh = asset.scene.meshes[i];
    EncodedMesh transfer = meshOf(JsonFields(*object, place, fault), accessors, mesh);
    if (!fault.empty()) return report::badInput(name + ": " + fault);
    if (const auto wrong = faultOf(transfer, mesh, asset.transfer))
      return report::badInput(name + ": " + place + "." + *wrong);  // it begins with the member
    asset.transfer.meshes.push_back(std::move(transfer));
  }
  return asset;
}

}  // namespace lambent::asset
