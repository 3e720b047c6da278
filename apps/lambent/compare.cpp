// lambent compare A B
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <filesystem>
#include <memory>

#include "apps/lambent/arguments.h"
#include "apps/lambent/describe.h"
#include "apps/lambent/help.h"
#include "apps/lambent/named_files.h"
#include "apps/lambent/picture_arguments.h"
#include "apps/lambent/reading_arguments.h"
#include "apps/lambent/receiver_file.h"
#include "apps/lambent/standard_streams.h"
#include "apps/lambent/verbs.h"
#include "lambent/file/atomic_file.h"
#include "lambent/image/code_difference.h"
#include "lambent/image/compare.h"
#include "lambent/image/io.h"
#include "lambent/image/strip.h"
#include "lambent/tone/compare.h"

namespace lambent::tool {

namespace {

struct Limit {
  std::string metric;
  double value;
};

struct CompareRequest {
  std::filesystem::path truth, judged, difference, strip;
  DevelopmentArguments development;
  float gain = 10.0f;
  std::vector<std::string> limits;
  ReadingArguments reading;
};

constexpr std::string_view kCompareExamples = R"(A is the truth, B what is judged.
  bias            sum of B - A over the sum of A: too dark below zero, too bright above
  rmse            root mean square difference, in radiance
  relative_rmse   the same over the root mean square of A
  relative_mse    mean of squared differences, each over its own A squared (+ 0.01)
  noise           what of it the variance in A and B accounts for ('lambent reference' stores it)
  beyond_noise    what is left of relative_rmse: the error proper
  psnr            dB below the brightest value of A; of PNG pictures: of their 8-bit codes, below
                  255, as other programs have it
  difference      mean difference of the developed pictures' 8-bit codes, in steps of 1/255; the
  difference_lit  same over the pixels that are not black in both; and the largest of one channel
  flip            0 to 1, what a person sees who flips between the developed pictures
Pixels that neither picture covers are left out of all but difference and flip.

Examples:
  lambent compare truth.exr ours.exr
  lambent compare truth.exr ours.exr --strip strip.png
      One picture to look at: A, B, and ten times the difference.
  lambent compare truth.exr ours.exr --fail-above relative_rmse=0.02 --json
      In a script: exit code 1 if the error is larger.
  lambent compare truth.csv ours.csv
      Receiver by receiver: outputs of 'lambent reference' and 'lambent shade'.
)";

constexpr std::array kMetrics = {"bias",         "rmse",       "relative_rmse",  "relative_mse",
                                 "beyond_noise", "difference", "difference_lit", "flip"};

Result<Limit> parseLimit(const std::string& text) {
  const std::size_t equals = text.find('=');
  const std::string metric = text.substr(0, equals);
  if (equals == std::string::npos ||
      std::find(kMetrics.begin(), kMetrics.end(), metric) == kMetrics.end())
    return badUsage(
        fmt::format("'{}': write METRIC=VALUE with one of {}", text, fmt::join(kMetrics, ", ")));
  const Result<double> value = parseNumber(std::string_view(text).substr(equals + 1), {0.0, 1e30});
  if (!value) return badUsage(fmt::format("'{}': {}", text, value.error().message));
  return Limit{metric, *value};
}

struct Outcome {
  std::size_t count = 0;  ///< pixels or receivers
  image::Comparison numbers;
  std::optional<image::CodeDifference> codes;
  std::optional<double> flip;
  float exposure = 0.0f;
  std::optional<double> noise;  ///< relative RMSE that the pictures' own variance accounts for
};

Json numberOrNull(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);  // JSON has no infinity
}

/// What of the relative RMSE is left once the noise is taken away.
double beyondNoise(const Outcome& outcome) {
  const double error = outcome.numbers.relativeRmse, noise = *outcome.noise;
  return std::sqrt(std::max(0.0, error * error - noise * noise));
}

Json summaryOf(const Outcome& outcome) {
  const image::Comparison& n = outcome.numbers;
  Json json = {{"count", outcome.count},
               {"bias", numberOrNull(n.relativeBias)},
               {"bias_rgb", asJson(n.bias)},
               {"rmse", n.rmse},
               {"relative_rmse", numberOrNull(n.relativeRmse)},
               {"relative_mse", n.relativeMse},
               {"psnr", numberOrNull(n.psnr)},
               {"largest", n.largest},
               {"not_finite", n.nonFinitePixels}};
  if (outcome.noise) {
    json["noise"] = numberOrNull(*outcome.noise);
    json["beyond_noise"] = numberOrNull(beyondNoise(outcome));
  }
  if (outcome.codes) {
    json["difference"] = outcome.codes->mean;
    json["difference_lit"] = outcome.codes->meanLit;
    json["difference_largest"] = outcome.codes->largest;
  }
  if (outcome.flip) {
    json["flip"] = *outcome.flip;
    json["exposure"] = outcome.exposure;
  }
  return json;
}

