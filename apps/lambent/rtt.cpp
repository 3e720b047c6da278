// lambent rtt PATCH -o PATCH.rtt
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>

#include "apps/lambent/arguments.h"
#include "apps/lambent/describe.h"
#include "apps/lambent/help.h"
#include "apps/lambent/named_files.h"
#include "apps/lambent/reading_arguments.h"
#include "apps/lambent/verbs.h"
#include "lambent/asset/rtt_file.h"
#include "lambent/image/io.h"
#include "lambent/meso/acquired.h"
#include "lambent/meso/btf_table.h"
#include "lambent/meso/build_rtt.h"
#include "lambent/meso/effective_albedo.h"
#include "lambent/meso/generators.h"
#include "lambent/meso/load_patch.h"
#include "lambent/meso/preview.h"
#include "lambent/tone/tone_curve.h"
#include "lambent/transfer/encode.h"
#include "lambent/transfer/names.h"

namespace lambent::tool {

namespace {

Choices<meso::RttMethod> methods() {
  return {{"gather", meso::RttMethod::Gather}, {"images", meso::RttMethod::Images}};
}

constexpr int kMostPositions = 1024, kMostLights = 256, kMostMeasuredLights = 64;  // a side

struct RttRequest {
  std::string patch;
  std::filesystem::path output, previewPath, patchPath;
  std::string size, positions = "64x64", lights = "8x16";
  transfer::Encoding encoding = transfer::Encoding::Snorm8;
  std::optional<Rgb> albedo, backing, gloss;
  std::optional<double> depth, lobe;
  meso::RttOptions rtt;
  meso::PatchFileOptions file;
  ReadingArguments reading;
  double white = 1.0;
};

constexpr std::string_view kRttExamples = R"(
PATCH is weave, knit, holes, bin, bricks, scales, pebbles, flower, stucco or plaster; a height field
(.png, .exr: black is low); a mesh (.glb, .gltf, .obj, .ply) that lies on the ground; or a measured
BTF: a folder of rectified pictures (or its .csv) with a table
    file,view_theta,view_phi,light_theta,light_phi
of degrees, theta from the normal, phi from the pictures' right towards their top.

Examples:
  lambent rtt weave -o weave.rtt --preview weave.png
      64×64 positions, 8×8 views; pictures from two sides under three lights.
  lambent rtt stucco -o stucco.rtt --views 1 --positions 128x128 --seed 3
      The diffuse special case: finer, and the same from every side.
  lambent rtt bricks.png --color bricks_albedo.png --size 0.5 --depth 0.02 -o bricks.rtt
      A height field of half a metre, 2 cm deep.
  lambent rtt scales.glb -o scales.rtt --bounces 5
  lambent rtt weave -o paper.rtt --method images
      By 8×16 directional lights, as the paper does.
  lambent rtt measured/corduroy -o corduroy.rtt
)";

Result<Vec2> parsePeriod(std::string_view text) {
  const std::size_t times = text.find('x');
  const NumberRange metres = {1e-6, 1e6};
  const Result<double> width = parseNumber(text.substr(0, times), metres);
  if (!width) return badUsage(fmt::format("'{}': {}", text, width.error().message));
  const Result<double> height =
      times == text.npos ? width : parseNumber(text.substr(times + 1), metres);
  if (!height) return badUsage(fmt::format("'{}': {}", text, height.error().message));
  return Vec2(float(*width), float(*height));
}

bool isBtf(const std::filesystem::path& path) {
  std::error_code ignored;
  return extensionOf(path) == ".csv" || std::filesystem::is_directory(path, ignored);
}

bool isGenerator(const std::string& name) {
  const auto names = meso::generatorNames();
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// The patch that is named, with what the options change about it.
Result<meso::Patch> makePatch(const RttRequest& arguments, const std::optional<Vec2>& size,
                              NamedFiles& files, Console& console) {
  if (isGenerator(arguments.patch)) {
    if (arguments.depth || arguments.albedo || !arguments.file.color.empty())
      return badUsage("--depth, --albedo and --color are for height fields in files; '" +
                      arguments.patch + "' brings its own");
    return *meso::generate(arguments.patch, size.value_or(Vec2(0.1f, 0.1f)), arguments.rtt.seed);
  }
  std::error_code ignored;
  if (std::filesystem::path(arguments.patch).extension().empty() &&
      !std::filesystem::exists(arguments.patch, ignored)) {
    std::string names;
    for (const std::string_view name : meso::generatorNames())
      names += (names.empty() ? "" : ", ") + std::string(name);
    return badInput(arguments.patch + ": there is neither such a file nor such a pattern (" +
                    names + ")");
  }
  meso::PatchFileOptions options = arguments.file;
  options.size = size;
  if (arguments.depth) options.depth = float(*arguments.depth);
  if (arguments.albedo) options.albedo = *arguments.albedo;
  if (arguments.backing) options.backing = *arguments.backing;
  options.allowOutside = arguments.reading.allowOutside;
  options.memoryLimit = arguments.reading.memoryLimit;
  auto loaded = console.stage("load", [&] { return meso::loadPatch(arguments.patch, options); });
  if (!loaded) return loaded.error();
  if (Status whole = console.accept(loaded->findings); !whole) return whole.error();
  files.readsFilesOf("PATCH", loaded->linkedFiles);
  if (Status distinct = files.check(); !distinct) return distinct.error();
  return std::move(loaded->value);
}

/// No output may replace a picture of a measured BTF.
Status checkAgainstPictures(const std::filesystem::path& patch, NamedFiles& files) {
  const auto table = meso::findBtfTable(patch);
  if (!table) return table.error();
  const auto samples = meso::readBtfTable(*table);
  if (!samples) return samples.error();
  files.reads("the table of PATCH", *table);
  for (const meso::BtfSample& sample : *samples) files.reads("a picture of PATCH", sample.file);
  return files.check();
}

Status runRtt(RttRequest arguments, Console& console) {
  if (Status s = console.takeInput(arguments.patch, "PATCH"); !s) return s;
  if (Status s = console.takeOutput(arguments.output, "-o", ".rtt"); !s) return s;
  NamedFiles files;
  files.writes("--output", arguments.output, {".rtt"});
  files.writes("--preview", arguments.previewPath, {".png", ".exr"});
  files.writes("--patch", arguments.patchPath, {".glb"});
  if (!isGenerator(arguments.patch)) files.reads("PATCH", arguments.patch);
  files.reads("--color", arguments.file.color);
  if (Status distinct = files.check(); !distinct) return distinct;
  std::optional<Vec2> size;
  if (!arguments.size.empty()) size = *parsePeriod(arguments.size);
  const Size positions = *parseSize(arguments.positions, kMostPositions),
             lights = *parseSize(arguments.lights, kMostLights);
  meso::RttOptions& options = arguments.rtt;
  options.width = positions.width, options.height = positions.height;
  options.polarLights = lights.width, options.azimuthLights = lights.height;
  options.threads = console.options().threads;

  meso::RttCost cost;
  Result<WithFindings<transfer::SimulatedRtt>> built = failed("nothing was built");
  const bool measured = !isGenerator(arguments.patch) && isBtf(arguments.patch);
  if (measured) {
    if (!arguments.patchPath.empty())
      return badUsage("--patch: a measured patch has no geometry to write");
    if (std::max(lights.width, lights.height) > kMostMeasuredLights)
      return badUsage(fmt::format("--lights {}: of a measured patch, each from 1 to {}",
                                  arguments.lights, kMostMeasuredLights));
    if (Status distinct = checkAgainstPictures(arguments.patch, files); !distinct) return distinct;
    meso::AcquiredOptions acquired;
    acquired.width = options.width, acquired.height = options.height;
    acquired.views = options.views, acquired.bands = options.bands;
    acquired.polarLights = options.polarLights, acquired.azimuthLights = options.azimuthLights;
    if (size) acquired.size = *size;
    acquired.white = float(arguments.white);
    acquired.memoryLimit = arguments.reading.memoryLimit;
    acquired.threads = options.threads;
    built = meso::acquireRtt(arguments.patch, acquired, console.progress());
  } else {
    auto patch = makePatch(arguments, size, files, console);
    if (!patch) return patch.error();
    if (arguments.gloss)
      for (scene::Material& material : patch->scene.materials) {
        material.glossy = *arguments.gloss;
        if (arguments.lobe) material.lobeExponent = float(*arguments.lobe);
      }
    if (!arguments.patchPath.empty()) {
      Status saved = written(console.stage(
          "write patch", [&] { return meso::savePatch(*patch, arguments.patchPath); }));
      if (!saved) return saved;
    }
    built = meso::buildRtt(*patch, options, console.progress(), &cost);
  }
  if (!built) return built.error();
  console.report(built->findings);
  const transfer::SimulatedRtt& rtt = built->value;

  const transfer::EncodedRtt encoded =
      console.stage("encode", [&] { return transfer::encode(rtt, arguments.encoding); });
  const double error = transfer::encodingError(rtt.values, encoded.values);
  const Rgb albedo = meso::effectiveAlbedo(rtt);
  Status status =
      written(console.stage("write", [&] { return asset::writeRtt(encoded, arguments.output); }));
  if (!status) return status;
  if (!arguments.previewPath.empty()) {
    status = written(console.stage("preview", [&] {
      const image::Image picture = meso::preview(rtt);
      if (extensionOf(arguments.previewPath) == ".exr")
        return image::write(picture, arguments.previewPath);
      // The lights would show a white square facing them as 1: a little brighter for the eye.
      return image::write(tone::toneMap(picture, 0.8f, tone::Curve::Filmic), arguments.previewPath);
    }));
    if (!status) return status;
  }

  const auto [seconds, times] = inAll(console.stages());
  std::error_code ignored;
  const std::uintmax_t bytes = std::filesystem::file_size(arguments.output, ignored);
  const std::uint64_t rays = cost.viewRays + cost.lightRays;
  return console.finish(
      {{"output", arguments.output.string()},
       {"bytes", bytes},
       {"name", rtt.name},
       {"positions", {rtt.width, rtt.height}},
       {"views", rtt.views},
       {"bands", rtt.bands},
       {"size", {rtt.size.x(), rtt.size.y()}},
       {"depth", rtt.depth},
       {"method", measured ? "measured" : wordOf(options.method, methods())},
       {"bounces", measured ? 0 : options.bounces},
       {"encoding", transfer::nameOf(arguments.encoding)},
       {"encoding_error", error},
       {"effective_albedo", asJson(albedo)},
       {"rays", rays},
       {"seconds", seconds}},
      fmt::format(
          "{}: {}\n"
          "  {}×{} positions, {}×{} views, {} bands; {:.4g} × {:.4g} m, {:.3g} m deep\n"
          "  reflects {:.3f} {:.3f} {:.3f} of even light (R, G, B)\n"
          "  encoding {}: {:.2g} % root mean square error\n"
          "{}{} in all\n{}",
          arguments.output.string(), formatBytes(double(bytes)), rtt.width, rtt.height, rtt.views,
          rtt.views, rtt.bands, double(rtt.size.x()), double(rtt.size.y()), double(rtt.depth),
          albedo[0], albedo[1], albedo[2], transfer::nameOf(arguments.encoding), 100.0 * error,
          rays > 0 ? formatCount(rays) + " rays, " : std::string(), formatSeconds(seconds), times));
}

/// A check that turns what does not parse into wrong usage.
template <class Parse>
std::function<std::string(const std::string&)> parses(Parse parse) {
  return [parse](const std::string& text) -> std::string {
    const auto parsed = parse(std::string_view(text));
    return parsed ? "" : parsed.error().message;
  };
}

}  // namespace

Verb addRtt(CLI::App& root, ConsoleOptions& common) {
  auto arguments = std::make_shared<RttRequest>();
  CLI::App* app = root.add_subcommand(
      "rtt", "Build the radiance transfer texture of a patch of meso-structure");
  app->group("Verbs");
  app->footer(std::string(kRttExamples));
  meso::RttOptions& options = arguments->rtt;
  app->add_option("PATCH", arguments->patch, "A pattern's name, a file, or a folder (see below)")
      ->required();
  app->add_option("-o,--output", arguments->output,
                  "The RTT to write, an .rtt; - : standard output")
      ->option_text("PATCH.rtt")
      ->required();

  const char* kPatch = "Patch";
  app->add_option("--size", arguments->size,
                  "The patch's period in metres. Default: 0.1; a mesh's bounding box")
      ->check(parses(parsePeriod))
      ->option_text("W[xH]")
      ->group(kPatch);
  addNumber(*app, "--depth", arguments->depth, {0.0, 1e6},
            "Of a height field, in metres. Default: PNG 0.15 of the period, EXR as it stands")
      ->option_text("METRES")
      ->group(kPatch);
  app->add_option("--color", arguments->file.color, "Of a height field: a PNG or JPEG over it")
      ->option_text("FILE")
      ->group(kPatch);
  addParsed(*app, "--albedo", arguments->albedo, parseReflectance,
            "Of a height field without --color. Default: 0.7")
      ->option_text("R,G,B")
      ->group(kPatch);
  addNumber(*app, "--blend", arguments->file.blend, {0.0, 0.5},
            "Blend a height field's borders over this fraction of it, so that it tiles")
      ->option_text("FRACTION")
      ->capture_default_str()
      ->group(kPatch);
  addChoice(*app, "--up", arguments->file.up, {{"y", meso::UpAxis::Y}, {"z", meso::UpAxis::Z}},
            "The axis of a mesh file that points away from the patch: y (glTF's up) or z")
      ->option_text("AXIS")
      ->group(kPatch);
  addParsed(*app, "--backing", arguments->backing, parseReflectance,
            "Reflectance of the plane under a mesh that is open below. Default: 0.05")
      ->option_text("R,G,B")
      ->group(kPatch);
  addParsed(*app, "--gloss", arguments->gloss, parseReflectance,
            "Glossy reflectance for all of the patch, besides its diffuse one")
      ->option_text("R,G,B")
      ->group(kPatch);
  addNumber(*app, "--lobe", arguments->lobe, kLobeExponents,
            "With --gloss: the exponent of the lobe")
      ->option_text("EXPONENT")
      ->group(kPatch);
  addNumber(*app, "--white", arguments->white, {1e-6, 1e6},
            "Of a measured BTF: the number that a white diffuse surface facing the light has "
            "in its pictures")
      ->option_text("NUMBER")
      ->capture_default_str()
      ->group(kPatch);

  const char* kRtt = "Radiance transfer texture";
  app->add_option("--positions", arguments->positions, "Samples of the patch along x and y")
      ->check(parses(sizesUpTo(kMostPositions)))
      ->option_text("WxH")
      ->capture_default_str()
      ->group(kRtt);
  addNumber(*app, "--views", options.views, {1, 32},
            "Views a side, over the hemisphere; 1: no dependence on the view")
      ->option_text("N")
      ->capture_default_str()
      ->group(kRtt);
  addNumber(*app, "--bands", options.bands, {1, 10}, "Bands of the light, 1 to 10")
      ->option_text("N")
      ->capture_default_str()
      ->group(kRtt);
  addNumber(*app, "--bounces", options.bounces, {0, 64}, "Bounces of light inside the patch")
      ->option_text("N")
      ->capture_default_str()
      ->group(kRtt);
  addChoice(*app, "--method", options.method, methods(),
            "gather: light is gathered in the basis at every point seen; images: summed over "
            "images under directional lights, as in the paper")
      ->option_text("NAME")
      ->group(kRtt);
  addNumber(*app, "--directions", options.directions, {16, 16384},
            "Directions over the whole sphere, from every point seen. Twice as many: twice "
            "the time, and a smaller error")
      ->option_text("N")
      ->capture_default_str()
      ->group(kRtt);
  app->add_option("--lights", arguments->lights,
                  "Of --method images and measured BTFs: polar × azimuthal directional lights")
      ->check(parses(sizesUpTo(kMostLights)))
      ->option_text("PxA")
      ->capture_default_str()
      ->group(kRtt);
  addNumber(*app, "--supersample", options.supersample, {1, 8}, "Samples of a position, a side")
      ->option_text("N")
      ->capture_default_str()
      ->group(kRtt);
  addNumber(*app, "--seed", options.seed, kSeeds,
            "Turns the directions, and draws other pebbles, stucco or plaster")
      ->option_text("N")
      ->capture_default_str()
      ->group(kRtt);

  addChoice(*app, "--encoding", arguments->encoding,
            {{"snorm8", transfer::Encoding::Snorm8},
             {"float16", transfer::Encoding::Float16},
             {"float32", transfer::Encoding::Float32}},
            "snorm8 (as textures on a GPU), float16, or float32 for exact round trips")
      ->option_text("KIND")
      ->group("Output");
  app->add_option("--preview", arguments->previewPath,
                  "A picture of the patch on a square, from two sides, under three lights")
      ->option_text("FILE.png|FILE.exr")
      ->group("Output");
  app->add_option("--patch", arguments->patchPath, "The patch's geometry, as a mesh")
      ->option_text("FILE.glb")
      ->group("Output");
  arguments->reading.addTo(*app);
  addCommonOptions(*app, common);
  return {app, [arguments](Console& console) { return runRtt(*arguments, console); }};
}

}  // namespace lambent::tool
