#include "lambent/scene_io/mtl.h"

#include <algorithm>
#include <optional>

#include "lambent/scene_io/gltf_material.h"
#include "lambent/scene_io/text_cursor.h"
#include "lambent/scene_io/texture.h"

namespace lambent::scene_io {
namespace {

/// One newmtl as the file says it.
struct Entry {
  std::string name;
  std::optional<Rgb> diffuse, specular;
  std::optional<double> exponent, metallic, roughness;
  int illumination = 2;
  std::string diffuseMap;
  bool transparent = false;
};

std::optional<Rgb> color(TextCursor& cursor) {
  const auto r = cursor.number();
  if (!r) return {};
  const auto g = cursor.number(), b = cursor.number();
  const Rgb c = g && b ? Rgb(float(*r), float(*g), float(*b)) : Rgb(Rgb::Constant(float(*r)));
  return c.isFinite().all() ? std::optional<Rgb>(c.max(0.0f).min(1.0f)) : std::nullopt;
}

/// The file's name behind a map's options ("-s 1 1 1 -clamp on wood.png"): words that begin with a
/// minus, and the numbers and switches after them, are left out.
std::string mapName(TextCursor& cursor) {
  std::string_view rest = cursor.rest();
  while (!rest.empty() && rest[0] == '-') {
    TextCursor words(rest);
    words.nextLine();
    words.word();
    for (;;) {
      const std::string_view after = words.rest();
      const bool isNumber = words.number().has_value();
      const std::string_view word = isNumber ? std::string_view() : words.word();
      if (isNumber || word == "on" || word == "off") continue;
      rest = after;
      break;
    }
  }
  std::string name(rest);
  std::replace(name.begin(), name.end(), '\\', '/');
  return name;
}

scene::Material materialOf(const Entry& entry, bool hasMap, Diagnosis& diagnosis) {
  scene::Material material;
  material.name = entry.name;
  Rgb diffuse = entry.diffuse.value_or(hasMap ? Rgb(Rgb::Ones()) : material.diffuse);
  if (hasMap && diffuse.maxCoeff() <= 0.0f) diffuse = Rgb::Ones();
  if (entry.metallic || entry.roughness) {
    MetallicRoughness pbr;
    pbr.baseColor = diffuse;
    pbr.metallic = float(entry.metallic.value_or(0.0));
    pbr.roughness = float(entry.roughness.value_or(0.5));
    applyMetallicRoughness(pbr, material);
    return material;
  }
  material.diffuse = diffuse;
  const Rgb specular = entry.specular.value_or(Rgb::Zero());
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

}  // namespace

Result<int> readTextureFile(const std::filesystem::path& path, scene::Scene& scene,
                            LinkedFiles& files, Diagnosis& diagnosis) {
  const auto missing = [&](const std::string& why) {
    diagnosis.add(Severity::Warning, "texture-unreadable", 1,
                  "base-colour textures could not be read; the colour stands alone", why);
    return -1;
  };
  files.note(path);
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) {
    return missing(path.string() + " does not exist");
  }
  if (!files.mayRead(path)) return files.outside("a texture", path.string());
  const Result<std::vector<std::byte>> bytes = files.read(path);
  if (!bytes) return missing(bytes.error().message);
  Result<scene::Texture> texture = decodeTexture(*bytes, path.string(), files.budget());
  files.budget().release(bytes->size());
  if (!texture && !isReadablePicture(*bytes)) return missing(texture.error().message);
  if (!texture) return texture.error();
  texture->name = path.filename().string();
  scene.textures.push_back(std::move(*texture));
  return int(scene.textures.size() - 1);
}

Status readMtl(const std::filesystem::path& path, scene::Scene& scene,
               std::map<std::string, int, std::less<>>& known,
               std::set<std::filesystem::path>& libraries, LinkedFiles& files,
               Diagnosis& diagnosis) {
  files.note(path);
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) {
    diagnosis.add(Severity::Warning, "material-file-missing", 1,
                  "material files do not exist; their materials are grey", path.string());
    return Status::ok();
  }
  if (!files.mayRead(path)) return files.outside("a material library", path.string());
  if (!libraries.insert(std::filesystem::weakly_canonical(path, error)).second) return Status::ok();
  const Result<std::vector<std::byte>> bytes = files.read(path);
  if (!bytes) {
    diagnosis.add(Severity::Warning, "material-file-missing", 1,
                  "material files could not be read; their materials are grey", path.string());
    return Status::ok();
  }
  std::vector<Entry> entries;
  TextCursor cursor(asText(*bytes));
  while (cursor.nextLine()) {
    const std::string_view key = cursor.word();
    if (key == "newmtl") {
      entries.emplace_back();
      entries.back().name = cursor.rest();
      continue;
    }
    if (entries.empty()) continue;
    Entry& entry = entries.back();
    if (key == "Kd") {
      entry.diffuse = color(cursor);
    } else if (key == "Ks") {
      entry.specular = color(cursor);
    } else if (key == "Ns") {
      entry.exponent = cursor.number();
    } else if (key == "Pm") {
      entry.metallic = cursor.number();
    } else if (key == "Pr") {
      entry.roughness = cursor.number();
    } else if (key == "illum") {
      const double value = cursor.number().value_or(2.0);
      entry.illumination = value >= 0.0 && value <= 10.0 ? int(value) : 2;
    } else if (key == "map_Kd") {
      entry.diffuseMap = mapName(cursor);
    } else if (key.starts_with("map_") || key == "bump" || key == "norm" || key == "disp" ||
               key == "decal" || key == "refl") {
      files.note(path.parent_path() / mapName(cursor));  // of no use to us, but the person's
    } else if (key == "d") {
      entry.transparent = cursor.number().value_or(1.0) < 0.999;
    }
  }
  std::map<std::string, int> textures;
  for (const Entry& entry : entries) {
    int texture = -1;
    if (!entry.diffuseMap.empty()) {
      const auto [place, isNew] = textures.try_emplace(entry.diffuseMap, -1);
      if (isNew) {
        const Result<int> read =
            readTextureFile(path.parent_path() / entry.diffuseMap, scene, files, diagnosis);
        if (!read) return read.error();
        place->second = *read;
      }
      texture = place->second;
    }
    scene::Material material = materialOf(entry, texture >= 0, diagnosis);
    material.baseColorTexture = texture;
    if (entry.transparent) {
      diagnosis.add(Severity::Warning, "alpha-ignored", 1,
                    "materials are (partly) transparent and are taken as opaque", entry.name);
    }
    if (known.try_emplace(entry.name, int(scene.materials.size())).second) {
      scene.materials.push_back(std::move(material));
    }
  }
  return Status::ok();
}

}  // namespace lambent::scene_io
