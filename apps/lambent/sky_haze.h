// lambent sky --haze: the air of a sky put into a picture.
#pragma once

#include <filesystem>
#include <vector>

#include "apps/lambent/arguments.h"
#include "apps/lambent/console.h"
#include "apps/lambent/named_files.h"
#include "apps/lambent/sky_arguments.h"
#include "lambent/image/image.h"
#include "lambent/report/result.h"
#include "lambent/sky/haze.h"
#include "lambent/sky/make_aerial_perspective.h"

namespace lambent::tool {

/// --haze and what belongs to it.
struct HazeArguments {
  std::vector<std::filesystem::path> pictures;  ///< colour, depth
  sky::DepthAlong along = sky::DepthAlong::Ray;
  sky::AerialForm form = sky::AerialForm::Table;
  double metres = 1;
  bool backdrop = false;

  void addTo(CLI::App& app);
  bool given() const { return !pictures.empty(); }
  void addFilesTo(NamedFiles& files) const;
};

/// The hazy picture. `map`: where its pixels look; a camera's unless `mapGiven`. The sky is the one
/// that was resolved, and its cache is used for the backdrop.
Result<image::Image> hazyPicture(const HazeArguments& haze, const MapArguments& map, bool mapGiven,
                                 const sky::ResolvedSky& resolved, Console& console);

}  // namespace lambent::tool
