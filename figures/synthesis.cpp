// Contact sheets of texture synthesis: every patch over every form, from afar and near.
#include "figures/synthesis.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <functional>

#include "figures/forms.h"
#include "figures/relief.h"
#include "figures/scenes.h"
#include "figures/sheet.h"
#include "lambent/bi_scale/asset_quality.h"
#include "lambent/scene/shapes.h"

namespace lambent::figures {

namespace {

struct Form {
  const char* name;
  std::function<scene::Scene(const Studio&)> make;
  Vec3 near;     ///< what the near view looks at, of the bounding box, −½ … ½
  float factor;  ///< by which it is nearer
};

scene::Scene only(scene::Mesh mesh) {
  return scene::sceneOf(std::move(mesh), diffuseMaterial(Rgb::Constant(0.5f)));
}

std::vector<Form> forms() {
  return {
      {"plane", [](const Studio&) { return only(holedPlane()); }, Vec3(0.12f, 0, 0.25f), 6.0f},
      {"bunny", [](const Studio& studio) { return studio.load("bunny.obj"); },
       Vec3(-0.1f, 0.1f, 0.2f), 4.5f},
      {"knot", [](const Studio&) { return only(torusKnot()); }, Vec3(0.25f, 0.2f, 0.35f), 4.5f},
      {"teapot",
       [](const Studio& studio) {
         scene::Scene teapot = studio.load("teapot.obj");
         for (scene::Mesh& mesh : teapot.meshes) mesh = smoothlySubdivided(welded(mesh), 2);
         return teapot;
       },
       Vec3(0.25f, 0.0f, 0.2f), 4.5f},
      {"dragon", [](const Studio& studio) { return studio.load("dragon/dragon_vrip_res3.ply"); },
       Vec3(-0.1f, 0.02f, 0.2f), 4.5f},
      {"creature", [](const Studio&) { return only(creature(150)); }, Vec3(0.2f, 0.05f, 0.25f),
       4.5f},
      {"low-poly", [](const Studio&) { return only(creature(13)); }, Vec3(0.2f, 0.05f, 0.25f),
       4.5f}};
}

constexpr const char* kPatches[] = {"weave", "knit", "bricks", "scales", "pebbles", "stucco"};

bool chosen(const std::vector<std::string>& among, const std::string& name) {
  return among.empty() || std::find(among.begin(), among.end(), name) != among.end();
}

/// The form wears the patch as the tool has it without options, but for fewer rays.
bi_scale::Spread worn(const Studio& studio, const scene::Scene& form,
                      const transfer::SimulatedRtt& rtt) {
  bi_scale::SpreadOptions options;
  options.transfer.kind = transfer::Kind::Shadowed;
  options.transfer.directions = 256;
  if (studio.quick) options.mesoVertices = 200000, options.atlas.size = 1024;
  return spread(form, rtt, options);
}

image::Image written(const std::vector<std::string>& lines, int width, int height) {
  image::Image cell(width, height);
  std::fill(cell.pixels.begin(), cell.pixels.end(), Rgb::Ones());
  int y = 8;
  for (const std::string& line : lines) drawText(cell, 4, y, line), y += 24;
  return cell;
}

std::string shareOf(const std::optional<double>& share) {
  return share ? fmt::format("{:.1f}%", 100.0 * *share) : "-";
}

std::string numberOf(const std::optional<double>& number) {
  return number ? fmt::format("{:.3f}", *number) : "-";
}

}  // namespace

void synthesisSheets(const Studio& studio) {
  const int side = studio.pixels(520);
  const sh::RgbCoefficients light =
      (light::Environment::clampedCosine(Vec3(0.1f, 1, 0.3f).normalized(), Rgb::Constant(0.9f)) +
       discLight(towards(130, 42), 40, Rgb(2.0f, 1.95f, 1.8f)))
          .project(5);
  for (const std::string& name : studio.patches)
    if (std::find(std::begin(kPatches), std::end(kPatches), name) == std::end(kPatches))
      die("synthesis: there is no patch '" + name + "'");
  std::vector<Form> all = forms();
  for (const std::string& name : studio.forms)
    if (std::none_of(all.begin(), all.end(), [&](const Form& f) { return f.name == name; }))
      die("synthesis: there is no form '" + name + "'");
  for (const char* patch : kPatches)  // which prints what they cost, before the table
    if (chosen(studio.patches, patch)) (void)rttNamed(studio, patch);
  fmt::print(
      "| patch | form | charts | singularities | goes on | tears | periods of tears per period² | "
      "whole by area | whole | unlikeness | misfit | repetition | s |\n"
      "|---|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|\n");
  for (const char* patch : kPatches) {
    if (!chosen(studio.patches, patch)) continue;
    const transfer::SimulatedRtt rtt = rttNamed(studio, patch);
    Sheet sheet;
    sheet.columnLabels = {std::string(patch) + ", whole", "near", ""};
    for (const Form& form : all) {
      if (!chosen(studio.forms, form.name)) continue;
      const scene::Scene scene = form.make(studio);
      const auto start = std::chrono::steady_clock::now();
      const bi_scale::Spread spread = worn(studio, scene, rtt);
      const double seconds =
          std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
      const bi_scale::SpreadReport& report = spread.reports.front();
      const auto measured = bi_scale::qualityOf(spread.asset);
      const synthesis::ResultQuality& quality = measured.front().quality;
      const std::vector<std::string> lines = {
          form.name,
          fmt::format("{} triangles", scene.meshes[0].triangles.size()),
          fmt::format("{:.0f} patches", report.patches),
          fmt::format("{} charts", report.charts),
          fmt::format("goes on {:.2f}%", 100.0 * quality.continued),
          fmt::format("{} tears, {:.3f}", quality.tears.size(), quality.tearLength),
          "whole by area " + shareOf(quality.wholeByArea),
          "whole " + shareOf(quality.whole),
          "unlikeness " + numberOf(quality.unlikeness),
          "misfit " + numberOf(quality.misfit),
          "repetition " + numberOf(quality.repetition),
          fmt::format("{:.0f} s", seconds)};
      fmt::print(
          "| {} | {} | {} | {} | {:.3f}% | {} | {:.3f} | {} | {} | {} | {} | {} | {:.0f} |\n",
          patch, form.name, report.charts, report.singularities, 100.0 * quality.continued,
          quality.tears.size(), quality.tearLength, shareOf(quality.wholeByArea),
          shareOf(quality.whole), numberOf(quality.unlikeness), numberOf(quality.misfit),
          numberOf(quality.repetition), seconds);
      std::fflush(stdout);
      const scene::Box box = scene::bounds(scene);
      // What is flat from further up than the rest.
      const bool isFlat = (box.upper - box.lower).minCoeff() < 1e-3f;
      const scene::Camera whole = isFlat ? lookAt(Vec3(0.8f, 3.2f, 2.8f), Vec3::Zero(), 33.0f)
                                         : scene::frameAutomatically(scene, 1.0f);
      const Vec3 target = box.center() + form.near.cwiseProduct(box.upper - box.lower);
      const auto shoot = [&](const scene::Camera& camera) {
        return develop(photograph(spread.asset, light, {}, {camera, side, side, 9}), 0.3f);
      };
      sheet.rows.push_back({shoot(whole), shoot(zoomed(whole, target, form.factor)),
                            written(lines, side / 2 + 60, side)});
    }
    studio.save(compose(sheet), std::string("synthesis-") + patch);
  }
}

}  // namespace lambent::figures
