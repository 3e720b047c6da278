// lambent sky [WHEN AND WHERE] [-o OUT] [--at AZIMUTH,ELEVATION]
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>

#include "apps/lambent/arguments.h"
#include "apps/lambent/help.h"
#include "apps/lambent/named_files.h"
#include "apps/lambent/output_argument.h"
#include "apps/lambent/picture_arguments.h"
#include "apps/lambent/sky_arguments.h"
#include "apps/lambent/sky_haze.h"
#include "apps/lambent/sky_report.h"
#include "apps/lambent/verbs.h"
#include "lambent/file/atomic_file.h"
#include "lambent/image/channels.h"
#include "lambent/image/io.h"
#include "lambent/math/directions.h"
#include "lambent/sky/make_sky.h"
#include "lambent/sky/sky_picture.h"
#include "lambent/tone/tone_curve.h"

namespace lambent::tool {

namespace {

namespace fs = std::filesystem;

struct SkyVerb {
  SkyArguments sky;
  SequenceArguments sequence;
  MapArguments map;
  AtArguments at;
  HazeArguments haze;
  DevelopmentArguments development;
  OutputArgument output{.extensions = {".exr", ".png", ".hdr", ".csv"}};
  const CLI::App* app = nullptr;

  bool given(const char* option) const { return app->count(option) > 0; }
  std::string extension() const { return extensionOf(output.path); }
  bool drawsPicture() const { return !output.path.empty() && extension() != ".csv"; }
};

constexpr std::string_view kSkyExamples = R"(
Without -o and --at: where the Sun stands and how bright it is there.

Examples:
  lambent sky --date 2026-06-21 --time 05:40 --utc-offset 2 --lat 46.2 --lon 6.1 -o sky.exr
      The sky of a place and a moment as a light, without the Sun's disc: 'sky:' adds that.
  lambent sky --sun-elevation 12 --sun-azimuth 140 -o view.png --map camera --look 140,10
      What one sees who looks to the south-east.
  lambent sky --sun-elevation -8 --at 0,10 --at 180,45 --wavelengths 450,550,650
      Towards the Sun and away from it: radiance, luminance and magnitudes, as CSV.
  lambent sky --date 2026-06-21 --utc-offset 2 --lat 46.2 --lon 6.1 --sequence 04:00,22:00,10
              --map fisheye -o day.png
      A day in steps of ten minutes: day-0001.png, day-0002.png, …
  lambent sky --sun-elevation 12 --sun-azimuth 140 --haze view.exr depth.exr --look 140,0
              --haze-sky -o hazy.exr
      A landscape that was drawn without air, seen through the air of that moment.
)";

/// Of --haze: of one moment, as colours.
Status checkHaze(const SkyVerb& verb) {
  if (!verb.haze.given()) {
    for (const char* option : {"--depth-along", "--depth-unit", "--haze-form", "--haze-sky"})
      if (verb.given(option))
        return badUsage(fmt::format("{} is of --haze COLOUR.exr DEPTH.exr", option));
    return Status::ok();
  }
  if (!verb.drawsPicture())
    return badUsage("--haze makes a picture: name it with -o OUT.exr, .hdr or .png");
  for (const char* option :
       {"--sequence", "--at", "--at-file", "--wavelengths", "--size", "--sun", "--quantity"})
    if (verb.given(option))
      return badUsage(
          fmt::format("{} is not of --haze, whose picture is as the one it is given", option));
  return Status::ok();
}

/// What goes nowhere is a mistake that a person wants to hear of.
Status checkUse(const SkyVerb& verb) {
  if (Status useful = checkHaze(verb); !useful || verb.haze.given()) return useful;
  for (const char* option : {"--map", "--size", "--quantity"})
    if (verb.given(option) && !verb.drawsPicture())
      return badUsage(
          fmt::format("{} is of a picture: name one with -o OUT.exr, .hdr or .png", option));
  const bool spectral = verb.map.quantity == sky::Quantity::Spectral;
  if (verb.given("--wavelengths") && !verb.at.given() && !spectral)
    return badUsage("--wavelengths are those of --at, --at-file or --quantity spectral: give one");
  if (verb.extension() == ".csv" && !verb.at.given())
    return badUsage("-o " + verb.output.path.string() +
                    ": there are no rows without --at or --at-file");
  if (verb.sequence.span && verb.output.path.empty() && !verb.at.given() && !verb.given("--json"))
    return badUsage("--sequence makes pictures or rows: give -o OUT.png or --at, or --json");
  if (!verb.drawsPicture()) return Status::ok();
  const bool colour = verb.map.quantity == sky::Quantity::Radiance;
  if (verb.extension() != ".exr" && !colour && verb.map.quantity != sky::Quantity::Luminance)
    return badUsage(fmt::format("--quantity {}: a {} has colours alone; write an .exr",
                                nameOf(verb.map.quantity), verb.extension()));
  if (verb.given("--exposure") && !colour && verb.extension() != ".png")
    return badUsage(fmt::format("--exposure would take --quantity {} out of its unit",
                                nameOf(verb.map.quantity)));
  return Status::ok();
}

NamedFiles namedFiles(const SkyVerb& verb, std::size_t frames) {
  NamedFiles files;
  const bool numbered = verb.sequence.span && verb.drawsPicture();
  if (!numbered) files.writes("--output", verb.output.path, verb.output.extensions);
  if (numbered) {
    files.writes("--output", framePath(verb.output.path, 1, frames), {".exr", ".hdr", ".png"});
    for (std::size_t i = 2; i <= frames; ++i)
      files.writesLater("--output", framePath(verb.output.path, i, frames));
  }
  files.reads("--atmosphere", verb.sky.file());
  files.reads("--at-file", verb.at.file);
  verb.haze.addFilesTo(files);
  return files;
}

/// The Suns of a sequence that stand above −18°.
struct Suns {
  std::vector<sky::ResolvedSky> resolved;
  std::vector<std::string> times;
};

/// Of a sequence, moments of night are left out. Its requests differ in their moment alone: what is
/// refused of some and not of others is their Sun.
Result<Suns> sunsOf(const SkyVerb& verb, const std::vector<sky::SkyRequest>& moments,
                    Console& console) {
  Suns suns;
  std::optional<Error> refused;
  std::string when;
  for (const sky::SkyRequest& moment : moments) {
    auto resolved = sky::resolve(moment);
    if (!resolved) {
      if (!verb.sequence.span || resolved.error().kind != ErrorKind::BadUsage)
        return resolved.error();
      if (!refused) when = *moment.time;
      if (!refused) refused = resolved.error();
      continue;
    }
    if (suns.resolved.empty()) console.report(resolved->findings);
    suns.resolved.push_back(std::move(resolved->value));
    suns.times.push_back(verb.sequence.span ? *moment.date + " " + *moment.time : "");
  }
  if (suns.resolved.empty()) return *refused;
  const std::uint64_t left = moments.size() - suns.resolved.size();
  if (left > 0)
    console.report({{Severity::Warning, "sky-night-left-out",
                     fmt::format("{} of {} moments are left out, and the others are numbered. The "
                                 "first of them is {}: {}",
                                 left, moments.size(), when, refused->message),
                     left}});
  return suns;
}

/// For sums over the spectrum and for what is asked for: every 10 nm, and the wavelengths.
std::vector<double> wavelengthsOf(const std::vector<double>& asked) {
  std::vector<double> all = asked;
  for (int nm = 340; nm <= 740; nm += 10) all.push_back(nm);
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

image::Image asImage(const image::ChannelImage& picture) {
  image::Image image(picture.width, picture.height);
  const bool grey = picture.channels.front().name == "Y";
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c)
      image.pixels[i][Eigen::Index(c)] = picture.channels[grey ? 0 : c].values[i];
  if (picture.channels.back().name == "A") image.alpha = picture.channels.back().values;
  return image;
}

Status writePicture(const SkyVerb& verb, image::ChannelImage picture, const std::string& words,
                    const fs::path& path) {
  // As in 'render': what is linear stays so, but for an exposure that is a number.
  if (verb.extension() != ".png" && verb.given("--exposure") && verb.development.exposure != "auto")
    for (image::ChannelImage::Channel& channel : picture.channels)
      for (float& value : channel.values)
        if (channel.name != "A") value *= std::exp2(verb.development.exposureFor({}));
  if (verb.extension() == ".exr") {
    picture.attributes.push_back({"comments", "sky:" + words});
    return written(image::write(picture, path));
  }
  image::Image image = asImage(picture);
  if (verb.extension() == ".hdr") return written(image::write(image, path));
  const float ev = verb.development.exposureFor(image);
  return written(image::write(tone::toneMap(std::move(image), ev, verb.development.curve), path));
}

/// What all moments of a command have in common.
struct Plan {
  sky::SkyPictureOptions picture;
  sky::ReadingOptions reading;
  std::vector<Vec3d> directions;
  SkyTable table;
  std::size_t frames = 0;
};

Result<Plan> planOf(const SkyVerb& verb, const Suns& suns) {
  Plan plan;
  plan.frames = suns.resolved.size();
  if (verb.drawsPicture()) {
    const auto shape = verb.map.shape();
    if (!shape) return shape.error();
    plan.picture.shape = *shape;
    const bool camera = shape->map == sky::PictureMap::Camera;
    if (camera && !verb.map.look) {
      // One that does not turn while the Sun moves.
      plan.picture.shape.lookBearing = suns.resolved[plan.frames / 2].sunBearing;
      plan.picture.shape.lookElevation = 15 * kPi / 180;
    }
    plan.picture.quantity = verb.map.quantity;
    plan.picture.sun = verb.map.sun.value_or(camera || verb.extension() == ".png");
    plan.picture.wavelengths =
        verb.at.wavelengths.empty() ? wavelengthsOf({}) : verb.at.wavelengths;
  }
  const auto directions = verb.at.directions();
  if (!directions) return directions.error();
  for (const AtArguments::Direction& at : *directions)
    plan.directions.push_back(
        math::directionFromAzimuthElevation(at.azimuth * kPi / 180, at.elevation * kPi / 180));
  plan.reading.wavelengths = verb.at.wavelengths;
  plan.reading.sun = verb.map.sun.value_or(false);
  plan.table = {*directions, verb.at.wavelengths, verb.at.magnitudes};
  for (const sky::ResolvedSky& sun : suns.resolved)
    plan.table.magnitudes |= sun.options.sunElevation < kMagnitudesBelow;
  return plan;
}

Result<SkyMoment> runMoment(const SkyVerb& verb, Plan& plan, sky::SkyMaker& maker,
                            sky::ResolvedSky resolved, const fs::path& path, Console& console) {
  resolved.options.wavelengths = wavelengthsOf(verb.at.wavelengths);
  resolved.options.cache = sky::cacheFolder();
  const auto made = maker.make(resolved.options, console.progress());
  if (!made) return made.error();
  console.report(made->findings);
  const sky::Sky& sky = made->value;
  SkyMoment moment;
  // A sum over the dome, which an exact one takes its time for: where it is told.
  if (console.options().json || (!verb.at.given() && !verb.sequence.span))
    moment.brightness = console.stage("brightness", [&] { return sky::brightnessOf(sky); });
  plan.picture.below = plan.reading.below = sky::belowHorizonOf(resolved.options.model);
  moment.readings = sky::readSky(sky, plan.directions, plan.reading);
  if (!path.empty()) {
    plan.picture.worldFromSun = resolved.worldFromSun;
    auto picture = sky::drawSky(sky, plan.picture, console.progress());
    if (!picture) return picture.error();
    const Status done = console.stage(
        "write", [&] { return writePicture(verb, std::move(*picture), verb.sky.inWords(), path); });
    if (!done) return done.error();
    moment.output = path.string();
  }
  moment.resolved = std::move(resolved);
  return moment;
}

Status runHaze(const SkyVerb& verb, Console& console) {
  auto resolved = sky::resolve(verb.sky.request);
  if (!resolved) return resolved.error();
  console.report(resolved->findings);
  resolved->value.options.cache = sky::cacheFolder();
  auto picture = hazyPicture(verb.haze, verb.map, verb.given("--map"), resolved->value, console);
  if (!picture) return picture.error();
  const std::string size = fmt::format("{}x{}", picture->width, picture->height);
  const bool numeric = verb.given("--exposure") && verb.development.exposure != "auto";
  const Status done = console.stage("write", [&] {
    if (verb.extension() == ".png") {
      const float ev = verb.development.exposureFor(*picture);
      return written(image::write(tone::toneMap(std::move(*picture), ev, verb.development.curve),
                                  verb.output.path));
    }
    if (numeric)
      for (Rgb& pixel : picture->pixels) pixel *= std::exp2(verb.development.exposureFor({}));
    return written(image::write(*picture, verb.output.path));
  });
  if (!done) return done.error();
  return console.finish({{"request", verb.sky.inWords()}, {"output", verb.output.path.string()}},
                        fmt::format("{}: {} through the air\n", verb.output.path.string(), size));
}

/// The summary, or the rows where they are the result.
std::string textFor(const SkyVerb& verb, const Plan& plan, const std::vector<SkyMoment>& moments) {
  if (verb.at.given() && verb.extension() != ".csv") return csvOf(plan.table, moments);
  if (verb.extension() == ".csv")
    return fmt::format("{}: {} rows\n", verb.output.path.string(),
                       plan.directions.size() * moments.size());
  if (!verb.drawsPicture()) return textOf(plan.table, moments.front());
  const std::string what =
      fmt::format("{}x{} {}, {}", plan.picture.shape.width, plan.picture.shape.height,
                  nameOf(verb.map.map), nameOf(verb.map.quantity));
  if (!verb.sequence.span)
    return fmt::format("{}: {}\n{}", moments.front().output, what,
                       textOf(plan.table, moments.front()));
  return fmt::format("{} … {}: {} pictures, {}\n", moments.front().output, moments.back().output,
                     moments.size(), what);
}

Status runSky(SkyVerb& verb, Console& console) {
  if (verb.output.path == "-" && verb.sequence.span && verb.output.format() != ".csv")
    return badUsage(
        "-o - is one picture, and --sequence makes many: name OUT.png, or ask for "
        "--format csv");
  if (Status taken = verb.output.take(console); !taken) return taken;
  if (Status useful = checkUse(verb); !useful) return useful;
  const auto moments = verb.sequence.moments(verb.sky.request);
  if (!moments) return moments.error();
  if (Status distinct = namedFiles(verb, moments->size()).check(); !distinct) return distinct;
  if (verb.haze.given()) return runHaze(verb, console);
  const auto suns = sunsOf(verb, *moments, console);
  if (!suns) return suns.error();
  auto plan = planOf(verb, *suns);
  if (!plan) return plan.error();

  sky::SkyMaker maker;  // its tables serve all moments
  std::vector<SkyMoment> made;
  Json json = Json::array();
  for (std::size_t i = 0; i < plan->frames; ++i) {
    fs::path path;
    if (verb.drawsPicture())
      path = verb.sequence.span ? framePath(verb.output.path, i + 1, moments->size())
                                : verb.output.path;
    auto moment = runMoment(verb, *plan, maker, suns->resolved[i], path, console);
    if (!moment) return moment.error();
    moment->time = suns->times[i];
    json.push_back(jsonOf(plan->table, *moment));
    made.push_back(std::move(*moment));
  }
  if (verb.extension() == ".csv") {
    const Status status = written(console.stage("write", [&] {
      return file::writeAtomically(verb.output.path, csvOf(plan->table, made));
    }));
    if (!status) return status;
  }
  Json summary = {{"request", verb.sky.inWords()}};
  if (!verb.output.path.empty()) summary["output"] = verb.output.path.string();
  if (verb.sequence.span)
    summary["frames"] = std::move(json);
  else
    summary.update(json.front());
  return console.finish(std::move(summary), textFor(verb, *plan, made));
}

}  // namespace

Verb addSky(CLI::App& root, ConsoleOptions& common) {
  auto verb = std::make_shared<SkyVerb>();
  CLI::App* app = root.add_subcommand(
      "sky", "The sky of a place and a moment: as a light, a picture, or numbers");
  verb->app = app;
  app->group("Verbs");
  app->footer(std::string(kSkyExamples));
  verb->sky.addTo(*app);
  verb->sequence.addTo(*app);
  verb->output.addTo(
      *app, "OUT.exr|OUT.png|OUT.csv",
      "The picture: .exr or .hdr in true units, .png for the eye; or rows of --at, .csv",
      "Picture");
  verb->map.addTo(*app);
  verb->at.addTo(*app);
  verb->haze.addTo(*app);
  verb->development.addTo(*app);
  addCommonOptions(*app, common);
  return {app, [verb](Console& console) { return runSky(*verb, console); }};
}

}  // namespace lambent::tool
