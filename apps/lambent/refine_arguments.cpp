#include "apps/lambent/refine_arguments.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <optional>

#include "apps/lambent/arguments.h"
#include "lambent/macro/refine.h"

namespace lambent::tool {

namespace {

constexpr NumberRange kErrors = {1e-4, 1.0};
/// Scans and other fine meshes are left as they are unless it is asked for.
constexpr std::size_t kMostToRefineUnasked = 100000;

/// So many places that looking at them and at the corners of their triangles costs some 3% of the
/// rays of a bake at 8192 directions. As all that decides on receivers, it depends on the scene
/// alone: bakes of one scene have the same ones, whatever their kind, bands, directions and seeds.
std::size_t samplesFor(std::size_t receivers) {
  return std::clamp<std::size_t>(receivers / 8, 128, 1024);
}

/// Cuts triangles, and looks again.
Status cutTriangles(const RefineArguments& arguments, const SceneToBake& bake,
                    macro::InterpolationErrorOptions look, Looked& looked, Console& console) {
  macro::RefineOptions refine;
  refine.error = arguments.error, refine.budget = arguments.budget;
  refine.threads = look.threads;
  // Rays that slip through edges are others for every kind of transfer; receivers are not.
  std::optional<trace::RayScene> watertight;
  if (bake.edges != trace::Edges::Watertight) {
    auto made = trace::RayScene::build(bake.scene, trace::Edges::Watertight);
    if (!made) return made.error();
    watertight.emplace(std::move(*made));
  }
  auto refined = macro::refine(bake.scene, watertight ? *watertight : bake.rays, bake.receivers,
                               refine, console.progress());
  if (!refined) return refined.error();
  looked.added = refined->added;
  if (refined->spent)
    console.note("refine-budget",
                 fmt::format("cutting triangles stopped at {} more vertices, before light between "
                             "them was within {}: --refine-budget allows more",
                             formatCount(refined->added), arguments.error));
  if (refined->added == 0) return Status::ok();
  bake.scene = std::move(refined->scene);
  auto rays = console.stage("ray structure",
                            [&] { return trace::RayScene::build(bake.scene, bake.edges); });
  if (!rays) return rays.error();
  bake.rays = std::move(*rays);
  auto receivers = transport::placeReceivers(bake.scene, bake.placement, bake.rays.offset());
  if (!receivers) return receivers.error();
  bake.receivers = std::move(*receivers);
  look.samples = samplesFor(bake.receivers.size());
  auto after =
      macro::interpolationError(bake.scene, bake.rays, bake.receivers, look, console.progress());
  if (!after) return after.error();
  looked.after = *after;
  return Status::ok();
}

}  // namespace

void RefineArguments::addTo(CLI::App& app) {
  app.add_option_function<std::string>(
         "--refine",
         [this](const std::string& text) {
           when = text == "off" ? Refining::Never : Refining::Always;
           if (text.empty() || text == "off") return;
           const Result<double> given = parseNumber(text, kErrors);
           if (!given)
             throw CLI::ValidationError("--refine", given.error().message +
                                                        ", or 'off'. Before another argument write "
                                                        "--refine=ERROR");
           error = *given;
         },
         "Cut triangles where shadows fall between vertices, until light there is off by no more "
         "than this: 0.01 of what a white surface sends back under an even sky. The surface stays "
         "as it is, and the asset holds the finer mesh. Without this option it is done where "
         "triangles are so large that shadows would be missed; 'off': never")
      ->expected(0, 1)
      ->option_text("[ERROR|off]")
      ->group("Transfer");
  addNumber(app, "--refine-budget", budget, {0, 100e6}, "Vertices that cutting triangles may add")
      ->option_text("VERTICES")
      ->capture_default_str()
      ->group("Transfer");
}

Result<Looked> lookBetweenReceivers(const RefineArguments& arguments, const SceneToBake& bake,
                                    Console& console) {
  Looked looked;
  macro::InterpolationErrorOptions look;
  look.threads = console.options().threads;
  look.samples = samplesFor(bake.receivers.size());
  auto before =
      macro::interpolationError(bake.scene, bake.rays, bake.receivers, look, console.progress());
  if (!before) return before.error();
  looked.before = *before;
  if (!looked.before) return looked;
  const bool tooLarge =
      looked.before->rms > look.tolerance && bake.receivers.size() <= kMostToRefineUnasked;
  if (arguments.when == Refining::Always ||
      (arguments.when == Refining::LargeTriangles && tooLarge)) {
    if (Status cut = cutTriangles(arguments, bake, look, looked, console); !cut) return cut.error();
    if (arguments.when == Refining::LargeTriangles && looked.added > 0)
      console.note("triangles-cut",
                   fmt::format("triangles were too large for the shadows on them, most of all "
                               "those of {}: they were cut where shadows fall, which "
                               "added {} vertices. --refine off leaves them as they are",
                               macro::meshInWords(bake.scene, looked.before->worstMesh),
                               formatCount(looked.added)));
  }
  console.report(
      macro::findingsOf(looked.after ? *looked.after : *looked.before, bake.scene, look,
                        fmt::format("--refine cuts triangles where that is so{}", bake.besides)));
  return looked;
}

Json asJson(const Looked& looked, const scene::Scene& scene) {
  const auto errorAsJson = [&](const macro::InterpolationError& error) -> Json {
    return {{"rms", error.rms},
            {"beyond_tolerance", error.beyond},
            {"places", error.samples},
            {"worst_mesh", scene.meshes[error.worstMesh].name},
            {"worst_mesh_share", error.worstMeshShare}};
  };
  if (!looked.before) return nullptr;
  Json json = errorAsJson(looked.after ? *looked.after : *looked.before);
  if (looked.after) {
    json["rms_before"] = looked.before->rms;
    json["vertices_added"] = looked.added;
  }
  return json;
}

}  // namespace lambent::tool
