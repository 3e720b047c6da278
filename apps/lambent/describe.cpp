#include "apps/lambent/describe.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lambent/asset/summary.h"
#include "lambent/math/directions.h"
#include "lambent/radiometry/luminance.h"
#include "lambent/scene/source.h"
#include "lambent/sh/basis.h"
#include "lambent/sh/zonal.h"
#include "lambent/transfer/names.h"

namespace lambent::tool {

using transfer::nameOf;

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

/// What a glTF file says of itself, as far as it says anything.
std::string sayWhose(const scene::Source& source) {
  std::string lines;
  const auto say = [&](std::string_view what, const std::string& said) {
    if (!said.empty()) lines += fmt::format("  {}: {:.400}\n", what, said);
  };
  say("scene", source.title);
  say("copyright", source.copyright);
  say("made by", source.generator);
  say("the asset's extras", source.assetExtras);
  return lines;
}

}  // namespace

Json asJson(const Rgb& rgb) {
  return {rgb[0], rgb[1], rgb[2]};
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
  if (!scene.origin.isZero(0.0))
    d.text += fmt::format("  its origin lies at {} {} {} m of the file\n", scene.origin.x(),
                          scene.origin.y(), scene.origin.z());
  if (scene.source) d.text += sayWhose(*scene.source);
  d.json = {{"vertices", vertices},
            {"triangles", triangles},
            {"origin", {scene.origin.x(), scene.origin.y(), scene.origin.z()}},
            {"bounds", {asJson(box.lower), asJson(box.upper)}},
            {"meshes", meshes},
            {"materials", materials},
            {"textures", textures},
            {"cameras", cameras}};
  if (scene.source) {
    const scene::Source& source = *scene.source;
    d.json.update({{"name", source.title},
                   {"copyright", source.copyright},
                   {"generator", source.generator},
                   {"asset_extras", Json::parse(source.assetExtras, nullptr, false)}});
    if (d.json["asset_extras"].is_discarded()) d.json["asset_extras"] = nullptr;
  }
  return d;
}

namespace {

Description describeBiScale(const asset::BiScaleSummary& biScale, std::uint64_t receivers) {
  const bool any = biScale.shadowed || biScale.interreflected;
  const std::string matrices = biScale.interreflected && biScale.shadowed
                                   ? "shadowed and interreflected matrices"
                               : biScale.interreflected ? "interreflected matrices"
                               : biScale.shadowed       ? "shadowed matrices"
                                                        : "no matrices";
  const std::string where =
      biScale.idMapWidth > 0
          ? fmt::format("id map {}x{}", biScale.idMapWidth, biScale.idMapHeight)
          : fmt::format("{:.4g}x{:.4g} tiles of its UVs", biScale.tiles.x(), biScale.tiles.y());
  const bool textured = biScale.tintWidth > 0;
  std::string tint;
  if (biScale.layer)
    tint = fmt::format(", a layer{}", textured ? fmt::format(" by a mask of {}x{} texels",
                                                             biScale.tintWidth, biScale.tintHeight)
                                               : "");
  else if (textured)
    tint = fmt::format(", tinted by {}x{} texels", biScale.tintWidth, biScale.tintHeight);
  if (biScale.tintedVertices)
    tint += textured ? " and colours of vertices" : ", tinted by colours of vertices";
  Description d;
  d.text = fmt::format("bi-scale, {} vertices, {}, {} of {} bands{}{}\n", formatCount(receivers),
                       where, matrices, biScale.bands,
                       any ? fmt::format(", {}", nameOf(biScale.encoding)) : "", tint);
  d.json = {{"rtt", biScale.rtt},
            {"bands", biScale.bands},
            {"scale", biScale.scale},
            {"id_map", {biScale.idMapWidth, biScale.idMapHeight}},
            {"tiles", {biScale.tiles.x(), biScale.tiles.y()}},
            {"shadowed", biScale.shadowed},
            {"interreflected", biScale.interreflected},
            {"channels", biScale.channels},
            {"encoding", nameOf(biScale.encoding)},
            {"layer", biScale.layer},
            {"tint",
             {{"texels", {biScale.tintWidth, biScale.tintHeight}},
              {"vertex_colors", biScale.tintedVertices}}}};
  return d;
}

Description describeMesh(const asset::MeshSummary& mesh) {
  const std::string called = mesh.name.empty() ? "(no name)" : mesh.name;
  Description d;
  d.json = {{"name", mesh.name}, {"layout", mesh.layout}};
  if (mesh.layout == transfer::kNoLayout) {
    d.text = fmt::format("  {}: a mirror, records no transfer\n", called);
    return d;
  }
  d.json["receivers"] = mesh.receivers;
  if (mesh.biScale) {
    const Description biScale = describeBiScale(*mesh.biScale, mesh.receivers);
    d.text = fmt::format("  {}: {}", called, biScale.text);
    d.json["bi_scale"] = biScale.json;
    return d;
  }
  const std::optional<asset::VectorsSummary>& vectors = mesh.vectors;
  const std::optional<asset::MatricesSummary>& matrices = mesh.matrices;
  const std::optional<asset::ShadowedSummary>& shadowed = mesh.shadowed;
  const auto vectorShape = [&](int channels) {
    return fmt::format(" vectors {}x{}", channels, vectors->bands * vectors->bands);
  };
  const auto matrixShape = [&](int channels) {
    return fmt::format(" matrices {}x{}x{}", channels, matrices->outBands * matrices->outBands,
                       matrices->inBands * matrices->inBands);
  };
  std::string what;
  if (vectors) what += "," + vectorShape(vectors->channels);
  if (matrices)
    what += fmt::format(",{}, lobe exponent {:.4g}", matrixShape(matrices->channels),
                        matrices->lobeExponent);
  if (shadowed) {
    what += ", shadowed beside:";
    if (vectors) what += vectorShape(shadowed->channels);
    if (matrices) what += (vectors ? "," : "") + matrixShape(shadowed->matrixChannels);
  }
  const transfer::Encoding encoding = vectors    ? vectors->encoding
                                      : matrices ? matrices->encoding
                                                 : transfer::Encoding::Float32;
  const std::string where = mesh.width > 0
                                ? fmt::format("{}x{} texels{}", mesh.width, mesh.height,
                                              mesh.texCoord > 0 ? " of TEXCOORD_1" : "")
                                : fmt::format("{} vertices", formatCount(mesh.receivers));
  d.text = fmt::format("  {}: {}{}, {}\n", called, where, what, nameOf(encoding));
  d.json.update({{"width", mesh.width},
                 {"height", mesh.height},
                 {"tex_coord", mesh.texCoord},
                 {"encoding", nameOf(encoding)},
                 {"vector_bands", vectors ? vectors->bands : 0},
                 {"vector_channels", vectors ? vectors->channels : 0},
                 {"matrix_out_bands", matrices ? matrices->outBands : 0},
                 {"matrix_in_bands", matrices ? matrices->inBands : 0},
                 {"matrix_channels", matrices ? matrices->channels : 0},
                 {"shadowed", shadowed.has_value()},
                 {"shadowed_vector_channels", shadowed ? shadowed->channels : 0},
                 {"shadowed_matrix_channels", shadowed ? shadowed->matrixChannels : 0}});
  return d;
}

}  // namespace

