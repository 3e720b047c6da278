// All that a viewer shows, as values: so that a picture which somebody set up by hand in one viewer
// can be made again in another, by the tool or by the path tracer.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lambent/math/types.h"
#include "lambent/report/result.h"
#include "lambent/scene/camera.h"
#include "lambent/shade/air.h"
#include "lambent/shade/sharp_sun.h"
#include "lambent/shade/showing.h"
#include "lambent/tone/tone_curve.h"

namespace lambent::view {

/// States are written in degrees, for people read them.
inline constexpr double kRadiansPerDegree = kPi / 180.0;

/// Looks from `position` to `target`, which differ; `up` is not along the line of sight.
struct LookAt {
  Vec3 position = Vec3(0, 0, 3), target = Vec3::Zero(), up = Vec3::UnitY();
  double verticalFov = 40.0;                     ///< degrees; not used if orthographic
  std::optional<double> orthographicHalfHeight;  ///< metres
};

/// A disc of light, in the world: it does not turn with the environment.
struct Disc {
  double azimuth = 0, elevation = 45;  ///< degrees; azimuth from +x towards +z
  double diameter = 20;                ///< angular, degrees, > 0 and at most 360
  Rgb radiance = Rgb::Ones();
};

/// The air of the environment's sky, before what is seen (see shade/air.h).
struct AirShown {
  double metresPerUnit = 1;  ///< of the world; from shade::kLeastMetresPerUnit to kMost…
  bool shafts = false;       ///< of light, under a Sun whose shadows are sharp
};

struct ViewState {
  std::optional<LookAt> camera;  ///< none: the file's first camera, or scene::frameAutomatically
  /// Where the object is: unit quaternion x, y, z, w, and metres.
  std::array<double, 4> objectRotation{0, 0, 0, 1};
  Vec3 objectTranslation = Vec3::Zero();
  /// A SOURCE, as sources::parseSource takes it; files are sought from the current folder.
  std::string environment = "uniform:1";
  std::array<double, 4> environmentRotation{0, 0, 0, 1};
  std::vector<Disc> discs;
  std::string window = "auto";             ///< as light::parseWindowing takes it
  std::optional<transfer::Kind> transfer;  ///< none: the most that is held
  /// Of the light's Sun, if it has one (light::sunOf): on diffuse surfaces.
  shade::SunShadow sunShadow = shade::SunShadow::Sharp;
  std::optional<AirShown> air;  ///< none: nothing lies between camera and things
  bool macro = true;            ///< off: meso-structure takes the light as nothing hid it
  bool viewDependent = true;    ///< of meso-structure
  std::optional<double> lobe;   ///< exponent of glossy lobes instead of the materials'
  double exposure = 0;          ///< EV
  tone::Curve tone = tone::Curve::Filmic;
  bool background = true;
  int samples = 16;  ///< per pixel, once nothing moves; 1 … 4096
};

bool operator==(const LookAt& a, const LookAt& b);
bool operator==(const Disc& a, const Disc& b);
bool operator==(const AirShown& a, const AirShown& b);
bool operator==(const ViewState& a, const ViewState& b);

/// JSON:
/// {"lambent": "view", "version": 1,
///  "camera": null | {"position": [x,y,z], "target": [x,y,z], "up": [0,1,0], "verticalFov": 40,
///                    "orthographicHalfHeight": null | metres},
///  "object": {"rotation": [x,y,z,w], "translation": [x,y,z]},
///  "environment": {"source": "studio.exr", "rotation": [x,y,z,w]},
///  "discs": [{"azimuth": 30, "elevation": 45, "diameter": 20, "radiance": [r,g,b]}],
///  "window": "auto", "transfer": "best" | "unshadowed" | "shadowed" | "interreflected",
///  "sunShadow": "sharp" | "soft", "air": null | {"metresPerUnit": 1, "shafts": false},
///  "macro": true, "viewDependent": true, "lobe": null | 16, "exposure": 0,
///  "tone": "filmic" | "linear", "background": true, "samples": 16}
/// A member that is missing has its default; one that is unknown is passed over; one of the wrong
/// kind or out of range is BadInput that names it. Rotations are made unit. `name` stands in
/// messages for the file.
Result<ViewState> parseViewState(std::string_view json, const std::string& name);
Result<ViewState> readViewState(const std::filesystem::path& path);
/// Every number comes back as it was.
std::string toJson(const ViewState& state);
Status writeViewState(const ViewState& state, const std::filesystem::path& path);

}  // namespace lambent::view