std::string textOf(const Outcome& outcome, std::string_view unit) {
  const image::Comparison& n = outcome.numbers;
  std::string text = fmt::format(
      "{} {} compared\n"
      "  bias           {:+.4f} %\n"
      "  rmse           {:.6g}\n"
      "  relative rmse  {:.4f} %\n"
      "  relative mse   {:.6g}\n"
      "  psnr           {:.2f} dB\n",
      formatCount(outcome.count), unit, 100.0 * n.relativeBias, n.rmse, 100.0 * n.relativeRmse,
      n.relativeMse, n.psnr);
  if (outcome.noise)
    text += fmt::format("  of which noise {:.4f} %, beyond it {:.4f} %\n", 100.0 * *outcome.noise,
                        100.0 * beyondNoise(outcome));
  if (outcome.codes)
    text += fmt::format(
        "  difference     {:.4f} / 255, {:.4f} / 255 where not both are black, at most {}\n",
        outcome.codes->mean, outcome.codes->meanLit, outcome.codes->largest);
  if (outcome.flip)
    text += fmt::format("  flip           {:.5f} at {:+.2f} EV\n", *outcome.flip, outcome.exposure);
  return text;
}

Result<Outcome> compareReceivers(const CompareRequest& arguments) {
  if (!arguments.difference.empty() || !arguments.strip.empty())
    return badUsage("--diff and --strip need two pictures, not receivers");
  const auto a = readReceivers(arguments.truth, arguments.reading.memoryLimit);
  if (!a) return a.error();
  const auto b = readReceivers(arguments.judged, arguments.reading.memoryLimit);
  if (!b) return b.error();
  if (a->receivers.size() != b->receivers.size())
    return badInput(
        fmt::format("{} has {} receivers, {} has {}: take both of one scene, baked at its vertices",
                    arguments.truth.string(), a->receivers.size(), arguments.judged.string(),
                    b->receivers.size()));
  std::vector<Rgb> truth, judged;
  for (const ShadedReceiver& receiver : a->receivers) truth.push_back(receiver.radiance);
  for (const ShadedReceiver& receiver : b->receivers) judged.push_back(receiver.radiance);
  const auto numbers = image::compare(std::span<const Rgb>(judged), std::span<const Rgb>(truth));
  if (!numbers) return badInput(arguments.truth.string() + ": " + numbers.error().message);
  Outcome outcome{truth.size(), *numbers, {}, {}, 0.0f, {}};
  if (!a->variances.empty() || !b->variances.empty()) {
    double variance = 0.0, power = 0.0;
    for (const auto* file : {&*a, &*b})
      for (const Rgb& v : file->variances) variance += double(v.sum());
    for (const Rgb& radiance : truth) power += double(radiance.square().sum());
    if (power > 0.0) outcome.noise = std::sqrt(variance / power);
  }
  return outcome;
}

/// The relative RMSE to be expected of the noise alone, if one of the files has a layer of
/// variance.
Result<std::optional<double>> noiseOf(const CompareRequest& arguments, const image::Image& a,
                                      const image::Image& b) {
  double variance = 0.0, power = 0.0;
  bool known = false;
  for (const auto& path : {arguments.truth, arguments.judged}) {
    const auto bytes = file::readWhole(path);
    if (!bytes) return bytes.error();
    const auto layer =
        image::decodeLayer(*bytes, path.string(), "variance", arguments.reading.forImage());
    if (!layer && layer.error().kind != ErrorKind::BadInput) return layer.error();
    if (!layer || layer->pixels.size() != a.pixels.size()) continue;
    known = true;
    for (std::size_t i = 0; i < a.pixels.size(); ++i)
      if (a.pixels[i].isFinite().all() && b.pixels[i].isFinite().all())
        variance += double(layer->pixels[i].sum());
  }
  for (const Rgb& pixel : a.pixels)
    if (pixel.isFinite().all()) power += double(pixel.square().sum());
  if (!known || !(power > 0.0)) return std::optional<double>();
  return std::optional<double>(std::sqrt(variance / power));
}

/// Only the pixels that either picture covers.
std::pair<std::vector<Rgb>, std::vector<Rgb>> covered(const image::Image& a,
                                                      const image::Image& b) {
  std::pair<std::vector<Rgb>, std::vector<Rgb>> both;
  const bool masked = !a.alpha.empty() && !b.alpha.empty();
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    if (masked && a.alpha[i] <= 0.0f && b.alpha[i] <= 0.0f) continue;
    both.first.push_back(a.pixels[i]);
    both.second.push_back(b.pixels[i]);
  }
  return both;
}

Status writeStrip(const CompareRequest& arguments, const image::Image& a, const image::Image& b,
                  const image::Image& difference) {
  const Rgb backdrop = Rgb::Constant(0.03f), gap = Rgb::Constant(1.0f);
  const std::array panels = {image::over(a, backdrop), image::over(b, backdrop), difference};
  return written(image::write(image::strip(panels, 4, gap), arguments.strip));
}

