#include "lambent/asset/bi_scale_part.h"

#include <cmath>

#include "lambent/asset/format.h"
#include "lambent/asset/receivers_part.h"
#include "lambent/transfer/names.h"

namespace lambent::asset {

using nlohmann::json;
using transfer::IdMap;
using transfer::Kind;
using transfer::Matrices;
using transfer::Numbers;
using BiScale = transfer::BiScale<Numbers>;

namespace {

IdMap idMapFrom(JsonFields object, AccessorReader& accessors) {
  IdMap map;
  map.width = int(object.integer("width", 1, kLargestGrid));
  map.height = int(object.integer("height", 1, kLargestGrid));
  object.integer("texCoord", 0, 0);
  map.ids = accessors.read<std::uint16_t>(object, "accessor", Component::UnsignedShort, 1);
  return map;
}

Wrong faultOfMap(const IdMap& map) {
  const auto within = [](int side) { return side >= 1 && side <= kLargestGrid; };
  if (within(map.width) && within(map.height) && map.ids.size() == 2 * map.texelCount())
    return std::nullopt;
  return "biScale.idMap: " + text(map.ids.size()) + " numbers for " + std::to_string(map.width) +
         "×" + std::to_string(map.height) + " texels";
}

Wrong faultOfPlace(const transfer::Patch& patch, const scene::Mesh& mesh) {
  if (!(patch.scale > 0.0f) || !std::isfinite(patch.scale))
    return std::string("biScale.scale: must be finite and above 0");
  if (mesh.uvs.size() != mesh.positions.size())
    return std::string("biScale: the primitive has no TEXCOORD_0 to find the patch by");
  if (const IdMap* map = patch.idMap()) return faultOfMap(*map);
  const Vec2 tiles = patch.tiles();
  if (!tiles.allFinite() || tiles.x() == 0.0f || tiles.y() == 0.0f)
    return std::string("biScale.tiles: must be finite and not 0");
  return std::nullopt;
}

Wrong faultOfTangents(const BiScale& biScale, const scene::Mesh& mesh) {
  if (biScale.tangents.size() != mesh.positions.size())
    return "biScale.tangents: " + text(biScale.tangents.size()) + " for " +
           text(mesh.positions.size()) + " vertices";
  for (std::size_t i = 0; i < biScale.tangents.size(); ++i)
    if (!(std::abs(biScale.tangents[i].norm() - 1.0f) < kTangentLength) ||
        !(std::abs(biScale.tangents[i].dot(mesh.normals[i])) < kTangentLean))
      return "biScale.tangents: that of vertex " + text(i) +
             " is not of unit length at right angles to the normal";
  return std::nullopt;
}

Wrong faultOfMatrices(Kind kind, const Matrices<Numbers>& matrices, const BiScale& biScale) {
  const std::string name = "biScale." + std::string(transfer::nameOf(kind));
  if (kind == Kind::Unshadowed) return name + ": the turn into the frames needs no matrices";
  if (kind == Kind::Shadowed && matrices.channels != 1)
    return name + ": channels is " + std::to_string(matrices.channels) + ", not 1";
  if (matrices.outBands != biScale.bands || matrices.inBands != biScale.bands)
    return name + ": must have the bands of biScale, rows and columns alike";
  if (matrices.numbers.encoding == transfer::Encoding::Snorm8 &&
      matrices.numbers.block != matrices.perMatrix())
    return name + ": snorm8 needs one scale for each matrix";
  return faultOf(matrices, biScale.receivers->size(), name);
}

}  // namespace

json toJson(const BiScale& biScale, const scene::Mesh& mesh, scene_io::GltfBuilder& gltf) {
  json object = {{"rtt", biScale.patch.rtt},
                 {"bands", biScale.bands},
                 {"scale", biScale.patch.scale},
                 {"tangents", gltf.addAccessor(bytesOf(biScale.tangents), Component::Float, "VEC3",
                                               biScale.tangents.size())}};
  if (mesh.layer) object["layer"] = true;
  if (const IdMap* map = biScale.patch.idMap())
    object["idMap"] = {{"width", map->width},
                       {"height", map->height},
                       {"texCoord", 0},
                       {"accessor", gltf.addAccessor(bytesOf(map->ids), Component::UnsignedShort,
                                                     "SCALAR", map->ids.size())}};
  else
    object["tiles"] = {biScale.patch.tiles().x(), biScale.patch.tiles().y()};
  biScale.matrices.each([&](Kind kind, const Matrices<Numbers>& matrices) {
    json members = json::object();
    if (kind == Kind::Interreflected) members["channels"] = matrices.channels;
    object[std::string(transfer::nameOf(kind))] =
        toJson(matrices.numbers, gltf, std::move(members));
  });
  json whole = {{"biScale", std::move(object)}};
  writeReceivers(*biScale.receivers, mesh, gltf, whole);
  return whole;
}

BiScale biScaleFrom(JsonFields& primitive, AccessorReader& accessors,
                    transfer::SharedReceivers receivers) {
  JsonFields object = primitive.object("biScale");
  BiScale biScale;
  biScale.receivers = std::move(receivers);
  biScale.patch.rtt = int(object.integer("rtt", 0, std::numeric_limits<std::int32_t>::max()));
  biScale.bands = int(object.integer("bands", 1, sh::kMaxBands));
  biScale.patch.scale = float(object.number("scale", 0.0, std::numeric_limits<float>::max()));
  biScale.tangents = accessors.read<Vec3>(object, "tangents", Component::Float, 3);
  if (object.has("idMap") == object.has("tiles"))
    object.complain("idMap", "exactly one of idMap and tiles says where the patch stands");
  if (object.has("tiles")) biScale.patch.place = transfer::Tiles{pairFrom(object, "tiles")};
  if (object.has("idMap")) biScale.patch.place = idMapFrom(object.object("idMap"), accessors);
  for (const Kind kind : {Kind::Shadowed, Kind::Interreflected}) {
    const std::string_view name = transfer::nameOf(kind);
    if (!object.has(name)) continue;
    JsonFields fields = object.object(name);
    const int channels = kind == Kind::Interreflected ? channelsFrom(fields) : 1;
    biScale.matrices.set(kind, {biScale.bands, biScale.bands, channels,
                                numbersFrom(fields, accessors, Snorm8::Allowed)});
  }
  return biScale;
}

Wrong faultOf(const BiScale& biScale, const scene::Mesh& mesh,
              const transfer::EncodedField& field) {
  if (biScale.receivers->texels()) return std::string("biScale: receivers must be vertices");
  if (biScale.patch.rtt < 0 || std::size_t(biScale.patch.rtt) >= field.rtts.size())
    return "biScale.rtt: is " + std::to_string(biScale.patch.rtt) + ", and the asset has " +
           text(field.rtts.size());
  if (!bandsInRange(biScale.bands))
    return "biScale.bands: is " + std::to_string(biScale.bands) + ", not 1 to 10";
  if (const int other = field.rtts[std::size_t(biScale.patch.rtt)].bands; other != biScale.bands)
    return "biScale.bands: is " + std::to_string(biScale.bands) + ", and its RTT's " +
           std::to_string(other);
  if (auto wrong = faultOfTangents(biScale, mesh)) return wrong;
  if (auto wrong = faultOfPlace(biScale.patch, mesh)) return wrong;
  Wrong wrong;
  biScale.matrices.each([&](Kind kind, const Matrices<Numbers>& matrices) {
    if (!wrong) wrong = faultOfMatrices(kind, matrices, biScale);
  });
  if (wrong || biScale.bands <= field.bands) return wrong;
  return "biScale.bands: takes light of " + std::to_string(biScale.bands) +
         " bands, more than the asset's " + std::to_string(field.bands);
}

void count(const BiScale& biScale, PartBytes& bytes) {
  bytes.receivers += bytesOf(biScale.tangents).size();
  if (const IdMap* map = biScale.patch.idMap()) bytes.idMaps += bytesOf(map->ids).size();
  biScale.matrices.each([&](Kind, const Matrices<Numbers>& matrices) {
    bytes.matrices += transfer::bytesOf(matrices.numbers);
  });
}

}  // namespace lambent::asset
