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
#include "lambent/bi_scale/asset_quality.h"
#include "lambent/file/atomic_file.h"
#include "lambent/image/io.h"
#include "lambent/image/maps.h"
#include "lambent/light/environment.h"
#include "lambent/light/light_file.h"
#include "lambent/scene_io/load.h"
#include "lambent/sources/source.h"

namespace lambent::tool {

namespace {

constexpr std::string_view kInfoExamples = R"(Examples:
  lambent info model.glb          meshes, materials, cameras, and what is odd in them
  lambent info baked.glb          also: bands, directions, bounces, encoding
  lambent info woven.glb --measure
                                  also how well its patch lies: where it is torn, say
  lambent info weave.rtt          a patch: positions, views, bands, size
  lambent info sky.exr            size, range, layers, and what it is as a light
  lambent info cube:probe.exr     what any SOURCE of light is, as 'lambent light' reads it
  lambent info light.json --json  for a script
  curl -L URL | lambent info -    what comes from standard input

)";

struct Whole {
  std::string kind;
  Description description;
};

struct InfoRequest {
  std::filesystem::path path;
  bool measure = false;  ///< of assets: how their patches lie
  ReadingArguments reading;
};

Result<Whole> describeModel(const InfoRequest& request, Console& console) {
  const auto& [path, measure, reading] = request;
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
      if (measure) {
        const Description layouts = describe(
            console.stage("measure", [&] { return bi_scale::qualityOf(*asset); }), asset->scene);
        scene.text += layouts.text;
        scene.json["layouts"] = layouts.json;
      }
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

/// Of a SOURCE, or of a picture as one.
Result<Description> describeLight(std::string_view source, const ReadingArguments& reading,
                                  Console& console, bool tellFindings) {
  sources::SourceOptions options = reading.forSource(console.progress());
  options.notFinite = sources::SourceOptions::NotFinite::Repair;
  const auto light = sources::parseSource(source, options);
  if (!light) return light.error();
  if (tellFindings)
    if (Status whole = console.accept(light->findings); !whole) return whole.error();
  return describe(light->value.project(5));
}

/// The word that makes a light of a picture, and what it is taken for. By what the file says, else
/// by its shape; nothing for shapes that no map has.
struct TakenFor {
  std::string_view word, name;
};
std::optional<TakenFor> takenFor(const image::PictureFile& picture) {
  const auto kind =
      picture.map ? picture.map : image::guessKind(picture.image.width, picture.image.height);
  if (!kind) return std::nullopt;
  switch (*kind) {
    case image::MapKind::LatLong:
      return TakenFor{"latlong", "latitude-longitude map"};
    case image::MapKind::Cube:
      return TakenFor{"cube", "cube map"};
    default:
      return TakenFor{"angular", "light probe (a mirrored ball is ball:FILE)"};
  }
}

/// A picture for a screen is a light only where it lies in latitude and longitude: most are textures.
Result<Description> describeAsLight(image::PictureFile picture, const TakenFor& taken,
                                    const std::string& name, const ReadingArguments& reading,
                                    Console& console) {
  const bool latLong = taken.word == "latlong";
  const std::string why = picture.map ? "by its header" : "by its shape";
  Description d;
  d.json["taken_for"] = taken.word;
  if (picture.codes && !latLong) {
    d.text =
        fmt::format("as a light {} a {}: {}:FILE reads it as one\n", why, taken.name, taken.word);
    return d;
  }
  Result<Description> light = Description{};
  if (latLong && !picture.codes && picture.image.width == 2 * picture.image.height) {
    light = describe(light::Environment::latLong(std::move(picture.image)).project(5));
  } else {
    const bool untold = picture.codes;  // that it is made for a screen is told of lights alone
    picture.image = {};
    light = describeLight(fmt::format("{}:{}", taken.word, name), reading, console, untold);
  }
  if (!light) return light.error();
  d.text = fmt::format("as a light, {} a {}: {}", why, taken.name, light->text);
  d.json["light"] = light->json;
  return d;
}

Result<Whole> describeImage(const std::string& name, const ReadingArguments& reading,
                            Console& console) {
  const sources::PictureName file = sources::pictureNameOf(name);
  image::ReadOptions options = reading.forImage();
  options.layer = file.layer;
  auto picture = image::readPicture(file.path, options);
  if (!picture) return picture.error();
  Description d = describe(picture->image);
  const auto taken = takenFor(*picture);
  if (!picture->codes || !taken)
    if (Status whole = console.accept(picture->findings); !whole) return whole.error();
  if (!taken) {
    d.text += "no light by itself: its shape is that of no map; latlong:FILE takes it for one\n";
    return Whole{"image", d};
  }
  const auto light = describeAsLight(std::move(*picture), *taken, name, reading, console);
  if (!light) return light.error();
  d.text += light->text;
  d.json.update(light->json);
  return Whole{"image", d};
}

/// Whether a name is that of no file but a SOURCE: a word of light, or a sum.
bool isSource(const std::string& name) {
  std::error_code ignored;
  if (std::filesystem::exists(name, ignored)) return false;
  return sources::kindOf(name) || sources::sourceTerms(name).size() > 1;
}

Result<Whole> describeFile(const InfoRequest& request, Console& console) {
  const std::filesystem::path& path = request.path;
  const ReadingArguments& reading = request.reading;
  if (isSource(path.string())) {
    const auto light = describeLight(path.string(), reading, console, true);
    if (!light) return light.error();
    return Whole{"light", *light};
  }
  const std::string extension = extensionOf(sources::pictureNameOf(path.string()).path);
  if (extension == ".glb" || extension == ".gltf" || extension == ".obj" || extension == ".ply")
    return describeModel(request, console);
  if (extension == ".rtt") {
    const auto rtt = asset::readRtt(path, reading.forAsset());
    if (!rtt) return rtt.error();
    return Whole{"radiance transfer texture", describe(asset::summarize(*rtt))};
  }
  for (const std::string_view picture : {".exr", ".hdr", ".png", ".jpg", ".jpeg", ".webp"})
    if (extension == picture) return describeImage(path.string(), reading, console);
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

Status runInfo(InfoRequest request, Console& console) {
  std::filesystem::path& path = request.path;
  if (Status s = console.takeInput(path, "FILE"); !s) return s;
  const auto whole = describeFile(request, console);
  if (!whole) return whole.error();
  Json json = {{"file", path.string()}, {"kind", whole->kind}};
  std::string head = fmt::format("{}: {}", path.string(), whole->kind);
  std::error_code none;
  const std::uintmax_t bytes =
      std::filesystem::file_size(sources::pictureNameOf(path.string()).path, none);
  if (!none) {  // a SOURCE may be of no file
    json["bytes"] = bytes;
    head += fmt::format(", {}", formatBytes(double(bytes)));
  }
  json.update(whole->description.json);
  return console.finish(json, head + "\n" + whole->description.text);
}

}  // namespace

Verb addInfo(CLI::App& root, ConsoleOptions& common) {
  auto arguments = std::make_shared<InfoRequest>();
  CLI::App* app =
      root.add_subcommand("info", "Say what is in a scene, an asset, an image or a light");
  app->group("Verbs");
  app->footer(std::string(kInfoExamples) + sources::sourceHelp());
  app->add_option("FILE", arguments->path,
                  "The file to look into, - for standard input, or a SOURCE of light (see below)")
      ->required();
  app->add_flag(
      "--measure", arguments->measure,
      "Of an asset with meso-structure: also where its patch is torn, how many of its pieces "
      "are whole, how much it looks like itself and how much it repeats itself");
  arguments->reading.addTo(*app);
  addCommonOptions(*app, common);
  return {app, [arguments](Console& console) { return runInfo(*arguments, console); }};
}

}  // namespace lambent::tool
