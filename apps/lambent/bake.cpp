// lambent bake SCENE -o ASSET.glb
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "apps/lambent/arguments.h"
#include "apps/lambent/describe.h"
#include "apps/lambent/help.h"
#include "apps/lambent/named_files.h"
#include "apps/lambent/refine_arguments.h"
#include "apps/lambent/scene_arguments.h"
#include "apps/lambent/texel_arguments.h"
#include "apps/lambent/transfer_arguments.h"
#include "apps/lambent/verbs.h"
#include "lambent/asset/asset.h"
#include "lambent/trace/ray_scene.h"
#include "lambent/transfer/encode.h"
#include "lambent/transfer/names.h"
#include "lambent/transport/receivers.h"

namespace lambent::tool {

namespace {

struct BakeRequest {
  SceneArguments scene;
  std::filesystem::path output;
  TransferArguments transfer;
  RefineArguments refine;
  transfer::Encoding encoding = transfer::Encoding::Float16;
  TexelArguments texels;
};

constexpr std::string_view kBakeExamples = R"(Examples:
  lambent bake bunny.obj -o bunny.glb
      Soft shadows and two bounces at every vertex, for light of 5 bands.
  lambent bake bunny.obj -o draft.glb --directions 1024 --transfer shadowed
      A quick look.
  lambent bake teapot.glb -o teapot.glb --material glossy --lobe 64 --bands 7
      As if everything were polished: a transfer matrix at every vertex.
  lambent bake ring.obj -o ring.glb --keep-shadowed
      One asset that can be shown with shadows alone, and with bounces.
  lambent bake house.glb -o house.glb --refine 0.01
      Triangles are cut where shadows fall between their corners, finer than by itself.
  lambent bake bunny.obj -o standing.glb --ground --albedo 0.7,0.6,0.5
      On a floor that takes its shadow.
  lambent bake ring.gltf -o ring.glb --texels ground=256x256
      The mesh "ground" is baked on a grid over its UVs: caustics finer than its vertices.
  lambent bake house.glb -o house.glb --texels auto
      All meshes are laid out anew, whatever UVs they have, with texels where shadows fall.
)";

Status runBake(BakeRequest arguments, Console& console) {
  if (Status s = console.takeInput(arguments.scene.path, "SCENE"); !s) return s;
  if (Status s = console.takeOutput(arguments.output, "-o", ".glb"); !s) return s;
  NamedFiles files;
  files.writes("--output", arguments.output, {".glb"});
  files.reads("SCENE", arguments.scene.path);
  if (Status distinct = files.check(); !distinct) return distinct;
  if (Status sane = arguments.transfer.check(); !sane) return sane;
  arguments.scene.layout = arguments.texels.wantsUvs();
  auto scene = arguments.scene.loadToBake(console, files);
  if (!scene) return scene.error();

  const macro::BakeOptions options = arguments.transfer.chosen(console);
  auto chosen = arguments.texels.resolve(*scene);
  if (!chosen) return chosen.error();

  // Without bounces there is no room for a slipped ray's light to gather in.
  const trace::Edges edges = options.kind == transfer::Kind::Interreflected
                                 ? trace::Edges::Watertight
                                 : trace::Edges::Fast;
  auto rays = console.stage("ray structure", [&] { return trace::RayScene::build(*scene, edges); });
  if (!rays) return rays.error();
  const auto laid =
      layOutTexels(arguments.texels, arguments.refine, *chosen, *scene, *rays, edges, console);
  if (!laid) return laid.error();
  const transport::Placement placement{std::move(chosen->grids), {}};
  auto receivers = transport::placeReceivers(*scene, placement, rays->offset());
  if (!receivers && receivers.error().kind == ErrorKind::BadInput)
    return badInput(arguments.scene.path.string() + ": " + receivers.error().message);
  if (!receivers) return receivers.error();
  const auto looked = lookBetweenReceivers(arguments.refine,
                                           {*scene, *rays, edges, *receivers, placement,
                                            ", --texels bakes a mesh on a grid over its UVs, "
                                            "--texels auto over a layout made for it"},
                                           console);
  if (!looked) return looked.error();
  auto field = macro::bake(*scene, *rays, *receivers, options, console.progress());
  if (!field) return field.error();
  *receivers = {};
  console.report(field->findings);

  asset::Asset asset;
  asset.transfer =
      console.stage("encode", [&] { return transfer::encode(field->value, arguments.encoding); });
  field->value = {};  // as large as the asset again
  asset.scene = std::move(*scene);
  Status status =
      written(console.stage("write", [&] { return asset::write(asset, arguments.output); }));
  if (!status) return status;

  std::uint64_t rayCount = 0;
  double raySeconds = 0.0, seconds = 0.0;
  std::string times;
  for (const StageTime& stage : console.stages()) {
    seconds += stage.seconds;
    times += fmt::format("  {:<28} {:>8}", stage.name, formatSeconds(stage.seconds));
    if (stage.unit == "rays" && stage.units > 0 && stage.seconds > 0.0) {
      rayCount += stage.units;
      raySeconds += stage.seconds;
      times += fmt::format("  {}", formatRate(double(stage.units) / stage.seconds, "rays"));
    }
    times += '\n';
  }
  std::error_code ignored;
  const std::uintmax_t bytes = std::filesystem::file_size(arguments.output, ignored);
  std::size_t stored = 0;
  for (const transfer::EncodedMesh& mesh : asset.transfer.meshes)
    if (const transfer::Receivers* held = transfer::receiversOf(mesh)) stored += held->size();
  Description transfer = describe(asset);
  const Json between = asJson(*looked, asset.scene);
  const double rate = raySeconds > 0.0 ? double(rayCount) / raySeconds : 0.0;
  return console.finish(
      {{"output", arguments.output.string()},
       {"bytes", bytes},
       {"receivers", stored},
       {"rays", rayCount},
       {"rays_per_second", rate},
       {"seconds", seconds},
       {"between_receivers", between},
       {"texel_layout", asJson(*laid, asset.scene)},
       {"transfer", transfer.json}},
      fmt::format("{}: {}\n{}{}{} receivers, {} rays at {}, {} in all\n{}",
                  arguments.output.string(), formatBytes(double(bytes)), transfer.text,
                  inWords(*laid), formatCount(stored), formatCount(rayCount),
                  formatRate(rate, "rays"), formatSeconds(seconds), times));
}

}  // namespace