Description describe(const asset::Asset& asset) {
  const asset::Summary transfer = asset::summarize(asset);
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
  for (const asset::MeshSummary& mesh : transfer.meshes) {
    const Description one = describeMesh(mesh);
    d.text += one.text;
    meshes.push_back(one.json);
  }
  Json rtts = Json::array();
  for (const asset::RttSummary& rtt : transfer.rtts) {
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

Description describe(const std::vector<bi_scale::MeshQuality>& layouts, const scene::Scene& scene) {
  constexpr std::size_t kMostTears = 16;
  Description d;
  d.json = Json::array();
  for (const bi_scale::MeshQuality& layout : layouts) {
    const synthesis::ResultQuality& q = layout.quality;
    const std::string& name = scene.meshes[layout.mesh].name;
    d.text += fmt::format(
        "  lay-out on {}: goes on over {:.3f}% of steps, {} tears, {:.3f} periods of "
        "them in an area of one\n",
        name.empty() ? fmt::format("mesh {}", layout.mesh) : name, 100.0 * q.continued,
        formatCount(q.tears.size()), q.tearLength);
    Json json = {{"mesh", layout.mesh},
                 {"name", name},
                 {"period", {layout.period.x(), layout.period.y()}},
                 {"continued", q.continued},
                 {"tear_length", q.tearLength},
                 {"tear_count", q.tears.size()}};
    Json& tears = json["tears"] = Json::array();
    for (std::size_t k = 0; k < std::min(kMostTears, q.tears.size()); ++k)
      tears.push_back({{"middle", asJson(q.tears[k].middle)}, {"length", q.tears[k].length}});
    const auto add = [&](const char* key, const std::optional<double>& number) {
      if (number) json[key] = *number;
    };
    add("whole_by_area", q.wholeByArea), add("whole", q.whole), add("unlikeness", q.unlikeness);
    add("misfit", q.misfit), add("repetition", q.repetition);
    if (q.whole)
      d.text += fmt::format("    {:.1f}% of its pieces whole by their area, {:.1f}% in all\n",
                            100.0 * *q.wholeByArea, 100.0 * *q.whole);
    if (q.unlikeness)
      d.text += fmt::format("    unlikeness {:.4f}, misfit {:.4f}\n", *q.unlikeness, *q.misfit);
    if (q.repetition) d.text += fmt::format("    repetition {:.2f}\n", *q.repetition);
    d.json.push_back(json);
  }
  return d;
}

Description describe(const asset::RttSummary& rtt) {
  const std::string views =
      rtt.views > 1 ? fmt::format("{}x{} views", rtt.views, rtt.views) : std::string("no views");
  Description d;
  d.text = fmt::format(
      "patch {}: {}x{} positions, {}, light of {} bands, {:.4g}x{:.4g} m, {:.3g} m "
      "deep, {}, {}\n",
      rtt.name.empty() ? "(no name)" : rtt.name, rtt.width, rtt.height, views, rtt.bands,
      rtt.size.x(), rtt.size.y(), rtt.depth, nameOf(rtt.encoding), formatBytes(double(rtt.bytes)));
  d.json = {{"name", rtt.name},     {"width", rtt.width},
            {"height", rtt.height}, {"views", rtt.views},
            {"bands", rtt.bands},   {"size", {rtt.size.x(), rtt.size.y()}},
            {"depth", rtt.depth},   {"encoding", nameOf(rtt.encoding)},
            {"bytes", rtt.bytes}};
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
