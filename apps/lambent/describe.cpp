#include "apps/lambent/describe.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lambent/asset/names.h"
#include "lambent/asset/summary.h"
#include "lambent/math/directions.h"
#include "lambent/radiometry/luminance.h"
#include "lambent/sh/basis.h"
#include "lambent/sh/zonal.h"

namespace lambent::tool {

namespace {

std::string text(const Rgb& rgb) {
  return fmt::format("{:.4g} {:.4g} {:.4g}", rgb[0], rgb[1], rgb[2]);
}

std::string text(const Vec3& v) {
  return fmt::format("{:.4g} {:.4g} {:.4g}", v[0], v[1], v[2]);
}

Json asJson(const Vec3& v) {
  return {v[0], v[1], v[2]};
}

Rgb irradianceOn(const sh::RgbCoefficients& light, const Vec3& normal) {
  std::vector<float> lobe(static_cast<std::size_t>(sh::coefficientCount(light.bands)));
  sh::turnTo(sh::clampedCosine(light.bands), normal, std::span<float>(lobe));
  Rgb sum = Rgb::Zero();
  for (int c = 0; c < 3; ++c)
    for (std::size_t i = 0; i < lobe.size(); ++i) sum[c] += lobe[i] * light.channel(c)[i];
  return sum;
}

/// The lowest reconstructed luminance: below zero where the bands ring.
float lowestLuminance(const sh::RgbCoefficients& light) {
  constexpr int kCount = 4096;
  float lowest = std::numeric_limits<float>::infinity();
  for (int i = 0; i < kCount; ++i) {  // a spiral of equal-area steps
    const double z = 1.0 - 2.0 * (i + 0.5) / kCount;
    const double angle = i * kPi * (3.0 - std::sqrt(5.0));
    const double r = std::sqrt(1.0 - z * z);
    const Vec3 direction(float(r * std::cos(angle)), float(r * std::sin(angle)), float(z));
    lowest = std::min(lowest, radiometry::luminance(sh::reconstruct(light, direction)));
  }
  return lowest;
}

std::string describeMaterial(const scene::Material& material) {
  std::string words;
  if (material.isMirror()) return fmt::format("mirror {}", text(material.mirror));
  if (material.isDiffuse()) words += fmt::format("diffuse {}", text(material.diffuse));
  if (material.isGlossy())
    words += fmt::format("{}glossy {} with lobe exponent {:.4g}", words.empty() ? "" : " and ",
                         text(material.glossy), material.lobeExponent);
  return words.empty() ? "black" : words;
}

}  // namespace

Json asJson(const Rgb& rgb) {
  return {rgb[0], rgb[1], rgb[2]};
}

std::string_view nameOf(transport::TransferKind kind) {
  switch (kind) {
    case transport::TransferKind::Unshadowed:
      return "unshadowed";
    case transport::TransferKind::Shadowed:
      return "shadowed";
    case transport::TransferKind::Interreflected:
      return "interreflected";
  }
  return "";
}

std::string_view nameOf(transport::Layout layout) {
  switch (layout) {
    case transport::Layout::None:
      return "none";
    case transport::Layout::Vertices:
      return "vertices";
    case transport::Layout::Texels:
      return "texels";
  }
  return "";
}

std::string_view nameOf(encode::Encoding encoding) {
  return asset::nameOf(encoding);
}

Description describe(const scene::Scene& scene) {
  Description d;
  std::size_t vertices = 0, triangles = 0;
  Json meshes = Json::array(), materials = Json::array(), textures = Json::array(),
       cameras = Json::array();
  std::string lines;
  for (const scene::Mesh& mesh : scene.meshes) {
    vertices += mesh.positions.size();
    triangles += mesh.triangles.size();
    const scene::Material& material = scene.materials[size_t(mesh.material)];
    lines += fmt::format(
        "  {}: {} vertices, {} triangles{}{}, {}{}\n", mesh.name.empty() ? "(no name)" : mesh.name,
        formatCount(mesh.positions.size()), formatCount(mesh.triangles.size()),
        mesh.uvs.empty() ? "" : ", UVs", mesh.colors.empty() ? "" : ", colours",
        describeMaterial(material), material.baseColorTexture >= 0 ? ", textured" : "");
    meshes.push_back({{"name", mesh.name},
                      {"vertices", mesh.positions.size()},
                      {"triangles", mesh.triangles.size()},
                      {"uvs", !mesh.uvs.empty()},
                      {"colors", !mesh.colors.empty()},
                      {"material", mesh.material}});
  }
  for (const scene::Material& material : scene.materials)
    materials.push_back({{"name", material.name},
                         {"diffuse", asJson(material.diffuse)},
                         {"glossy", asJson(material.glossy)},
                         {"mirror", asJson(material.mirror)},
                         {"lobe_exponent", material.lobeExponent},
                         {"texture", material.baseColorTexture}});
  for (const scene::Texture& texture : scene.textures) {
    lines += fmt::format("  texture {}: {}x{}\n", texture.name, texture.width, texture.height);
    textures.push_back(
        {{"name", texture.name}, {"width", texture.width}, {"height", texture.height}});
  }
  for (const scene::Camera& camera : scene.cameras) {
    lines += fmt::format("  camera {}: {}\n", camera.name.empty() ? "(no name)" : camera.name,
                         camera.orthographicHalfHeight
                             ? std::string("orthographic")
                             : fmt::format("{:.3g} degrees high", camera.verticalFov * 180 / kPi));
    cameras.push_back(camera.name);
  }
  const scene::Box box = scene::bounds(scene);
  d.text = fmt::format("{} meshes, {} vertices, {} triangles, from {} to {} m\n{}",
                       scene.meshes.size(), formatCount(vertices), formatCount(triangles),
                       text(box.lower), text(box.upper), lines);
  d.json = {{"vertices", vertices},
            {"triangles", triangles},
            {"bounds", {asJson(box.lower), asJson(box.upper)}},
            {"meshes", meshes},
            {"materials", materials},
            {"textures", textures},
            {"cameras", cameras}};
  return d;
}

namespace {

Description describe(const encode::EncodedBiScale& biScale, std::size_t receivers) {
  const std::string matrices = !biScale.interreflected.empty() && !biScale.shadowed.empty()
                                   ? "shadowed and interreflected matrices"
                               : !biScale.interreflected.empty() ? "interreflected matrices"
                               : !biScale.shadowed.empty()       ? "shadowed matrices"
                                                                 : "no matrices";
  const encode::Numbers& any =
      biScale.interreflected.empty() ? biScale.shadowed : biScale.interreflected;
  const std::string where =
      biScale.idMap
          ? fmt::format("id map {}x{}", biScale.idMap->width, biScale.idMap->height)
          : fmt::format("{:.4g}x{:.4g} tiles of its UVs", biScale.tiles.x(), biScale.tiles.y());
  Description d;
  d.text = fmt::format("bi-scale, {} vertices, {}, {} of {} bands{}\n", formatCount(receivers),
                       where, matrices, biScale.bands,
                       any.empty() ? "" : fmt::format(", {}", nameOf(any.encoding)));
  d.json = {{"rtt", biScale.rtt},
            {"bands", biScale.bands},
            {"scale", biScale.scale},
            {"id_map",
             {biScale.idMap ? biScale.idMap->width : 0, biScale.idMap ? biScale.idMap->height : 0}},
            {"tiles", {biScale.tiles.x(), biScale.tiles.y()}},
            {"shadowed", !biScale.shadowed.empty()},
            {"interreflected", !biScale.interreflected.empty()},
            {"channels", biScale.channels},
            {"encoding", nameOf(any.encoding)}};
  return d;
}

}  // namespace

Description describe(const encode::EncodedField& transfer, const scene::Scene& scene) {
  Description d;
  d.text = fmt::format("{} transfer for light of {} bands, {} directions, {} bounces, seed {}\n",
                       nameOf(transfer.kind), transfer.bands, formatCount(transfer.directions),
                       transfer.bounces, transfer.seed);
  if (transfer.passEnergy.size() > 1) {
    d.text += "  energy of each pass:";
    for (const double energy : transfer.passEnergy) d.text += fmt::format(" {:.4g}", energy);
    d.text += '\n';
  }
  Json meshes = Json::array();
  for (std::size_t i = 0; i < transfer.meshes.size(); ++i) {
    const encode::EncodedMesh& mesh = transfer.meshes[i];
    const std::string name = i < scene.meshes.size() ? scene.meshes[i].name : std::string();
    const std::string called = name.empty() ? "(no name)" : name;
    if (mesh.layout == transport::Layout::None) {
      d.text += fmt::format("  {}: a mirror, records no transfer\n", called);
      meshes.push_back({{"name", name}, {"layout", nameOf(mesh.layout)}});
      continue;
    }
    if (mesh.biScale) {
      const Description biScale = describe(*mesh.biScale, mesh.receiverCount());
      d.text += fmt::format("  {}: {}", called, biScale.text);
      Json json = {
          {"name", name}, {"layout", nameOf(mesh.layout)}, {"receivers", mesh.receiverCount()}};
      json["bi_scale"] = biScale.json;
      meshes.push_back(json);
      continue;
    }
    const encode::Numbers& any = mesh.vectors.empty() ? mesh.matrices : mesh.vectors;
    std::string what;
    if (!mesh.vectors.empty())
      what += fmt::format(", vectors {}x{}", mesh.channels, mesh.bands * mesh.bands);
    if (!mesh.matrices.empty())
      what += fmt::format(", matrices {}x{}x{}, lobe exponent {:.4g}", mesh.matrixChannels,
                          mesh.outBands * mesh.outBands, mesh.inBands * mesh.inBands,
                          mesh.lobeExponent);
    if (!mesh.shadowed.empty()) {
      what += ", shadowed beside:";
      if (!mesh.shadowed.vectors.empty())
        what += fmt::format(" vectors {}x{}", mesh.shadowed.channels, mesh.bands * mesh.bands);
      if (!mesh.shadowed.matrices.empty())
        what += fmt::format("{} matrices {}x{}x{}", mesh.shadowed.vectors.empty() ? "" : ",",
                            mesh.shadowed.matrixChannels, mesh.outBands * mesh.outBands,
                            mesh.inBands * mesh.inBands);
    }
    const std::string where = mesh.layout == transport::Layout::Texels
                                  ? fmt::format("{}x{} texels", mesh.width, mesh.height)
                                  : fmt::format("{} vertices", formatCount(mesh.receiverCount()));
    d.text += fmt::format("  {}: {}{}, {}\n", called, where, what, nameOf(any.encoding));
    meshes.push_back(
        {{"name", name},
         {"layout", nameOf(mesh.layout)},
         {"receivers", mesh.receiverCount()},
         {"width", mesh.width},
         {"height", mesh.height},
         {"encoding", nameOf(any.encoding)},
         {"vector_bands", mesh.vectors.empty() ? 0 : mesh.bands},
         {"vector_channels", mesh.vectors.empty() ? 0 : mesh.channels},
         {"matrix_out_bands", mesh.matrices.empty() ? 0 : mesh.outBands},
         {"matrix_in_bands", mesh.matrices.empty() ? 0 : mesh.inBands},
         {"matrix_channels", mesh.matrices.empty() ? 0 : mesh.matrixChannels},
         {"shadowed", !mesh.shadowed.empty()},
         {"shadowed_vector_channels", mesh.shadowed.vectors.empty() ? 0 : mesh.shadowed.channels},
         {"shadowed_matrix_channels",
          mesh.shadowed.matrices.empty() ? 0 : mesh.shadowed.matrixChannels}});
  }
  Json rtts = Json::array();
  for (const encode::EncodedRtt& rtt : transfer.rtts) {
    const Description one = describe(rtt);
    d.text += "  " + one.text;
    rtts.push_back(one.json);
  }
  d.json = {{"kind", nameOf(transfer.kind)},
            {"bands", transfer.bands},
            {"directions", transfer.directions},
            {"bounces", transfer.bounces},
            {"seed", transfer.seed},
            {"pass_energy", transfer.passEnergy},
            {"meshes", meshes},
            {"rtts", rtts}};
  return d;
}

Description describe(const encode::EncodedRtt& rtt) {
  const asset::RttSummary summary = asset::summarize(rtt);
  const std::string views =
      rtt.views > 1 ? fmt::format("{}x{} views", rtt.views, rtt.views) : std::string("no views");
  Description d;
  d.text = fmt::format(
      "patch {}: {}x{} positions, {}, light of {} bands, {:.4g}x{:.4g} m, {:.3g} m "
      "deep, {}, {}\n",
      rtt.name.empty() ? "(no name)" : rtt.name, rtt.width, rtt.height, views, rtt.bands,
      rtt.size.x(), rtt.size.y(), rtt.depth, nameOf(rtt.values.encoding),
      formatBytes(double(summary.bytes)));
  d.json = {{"name", rtt.name},      {"width", rtt.width},
            {"height", rtt.height},  {"views", rtt.views},
            {"bands", rtt.bands},    {"size", {rtt.size.x(), rtt.size.y()}},
            {"depth", rtt.depth},    {"encoding", nameOf(rtt.values.encoding)},
            {"bytes", summary.bytes}};
  return d;
}

Description describe(const sh::RgbCoefficients& light) {
  Description d;
  Rgb mean;
  Vec3 toLight = Vec3::Zero();
  const float weights[3] = {radiometry::luminance(Rgb(1, 0, 0)),
                            radiometry::luminance(Rgb(0, 1, 0)),
                            radiometry::luminance(Rgb(0, 0, 1))};
  for (int c = 0; c < 3; ++c) {
    const auto f = light.channel(c);
    mean[c] = f[0] * float(1.0 / std::sqrt(4.0 * kPi));
    if (light.bands > 1)
      toLight += weights[c] * Vec3(f[size_t(sh::index(1, 1))], f[size_t(sh::index(1, -1))],
                                   f[size_t(sh::index(1, 0))]);
  }
  const Rgb above = irradianceOn(light, Vec3::UnitY());
  const float lowest = lowestLuminance(light);
  d.text = fmt::format(
      "{} bands, {} coefficients per channel\n"
      "  mean radiance {}\n"
      "  irradiance on the ground {}\n",
      light.bands, sh::coefficientCount(light.bands), text(mean), text(above));
  d.json = {{"bands", light.bands},
            {"coefficients", sh::coefficientCount(light.bands)},
            {"mean_radiance", asJson(mean)},
            {"irradiance_up", asJson(above)},
            {"lowest_luminance", lowest}};
  if (toLight.norm() > 1e-4f * std::max(mean.abs().maxCoeff(), 1e-30f)) {
    const Vec3 u = toLight.normalized();
    const auto at = math::azimuthElevationOf(Vec3d(u.cast<double>()));
    const double azimuth = at.azimuth * 180.0 / kPi, elevation = at.elevation * 180.0 / kPi;
    d.text += fmt::format("  most of it from azimuth {:.1f}, elevation {:.1f} degrees\n", azimuth,
                          elevation);
    d.json["azimuth"] = azimuth;
    d.json["elevation"] = elevation;
  }
  if (lowest < -1e-3f * radiometry::luminance(mean))
    d.text += fmt::format(
        "  rings down to a luminance of {:.3g}: --window minimal keeps it from falling below "
        "zero\n",
        lowest);
  return d;
}

Description describe(const image::Image& image) {
  Description d;
  Rgb mean = Rgb::Zero(), lowest = Rgb::Constant(std::numeric_limits<float>::infinity()),
      highest = -lowest;
  std::size_t notFinite = 0;
  double covered = 0.0;
  Eigen::Array3d sum = Eigen::Array3d::Zero();
  for (const Rgb& pixel : image.pixels) {
    if (!pixel.isFinite().all()) {
      ++notFinite;
      continue;
    }
    sum += pixel.cast<double>();
    lowest = lowest.min(pixel);
    highest = highest.max(pixel);
  }
  const std::size_t finite = image.pixels.size() - notFinite;
  if (finite > 0) mean = (sum / double(finite)).cast<float>();
  for (const float a : image.alpha) covered += a;
  d.text = fmt::format("{}x{} pixels\n  mean {}\n  from {} to {}\n", image.width, image.height,
                       text(mean), text(lowest), text(highest));
  d.json = {{"width", image.width},     {"height", image.height},     {"mean", asJson(mean)},
            {"lowest", asJson(lowest)}, {"highest", asJson(highest)}, {"not_finite", notFinite}};
  if (notFinite > 0) d.text += fmt::format("  {} pixels are not finite\n", notFinite);
  if (!image.alpha.empty()) {
    d.text += fmt::format("  {:.1f}% covered\n", 100.0 * covered / double(image.alpha.size()));
    d.json["covered"] = covered / double(image.alpha.size());
  }
  return d;
}

}  // namespace lambent::tool
