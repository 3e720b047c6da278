#include "apps/lambent/sky_haze.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <optional>

#include "lambent/image/io.h"

namespace lambent::tool {

namespace {

Choices<sky::DepthAlong> depths() {
  return {{"ray", sky::DepthAlong::Ray}, {"axis", sky::DepthAlong::Axis}};
}

Choices<sky::AerialForm> forms() {
  return {{"exact", sky::AerialForm::Exact},
          {"table", sky::AerialForm::Table},
          {"constant", sky::AerialForm::Constant}};
}

}  // namespace

void HazeArguments::addTo(CLI::App& app) {
  app.add_option("--haze", pictures,
                 "Aerial perspective for a picture that was made without air: its colours (linear, "
                 "in W/m²/sr) and its depths in metres (the first channel; where it is 0, infinite "
                 "or above 1e9 nothing stands). The picture is a camera's (--look, --fov) if --map "
                 "does not say another")
      ->expected(2)
      ->option_text("COLOUR.exr DEPTH.exr")
      ->group("Haze");
  addChoice(app, "--depth-along", along, depths(),
            "ray: depths are distances; axis: they are measured along the camera's axis (z)")
      ->option_text("ray|axis")
      ->group("Haze");
  addNumber(app, "--depth-unit", metres, {1e-6, 1e6}, "Metres in one unit of depth")
      ->option_text("METRES")
      ->group("Haze");
  addChoice(app, "--haze-form", form, forms(),
            "table (of the integral, made for this Sun), exact (the integral at every pixel), or "
            "constant (closed form for air of the viewer's density and light scattered once)")
      ->option_text("NAME")
      ->group("Haze");
  app.add_flag("--haze-sky", backdrop, "Fill in the sky where nothing stands")->group("Haze");
}

void HazeArguments::addFilesTo(NamedFiles& files) const {
  for (const std::filesystem::path& picture : pictures) files.reads("--haze", picture);
}

Result<image::Image> hazyPicture(const HazeArguments& haze, const MapArguments& map, bool mapGiven,
                                 const sky::ResolvedSky& resolved, Console& console) {
  auto read = image::readPicture(haze.pictures[0]);
  if (!read) return read.error();
  if (Status whole = console.accept(read->findings); !whole) return whole.error();
  const image::Image* const color = &read->image;
  const auto depth = image::read(haze.pictures[1]);
  if (!depth) return depth.error();

  MapArguments picture = map;
  if (!mapGiven) picture.map = sky::PictureMap::Camera;
  picture.size = MapArguments::Sides{color->width, color->height};
  const auto shape = picture.shape();
  if (!shape) return shape.error();
  sky::HazeOptions options;
  options.shape = *shape;
  if (picture.map == sky::PictureMap::Camera && !map.look) {
    options.shape.lookBearing = resolved.sunBearing;
    options.shape.lookElevation = 15 * kPi / 180;
  }
  options.worldFromSun = resolved.worldFromSun;
  options.depth = haze.along;
  options.metres = haze.metres;
  if (const Status fits = sky::checkHaze(*color, *depth, options); !fits) return fits.error();

  const auto air = sky::makeAerialPerspective(resolved.options, haze.form, console.progress());
  if (!air) return air.error();
  console.report(air->findings);
  std::optional<sky::Sky> backdrop;
  if (haze.backdrop) {
    auto made = sky::makeSky(resolved.options, console.progress());
    if (!made) return made.error();
    console.report(made->findings);
    backdrop = std::move(made->value);
    options.backdrop = &*backdrop;
    options.below = sky::belowHorizonOf(resolved.options.model);
  }
  return sky::haze(*color, *depth, air->value, options, console.progress());
}

}  // namespace lambent::tool