Verb addBake(CLI::App& root, ConsoleOptions& common) {
  auto arguments = std::make_shared<BakeRequest>();
  CLI::App* app = root.add_subcommand(
      "bake", "Simulate once how light moves over a scene, and write an asset to relight");
  app->group("Verbs");
  app->footer(std::string(kBakeExamples));
  macro::BakeOptions& options = arguments->transfer.options;
  arguments->scene.addTo(*app);
  arguments->scene.addSidesTo(*app);
  app->add_option("-o,--output", arguments->output,
                  "The asset to write, a .glb; - : standard output")
      ->option_text("ASSET.glb")
      ->required();
  arguments->transfer.addTo(*app);
  addNumber(*app, "--bands", options.bands, {1, 10},
            "Bands of the light that will relight it, 1 to 10: 3 for overcast skies, 5 for "
            "soft shadows, more for smaller lights")
      ->option_text("N")
      ->capture_default_str()
      ->group("Transfer");
  addNumber(*app, "--glossy-bands", options.glossyBands, {0, 10},
            "Rows of glossy matrices in bands, 1 to 10; 0: as --bands")
      ->option_text("N")
      ->capture_default_str()
      ->group("Transfer");
  arguments->refine.addTo(*app);
  arguments->texels.addTo(*app);
  addChoice(*app, "--encoding", arguments->encoding,
            {{"float16", transfer::Encoding::Float16}, {"float32", transfer::Encoding::Float32}},
            "float16, or float32 for exact round trips")
      ->option_text("KIND")
      ->group("Output");
  addCommonOptions(*app, common);
  return {app, [arguments](Console& console) { return runBake(*arguments, console); }};
}

}  // namespace lambent::tool
