#include "lambent/scene_io/gltf_origin.h"

#include "lambent/scene_io/gltf_json.h"

namespace lambent::scene_io {

nlohmann::json originExtras(const Vec3d& origin) {
  return {{"lambent", {{"origin", {origin.x(), origin.y(), origin.z()}}}}};
}

Vec3d originOf(const nlohmann::json& document) {
  const nlohmann::json* scene = element(document, "scenes", integer(document, "scene").value_or(0));
  const auto origin = numbers(find(find(scene, "extras"), "lambent"), "origin", 3);
  return origin ? Vec3d((*origin)[0], (*origin)[1], (*origin)[2]) : Vec3d(Vec3d::Zero());
}

}  // namespace lambent::scene_io
