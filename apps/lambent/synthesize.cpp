// lambent synthesize SCENE --rtt PATCH.rtt -o ASSET.glb
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "apps/lambent/arguments.h"
#include "apps/lambent/atlas_picture.h"
#include "apps/lambent/describe.h"
#include "apps/lambent/help.h"
#include "apps/lambent/named_files.h"
#include "apps/lambent/refine_arguments.h"
#include "apps/lambent/scene_arguments.h"
#include "apps/lambent/transfer_arguments.h"
#include "apps/lambent/verbs.h"
#include "lambent/asset/asset.h"
#include "lambent/asset/rtt_file.h"
#include "lambent/bi_scale/spread_patch.h"
#include "lambent/file/atomic_file.h"
#include "lambent/file/budget.h"
#include "lambent/file/extension.h"
#include "lambent/meso/effective_albedo.h"
#include "lambent/scene_io/curves.h"
#include "lambent/scene_io/texture.h"
#include "lambent/transfer/encode.h"
#include "lambent/transfer/names.h"

namespace lambent::tool {

namespace {

/// What --direction says.
struct SteeringArgument {
  std::optional<Vec3> direction;
  std::filesystem::path file;  ///< of curves, or a picture
};

/// "0,0,1", or a file: what has an extension that begins with a letter.
Result<SteeringArgument> parseSteering(std::string_view text) {
  const std::string extension = file::extensionOf(text);
  if (extension.size() > 1 && extension[1] >= 'a' && extension[1] <= 'z')
    return SteeringArgument{{}, text};
  const auto direction = parseDirection(text);
  if (!direction) return direction.error();
  return SteeringArgument{*direction, {}};
}

struct SynthesizeRequest {
  SceneArguments scene;
  TransferArguments transfer;
  RefineArguments refine;
  std::vector<std::filesystem::path> rtts;
  std::filesystem::path mask, output, atlasPicture;
  std::vector<float> patchWidths;
  std::vector<std::string> meshes;
  std::optional<Size> tiles;
  bi_scale::SpreadOptions options;
  SteeringArgument steering;
  std::string tint;  ///< kOwnTint or a picture; empty: none
  bool preview = false;
};

constexpr std::string_view kOwnTint = "own";

constexpr std::string_view kSynthesizeExamples = R"(Examples:
  lambent rtt weave -o weave.rtt
  lambent synthesize bunny.obj --rtt weave.rtt -o bunny.glb
      The weave over the whole bunny, with shadows and two bounces at the macro-scale. It repeats
      itself, and so it is laid as a lattice: every thread goes on.
  lambent synthesize bunny.obj --rtt weave.rtt -o look.glb --preview
      How it lies, within seconds and without shadows, before the whole is made.
  lambent synthesize bunny.obj --rtt stucco.rtt -o rough.glb --patch-width 0.3 --transfer shadowed
      A patch as wide as 0.3 units of the model.
  lambent synthesize bird.glb --rtt scales.rtt -o bird.glb --direction 0,0,1 --atlas-picture a.png
      The patch's +x follows +z; a picture of the charts and of where the patch stands.
  lambent synthesize sleeve.glb --rtt knit.rtt -o knitted.glb --direction strokes.csv
      The knit follows strokes over the sleeve, lines of curve,x,y,z, not its creases and borders.
  lambent synthesize vase.glb --rtt flower.rtt -o vase2.glb --map uv --tiles 8x4
      No synthesis: the vase's own UVs repeat the patch.
  lambent synthesize jumper.glb --rtt knit.rtt -o jumper2.glb --tint own
      The jumper's own texture and vertex colours dye the wool.
  lambent synthesize path.glb --rtt sand.rtt --rtt pebbles.rtt --mask mask.png -o path2.glb
      Sand, and pebbles over it where the picture is red, or white; on its greys they fade.
  lambent render bunny.glb --light sky.exr -o a.png --macro off
      What the macro-scale brings: without it the bunny glows.
)";

Result<std::vector<std::uint32_t>> chosenMeshes(const SynthesizeRequest& arguments,
                                                const scene::Scene& scene) {
  std::vector<std::uint32_t> chosen;
  for (std::uint32_t m = 0; m < scene.meshes.size(); ++m) {
    const bool isGround = arguments.scene.ground && m + 1 == scene.meshes.size();
    const bool mirror = scene.materials[std::size_t(scene.meshes[m].material)].isMirror();
    if (arguments.meshes.empty() && !mirror && !isGround) chosen.push_back(m);
  }
  for (const std::string& wanted : arguments.meshes) {
    const std::size_t before = chosen.size();
    for (std::uint32_t m = 0; m < scene.meshes.size(); ++m)
      if (scene.meshes[m].name == wanted || std::to_string(m) == wanted) chosen.push_back(m);
    if (chosen.size() == before) return noSuch("--mesh", wanted, "mesh", meshNames(scene));
  }
  if (chosen.empty())
    return badInput(arguments.scene.path.string() +
                    ": every mesh is a mirror: there is nothing to spread the patch over");
  return chosen;
}

/// What the patch repeats, in words.
std::string repeats(const synthesis::PatchSymmetry& symmetry) {
  if (!symmetry.regular()) return "the patch does not repeat itself within its period";
  std::string text =
      symmetry.cells() > 1
          ? fmt::format("the patch repeats itself {} times within its period", symmetry.cells())
          : std::string("the patch nearly repeats itself within its period");
  if (symmetry.turns > 1)
    text += fmt::format(" and bears {} turns", symmetry.turns == 4 ? "quarter" : "half");
  return text;
}

/// How it lies, beyond its smoothness.
std::string aligned(const bi_scale::SpreadReport& r) {
  std::string text;
  if (r.guided > 0.0)
    text += fmt::format("    steered at {:.3g}% of the vertices\n", 100.0 * r.guided);
  if (r.featureLines > 0)
    text += fmt::format("    along or across {} of {} creases and borders\n", r.alignedLines,
                        r.featureLines);
  return text;
}

std::string reportText(const bi_scale::SpreadReport& r) {
  const bool alone = !r.layer && r.share == 1.0;
  std::string text = fmt::format("  {}: {:.1f} patches{}, each {:.4g} wide, at {} vertices\n",
                                 r.name.empty() ? "mesh " + std::to_string(r.mesh) : r.name,
                                 r.patches, alone || r.layer ? "" : fmt::format(" of {}", r.patch),
                                 double(r.patchWidth), formatCount(r.vertices));
  if (!alone) text += fmt::format("    seen on {:.3g}% of the surface\n", 100.0 * r.share);
  const auto atlas = [&] {
    text += fmt::format(
        "    atlas: {} charts{}, stretch {:.3f} (worst chart {:.3f}), {:.0f}% of "
        "the map in use\n",
        r.charts, r.ownUvs ? " (the mesh's own UVs)" : "", r.stretch, r.worstStretch,
        100.0 * r.usedArea);
  };
  if (r.layout == bi_scale::Layout::Lattice) {
    text += fmt::format(
        "    laid as a lattice; {}\n"
        "    {} singularities; it goes on over {:.6g}% of the edges, {:.1f}% off its size (rms), "
        "by more than a half over {:.1f}% of the surface\n",
        repeats(r.symmetry), r.singularities, 100.0 * r.continued, 100.0 * r.sizeError,
        100.0 * r.squeezed);
    text += aligned(r);
    atlas();
  } else if (r.mesoVertices > 0) {
    text += fmt::format("    laid in pieces; {}\n", repeats(r.symmetry));
    text += fmt::format(
        "    {} meso-vertices, {} singularities of the tangent field, randomness {:.2f}\n",
        formatCount(r.mesoVertices), r.singularities, r.randomness);
    text += aligned(r);
    atlas();
  }
  if (r.matrixError > 0.0)
    text += fmt::format("    encoding the matrices costs {:.2g}% (relative RMS)\n",
                        100.0 * r.matrixError);
  return text;
}

Json asJson(const bi_scale::SpreadReport& r) {
  return {{"mesh", r.mesh},
          {"name", r.name},
          {"patch", r.patch},
          {"layer", r.layer},
          {"share", r.share},
          {"area", r.area},
          {"patches", r.patches},
          {"patch_width", r.patchWidth},
          {"vertices", r.vertices},
          {"meso_vertices", r.mesoVertices},
          {"singularities", r.singularities},
          {"feature_lines", r.featureLines},
          {"aligned_lines", r.alignedLines},
          {"guided", r.guided},
          {"randomness", r.randomness},
          {"layout", r.layout == bi_scale::Layout::Lattice ? "lattice" : "pieces"},
          {"patch_symmetry",
           {{"cells", r.symmetry.cells()},
            {"turns", r.symmetry.turns},
            {"moved", r.symmetry.moved},
            {"half_turned", r.symmetry.halfTurned},
            {"quarter_turned", r.symmetry.quarterTurned}}},
          {"continued", r.continued},
          {"flipped", r.flipped},
          {"squeezed", r.squeezed},
          {"size_error", r.sizeError},
          {"charts", r.charts},
          {"stretch", r.stretch},
          {"worst_stretch", r.worstStretch},
          {"used_area", r.usedArea},
          {"own_uvs", r.ownUvs},
          {"matrix_error", r.matrixError}};
}

/// What shows how the patch lies, within seconds: as large as it will be, on fewer places.
void hasten(SynthesizeRequest& arguments, const scene::Scene& scene,
            const transfer::EncodedRtt& rtt) {
  constexpr std::uint32_t kVertices = 100'000;
  constexpr int kTexels = 1024;
  bi_scale::SpreadOptions& options = arguments.options;
  double area = 0.0;
  for (const std::uint32_t m : options.meshes) area += bi_scale::areaOf(scene.meshes[m]);
  const auto widthOf = [&](const transfer::EncodedRtt& patch, float asked) {
    return asked > 0.0f ? asked : bi_scale::automaticPatchWidth(area, patch, options.mesoVertices);
  };
  for (bi_scale::PatchOver& over : options.over)
    over.patchWidth = widthOf(over.rtt, over.patchWidth.value_or(options.patchWidth));
  options.patchWidth = widthOf(rtt, options.patchWidth);
  if (options.mesoVertices == 0) options.mesoVertices = kVertices;
  options.mesoVertices = std::min(options.mesoVertices, kVertices);
  options.atlas.size = std::min(options.atlas.size, kTexels);
  arguments.transfer.options.kind = transfer::Kind::Unshadowed;
}

/// How many materials were there in parts alone.
std::size_t makeWhole(scene::Scene& scene) {
  std::size_t count = 0;
  for (scene::Material& material : scene.materials) {
    count +=
        material.alphaMode != scene::AlphaMode::Opaque || material.transmitted.maxCoeff() > 0.0f;
    material.alphaMode = scene::AlphaMode::Opaque;
    material.diffuse += material.transmitted;
    material.transmitted = Rgb::Zero();
  }
  for (scene::Mesh& mesh : scene.meshes) mesh.alphas.clear();
  return count;
}

/// The file of a --tint that is one.
std::filesystem::path tintFile(const SynthesizeRequest& arguments) {
  return arguments.tint == kOwnTint ? std::string() : arguments.tint;
}

Result<scene::Texture> readPicture(const SynthesizeRequest& arguments,
                                   const std::filesystem::path& path) {
  const auto bytes = file::readWhole(path);
  if (!bytes) return bytes.error();
  file::Budget budget(arguments.scene.reading.memoryLimit);
  budget.addFile(bytes->size());
  auto picture = scene_io::decodeTexture(*bytes, path.string(), budget);
  if (picture) picture->name = path.stem().string();
  return picture;
}

/// What steers the patch, in the coordinates of the scene.
Status steer(const SynthesizeRequest& arguments, const scene::Scene& scene,
             bi_scale::SpreadOptions& options) {
  const auto& [direction, file] = arguments.steering;
  if (!direction && file.empty()) return Status::ok();
  if (options.placement == bi_scale::Placement::OwnUvs)
    return badUsage(
        "--direction steers the synthesis: with --map uv the mesh's UVs say how the "
        "patch lies");
  if (direction) {
    options.steering = *direction;
    return Status::ok();
  }
  const std::string extension = file::extensionOf(file);
  if (extension != ".csv" && extension != ".obj") {
    auto picture = readPicture(arguments, file);
    if (!picture) return picture.error();
    options.steering = bi_scale::PictureSteering{std::move(*picture)};
    return Status::ok();
  }
  const auto curves = scene_io::readCurves(file);
  if (!curves) return curves.error();
  bi_scale::CurveSteering steering;
  for (const scene_io::Polyline& curve : *curves) {
    bi_scale::Curve& to = steering.curves.emplace_back();
    for (const Vec3d& point : curve) to.push_back((point - scene.origin).cast<float>());
  }
  options.steering = std::move(steering);
  return Status::ok();
}

/// The picture of a --tint becomes one of the scene's.
Result<bi_scale::Tint> tintOf(const SynthesizeRequest& arguments, scene::Scene& scene) {
  if (arguments.tint.empty()) return bi_scale::Tint(bi_scale::NoTint{});
  if (arguments.tint == kOwnTint) return bi_scale::Tint(bi_scale::OwnTint{});
  auto picture = readPicture(arguments, arguments.tint);
  if (!picture) return picture.error();
  scene.textures.push_back(std::move(*picture));
  return bi_scale::Tint(bi_scale::PictureTint{int(scene.textures.size()) - 1});
}

/// Cuts triangles between whose vertices light would be missed, before a patch is laid over them:
/// vertices are the receivers of what carries one.
Result<Looked> refineReceivers(const RefineArguments& arguments, scene::Scene& scene,
                               Console& console) {
  constexpr trace::Edges kEdges = trace::Edges::Watertight;
  auto rays = console.stage("ray structure", [&] { return trace::RayScene::build(scene, kEdges); });
  if (!rays) return rays.error();
  const transport::Placement vertices;
  auto receivers = transport::placeReceivers(scene, vertices, rays->offset());
  if (!receivers) return receivers.error();
  return lookBetweenReceivers(arguments, {scene, *rays, kEdges, *receivers, vertices, ""}, console);
}

/// The patches, which are one more than the channels of the mask that show them.
Status checkPatches(const SynthesizeRequest& arguments) {
  const std::size_t count = arguments.rtts.size();
  if (count > 4)
    return badUsage(
        fmt::format("--rtt {} times: a mask has red, green and blue, for three patches "
                    "over the first",
                    count));
  if (count > 1 && arguments.mask.empty())
    return badUsage("several --rtt: --mask says where each is to be seen");
  if (count == 1 && !arguments.mask.empty())
    return badUsage("--mask shows a second patch over the first: give it as one more --rtt");
  if (arguments.patchWidths.size() > count)
    return badUsage(
        fmt::format("--patch-width {} times, for {} --rtt", arguments.patchWidths.size(), count));
  return Status::ok();
}

bool isGrey(const scene::Texture& picture) {
  const std::vector<std::uint8_t>& rgba = picture.rgba;
  for (std::size_t i = 0; i + 3 < rgba.size(); i += 4)
    if (rgba[i] != rgba[i + 1] || rgba[i] != rgba[i + 2]) return false;
  return true;
}

/// What lies over the first patch, and the mask.
Status readPatchesOver(SynthesizeRequest& arguments, Console& console) {
  bi_scale::SpreadOptions& options = arguments.options;
  const std::vector<float>& widths = arguments.patchWidths;
  if (!widths.empty()) options.patchWidth = widths[0];
  for (std::size_t k = 1; k < arguments.rtts.size(); ++k) {
    auto rtt = console.stage("read RTT", [&] {
      return asset::readRtt(arguments.rtts[k], arguments.scene.reading.forAsset());
    });
    if (!rtt) return rtt.error();
    bi_scale::PatchOver& over = options.over.emplace_back();
    over.albedo = meso::effectiveAlbedo(transfer::decode(*rtt));
    over.rtt = std::move(*rtt);
    if (k < widths.size()) over.patchWidth = widths[k];
  }
  if (arguments.mask.empty()) return Status::ok();
  auto mask = readPicture(arguments, arguments.mask);
  if (!mask) return mask.error();
  options.mask = std::move(*mask);
  if (options.over.size() > 1 && isGrey(options.mask))
    console.warn("mask-grey",
                 "--mask is grey: its green is its red, and the third patch hides the second");
  return Status::ok();
}

Status run(SynthesizeRequest arguments, Console& console) {
  if (Status s = console.takeInput(arguments.scene.path, "SCENE"); !s) return s;
  if (Status s = console.takeOutput(arguments.output, "-o", ".glb"); !s) return s;
  NamedFiles files;
  files.writes("--output", arguments.output, {".glb"});
  files.writes("--atlas-picture", arguments.atlasPicture, {".png"});
  files.reads("SCENE", arguments.scene.path);
  for (const std::filesystem::path& rtt : arguments.rtts) files.reads("--rtt", rtt);
  files.reads("--mask", arguments.mask);
  files.reads("--tint", tintFile(arguments));
  files.reads("--direction", arguments.steering.file);
  if (Status distinct = files.check(); !distinct) return distinct;
  if (Status sane = arguments.transfer.check(); !sane) return sane;
  if (Status sane = checkPatches(arguments); !sane) return sane;
  auto rtt = console.stage("read RTT", [&] {
    return asset::readRtt(arguments.rtts[0], arguments.scene.reading.forAsset());
  });
  if (!rtt) return rtt.error();
  if (Status over = readPatchesOver(arguments, console); !over) return over;
  arguments.scene.sides = scene_io::Sides::One;  // a patch has no other side
  auto scene = arguments.scene.loadToBake(console, files);
  if (!scene) return scene.error();
  if (const std::size_t gaps = makeWhole(*scene); gaps > 0) {
    const Finding lost{Severity::Warning, "alpha-ignored",
                       fmt::format("{} materials are (partly) transparent and are taken as opaque: "
                                   "what carries meso-structure has no holes",
                                   gaps),
                       gaps, true};
    if (Status whole = console.accept({lost}); !whole) return whole;
  }

  bi_scale::SpreadOptions& options = arguments.options;
  auto meshes = chosenMeshes(arguments, *scene);
  if (!meshes) return meshes.error();
  options.meshes = *meshes;
  if (arguments.tiles) {
    if (options.placement != bi_scale::Placement::OwnUvs)
      return badUsage("--tiles says how often UVs repeat the patch: it goes with --map uv");
    options.tiles = Vec2(float(arguments.tiles->width), float(arguments.tiles->height));
  }
  if (Status status = steer(arguments, *scene, options); !status) return status;
  auto tint = tintOf(arguments, *scene);
  if (!tint) return tint.error();
  options.tint = *tint;
  if (arguments.preview) hasten(arguments, *scene, *rtt);
  options.transfer = arguments.transfer.chosen(console);
  options.transfer.bands = rtt->bands;
  options.seed = options.transfer.seed;
  options.albedo = meso::effectiveAlbedo(transfer::decode(*rtt));

  Looked looked;
  console.report(bi_scale::prepare(*scene, *rtt, options));
  if (!arguments.preview) {
    auto refined = refineReceivers(arguments.refine, *scene, console);
    if (!refined) return refined.error();
    looked = *refined;
  }
  auto made = bi_scale::spreadPatch(std::move(*scene), *rtt, options, console.progress());
  if (!made && made.error().kind == ErrorKind::BadInput)
    return badInput(arguments.scene.path.string() + ": " + made.error().message);
  if (!made) return made.error();
  console.report(made->findings);
  const bi_scale::Spread& spread = made->value;

  Status status =
      written(console.stage("write", [&] { return asset::write(spread.asset, arguments.output); }));
  if (!status) return status;
  if (!arguments.atlasPicture.empty()) {
    if (spread.atlases.empty())
      console.warn("no-atlas", "--atlas-picture: with --map uv there is no atlas to show");
    else
      status = written(console.stage("atlas picture", [&] {
        return writeAtlasPicture(spread.atlases.front(), spread.asset, spread.reports.front().mesh,
                                 arguments.atlasPicture);
      }));
    if (!status) return status;
  }

  const auto [seconds, times] = inAll(console.stages());
  std::error_code ignored;
  const std::uintmax_t bytes = std::filesystem::file_size(arguments.output, ignored);
  std::string reports;
  Json reportsJson = Json::array();
  for (const bi_scale::SpreadReport& report : spread.reports) {
    reports += reportText(report);
    reportsJson.push_back(asJson(report));
  }
  const Description transfer = describe(spread.asset);
  return console.finish({{"output", arguments.output.string()},
                         {"bytes", bytes},
                         {"seconds", seconds},
                         {"surfaces", reportsJson},
                         {"between_receivers", asJson(looked, spread.asset.scene)},
                         {"transfer", transfer.json}},
                        fmt::format("{}: {}\n{}{}{} in all\n{}", arguments.output.string(),
                                    formatBytes(double(bytes)), reports, transfer.text,
                                    formatSeconds(seconds), times));
}

}  // namespace

