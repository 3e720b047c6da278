// lambent compare A B
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <filesystem>
#include <memory>

#include "apps/lambent/arguments.h"
#include "apps/lambent/describe.h"
#include "apps/lambent/help.h"
#include "apps/lambent/picture_arguments.h"
#include "apps/lambent/receiver_file.h"
#include "apps/lambent/verbs.h"
#include "lambent/compare/flip.h"
#include "lambent/compare/metrics.h"
#include "lambent/compare/strip.h"
#include "lambent/image/io.h"

namespace lambent::tool {

namespace {

struct Limit {
  std::string metric;
  double value;
};

struct Arguments {
  std::filesystem::path truth, judged, difference, strip;
  DevelopmentArguments development;
  float gain = 10.0f;
  std::vector<std::string> limits;
};

constexpr std::string_view kExamples = R"(A is the truth, B what is judged.
  bias            mean(B - A) / mean(A): too dark below zero, too bright above
  rmse            root mean square difference, in radiance
  relative_rmse   the same over the root mean square of A
  relative_mse    mean of squared differences, each over its own A squared
  psnr            dB, of the developed pictures (exposure, tone curve, sRGB)
  flip            0 to 1, what a person sees who flips between the developed pictures
Pixels that neither picture covers are left out of the first four.

Examples:
  lambent compare truth.exr ours.exr
  lambent compare truth.exr ours.exr --strip strip.png
      One picture to look at: A, B, and ten times the difference.
  lambent compare truth.exr ours.exr --fail-above relative_rmse=0.02 --json
      In a script: exit code 1 if the error is larger.
  lambent compare before.csv after.csv
      Two outputs of 'lambent shade', receiver by receiver.
)";

constexpr std::array kMetrics = {"bias", "rmse", "relative_rmse", "relative_mse", "flip"};

Result<Limit> parseLimit(const std::string& text) {
  const std::size_t equals = text.find('=');
  const std::string metric = text.substr(0, equals);
  if (equals == std::string::npos ||
      std::find(kMetrics.begin(), kMetrics.end(), metric) == kMetrics.end())
    return badUsage(
        fmt::format("'{}': write METRIC=VALUE with one of {}", text, fmt::join(kMetrics, ", ")));
  const Result<double> value = parseNumber(std::string_view(text).substr(equals + 1));
  if (!value) return value.error();
  return Limit{metric, *value};
}

struct Comparison {
  compare::Metrics metrics;
  std::optional<double> psnr, flip;
  float exposure = 0.0f;
};

Json numberOrNull(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);  // JSON has no infinity
}

Json summaryOf(const Comparison& comparison) {
  const compare::Metrics& m = comparison.metrics;
  Json json = {{"count", m.count},
               {"bias", numberOrNull(m.relativeBias)},
               {"bias_rgb", asJson(m.bias)},
               {"rmse", m.rmse},
               {"relative_rmse", numberOrNull(m.relativeRmse)},
               {"relative_mse", numberOrNull(m.relativeMse)},
               {"worst", m.worst}};
  if (comparison.psnr) json["psnr"] = numberOrNull(*comparison.psnr);
  if (comparison.flip) {
    json["flip"] = *comparison.flip;
    json["exposure"] = comparison.exposure;
  }
  return json;
}

std::string asText(const Comparison& comparison, std::string_view unit) {
  const compare::Metrics& m = comparison.metrics;
  std::string text = fmt::format(
      "{} {} compared\n"
      "  bias           {:+.4f} %\n"
      "  rmse           {:.6g}\n"
      "  relative rmse  {:.4f} %\n"
      "  relative mse   {:.6g}\n",
      formatCount(m.count), unit, 100.0 * m.relativeBias, m.rmse, 100.0 * m.relativeRmse,
      m.relativeMse);
  if (comparison.psnr) text += fmt::format("  psnr           {:.2f} dB\n", *comparison.psnr);
  if (comparison.flip)
    text += fmt::format("  flip           {:.5f} at {:+.2f} EV\n", *comparison.flip,
                        comparison.exposure);
  return text;
}

/// Nothing can be said about what is not a number.
Status requireFinite(std::span<const Rgb> values, const std::filesystem::path& path) {
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!values[i].isFinite().all())
      return badInput(
          fmt::format("{}: entry {} is not finite: make the picture again", path.string(), i));
  return Status::ok();
}

Result<Comparison> compareReceivers(const Arguments& arguments) {
  if (!arguments.difference.empty() || !arguments.strip.empty())
    return badUsage("--diff and --strip need two pictures, not receivers");
  const auto a = readReceivers(arguments.truth);
  if (!a) return a.error();
  const auto b = readReceivers(arguments.judged);
  if (!b) return b.error();
  if (a->size() != b->size())
    return badInput(fmt::format("{} has {} receivers, {} has {}: shade two bakes of one scene",
                                arguments.truth.string(), a->size(), arguments.judged.string(),
                                b->size()));
  std::vector<Rgb> truth, judged;
  for (const ShadedReceiver& receiver : *a) truth.push_back(receiver.radiance);
  for (const ShadedReceiver& receiver : *b) judged.push_back(receiver.radiance);
  if (Status s = requireFinite(truth, arguments.truth); !s) return s.error();
  if (Status s = requireFinite(judged, arguments.judged); !s) return s.error();
  return Comparison{compare::measure(truth, judged), {}, {}, 0.0f};
}

