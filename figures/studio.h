// What every figure does: bake, light, take a picture.
#pragma once

#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "lambent/asset/asset.h"
#include "lambent/light/environment.h"
#include "lambent/macro/bake.h"
#include "lambent/reference/path_tracer.h"
#include "lambent/scene/camera.h"
#include "lambent/transfer/field.h"

namespace lambent::figures {

[[noreturn]] void die(const std::string& message);

/// What a figure needs and can not do without.
template <class T>
T orDie(Result<T> result) {
  if (!result) die(result.error().message);
  return std::move(*result);
}

struct Studio {
  std::filesystem::path inputs;         ///< bunny.obj, hdri/, dragon/, teapot.obj
  std::filesystem::path output;         ///< where pictures go
  bool quick = false;                   ///< fewer directions, paths and pixels, to try a figure out
  std::vector<double> suns = {60, 94};  ///< zenith angles of sky-accuracy, degrees
  std::vector<std::string> patches, forms;  ///< of synthesis; empty: all

  /// RTTs that one figure built and another may want, by the patch's name.
  std::shared_ptr<std::map<std::string, transfer::SimulatedRtt>> rtts =
      std::make_shared<std::map<std::string, transfer::SimulatedRtt>>();

  int directions() const { return quick ? 1024 : 8192; }
  int pixels(int full) const { return quick ? full / 2 : full; }
  int paths(int full) const { return quick ? std::max(8, full / 16) : full; }

  scene::Scene load(const std::string& file) const;  ///< exits with the reader's message
  light::Environment hdri(const std::string& name) const;
  void save(const image::Image& picture, const std::string& name) const;
};

/// A bake in memory, kept in 32 bits, and the seconds that it took.
struct Baked {
  asset::Asset asset;
  double seconds = 0.0;
};
Baked bake(const scene::Scene& scene, const macro::BakeOptions& options,
           const transport::Placement& placement = {});

/// Linear radiance, relit by `light`; mirrors see `environment` behind the asset.
image::Image photograph(const asset::Asset& asset, const sh::RgbCoefficients& light,
                        const light::Environment& environment, const scene::Camera& camera,
                        int width, int height);
image::Image pathTrace(const scene::Scene& scene, const light::Environment& environment,
                       const scene::Camera& camera, int width, int height, int paths, int bounces);

/// Tone-mapped over a light backdrop, ready for a sheet.
image::Image develop(const image::Image& linear, float exposureEv);

/// √(Σ (ours − truth)² − Σ variance) / √Σ truth², over what is covered.
double errorBeyondNoise(const image::Image& ours, const reference::Picture& truth);

/// What brings the mean of a picture to a middle grey.
float exposureOf(const image::Image& picture);

/// A camera at `eye` that looks at `target`.
scene::Camera lookAt(const Vec3& eye, const Vec3& target, float verticalFovDegrees);
/// From where `camera` stands, at `target`, as if from `factor` times as near.
scene::Camera zoomed(const scene::Camera& camera, const Vec3& target, float factor);

}  // namespace lambent::figures