/// What one of the two pictures lacks of its file is told, but for the layer that is read apart.
Result<image::Image> readTelling(const std::filesystem::path& path, const CompareRequest& arguments,
                                 Console& console) {
  auto picture = image::readPicture(path, arguments.reading.forImage());
  if (!picture) return picture.error();
  std::erase_if(picture->findings, [](const Finding& finding) {
    return finding.code == "exr-layers" && finding.count == 1 &&
           finding.message.find("left: variance (") != std::string::npos;
  });
  if (Status whole = console.accept(picture->findings); !whole) return whole.error();
  return std::move(picture->image);
}

Result<Outcome> comparePictures(const CompareRequest& arguments, Console& console) {
  NamedFiles files;
  files.writes("--diff", arguments.difference, {".png"});
  files.writes("--strip", arguments.strip, {".png"});
  files.reads("A", arguments.truth);
  files.reads("B", arguments.judged);
  if (Status distinct = files.check(); !distinct) return distinct.error();
  const auto a = readTelling(arguments.truth, arguments, console);
  if (!a) return a.error();
  const auto b = readTelling(arguments.judged, arguments, console);
  if (!b) return b.error();
  if (a->width != b->width || a->height != b->height)
    return badInput(fmt::format("{} is {}x{}, {} is {}x{}: make both of one --size",
                                arguments.truth.string(), a->width, a->height,
                                arguments.judged.string(), b->width, b->height));

  // PNG pictures are developed already.
  const bool developed =
      extensionOf(arguments.truth) == ".png" && extensionOf(arguments.judged) == ".png";
  const bool automatic = arguments.development.exposure == "auto";
  tone::CompareOptions options;
  options.displayReferred = developed;
  options.exposureEv = developed && automatic ? 0.0f : arguments.development.exposureFor(*a);
  options.curve = developed ? tone::Curve::Linear : arguments.development.curve;
  const auto whole = console.stage("compare", [&] { return tone::compare(*b, *a, options); });
  if (!whole) return badInput(arguments.truth.string() + ": " + whole.error().message);
  const auto [truth, judged] = covered(*a, *b);
  const auto numbers = image::compare(std::span<const Rgb>(judged), std::span<const Rgb>(truth));
  const auto develop = [&](const image::Image& picture, tone::Curve curve) {
    return tone::toneMap(picture, options.exposureEv, curve);
  };
  const image::Image shownA = develop(*a, options.curve), shownB = develop(*b, options.curve);
  const auto noise = noiseOf(arguments, *a, *b);
  if (!noise) return noise.error();
  Outcome outcome{truth.size(), numbers ? *numbers : *whole, image::codeDifference(shownB, shownA),
                  whole->flip,  options.exposureEv,          *noise};
  if (developed) outcome.numbers.psnr = whole->psnr;
  if (outcome.numbers.nonFinitePixels > 0)
    console.warn("not-finite", fmt::format("{} pixels are not finite and were left out",
                                           outcome.numbers.nonFinitePixels));

  const image::Image difference =
      develop(image::difference(*b, *a, arguments.gain), tone::Curve::Linear);
  if (!arguments.difference.empty())
    if (Status s = written(image::write(difference, arguments.difference)); !s) return s.error();
  if (!arguments.strip.empty()) {
    Status s = writeStrip(arguments, shownA, shownB, difference);
    if (!s) return s.error();
  }
  return outcome;
}

bool holdsReceivers(const std::filesystem::path& path) {
  const std::string extension = extensionOf(path);
  return extension == ".csv" || extension == ".ply";
}

Status runCompare(CompareRequest arguments, Console& console) {
  if (Status s = console.takeInput(arguments.truth, "A"); !s) return s;
  if (Status s = console.takeInput(arguments.judged, "B"); !s) return s;
  const bool receivers = holdsReceivers(arguments.truth);
  if (receivers != holdsReceivers(arguments.judged))
    return badUsage("compare two pictures, or two outputs of 'lambent shade'");
  const auto outcome =
      receivers ? compareReceivers(arguments) : comparePictures(arguments, console);
  if (!outcome) return outcome.error();

  const Json json = summaryOf(*outcome);
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
  std::string text = textOf(*outcome, receivers ? "receivers" : "pixels");
  if (!arguments.difference.empty())
    text += fmt::format("difference x{:g}: {}\n", arguments.gain, arguments.difference.string());
  if (!arguments.strip.empty()) text += fmt::format("strip: {}\n", arguments.strip.string());
  if (!exceeded.empty()) {
    console.keep(json);
    if (!console.options().json)
      if (const Status said = print(text); !said && !said.error().message.empty())
        exceeded += "; " + said.error().message;
    return failed(exceeded);
  }
  return console.finish(json, text);
}

}  // namespace

Verb addCompare(CLI::App& root, ConsoleOptions& common) {
  auto arguments = std::make_shared<CompareRequest>();
  CLI::App* app = root.add_subcommand("compare", "Say how far one picture is from another");
  app->group("Verbs");
  app->footer(std::string(kCompareExamples));
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
  addNumber(*app, "--gain", arguments->gain, {1e-6, 1e6}, "What the difference is multiplied by")
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
  arguments->reading.addLimitTo(*app);
  addCommonOptions(*app, common);
  return {app, [arguments](Console& console) { return runCompare(*arguments, console); }};
}

}  // namespace lambent::tool
