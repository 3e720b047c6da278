#include "lambent/scene_io/gltf_extensions.h"

#include <algorithm>
#include <map>
#include <vector>

#include <fmt/format.h>

#include "lambent/scene_io/gltf_json.h"

namespace lambent::scene_io {
namespace {

using nlohmann::json;

/// What a scene is like without an extension.
enum class Without {
  Same,   ///< it is read, or says nothing about light
  Other,  ///< of another look
  Wrong,  ///< of a wrong shape or without its textures: a file that requires it is refused
};

struct Extension {
  std::string_view name;  ///< that ends in '*': all that begin so
  Without without;
  std::string_view changes;  ///< empty: it is read
  std::string_view remedy = "";
};

constexpr std::string_view kBakeTextures =
    "convert its textures to PNG: npx @gltf-transform/cli png IN.glb OUT.glb";
constexpr std::string_view kOwnMaterial = "say what it is made of with --material and --albedo";

// The first that fits is meant.
constexpr Extension kExtensions[] = {
    {"EXT_mesh_gpu_instancing", Without::Same, ""},
    {"EXT_meshopt_compression", Without::Same, ""},
    {"EXT_texture_webp", Without::Same, ""},
    {"KHR_draco_mesh_compression", Without::Same, ""},
    {"KHR_materials_emissive_strength", Without::Same, ""},
    {"KHR_materials_ior", Without::Same, ""},
    {"KHR_materials_pbrSpecularGlossiness", Without::Same, ""},
    {"KHR_materials_specular", Without::Same, ""},
    {"KHR_materials_transmission", Without::Same, ""},
    {"KHR_materials_unlit", Without::Same, ""},
    {"KHR_mesh_quantization", Without::Same, ""},
    {"KHR_meshopt_compression", Without::Same, ""},
    {"KHR_node_visibility", Without::Same, ""},
    {"KHR_texture_transform", Without::Same, ""},
    {"LAMBENT_*", Without::Same, ""},

    {"KHR_materials_diffuse_transmission", Without::Other,
     "leaves and cloth let no light through to their back"},
    {"KHR_materials_volume*", Without::Other,
     "what is inside absorbs and scatters no light: the surface alone is baked"},
    {"KHR_materials_dispersion", Without::Other, "glass splits no light into colours"},
    {"KHR_materials_clearcoat", Without::Other, "the varnish over a material reflects no light"},
    {"KHR_materials_sheen", Without::Other, "cloth has no sheen at grazing angles"},
    {"KHR_materials_anisotropy", Without::Other,
     "brushed metal has a round lobe instead of a long one"},
    {"KHR_materials_iridescence", Without::Other, "thin films show no colours"},
    {"KHR_materials_variants", Without::Other,
     "the material that a mesh has by itself is baked, and none of its variants",
     "export the variant that you want"},
    {"KHR_technique*", Without::Other,
     "materials are drawn by shaders of the file's own, which are not run: their colours are lost",
     kOwnMaterial},
    {"*_materials_*", Without::Other, "materials lose what it adds to them"},
    {"KHR_lights_punctual", Without::Other, "the file's lamps are left out: a bake holds no light",
     "light the asset with --light"},
    {"EXT_lights_*", Without::Other, "the file's light is left out: a bake holds no light",
     "light the asset with --light"},
    {"KHR_texture_basisu", Without::Wrong, "textures of KTX2 are lost where the file has no other",
     kBakeTextures},
    {"EXT_texture_avif", Without::Wrong, "textures of AVIF are lost where the file has no other",
     kBakeTextures},
    {"MSFT_texture_dds", Without::Wrong, "textures of DDS are lost where the file has no other",
     kBakeTextures},
    {"MSFT_packing_*", Without::Same, "textures packed otherwise than glTF does are not looked at"},
    {"MSFT_lod", Without::Same, "the finest level of detail is baked, and none of the others"},
    {"KHR_animation_pointer", Without::Same, "what it would move stands still"},
    {"KHR_node_hoverability", Without::Same, ""},
    {"KHR_node_selectability", Without::Same, ""},
    {"KHR_interactivity", Without::Same, "what it would change stays as it is"},
    {"KHR_audio*", Without::Same, "sound is left out"},
    {"KHR_xmp*", Without::Same, ""},
    {"EXT_mesh_features", Without::Same, "what it says about parts of a mesh is not kept"},
    {"EXT_instance_features", Without::Same, "what it says about instances is not kept"},
    {"EXT_structural_metadata", Without::Same, "what it says about parts of a mesh is not kept"},
    {"FB_geometry_metadata", Without::Same, "it says nothing about light"},
    {"VRM*", Without::Other, "what an avatar wears, how it is drawn and how it moves is left out",
     kOwnMaterial},
    {"KHR_gaussian_splatting*", Without::Wrong, "splats have no surface and are left out",
     "make a mesh of them"},
};

/// `pattern` may begin and end in '*'.
bool fits(std::string_view name, std::string_view pattern) {
  const bool front = pattern.starts_with('*'), back = pattern.ends_with('*');
  if (front) pattern.remove_prefix(1);
  if (back) pattern.remove_suffix(1);
  if (front) return name.find(pattern) != std::string_view::npos;
  return back ? name.starts_with(pattern) : name == pattern;
}

const Extension* entryOf(std::string_view name) {
  const auto* const entry =
      std::find_if(std::begin(kExtensions), std::end(kExtensions),
                   [&](const Extension& extension) { return fits(name, extension.name); });
  return entry == std::end(kExtensions) ? nullptr : entry;
}

/// A file may invent as many names as it likes.
constexpr std::size_t kMostNames = 32;

}  // namespace

std::map<std::string, std::uint64_t> extensionsIn(const json& document) {
  std::map<std::string, std::uint64_t> uses;
  std::vector<const json*> pending{&document};
  while (!pending.empty()) {
    const json& value = *pending.back();
    pending.pop_back();
    if (value.is_array()) {
      for (const json& each : value) {
        if (each.is_structured()) pending.push_back(&each);
      }
    } else if (value.is_object()) {
      for (const auto& [key, each] : value.items()) {
        if (!each.is_structured() || key == "extras") continue;
        pending.push_back(&each);
        if (key != "extensions" || !each.is_object()) continue;
        for (const auto& [name, ignored] : each.items()) ++uses[name];
      }
    }
  }
  return uses;
}

bool mayBeRequired(std::string_view name) {
  const Extension* entry = entryOf(name);
  return entry != nullptr && entry->without != Without::Wrong;
}

std::string remedyFor(std::string_view extension) {
  const Extension* entry = entryOf(extension);
  return entry != nullptr && !entry->remedy.empty() ? std::string(entry->remedy)
                                                    : "export it without this extension";
}

bool isCarried(std::string_view name) {
  constexpr std::string_view kCarried[] = {"*_materials_*",
                                           "KHR_texture_transform",
                                           "KHR_lights_punctual",
                                           "KHR_node_visibility",
                                           "KHR_node_hoverability",
                                           "KHR_node_selectability",
                                           "KHR_xmp*"};
  return std::any_of(std::begin(kCarried), std::end(kCarried),
                     [&](std::string_view pattern) { return fits(name, pattern); });
}

void noteExtensions(const json& document, Diagnosis& diagnosis) {
  std::map<std::string, std::uint64_t> uses = extensionsIn(document);
  const json* declared = find(document, "extensionsUsed");
  for (std::size_t i = 0; i < arraySize(declared); ++i) {
    if ((*declared)[i].is_string()) uses.try_emplace((*declared)[i].get<std::string>(), 0);
  }
  std::size_t named = 0;
  for (const auto& [name, count] : uses) {
    const Extension* entry = entryOf(name);
    if (entry != nullptr && entry->changes.empty()) continue;
    if (++named > kMostNames) {
      diagnosis.lose(Severity::Warning, "extension-others", 1, "more extensions are not read");
      continue;
    }
    const std::string shown = name.substr(0, 100);
    std::string what = fmt::format("uses of {}, which is not read: ", shown);
    what += entry != nullptr ? std::string(entry->changes) : "what it changes is not known here";
    if (entry == nullptr || entry->without != Without::Same) {
      const std::string remedy = remedyFor(name);
      what += "; " + remedy + (entry != nullptr && !entry->remedy.empty() ? "" : " if it matters");
    }
    if (isCarried(name)) what += "; what is written keeps it for other viewers";
    const std::string code = "extension-" + shown;
    if (count == 0) {
      diagnosis.add(Severity::Note, code, 0, shown + " is declared and not read; nothing uses it");
    } else if (entry != nullptr && entry->without == Without::Same) {
      diagnosis.add(Severity::Note, code, count, what);
    } else {
      diagnosis.lose(Severity::Warning, code, count, what);
    }
  }
}

}  // namespace lambent::scene_io