Verb addSynthesize(CLI::App& root, ConsoleOptions& common) {
  auto arguments = std::make_shared<SynthesizeRequest>();
  bi_scale::SpreadOptions& options = arguments->options;
  CLI::App* app = root.add_subcommand(
      "synthesize", "Spread a patch of meso-structure over a surface, and write a bi-scale asset");
  app->group("Verbs");
  app->footer(std::string(kSynthesizeExamples));
  arguments->scene.addTo(*app);
  app->add_option("--rtt", arguments->rtts,
                  "The patch: what 'lambent rtt' wrote. Up to three more lie over it, where --mask "
                  "shows them")
      ->option_text("PATCH.rtt")
      ->allow_extra_args(false)
      ->required();
  app->add_option("--mask", arguments->mask,
                  "A picture over the mesh's own UVs: the second --rtt is seen where its red is 1, "
                  "the third where its green is, the fourth where its blue is; between 0 and 1 "
                  "what lies below shows through. Of a grey picture red is its grey")
      ->option_text("FILE.png|FILE.jpg");
  app->add_option("-o,--output", arguments->output,
                  "The asset to write, a .glb; - : standard output")
      ->option_text("ASSET.glb")
      ->required();
  addNumbers(*app, "--patch-width", arguments->patchWidths, {0.0, 1e6},
             "How much of the surface the patch's width covers, in the model's units; 0: about 200 "
             "patches over the whole surface, or as many as --vertices can show. Several times: of "
             "each --rtt; of those without their own it is the first")
      ->option_text("LENGTH")
      ->default_str("0")
      ->group("Placement");
  addChoice(
      *app, "--map", options.placement,
      {{"synthesized", bi_scale::Placement::Synthesized}, {"uv", bi_scale::Placement::OwnUvs}},
      "synthesized: texture synthesis over the surface; uv: the mesh's own UVs repeat "
      "the patch")
      ->option_text("KIND")
      ->group("Placement");
  addChoice(*app, "--layout", options.layout,
            {{"auto", bi_scale::Layout::Automatic},
             {"lattice", bi_scale::Layout::Lattice},
             {"pieces", bi_scale::Layout::Pieces}},
            "lattice: whole cells of the patch, without a seam, for what repeats itself; pieces: "
            "grown of parts that fit, for what never does; auto: as the patch is")
      ->option_text("KIND")
      ->group("Placement");
  addParsed(*app, "--tiles", arguments->tiles, sizesUpTo(32768),
            "With --map uv: how often the patch repeats along u and v, as in 8x4")
      ->option_text("UxV")
      ->group("Placement");
  addParsed(*app, "--direction", arguments->steering, parseSteering,
            "What the patch's +x follows where the surface lets it: a direction in the world; "
            "curves, lines of curve,x,y,z or l elements of OBJ; or a picture over the mesh's UVs, "
            "red to the right and green up, grey for no opinion. Without it the field is as "
            "smooth as can be")
      ->option_text("X,Y,Z|FILE.csv|FILE.obj|FILE.png")
      ->group("Placement");
  app->add_flag(
         "!--no-align", options.align,
         "Do not lay the patch along sharp creases and borders, or across them, as it is where "
         "no direction in the world steers it")
      ->group("Placement");
  addNumber(*app, "--randomness", options.randomness, {0.0, 1.0},
            "Of pieces: 0 repeats the patch wherever the surface lets it, 1 scatters it about. "
            "Without it: what the patch bears")
      ->option_text("0..1")
      ->group("Placement");
  app->add_option("--tint", arguments->tint,
                  "What varies the patch's colours: own, the mesh's texture and colours; or a "
                  "picture, sRGB, over the mesh's own UVs. Without it: nothing does")
      ->option_text("own|FILE.png|FILE.jpg")
      ->group("Placement");
  app->add_option("--mesh", arguments->meshes,
                  "Name or number of a mesh that gets the patch; may be given several times. "
                  "Without it: all but mirrors and the --ground")
      ->option_text("NAME")
      ->group("Placement");
  addNumber(*app, "--vertices", options.mesoVertices, {0, 16000000},
            "Of pieces: vertices of the mesh that synthesis runs on; 0: one for each position of "
            "the patch, to 960,000")
      ->option_text("N")
      ->capture_default_str()
      ->group("Placement");
  addNumber(*app, "--map-size", options.atlas.size, {64, 16384}, "Texels a side of the id map")
      ->option_text("N")
      ->capture_default_str()
      ->group("Atlas");
  addNumber(*app, "--gutter", options.atlas.gutter, {1, 64}, "Texels at least between charts")
      ->option_text("N")
      ->capture_default_str()
      ->group("Atlas");
  addNumber(*app, "--stretch", options.atlas.maximumStretch, {1.01, 100.0},
            "L2 stretch above which a chart is cut in two; 1 is none")
      ->option_text("FACTOR")
      ->capture_default_str()
      ->group("Atlas");
  app->add_flag("!--new-uvs", options.atlas.ownUvs,
                "Lay the surface out anew even where its own UVs would do")
      ->group("Atlas");
  app->add_option("--atlas-picture", arguments->atlasPicture,
                  "Also draw the first mesh's charts and its id map")
      ->option_text("OUT.png")
      ->group("Atlas");
  arguments->transfer.addTo(*app);
  arguments->refine.addTo(*app);
  app->add_flag("--preview", arguments->preview,
                "Within seconds, to look at how the patch lies: without shadows, on an id map of "
                "1024 texels a side and, in pieces, of 100,000 vertices at most")
      ->group("Placement")
      ->excludes(app->get_option("--transfer"), app->get_option("--keep-shadowed"));
  addChoice(*app, "--encoding", options.matrixEncoding,
            {{"snorm8", transfer::Encoding::Snorm8},
             {"float16", transfer::Encoding::Float16},
             {"float32", transfer::Encoding::Float32}},
            "Of the matrices: snorm8 (a byte, and a scale for each matrix), float16, float32")
      ->option_text("KIND")
      ->group("Output");
  addCommonOptions(*app, common);
  return {app, [arguments](Console& console) { return run(*arguments, console); }};
}

}  // namespace lambent::tool
