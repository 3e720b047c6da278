// lambent info FILE
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "apps/lambent/arguments.h"
#include "apps/lambent/describe.h"
#include "apps/lambent/help.h"
#include "apps/lambent/reading_arguments.h"
#include "apps/lambent/receiver_file.h"
#include "apps/lambent/verbs.h"
#include "lambent/asset/asset.h"
#include "lambent/asset/rtt_file.h"
#include "lambent/asset/summary.h"
#include "lambent/file/atomic_file.h"
#include "lambent/image/io.h"
#include "lambent/light/environment.h"
#include "lambent/light/light_file.h"
#include "lambent/scene_io/load.h"

namespace lambent::tool {

namespace {

constexpr std::string_view kInfoExamples = R"(Examples:
  lambent info model.glb          meshes, materials, cameras, and what is odd in them
  lambent info baked.glb          also: bands, directions, bounces, encoding
  lambent info weave.rtt          a patch: positions, views, bands, size
  lambent info sky.exr            size, range, and what it is as a light
  lambent info light.json --json  for a script
)";

struct Whole {
  std::string kind;
  Description description;
};

Result<Whole> describeModel(const std::filesystem::path& path, const ReadingArguments& reading,
                            Console& console) {
  if (extensionOf(path) == ".glb") {
    const Result<bool> baked = asset::isAsset(path);
    if (!baked) return baked.error();
    if (*baked) {
      const auto asset = asset::read(path, reading.forAsset());
      if (!asset) return asset.error();
      Description scene = describe(asset->scene);
      const Description transfer = describe(*asset);
      scene.text += transfer.text;
      scene.json["transfer"] = transfer.json;
      return Whole{"asset", scene};
    }
  }
  const auto loaded = scene_io::load(path, reading.forScene());
  if (!loaded) {
    if (extensionOf(path) == ".ply" && loaded.error().kind == ErrorKind::BadInput) {
      if (const auto receivers = readReceivers(path, reading.memoryLimit))
        return Whole{
            "receivers",
            {fmt::format("{} shaded receivers\n", formatCount(receivers->receivers.size())),
             {{"receivers", receivers->receivers.size()}}}};
    }
    return loaded.error();
  }
  if (Status whole = console.accept(loaded->findings); !whole) return whole.error();
  return Whole{"scene", describe(loaded->scene)};
}

Result<Whole> describeImage(const std::filesystem::path& path, const ReadingArguments& reading) {
  auto image = image::read(path, reading.forImage());
  if (!image) return image.error();
  Description d = describe(*image);
  if (image->width == 2 * image->height) {  // the shape of a latitude-longitude map
    const Description light = describe(light::Environment::latLong(std::move(*image)).project(5));
    d.text += "as a light: " + light.text;
    d.json["light"] = light.json;
  }
  return Whole{"image", d};
}

Result<Whole> describeFile(const std::filesystem::path& path, const ReadingArguments& reading,
                           Console& console) {
  const std::string extension = extensionOf(path);
  if (extension == ".glb" || extension == ".gltf" || extension == ".obj" || extension == ".ply")
    return describeModel(path, reading, console);
  if (extension == ".rtt") {
    const auto rtt = asset::readRtt(path, reading.forAsset());
    if (!rtt) return rtt.error();
    return Whole{"radiance transfer texture", describe(asset::summarize(*rtt))};
  }
  for (const std::string_view picture : {".exr", ".hdr", ".png", ".jpg", ".jpeg", ".webp"})
    if (extension == picture) return describeImage(path, reading);
  if (extension == ".json") {
    const auto light = light::readLight(path);
    if (!light) return light.error();
    return Whole{"light", describe(*light)};
  }
  if (extension == ".csv") {
    const auto receivers = readReceivers(path, reading.memoryLimit);
    if (!receivers) return receivers.error();
    return Whole{"receivers",
                 {fmt::format("{} shaded receivers\n", formatCount(receivers->receivers.size())),
                  {{"receivers", receivers->receivers.size()}}}};
  }
  return badInput(fmt::format(
      "{}: what ends in '{}' is unknown here; info reads .glb .gltf .obj .ply .exr .hdr .png "
      ".jpg .webp .json .csv .rtt",
      path.string(), extension));
}

Status runInfo(const std::filesystem::path& path, const ReadingArguments& reading,
               Console& console) {
  const auto whole = describeFile(path, reading, console);
  if (!whole) return whole.error();
  std::error_code ignored;
  const std::uintmax_t bytes = std::filesystem::file_size(path, ignored);
  Json json = {{"file", path.string()}, {"kind", whole->kind}, {"bytes", bytes}};
  json.update(whole->description.json);
  return console.finish(json, fmt::format("{}: {}, {}\n{}", path.string(), whole->kind,
                                          formatBytes(double(bytes)), whole->description.text));
}

}  // namespace

Verb addInfo(CLI::App& root, ConsoleOptions& common) {
  struct InfoRequest {
    std::filesystem::path path;
    ReadingArguments reading;
  };
  auto arguments = std::make_shared<InfoRequest>();
  CLI::App* app =
      root.add_subcommand("info", "Say what is in a scene, an asset, an image or a light");
  app->group("Verbs");
  app->footer(std::string(kInfoExamples));
  app->add_option("FILE", arguments->path, "The file to look into")->required();
  arguments->reading.addTo(*app);
  addCommonOptions(*app, common);
  return {app, [arguments](Console& console) {
            return runInfo(arguments->path, arguments->reading, console);
          }};
}

}  // namespace lambent::tool
