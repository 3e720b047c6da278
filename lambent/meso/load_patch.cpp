#include "lambent/meso/load_patch.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lambent/file/atomic_file.h"
#include "lambent/file/budget.h"
#include "lambent/file/extension.h"
#include "lambent/image/decode.h"
#include "lambent/image/io.h"
#include "lambent/meso/check_tiling.h"
#include "lambent/meso/height_field.h"
#include "lambent/radiometry/srgb.h"
#include "lambent/scene_io/gltf_write.h"
#include "lambent/scene_io/load.h"

namespace lambent::meso {

namespace {

Vec3 patchFromYUp(const Vec3& p) {
  return Vec3(p.x(), -p.z(), p.y());
}
Vec3 yUpFromPatch(const Vec3& p) {
  return Vec3(p.x(), p.z(), -p.y());
}

template <class Turn>
void turn(scene::Scene& scene, const Turn& rotated) {
  for (scene::Mesh& mesh : scene.meshes) {
    for (Vec3& p : mesh.positions) p = rotated(p);
    for (Vec3& n : mesh.normals) n = rotated(n);
  }
}

Result<LoadedPatch> loadMesh(const std::filesystem::path& path, const PatchFileOptions& options) {
  Result<scene_io::LoadedScene> loaded =
      scene_io::load(path, {.allowOutside = options.allowOutside,
                            .memoryLimit = options.memoryLimit,
                            .sides = scene_io::Sides::One});  // nobody sees a patch from below
  if (!loaded) return loaded.error();
  Findings findings = std::move(loaded->findings);
  Patch patch;
  patch.name = path.stem().string();
  patch.scene = std::move(loaded->scene);
  patch.scene.cameras.clear();
  std::uint64_t gaps = 0;
  for (scene::Material& material : patch.scene.materials) {
    gaps +=
        material.alphaMode != scene::AlphaMode::Opaque || material.transmitted.maxCoeff() > 0.0f;
    material.alphaMode = scene::AlphaMode::Opaque;
    material.diffuse += material.transmitted;
    material.transmitted = Rgb::Zero();
  }
  if (gaps > 0)
    findings.push_back({Severity::Warning, "alpha-ignored",
                        std::to_string(gaps) +
                            " materials are (partly) transparent and are taken as opaque: a patch "
                            "has no holes",
                        gaps, true});
  if (options.up == UpAxis::Y) turn(patch.scene, patchFromYUp);
  const scene::Box box = scene::bounds(patch.scene);
  const Vec3 span = box.upper - box.lower;
  patch.size = options.size.value_or(Vec2(span.head<2>()));
  if (!(patch.size.array() > 0.0f).all())
    return report::badInput(path.string() +
                            ": the mesh has no extent along x or y of the patch; if its z points "
                            "away from the patch, say so (--up z), or give the period (--size)");
  patch.backing = options.backing;
  const Findings seams = checkTiling(patch);
  findings.insert(findings.end(), seams.begin(), seams.end());
  return LoadedPatch{{std::move(patch), std::move(findings)}, std::move(loaded->linkedFiles)};
}

/// Rows from the top in the picture, from y = 0 in the field.
Result<HeightField> readHeights(const std::filesystem::path& path, bool codeValues,
                                const PatchFileOptions& options) {
  const Result<image::Image> picture = image::read(
      path, {.memoryLimit = options.memoryLimit, .layer = {}, .plainCodes = codeValues});
  if (!picture) return picture.error();
  if (picture->width < 2 || picture->height < 2)
    return report::badInput(path.string() + ": a height field needs 2×2 samples at least");
  HeightField field;
  field.width = picture->width, field.height = picture->height;
  field.heights.reserve(picture->pixels.size());
  for (int y = field.height - 1; y >= 0; --y)
    for (int x = 0; x < field.width; ++x) {
      Rgb value = picture->at(x, y);
      if (!value.isFinite().all())
        return report::badInput(path.string() + ": the height at column " + std::to_string(x) +
                                ", row " + std::to_string(y) + " from the top is not a number");
      if (codeValues)
        for (float& channel : value) channel = radiometry::srgbEncode(channel);
      field.heights.push_back(value.mean());
    }
  return field;
}

/// Means over whole blocks of samples.
HeightField reduced(const HeightField& field, int factor) {
  HeightField out;
  out.width = field.width / factor, out.height = field.height / factor;
  for (int y = 0; y < out.height; ++y)
    for (int x = 0; x < out.width; ++x) {
      // Blocks of nearly equal size that together cover all samples.
      const int x0 = int(std::int64_t(x) * field.width / out.width);
      const int x1 = int(std::int64_t(x + 1) * field.width / out.width);
      const int y0 = int(std::int64_t(y) * field.height / out.height);
      const int y1 = int(std::int64_t(y + 1) * field.height / out.height);
      double sum = 0.0;
      for (int j = y0; j < y1; ++j)
        for (int i = x0; i < x1; ++i) sum += field.at(i, j);
      out.heights.push_back(static_cast<float>(sum / double((x1 - x0) * (y1 - y0))));
    }
  return out;
}

Result<scene::Texture> readColor(const PatchFileOptions& options) {
  const std::filesystem::path& path = options.color;
  Result<std::vector<std::byte>> bytes = file::readWhole(path);
  if (!bytes) return bytes.error();
  file::Budget budget(options.memoryLimit);
  budget.addFile(bytes->size());
  Result<image::Pixels8> pixels = image::decode8(*bytes, path.string(), budget);
  if (!pixels) return pixels.error();
  scene::Texture texture;
  texture.name = path.stem().string();
  texture.width = pixels->width, texture.height = pixels->height;
  texture.rgba = std::move(pixels->rgba);
  return texture;
}

Result<LoadedPatch> loadHeights(const std::filesystem::path& path,
                                const PatchFileOptions& options) {
  Findings findings;
  const bool isPng = file::extensionOf(path) == ".png";
  Result<HeightField> read = readHeights(path, isPng, options);
  if (!read) return read.error();
  HeightField field = std::move(*read);
  const int longest = std::max(field.width, field.height);
  if (longest > options.maximumSamples) {
    const int factor = (longest + options.maximumSamples - 1) / options.maximumSamples;
    if (field.width / factor < 2 || field.height / factor < 2)
      return report::badInput(path.string() + ": the height field is too long and narrow");
    findings.push_back(
        {Severity::Note, "height-field-reduced",
         path.string() + ": " + std::to_string(field.width) + "×" + std::to_string(field.height) +
             " samples are averaged down to " + std::to_string(field.width / factor) + "×" +
             std::to_string(field.height / factor) + ", which is finer than an RTT's positions",
         1});
    field = reduced(field, factor);
  }
  const float aspect = float(field.height) / float(field.width);
  const Vec2 size = options.size.value_or(Vec2(0.1f, 0.1f * aspect));
  if (isPng) {
    const float depth = options.depth.value_or(0.15f * size.x());
    for (float& h : field.heights) h *= depth;
  } else if (options.depth) {
    const auto [low, high] = std::minmax_element(field.heights.begin(), field.heights.end());
    const float lowest = *low, span = *high - *low;
    for (float& h : field.heights) h = span > 0.0f ? (h - lowest) / span * *options.depth : 0.0f;
  }

  scene::Material material;
  material.name = path.stem().string();
  material.diffuse = options.albedo;
  std::optional<scene::Texture> texture;
  if (!options.color.empty()) {
    Result<scene::Texture> color = readColor(options);
    if (!color) return color.error();
    texture = std::move(*color);
    material.diffuse = Rgb::Ones();
  }
  if (options.blend > 0.0f) {
    // Colours have to be blended with the heights, sample by sample.
    if (texture)
      for (int y = 0; y < field.height; ++y)
        for (int x = 0; x < field.width; ++x)
          field.colors.push_back(scene::sampleBaseColor(
              *texture,
              Vec2((x + 0.5f) / float(field.width), 1.0f - (y + 0.5f) / float(field.height))));
    texture.reset();
    field = withBlendedBorders(field, options.blend);
  }
  for (Finding finding : checkTiling(field)) {
    finding.message = path.string() + ": " + finding.message;
    findings.push_back(finding);
  }
  if (texture) material.baseColorTexture = 0;
  Patch patch = patchOf(field, size, material, path.stem().string());
  if (texture) patch.scene.textures.push_back(std::move(*texture));
  return LoadedPatch{{std::move(patch), std::move(findings)}, {}};
}

}  // namespace

Result<LoadedPatch> loadPatch(const std::filesystem::path& path, const PatchFileOptions& options) {
  if (!(options.blend >= 0.0f && options.blend <= 0.5f))
    return report::badUsage("blending reaches over 0 to 0.5 of the period");
  const std::string extension = file::extensionOf(path);
  if (extension == ".png" || extension == ".exr") return loadHeights(path, options);
  if (!options.color.empty())
    return report::badUsage(path.string() +
                            ": a colour picture goes with a height field; a mesh brings its own");
  if (extension == ".glb" || extension == ".gltf" || extension == ".obj" || extension == ".ply")
    return loadMesh(path, options);
  return report::badInput(path.string() +
                          ": a patch is a height field (.png, .exr) or a mesh (.glb, .gltf, .obj, "
                          ".ply)");
}

Status savePatch(const Patch& patch, const std::filesystem::path& path) {
  scene::Scene scene = patch.scene;
  if (patch.backing) {
    const float z = extentOf(patch).lowest, x = patch.size.x(), y = patch.size.y();
    scene::Mesh plane;
    plane.name = "backing";
    plane.material = static_cast<int>(scene.materials.size());
    plane.positions = {{0, 0, z}, {x, 0, z}, {x, y, z}, {0, y, z}};
    plane.normals.assign(4, Vec3::UnitZ());
    plane.triangles = {{0, 1, 2}, {0, 2, 3}};
    scene.meshes.push_back(std::move(plane));
    scene::Material material;
    material.name = "backing";
    material.diffuse = *patch.backing;
    scene.materials.push_back(material);
  }
  turn(scene, yUpFromPatch);
  return scene_io::saveGlb(scene, path);
}

}  // namespace lambent::meso
