// lambent shade ASSET --light SOURCE -o OUT.ply|OUT.csv
#include "lambent/shade/shade.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "apps/lambent/arguments.h"
#include "apps/lambent/describe.h"
#include "apps/lambent/help.h"
#include "apps/lambent/light_arguments.h"
#include "apps/lambent/named_files.h"
#include "apps/lambent/output_argument.h"
#include "apps/lambent/receiver_file.h"
#include "apps/lambent/showing_arguments.h"
#include "apps/lambent/verbs.h"
#include "lambent/asset/asset.h"
#include "lambent/sources/source.h"

namespace lambent::tool {

namespace {

struct ShadeRequest {
  std::filesystem::path asset;
  OutputArgument output{.extensions = {".csv", ".ply"}};
  LightArguments light;
  std::optional<Vec3> eye;
  ShowingArguments showing;
  ReadingArguments reading;
};

constexpr std::string_view kShadeExamples = R"(
Examples:
  lambent shade bunny.glb --light sky.exr -o bunny.csv
      Exit radiance of every vertex, one row each, for a spreadsheet or a script.
  lambent shade teapot.glb --light sky.exr -o teapot.ply --eye 0,1,4 --lobe 32
      Seen from a point, which matters to glossy surfaces.
  lambent shade bird.glb --light sky.exr -o bird.csv --macro off
      A surface with meso-structure as if its shape hid no light.
)";

Status runShade(ShadeRequest arguments, Console& console) {
  if (Status s = console.takeInput(arguments.asset, "ASSET"); !s) return s;
  if (Status s = console.takeInput(arguments.light.source, "--light"); !s) return s;
  if (Status s = arguments.output.take(console); !s) return s;
  const std::filesystem::path& output = arguments.output.path;
  NamedFiles files;
  files.writes("--output", output, arguments.output.extensions);
  files.readsAsset("ASSET", arguments.asset);
  files.readsLight("--light", arguments.light.source);
  if (Status distinct = files.check(); !distinct) return distinct;
  const auto asset = console.stage(
      "load", [&] { return asset::read(arguments.asset, arguments.reading.forAsset()); });
  if (!asset) return asset.error();
  const auto environment = arguments.light.environment(arguments.reading, console);
  if (!environment) return environment.error();
  const auto light = arguments.light.coefficients(*environment, asset->transfer.bands, console);
  if (!light) return light.error();

  shade::ReceiverView view{arguments.eye, arguments.showing.showing()};
  view.showing.softLobes = arguments.light.softensLobes();
  if (Status s = checkHeld(*asset, view.showing, arguments.asset); !s) return s;
  const ReceiverFile file = console.stage("shade", [&] {
    ReceiverFile all;
    for (std::uint32_t m = 0; m < asset->transfer.meshes.size(); ++m) {
      const transfer::Receivers* receivers = transfer::receiversOf(asset->transfer.meshes[m]);
      if (!receivers) continue;
      const transfer::AtTexels* grid = receivers->texels();
      const std::vector<Rgb> radiance = shade::exitRadiance(*asset, m, *light, view);
      for (std::size_t i = 0; i < radiance.size(); ++i)
        if (!grid || grid->covered[i])
          all.receivers.push_back({receivers->positions[i], receivers->normals[i], radiance[i]});
    }
    return all;
  });
  Status status = written(console.stage("write", [&] { return writeReceivers(file, output); }));
  if (!status) return status;

  const std::vector<ShadedReceiver>& receivers = file.receivers;
  Eigen::Array3d sum = Eigen::Array3d::Zero();
  for (const ShadedReceiver& receiver : receivers) sum += receiver.radiance.cast<double>();
  const Rgb mean =
      receivers.empty() ? Rgb(Rgb::Zero()) : Rgb((sum / double(receivers.size())).cast<float>());
  return console.finish(
      {{"output", output.string()},
       {"receivers", receivers.size()},
       {"mean_radiance", asJson(mean)}},
      fmt::format("{}: {} receivers, mean exit radiance {:.5g} {:.5g} {:.5g}\n", output.string(),
                  formatCount(receivers.size()), mean[0], mean[1], mean[2]));
}

}  // namespace

Verb addShade(CLI::App& root, ConsoleOptions& common) {
  auto arguments = std::make_shared<ShadeRequest>();
  CLI::App* app = root.add_subcommand(
      "shade", "Relight an asset and write the exit radiance of every receiver as numbers");
  app->group("Verbs");
  app->footer(sources::sourceHelp() + std::string(kShadeExamples));
  app->add_option("ASSET", arguments->asset,
                  "A .glb that 'lambent bake' or 'lambent synthesize' wrote; - : standard input")
      ->required();
  arguments->light.addTo(*app, false);
  arguments->output
      .addTo(*app, "OUT.ply|OUT.csv",
             "Columns x,y,z,nx,ny,nz,r,g,b in world space, .ply (binary) or .csv")
      ->required();
  addParsed(*app, "--eye", arguments->eye, parsePoint,
            "Where the viewer stands. Without it every receiver is seen along its normal")
      ->option_text("X,Y,Z")
      ->group("View");
  arguments->showing.addLobeTo(*app, "View");
  arguments->showing.addTo(*app);
  arguments->light.addWindowOfAssetsTo(*app);
  arguments->reading.addTo(*app);
  addCommonOptions(*app, common);
  return {app, [arguments](Console& console) { return runShade(*arguments, console); }};
}

}  // namespace lambent::tool
