// --size and --camera; --exposure and --tone: what a picture shows and how it is developed.
#pragma once

#include <optional>
#include <string>

#include "apps/lambent/arguments.h"
#include "apps/lambent/console.h"
#include "lambent/image/image.h"
#include "lambent/report/result.h"
#include "lambent/scene/scene.h"
#include "lambent/tone/tone_curve.h"

namespace lambent::tool {

struct ViewArguments {
  Size size{1024, 1024};
  std::string camera;  ///< name or number in the file, "auto", or empty: the file's first, if any
  bool background = false;

  /// `mostPixels`: a side.
  void addTo(CLI::App& app, int mostPixels);
  Result<scene::Camera> choose(const scene::Scene& scene) const;
};

struct DevelopmentArguments {
  std::string exposure = "auto";  ///< EV, or auto
  tone::Curve curve = tone::Curve::Filmic;

  void addTo(CLI::App& app);
  /// The exposure in EV for this picture.
  float exposureFor(const image::Image& picture) const;
};

/// The EV that takes the log-average luminance of what is covered and lit to a middle grey.
float automaticExposure(const image::Image& picture);

}  // namespace lambent::tool
