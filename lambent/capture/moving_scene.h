// What is around an object and moves: lamps and occluders, as plain values.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "lambent/math/types.h"
#include "lambent/report/finding.h"
#include "lambent/report/result.h"
#include "lambent/scene/scene.h"

namespace lambent::capture {

/// Turning about a line, at constant speed, counter-clockwise as seen from where `axis` points to.
struct Turn {
  Vec3 axis = Vec3::UnitY();   ///< unit
  Vec3 center = Vec3::Zero();  ///< a point on the line, metres
  double period = 0;           ///< seconds for a turn; 0: it stands still at `phase`
  double phase = 0;            ///< of a turn, at time 0
};

/// To and fro along a line: amplitude · sin 2π(t/period + phase).
struct Swing {
  Vec3 amplitude = Vec3::Zero();  ///< metres
  double period = 0;              ///< seconds; 0: it stands still at `phase`
  double phase = 0;               ///< of a period, at time 0
};

/// A body turns in its own frame, is put in its place, goes about a line and swings, in this
/// sequence.
struct Motion {
  Turn spin;
  Vec3 place = Vec3::Zero();  ///< metres
  Turn orbit;
  Swing swing;
};

/// The rigid transform of a body at a time in seconds.
Mat4 worldFromBody(const Motion& motion, double time);

/// A surface that looks the same from everywhere in front of it: a lamp if it is bright, else an
/// occluder. It neither reflects nor is lit. Its back is black, as backs are everywhere in Lambent.
struct Body {
  std::string name;
  scene::Mesh mesh;            ///< in the body's frame; positions and triangles count
  Rgb radiance = Rgb::Zero();  ///< W m⁻² sr⁻¹
  Motion motion;
};

struct MovingScene {
  std::vector<Body> bodies;
  Vec3d origin = Vec3d::Zero();  ///< as of scene::Scene: where (0, 0, 0) lies, metres
};

/// The same bodies at the same places of the world, with (0, 0, 0) at `origin`: beside an asset that
/// stands far away.
MovingScene about(MovingScene scene, const Vec3d& origin);

/// How it stands at a time: every body a mesh of a black material that emits. For the path tracer,
/// and for capture by rays.
scene::Scene frozen(const MovingScene& scene, double time);

/// A box that holds all bodies as they stand at a time; not the smallest. Empty without bodies.
scene::Box bounds(const MovingScene& scene, double time);

struct LoadedMovingScene {
  MovingScene scene;
  Findings findings;
  std::vector<std::filesystem::path> linkedFiles = {};  ///< as of scene_io::LoadedScene
};

/// As of scene_io::LoadOptions.
struct MovingSceneOptions {
  bool allowOutside = false;
  std::optional<std::uint64_t> memoryLimit = {};  ///< bytes
};

/// Every mesh of a file (glTF: emissiveFactor × KHR_materials_emissive_strength is a material's
/// radiance) as a body that stands where it stands in the file. What does not emit is a black
/// occluder. Files carry no motions: animations are not read. Errors as scene_io::load's.
Result<LoadedMovingScene> loadMovingScene(const std::filesystem::path& path,
                                          const MovingSceneOptions& options = {});

}  // namespace lambent::capture
