#include "lambent/asset/receivers_part.h"

#include "lambent/asset/format.h"
#include "lambent/transfer/names.h"

namespace lambent::asset {

using transfer::AtTexels;
using transfer::Receivers;

void writeReceivers(const Receivers& receivers, const scene::Mesh& mesh,
                    scene_io::GltfBuilder& gltf, nlohmann::json& object) {
  object["layout"] = transfer::layoutOf(receivers);
  const AtTexels* grid = receivers.texels();
  if (!grid) return;
  const auto add = [&](const auto& values, Component component, const char* type) {
    return gltf.addAccessor(bytesOf(values), component, type, receivers.size());
  };
  object["grid"] = {{"width", grid->width},
                    {"height", grid->height},
                    {"texCoord", mesh.texelUvs.empty() ? 0 : 1},
                    {"positions", add(receivers.positions, Component::Float, "VEC3")},
                    {"normals", add(receivers.normals, Component::Float, "VEC3")},
                    {"covered", add(grid->covered, Component::UnsignedByte, "SCALAR")}};
}

transfer::SharedReceivers receiversFrom(JsonFields& object, AccessorReader& accessors,
                                        const scene::Mesh& mesh) {
  Receivers receivers;
  const std::string layout = object.string("layout");
  if (layout == "vertices") {
    if (object.has("grid")) object.complain("grid", "is for the layout texels alone");
    receivers.positions = mesh.positions;
    receivers.normals = mesh.normals;
  } else if (layout == "texels") {
    JsonFields grid = object.object("grid");
    AtTexels texels;
    texels.width = int(grid.integer("width", 1, kLargestGrid));
    texels.height = int(grid.integer("height", 1, kLargestGrid));
    grid.integer("texCoord", 0, 1);
    receivers.positions = accessors.read<Vec3>(grid, "positions", Component::Float, 3);
    receivers.normals = accessors.read<Vec3>(grid, "normals", Component::Float, 3);
    texels.covered = accessors.read<std::uint8_t>(grid, "covered", Component::UnsignedByte, 1);
    receivers.where = std::move(texels);
  } else {
    object.complain("layout", "is neither vertices nor texels");
  }
  return std::make_shared<const Receivers>(std::move(receivers));
}

void count(const Receivers& receivers, PartBytes& bytes) {
  if (const AtTexels* grid = receivers.texels())
    bytes.receivers += bytesOf(receivers.positions).size() + bytesOf(receivers.normals).size() +
                       bytesOf(grid->covered).size();
}

}  // namespace lambent::asset
