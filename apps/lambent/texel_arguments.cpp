#include "apps/lambent/texel_arguments.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <string_view>
#include <utility>

#include "apps/lambent/arguments.h"
#include "lambent/scene/sheets.h"

namespace lambent::tool {

namespace {

constexpr int kMostTexels = 16384;  // a side

/// "ground=256x256" or "ground=auto" names a mesh by name or number; without a name every mesh is
/// meant.
struct AskedTexels {
  std::string mesh;
  std::optional<Size> size;  ///< none: auto
};
Result<AskedTexels> parseTexels(std::string_view text) {
  const std::size_t equals = text.rfind('=');
  const std::string_view what = text.substr(equals == text.npos ? 0 : equals + 1);
  AskedTexels asked;
  if (equals != text.npos) asked.mesh = std::string(text.substr(0, equals));
  if (what == "auto") return asked;
  const Result<Size> size = parseSize(what, kMostTexels);
  if (!size) return size.error();
  asked.size = *size;
  return asked;
}

std::string labelOf(const scene::Scene& scene, std::uint32_t mesh) {
  return fmt::format("mesh {} '{}'", mesh, scene.meshes[mesh].name);
}

/// The backs of meshes that have some lie beside their fronts: grids twice as wide.
Status layOutSides(std::vector<transport::TexelGrid>& grids, scene::Scene& scene) {
  for (transport::TexelGrid& grid : grids) {
    scene::Mesh& mesh = scene.meshes[grid.mesh];
    if (!scene::hasBacks(mesh)) continue;
    const auto refused = [&](const std::string& why) {
      return badUsage(fmt::format(
          "--texels: {} has two sides, whose texels lie beside each other, and {}: bake it at its "
          "vertices, or its front alone (--sides one)",
          labelOf(scene, grid.mesh), why));
    };
    if (scene.materials[std::size_t(mesh.material)].baseColorTexture >= 0)
      return refused("a texture, which has the same place on both");
    if (2 * grid.width > kMostTexels)
      return refused(fmt::format("{} texels each way are too many for both", grid.width));
    scene::layOutBacks(mesh);
    grid.width *= 2;
  }
  return Status::ok();
}

}  // namespace

void TexelArguments::addTo(CLI::App& app) {
  app.add_option("--texels", texels,
                 "Bake a mesh on a grid over its UVs instead of at its vertices; without MESH: "
                 "every mesh with UVs. May be given several times. Of a glTF mesh without a "
                 "texture the second set of UVs is taken, if it has one: that of light maps. "
                 "'auto': the mesh is laid out anew, as a second set beside the UVs that it has, "
                 "whatever they are, with texels where shadows want them, to the error of --refine "
                 "('--refine off': as dense everywhere); without MESH: every mesh")
      ->option_text("[MESH=]WxH|auto")
      ->check([](const std::string& text) -> std::string {
        const Result<AskedTexels> asked = parseTexels(text);
        return asked ? "" : asked.error().message;
      })
      ->group("Transfer");
  addNumber(app, "--texel-budget", budget, {1024, 100e6},
            "Texels of all grids that --texels auto makes, at most")
      ->option_text("TEXELS")
      ->capture_default_str()
      ->group("Transfer");
}

bool TexelArguments::wantsUvs() const {
  return std::any_of(texels.begin(), texels.end(), [](const std::string& text) {
    const Result<AskedTexels> asked = parseTexels(text);
    return asked && asked->size;
  });
}

Result<ChosenTexels> TexelArguments::resolve(scene::Scene& scene) const {
  ChosenTexels chosen;
  std::vector<bool> taken(scene.meshes.size(), false);
  // Meshes that are named are not meant by "every mesh" any more.
  std::vector<std::string> inTurn = texels;
  std::stable_partition(inTurn.begin(), inTurn.end(),
                        [](const std::string& text) { return text.find('=') != text.npos; });
  for (const std::string& text : inTurn) {
    const Result<AskedTexels> asked = parseTexels(text);
    if (!asked) return asked.error();
    const bool every = asked->mesh.empty();
    std::size_t found = 0;
    for (std::uint32_t m = 0; m < scene.meshes.size(); ++m) {
      const scene::Mesh& mesh = scene.meshes[m];
      const bool mirror = scene.materials[std::size_t(mesh.material)].isMirror();
      const bool fits = every ? !mirror && (!asked->size || !scene::texelUvsOf(mesh).empty())
                              : mesh.name == asked->mesh || std::to_string(m) == asked->mesh;
      if (!fits) continue;
      ++found;
      if (taken[m] && every) continue;
      taken[m] = true;
      if (asked->size)
        chosen.grids.push_back({m, asked->size->width, asked->size->height});
      else if (!mirror)
        chosen.toLayOut.push_back(m);
    }
    if (found > 0) continue;
    if (!every) return noSuch("--texels", asked->mesh, "mesh", meshNames(scene));
    return badUsage(
        asked->size
            ? "--texels: no mesh of this scene has UVs: 'auto' lays them out; or bake vertices"
            : "--texels auto: all meshes of this scene are mirrors");
  }
  if (Status laid = layOutSides(chosen.grids, scene); !laid) return laid.error();
  return chosen;
}

Result<Laid> layOutTexels(const TexelArguments& arguments, const RefineArguments& refine,
                          ChosenTexels& chosen, scene::Scene& scene, trace::RayScene& rays,
                          trace::Edges edges, Console& console) {
  if (chosen.toLayOut.empty()) return Laid();
  texel_layout::LayoutOptions options;
  options.budget = arguments.budget, options.threads = console.options().threads;
  options.error = refine.when == Refining::Never ? std::nullopt : std::optional(refine.error);
  auto found = texel_layout::layOut(scene, chosen.toLayOut, rays, options, console.progress());
  if (!found) return found.error();
  console.report(found->findings);
  texel_layout::LaidOutScene& laid = found->value;
  if (laid.spent && laid.worst.value_or(0.0) > refine.error)
    console.note("texel-budget",
                 fmt::format("{} texels are too few for light between them to be within {}: it is "
                             "off by {:.2g} on the whole, and by {:.2g} where it is worst. "
                             "--texel-budget allows more",
                             formatCount(laid.texels), refine.error, *laid.error, *laid.worst));
  scene = std::move(laid.scene);
  laid.scene = {};
  for (transport::TexelGrid& grid : laid.grids) chosen.grids.push_back(std::move(grid));
  laid.grids.clear();
  auto again = console.stage("ray structure", [&] { return trace::RayScene::build(scene, edges); });
  if (!again) return again.error();
  rays = std::move(*again);
  return Laid(std::move(laid));
}

Json asJson(const Laid& laid, const scene::Scene& scene) {
  if (!laid) return nullptr;
  Json meshes = Json::array();
  for (const texel_layout::MeshLayout& mesh : laid->meshes)
    meshes.push_back({{"mesh", scene.meshes[mesh.mesh].name},
                      {"charts", mesh.charts},
                      {"size", mesh.size},
                      {"texels_per_metre", {mesh.coarsest, mesh.finest}}});
  return {{"texels", laid->texels},
          {"rms", laid->error ? Json(*laid->error) : Json(nullptr)},
          {"worst", laid->worst ? Json(*laid->worst) : Json(nullptr)},
          {"meshes", std::move(meshes)}};
}

std::string inWords(const Laid& laid) {
  if (!laid || laid->meshes.empty()) return "";
  std::size_t charts = 0;
  double finest = 0.0, coarsest = laid->meshes[0].coarsest;
  for (const texel_layout::MeshLayout& mesh : laid->meshes) {
    charts += mesh.charts;
    finest = std::max(finest, mesh.finest), coarsest = std::min(coarsest, mesh.coarsest);
  }
  std::string text = fmt::format("laid out in {} charts on {} texels, {:.3g} to {:.3g} a metre",
                                 formatCount(charts), formatCount(laid->texels), coarsest, finest);
  if (laid->error) text += fmt::format("; light between them is off by {:.2g}", *laid->error);
  return text + "\n";
}

}  // namespace lambent::tool
