#include "lambent/scene_io/gltf_images.h"

#include "lambent/image/decode.h"
#include "lambent/radiometry/srgb.h"
#include "lambent/scene_io/gltf_json.h"
#include "lambent/scene_io/linked_files.h"
#include "lambent/scene_io/texture.h"

namespace lambent::scene_io {
namespace {

using nlohmann::json;

std::int64_t indexOf(const json* textureInfo) {
  return integer(textureInfo, "index").value_or(-1);
}

void takeMeans(GltfPicture& picture) {
  const std::vector<std::uint8_t>& rgba = picture.texture.rgba;
  std::array<double, 256> linear;
  for (int code = 0; code < 256; ++code) {
    linear[std::size_t(code)] = radiometry::srgbDecode(float(code) / 255.0f);
  }
  Eigen::Array3d color = Eigen::Array3d::Zero();
  std::array<double, 4> channels{};
  for (std::size_t i = 0; i < rgba.size(); i += 4) {
    for (int c = 0; c < 3; ++c) color[c] += linear[rgba[i + std::size_t(c)]];
    for (std::size_t c = 0; c < 4; ++c) channels[c] += rgba[i + c];
  }
  const double count = double(rgba.size() / 4);
  picture.meanColor = (color / count).cast<float>();
  for (std::size_t c = 0; c < 4; ++c) picture.meanChannels[c] = channels[c] / (255.0 * count);
}

}  // namespace

GltfImages::GltfImages(const GltfFile& file) : file_(file) {
  const json* materials = find(file.json(), "materials");
  for (std::size_t i = 0; i < arraySize(materials); ++i) {
    const json& material = (*materials)[i];
    const json* pbr = find(material, "pbrMetallicRoughness");
    const auto want = [&](const json* info, std::set<std::string>& keys) {
      if (info != nullptr) keys.insert(keyOf(sourceOf(indexOf(info))));
    };
    want(find(pbr, "baseColorTexture"), texelsWanted_);
    want(find(pbr, "metallicRoughnessTexture"), meansWanted_);
    want(find(material, "emissiveTexture"), meansWanted_);
    const json* extensions = find(material, "extensions");
    const json* specular = find(extensions, "KHR_materials_specular");
    want(find(specular, "specularTexture"), meansWanted_);
    want(find(specular, "specularColorTexture"), meansWanted_);
    if (specular != nullptr || find(extensions, "KHR_materials_ior") != nullptr) {
      want(find(pbr, "baseColorTexture"), meansWanted_);
    }
    const json* older = find(extensions, "KHR_materials_pbrSpecularGlossiness");
    want(find(older, "diffuseTexture"), texelsWanted_);
    want(find(older, "diffuseTexture"), meansWanted_);
    want(find(older, "specularGlossinessTexture"), meansWanted_);
  }
}

std::int64_t GltfImages::sourceOf(std::int64_t texture) const {
  const json* object = element(file_.json(), "textures", texture);
  if (const auto source = integer(object, "source")) return *source;
  return integer(find(find(object, "extensions"), formatOf(texture)), "source").value_or(-1);
}

std::string GltfImages::formatOf(std::int64_t texture) const {
  const json* object = element(file_.json(), "textures", texture);
  const json* extensions = find(object, "extensions");
  if (integer(object, "source") || extensions == nullptr || !extensions->is_object()) return {};
  if (extensions->contains("EXT_texture_webp")) return "EXT_texture_webp";
  for (const auto& [name, format] : extensions->items()) {
    if (integer(format, "source")) return name;
  }
  return {};
}

std::string GltfImages::keyOf(std::int64_t image) const {
  const json* object = element(file_.json(), "images", image);
  if (const auto view = integer(object, "bufferView")) return "view " + std::to_string(*view);
  const std::string uri = text(object, "uri");
  return isDataUri(uri) ? uri : "file " + file_.linkedFiles().placeOf(uri).string();
}

Result<GltfPicture> GltfImages::read(std::int64_t image, const std::string& key) const {
  const std::string place = file_.path().string() + ": image " + std::to_string(image);
  GltfPicture picture;
  const json* object = element(file_.json(), "images", image);
  if (object == nullptr) {
    picture.missing =
        image < 0 ? file_.path().string() + ": a texture has no image" : place + " does not exist";
    return picture;
  }
  const std::string uri = text(object, "uri");
  const bool isLink = !uri.empty() && !integer(object, "bufferView");
  if (isLink && !file_.linkedFiles().mayReadUri(uri))
    return file_.linkedFiles().outside("image " + std::to_string(image), uri);
  std::vector<std::byte> linked;
  const Result<std::span<const std::byte>> found = bytesOf(image, linked);
  if (!found) {
    picture.missing = found.error().message;
    return picture;
  }
  const std::span<const std::byte> bytes = *found;
  file::Budget& budget = file_.budget();
  Result<scene::Texture> texture = decodeTexture(bytes, place, budget);
  if (!texture && !isReadablePicture(bytes)) {
    picture.missing = texture.error().message;
    return picture;
  }
  if (!texture) return texture.error();
  if (!isDataUri(uri)) budget.release(linked.size());
  picture.texture = std::move(*texture);
  if (meansWanted_.contains(key)) takeMeans(picture);
  if (!texelsWanted_.contains(key)) {
    budget.release(picture.texture.rgba.size() + picture.texture.encoded.size());
    picture.texture = {};
  }
  return picture;
}

Result<std::span<const std::byte>> GltfImages::bytesOf(std::int64_t image,
                                                       std::vector<std::byte>& linked) const {
  const json* object = element(file_.json(), "images", image);
  if (const auto view = integer(object, "bufferView")) return file_.bufferViewBytes(*view);
  const std::string uri = text(object, "uri"), what = "image " + std::to_string(image);
  if (uri.empty())
    return report::badInput(file_.path().string() + ": " + what + " has neither a uri nor bytes");
  LinkedFiles& files = file_.linkedFiles();
  if (!files.mayReadUri(uri)) return files.outside(what, uri);
  Result<std::vector<std::byte>> content = files.readUri(uri, what);
  if (!content) return content.error();
  linked = std::move(*content);
  return std::span<const std::byte>(linked);
}

Result<scene::SourcePicture> GltfImages::carried(std::int64_t image, std::string& missing) const {
  std::vector<std::byte> linked;
  const Result<std::span<const std::byte>> bytes = bytesOf(image, linked);
  if (!bytes) {
    missing = bytes.error().message;
    return scene::SourcePicture();
  }
  const std::string place = file_.path().string() + ": image " + std::to_string(image);
  file::Budget& budget = file_.budget();
  const image::Format format = image::formatOf(*bytes);
  const std::string uri = text(element(file_.json(), "images", image), "uri");
  scene::SourcePicture picture;
  if (format == image::Format::Png || format == image::Format::Jpeg) {
    picture.mimeType = format == image::Format::Png ? "image/png" : "image/jpeg";
    const auto* const data = reinterpret_cast<const std::uint8_t*>(bytes->data());
    picture.encoded.assign(data, data + bytes->size());
  } else if (Result<scene::Texture> texture = decodeTexture(*bytes, place, budget); texture) {
    const std::vector<std::byte> png =
        image::encodePng(texture->width, texture->height, 4, texture->rgba);
    const auto* const data = reinterpret_cast<const std::uint8_t*>(png.data());
    picture.mimeType = "image/png";
    picture.encoded.assign(data, data + png.size());
    budget.release(texture->rgba.size());
  } else {
    missing = texture.error().message;
  }
  if (!linked.empty() && !isDataUri(uri)) budget.release(linked.size());
  if (Status fits = budget.hold(picture.encoded.size(), place); !fits) return fits.error();
  return picture;
}

std::string GltfImages::nameOf(std::int64_t texture) const {
  return text(element(file_.json(), "images", sourceOf(texture)), "name");
}

Result<GltfPicture*> GltfImages::pictureOf(std::int64_t texture) {
  const std::int64_t image = sourceOf(texture);
  const std::string key = keyOf(image);
  const auto known = pictures_.find(key);
  if (known != pictures_.end()) return &known->second;
  Result<GltfPicture> picture = read(image, key);
  if (!picture) return picture.error();
  if (const std::string format = formatOf(texture); !picture->missing.empty() && !format.empty()) {
    picture->missing += " (" + format.substr(0, 100) + ")";
  }
  return &pictures_.emplace(key, std::move(*picture)).first->second;
}

}  // namespace lambent::scene_io