Result<Comparison> comparePictures(const Arguments& arguments, Console& console) {
  for (const auto& output : {arguments.difference, arguments.strip}) {
    if (output.empty()) continue;
    for (const auto& input : {arguments.truth, arguments.judged})
      if (Status s = checkOutput(output, {".png"}, input); !s) return s.error();
  }
  const auto a = image::read(arguments.truth);
  if (!a) return a.error();
  const auto b = image::read(arguments.judged);
  if (!b) return b.error();
  if (a->width != b->width || a->height != b->height)
    return badInput(fmt::format("{} is {}x{}, {} is {}x{}: make both of one --size",
                                arguments.truth.string(), a->width, a->height,
                                arguments.judged.string(), b->width, b->height));
  if (Status s = requireFinite(a->pixels, arguments.truth); !s) return s.error();
  if (Status s = requireFinite(b->pixels, arguments.judged); !s) return s.error();

  // PNG pictures are developed already.
  const bool developed =
      extensionOf(arguments.truth) == ".png" && extensionOf(arguments.judged) == ".png";
  Comparison comparison;
  const bool automatic = arguments.development.exposure == "auto";
  comparison.exposure = developed && automatic ? 0.0f : arguments.development.exposureFor(*a);
  const auto curve = developed ? radiometry::ToneCurve::Linear : arguments.development.curve();
  const image::Image shownA = radiometry::toneMap(*a, comparison.exposure, curve);
  const image::Image shownB = radiometry::toneMap(*b, comparison.exposure, curve);
  comparison.metrics = compare::measure(*a, *b);
  comparison.psnr = compare::psnr(shownA, shownB);
  comparison.flip = console.stage("flip", [&] { return compare::flip(shownA, shownB).mean; });

  const image::Image difference =
      radiometry::toneMap(compare::difference(*a, *b, arguments.gain), comparison.exposure,
                          radiometry::ToneCurve::Linear);
  if (!arguments.difference.empty())
    if (Status s = written(image::write(difference, arguments.difference)); !s) return s.error();
  if (!arguments.strip.empty()) {
    const Rgb backdrop = Rgb::Constant(0.03f);
    const std::array panels = {compare::over(shownA, backdrop), compare::over(shownB, backdrop),
                               difference};
    const image::Image strip = compare::strip(panels, 4, Rgb::Constant(1.0f));
    if (Status s = written(image::write(strip, arguments.strip)); !s) return s.error();
  }
  return comparison;
}

bool holdsReceivers(const std::filesystem::path& path) {
  const std::string extension = extensionOf(path);
  return extension == ".csv" || extension == ".ply";
}

Status runCompare(const Arguments& arguments, Console& console) {
  const bool receivers = holdsReceivers(arguments.truth);
  if (receivers != holdsReceivers(arguments.judged))
    return badUsage("compare two pictures, or two outputs of 'lambent shade'");
  const auto comparison =
      receivers ? compareReceivers(arguments) : comparePictures(arguments, console);
  if (!comparison) return comparison.error();

  const Json json = summaryOf(*comparison);
  std::string exceeded;
  for (const std::string& text : arguments.limits) {
    const Result<Limit> limit = parseLimit(text);
    if (!limit) return limit.error();
    if (!json.contains(limit->metric))
      return badUsage(fmt::format("--fail-above {}: receivers have no {}", text, limit->metric));
    const Json& value = json[limit->metric];
    if (value.is_null() || std::abs(value.get<double>()) > limit->value)
      exceeded += fmt::format("{}{} is {}, above {}", exceeded.empty() ? "" : "; ", limit->metric,
                              value.dump(), limit->value);
  }
  std::string text = asText(*comparison, receivers ? "receivers" : "pixels");
  if (!arguments.difference.empty())
    text += fmt::format("difference x{:g}: {}\n", arguments.gain, arguments.difference.string());
  if (!arguments.strip.empty()) text += fmt::format("strip: {}\n", arguments.strip.string());
  if (!exceeded.empty()) {
    if (!console.options().json) fmt::print("{}", text);
    return failed(exceeded);
  }
  console.finish(json, text);
  return Status::ok();
}

}  // namespace

Verb addCompare(CLI::App& root, ConsoleOptions& common) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* app = root.add_subcommand("compare", "Say how far one picture is from another");
  app->footer(std::string(kExamples));
  app->add_option("A", arguments->truth,
                  "The truth: .exr, .hdr or .png; or .csv or .ply from 'lambent shade'")
      ->required();
  app->add_option("B", arguments->judged, "What is judged, of the same kind and size")->required();
  app->add_option("--diff", arguments->difference, "Write the absolute difference, times --gain")
      ->option_text("OUT.png")
      ->group("Pictures");
  app->add_option("--strip", arguments->strip, "Write A, B and the difference side by side")
      ->option_text("OUT.png")
      ->group("Pictures");
  app->add_option("--gain", arguments->gain, "What the difference is multiplied by")
      ->check(CLI::PositiveNumber)
      ->option_text("FACTOR")
      ->capture_default_str()
      ->group("Pictures");
  arguments->development.addTo(*app);
  app->add_option("--fail-above", arguments->limits,
                  "Exit with 1 if a metric is larger; may be given several times")
      ->option_text("METRIC=VALUE")
      ->check([](const std::string& text) -> std::string {
        const Result<Limit> limit = parseLimit(text);
        return limit ? "" : limit.error().message;
      })
      ->group("Output");
  addCommonOptions(*app, common);
  return {app, [arguments](Console& console) { return runCompare(*arguments, console); }};
}

}  // namespace lambent::tool
