// --view STATE.json: a picture of what was set up in a viewer.
#pragma once

#include <filesystem>

#include "apps/lambent/console.h"
#include "apps/lambent/light_arguments.h"
#include "apps/lambent/picture_arguments.h"
#include "lambent/light/environment.h"
#include "lambent/report/result.h"
#include "lambent/scene/camera.h"
#include "lambent/shade/sharp_sun.h"
#include "lambent/view/view_state.h"

namespace lambent::tool {

struct StateArguments {
  std::filesystem::path path;

  /// `light` need then not be given.
  void addTo(CLI::App& app, CLI::Option* light);
  bool given() const { return !path.empty(); }
  /// The file's state. What `app` was told explicitly by the options that these arguments added
  /// stands in it instead; the development takes the state's exposure and curve where it was told
  /// none.
  Result<view::ViewState> read(const CLI::App& app, const LightArguments& light,
                               const ViewArguments& view, DevelopmentArguments& development) const;
};

/// A state reduced to the asset's own frame, where a picture is made.
struct Shot {
  light::Environment environment;
  sh::RgbCoefficients light;  ///< windowed
  scene::Camera camera;
  std::optional<shade::SharpSun> sun = {};         ///< where its shadows are to be sharp
  std::string source = {};                         ///< what the environment was made of
  Mat3d assetFromEnvironment = Mat3d::Identity();  ///< how it was turned after that
  Vec3 worldOrigin = Vec3::Zero();                 ///< where the world's origin came to lie
};

struct ShotOptions {
  const ViewArguments& view;  ///< a camera that is named there wins over the state's
  int bands;                  ///< of the light
  const ReadingArguments& reading;
};
Result<Shot> shotOf(const view::ViewState& state, const scene::Scene& scene,
                    const ShotOptions& options, Console& console);

}  // namespace lambent::tool
