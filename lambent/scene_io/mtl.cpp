#include "lambent/scene_io/mtl.h"

#include <algorithm>
#include <optional>

#include "lambent/scene_io/gltf_material.h"
#include "lambent/scene_io/mtl_entry.h"
#include "lambent/scene_io/text_file.h"
#include "lambent/scene_io/texture.h"

namespace lambent::scene_io {
namespace {

Rgb reflectanceOf(const Rgb& color) {
  return color.max(0.0f).min(1.0f);
}

scene::Material materialOf(const MtlEntry& entry, bool hasMap, Diagnosis& diagnosis) {
  scene::Material material;
  material.name = entry.name;
  if (entry.emission) material.emission = entry.emission->max(0.0f);
  Rgb diffuse = reflectanceOf(entry.diffuse.value_or(hasMap ? Rgb(Rgb::Ones()) : material.diffuse));
  if (hasMap && diffuse.maxCoeff() <= 0.0f) diffuse = Rgb::Ones();
  if (entry.metallic || entry.roughness) {
    MetallicRoughness pbr;
    pbr.baseColor = diffuse;
    pbr.metallic = float(std::clamp(entry.metallic.value_or(0.0), 0.0, 1.0));
    pbr.roughness = float(std::clamp(entry.roughness.value_or(0.5), 0.0, 1.0));
    applyMetallicRoughness(pbr, material);
    return material;
  }
  material.diffuse = diffuse;
  const Rgb specular = reflectanceOf(entry.specular.value_or(Rgb::Zero()));
  const bool usual = (specular == 0.5f).all();
  if (specular.maxCoeff() <= 0.0f || entry.illumination < 2) return material;
  if (entry.illumination == 3 || entry.illumination == 5) {
    material.diffuse = Rgb::Zero();
    material.mirror = specular;
    return material;
  }
  if (usual) {
    diagnosis.add(Severity::Note, "usual-specular", 1,
                  "materials have Ks 0.5 0.5 0.5, which exporters write for any surface; they are "
                  "taken as diffuse",
                  entry.name);
    return material;
  }
  material.glossy = specular;
  material.lobeExponent = float(std::clamp(entry.exponent.value_or(16.0), 1.0, 1e4));
  const float most = (material.diffuse + material.glossy).maxCoeff();
  if (most > 1.0f) {
    material.diffuse /= most;
    material.glossy /= most;
    diagnosis.add(Severity::Note, "reflectance-scaled", 1,
                  "materials reflect more than they receive (Kd + Ks above 1); both were scaled "
                  "down",
                  entry.name);
  }
  return material;
}

double opacityOf(const MtlEntry& entry) {
  const double opacity = entry.opacity.value_or(1.0 - entry.transparency.value_or(0.0));
  return std::clamp(opacity, 0.0, 1.0);
}

/// Transparent in a way that is not read: by ray-traced glass, or a map of transparency.
bool isTransparentOtherwise(const MtlEntry& entry) {
  const int illumination = entry.illumination;
  const bool map = std::any_of(entry.otherMaps.begin(), entry.otherMaps.end(),
                               [](const auto& other) { return other.first == "map_Tr"; });
  const bool said = opacityOf(entry) < 1.0 || !entry.opacityMap.name.empty();
  const bool glass =
      illumination == 4 || illumination == 6 || illumination == 7 || illumination == 9;
  return map || (glass && !said);
}

bool isRelief(std::string_view key) {
  for (const std::string_view known :
       {"bump", "map_bump", "map_Bump", "norm", "map_norm", "disp", "map_disp", "map_Disp"}) {
    if (key == known) return true;
  }
  return false;
}

}  // namespace

Result<int> readTextureFile(const FileFinder::Found& found, scene::Scene& scene, LinkedFiles& files,
                            Diagnosis& diagnosis) {
  const std::filesystem::path& path = found.path;
  const auto missing = [&](const std::string& why) {
    diagnosis.lose(Severity::Warning, "texture-unreadable", 1,
                   "base-colour textures could not be read; the colour stands alone", why);
    return -1;
  };
  files.note(path);
  if (!found.exists) return missing(path.string() + " does not exist");
  if (!files.mayRead(path)) return files.outside("a texture", path.string());
  const Result<std::vector<std::byte>> bytes = files.read(path);
  if (!bytes) return missing(bytes.error().message);
  Result<scene::Texture> texture = decodeTexture(*bytes, path.string(), files.budget());
  files.budget().release(bytes->size());
  if (!texture && !isReadablePicture(*bytes)) return missing(texture.error().message);
  if (!texture) return texture.error();
  if (found.elsewhere) {
    diagnosis.add(Severity::Note, "file-found-beside", 1,
                  "files were not where their names say; those of the same name beside the scene "
                  "were read",
                  path.string());
  }
  texture->name = path.filename().string();
  scene.textures.push_back(std::move(*texture));
  return int(scene.textures.size() - 1);
}

Result<int> MtlReader::texture(const MtlMap& map) {
  if (map.name.empty()) return -1;
  const FileFinder::Found found = finder_.find(folder_, map.name, sceneFolder_);
  const auto [place, isNew] = textures_.try_emplace({found.path, map.clamp}, -1);
  if (isNew) {
    const Result<int> read = readTextureFile(found, scene_, files_, diagnosis_);
    if (!read) return read.error();
    place->second = *read;
    if (*read >= 0 && map.clamp) {
      scene::Texture& texture = scene_.textures[std::size_t(*read)];
      texture.wrapU = texture.wrapV = scene::Wrap::ClampToEdge;
    }
  }
  return place->second;
}

void MtlReader::tellUnread(const MtlEntry& entry) {
  const auto lose = [&](Severity severity, const char* code, const char* what,
                        const std::string& detail = {}) {
    diagnosis_.lose(severity, code, 1, what,
                    detail.empty() ? entry.name : entry.name + ": " + detail);
  };
  if (isTransparentOtherwise(entry)) {
    lose(Severity::Warning, "alpha-ignored",
         "materials are transparent by illum 4, 6, 7, 9 or map_Tr alone and are taken as opaque: "
         "say so by d or map_d");
  }
  for (const Rgb& color :
       {entry.diffuse.value_or(Rgb::Zero()), entry.specular.value_or(Rgb::Zero())}) {
    if (color.maxCoeff() > 1.0f || color.minCoeff() < 0.0f) {
      lose(Severity::Warning, "reflectance-clamped",
           "reflectances (Kd, Ks) are outside 0 to 1 and were clamped; divide by 255 what is "
           "counted to 255");
      break;
    }
  }
  for (const MtlMap* map : {&entry.diffuseMap, &entry.opacityMap}) {
    if (map->ignored.empty()) continue;
    lose(Severity::Warning, "texture-option-ignored",
         "textures have options that are not read and change their colours or place; bake them "
         "into the picture",
         map->ignored);
  }
  const UvTransform &color = entry.diffuseMap.uv, &alpha = entry.opacityMap.uv;
  if (!entry.diffuseMap.name.empty() && !entry.opacityMap.name.empty() &&
      (color.scale != alpha.scale || color.offset != alpha.offset)) {
    lose(Severity::Warning, "alpha-placed-otherwise",
         "map_d has other -s or -o than map_Kd and lies where that does; bake both into one "
         "picture");
  }
  for (const auto& [key, name] : entry.otherMaps) {
    files_.note(finder_.find(folder_, name, sceneFolder_).path);  // of no use here, but theirs
    if (isRelief(key)) {
      lose(Severity::Note, "relief-ignored",
           "maps of relief (bump, normals, displacement) were left out: surfaces are as smooth as "
           "their meshes; `lambent rtt` bakes relief",
           key);
    } else if (key != "map_Ka") {
      lose(Severity::Note, "map-ignored",
           "maps other than the base colour were left out: their factors hold everywhere", key);
    }
  }
  for (const std::string& key : entry.layers) {
    lose(Severity::Note, "layer-ignored",
         "layers of materials (sheen, clearcoat, anisotropy) were left out: the surface below is "
         "seen alone",
         key);
  }
  for (const std::string& key : entry.unknown) {
    lose(Severity::Note, "material-statement-ignored",
         "statements of material files are not known and were left out", key);
  }
}

/// The texture of an entry: its colour, with the alpha of another picture if it has one.
Result<int> MtlReader::textureOf(const MtlEntry& entry) {
  Result<int> color = texture(entry.diffuseMap);
  if (!color || entry.opacityMap.name.empty()) return color;
  const Result<int> alpha = texture(entry.opacityMap);
  if (!alpha) return alpha.error();
  if (*alpha < 0) return color;
  const auto [known, isNew] = combined_.try_emplace({*color, *alpha}, -1);
  if (!isNew) return known->second;
  Result<scene::Texture> both = withAlphaOf(
      *color < 0 ? nullptr : &scene_.textures[std::size_t(*color)],
      scene_.textures[std::size_t(*alpha)], "map_d of material " + entry.name, files_.budget());
  if (!both) return both.error();
  known->second = int(scene_.textures.size());
  scene_.textures.push_back(std::move(*both));
  return known->second;
}

void MtlReader::dropParts() {
  if (combined_.empty()) return;
  std::vector<int> newFromOld(scene_.textures.size(), -1);
  for (const scene::Material& material : scene_.materials) {
    if (material.baseColorTexture >= 0) newFromOld[std::size_t(material.baseColorTexture)] = 0;
  }
  std::vector<scene::Texture> kept;
  for (std::size_t t = 0; t < newFromOld.size(); ++t) {
    if (newFromOld[t] < 0) continue;
    newFromOld[t] = int(kept.size());
    kept.push_back(std::move(scene_.textures[t]));
  }
  scene_.textures = std::move(kept);
  for (scene::Material& material : scene_.materials) {
    if (material.baseColorTexture >= 0)
      material.baseColorTexture = newFromOld[std::size_t(material.baseColorTexture)];
  }
}

Status MtlReader::add(const MtlEntry& entry) {
  const Result<int> picture = textureOf(entry);
  if (!picture) return picture.error();
  tellUnread(entry);
  const int index = int(scene_.materials.size());
  if (!materials_.try_emplace(entry.name, index).second) return Status::ok();
  materials_.try_emplace(std::string(withoutComment(entry.name)), index);
  scene::Material material =
      materialOf(entry, !entry.diffuseMap.name.empty() && *picture >= 0, diagnosis_);
  material.baseColorTexture = *picture;
  material.opacity = float(opacityOf(entry));
  if (material.opacity < 1.0f || !entry.opacityMap.name.empty())
    material.alphaMode = scene::AlphaMode::Blend;
  scene_.materials.push_back(std::move(material));
  const UvTransform& uv = entry.diffuseMap.name.empty() ? entry.opacityMap.uv : entry.diffuseMap.uv;
  if (*picture >= 0 && !uv.isIdentity()) uvs_[index] = uv;
  return Status::ok();
}

int MtlReader::find(std::string_view name) const {
  auto known = materials_.find(name);
  if (known == materials_.end()) known = materials_.find(withoutComment(name));
  return known == materials_.end() ? -1 : known->second;
}

UvTransform MtlReader::uvOf(int material) const {
  const auto known = uvs_.find(material);
  return known == uvs_.end() ? UvTransform() : known->second;
}

Status MtlReader::read(const std::filesystem::path& path, const std::filesystem::path& scene) {
  files_.note(path);
  const auto missing = [&](const char* why) {
    diagnosis_.lose(Severity::Warning, "material-file-missing", 1, why, path.string());
    return Status::ok();
  };
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) {
    return missing(
        "material files do not exist; their materials are grey. Put them beside the scene");
  }
  if (!files_.mayRead(path)) return files_.outside("a material library", path.string());
  if (!read_.insert(std::filesystem::weakly_canonical(path, error)).second) return Status::ok();
  const Result<std::vector<std::byte>> bytes = files_.read(path);
  if (!bytes) return missing("material files could not be read; their materials are grey");
  const Result<std::string_view> text = textOf(*bytes, path.string());
  if (!text) return text.error();
  folder_ = path.parent_path();
  sceneFolder_ = scene;
  for (const MtlEntry& entry : readMtlEntries(*text)) {
    if (Status status = add(entry); !status) return status;
  }
  return Status::ok();
}

}  // namespace lambent::scene_io
