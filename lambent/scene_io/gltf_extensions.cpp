#include "lambent/scene_io/gltf_extensions.h"

namespace lambent::scene_io {

bool isKnownExtension(std::string_view name) {
  if (name == "KHR_materials_pbrSpecularGlossiness") return false;
  for (std::string_view known : {"KHR_mesh_quantization", "KHR_texture_transform",
                                 "KHR_lights_punctual", "KHR_xmp_json_ld", "EXT_texture_webp"}) {
    if (name == known) return true;
  }
  return name.starts_with("KHR_materials_") || name.starts_with("LAMBENT_");
}

std::string remedyFor(const std::string& extension) {
  if (extension == "KHR_draco_mesh_compression") {
    return "export it without Draco compression, or decompress it: "
           "npx @gltf-transform/cli copy IN.glb OUT.glb";
  }
  if (extension == "EXT_meshopt_compression") {
    return "decompress it: npx @gltf-transform/cli copy IN.glb OUT.glb";
  }
  if (extension == "KHR_texture_basisu" || extension == "EXT_texture_avif") {
    return "convert its textures to PNG: npx @gltf-transform/cli png IN.glb OUT.glb";
  }
  return "export it without this extension";
}

}  // namespace lambent::scene_io
