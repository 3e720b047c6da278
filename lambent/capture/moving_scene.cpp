#include "lambent/capture/moving_scene.h"

#include <cmath>

#include <Eigen/Geometry>

#include "lambent/scene/shapes.h"
#include "lambent/scene_io/load.h"

namespace lambent::capture {
namespace {

using Isometry = Eigen::Isometry3d;

/// Radians after a time, within a turn so that long times lose nothing.
double angleAt(double period, double phase, double time) {
  const double turns = (period == 0 ? 0 : time / period) + phase;
  return 2 * kPi * (turns - std::floor(turns));
}

Isometry turned(const Turn& turn, double time) {
  const Vec3d center = turn.center.cast<double>();
  const Eigen::AngleAxisd rotation(angleAt(turn.period, turn.phase, time),
                                   turn.axis.cast<double>().normalized());
  return Isometry(Eigen::Translation3d(center) * rotation * Eigen::Translation3d(-center));
}

}  // namespace

Mat4 worldFromBody(const Motion& motion, double time) {
  const Vec3d swing = motion.swing.amplitude.cast<double>() *
                      std::sin(angleAt(motion.swing.period, motion.swing.phase, time));
  const Isometry transform = Eigen::Translation3d(swing) * turned(motion.orbit, time) *
                             Eigen::Translation3d(motion.place.cast<double>()) *
                             turned(motion.spin, time);
  return transform.matrix().cast<float>();
}

scene::Scene frozen(const MovingScene& scene, double time) {
  scene::Scene result;
  for (const Body& body : scene.bodies) {
    scene::Material material;
    material.name = body.name;
    material.diffuse = Rgb::Zero();
    material.emission = body.radiance;
    scene::addTo(result, scene::transformed(body.mesh, worldFromBody(body.motion, time)),
                 std::move(material));
  }
  return result;
}

// Of each body the ball about the middle of its box: no corner has to be turned.
scene::Box bounds(const MovingScene& scene, double time) {
  scene::Box result;
  for (const Body& body : scene.bodies) {
    scene::Box own;
    for (const Vec3& p : body.mesh.positions) own.extend(p);
    if (own.empty()) continue;
    const Mat4 placed = worldFromBody(body.motion, time);
    const Vec3 center =
        placed.topLeftCorner<3, 3>() * own.center() + Vec3(placed.topRightCorner<3, 1>());
    result.extend(center - Vec3::Constant(0.5f * own.diagonal()));
    result.extend(center + Vec3::Constant(0.5f * own.diagonal()));
  }
  return result;
}

Result<LoadedMovingScene> loadMovingScene(const std::filesystem::path& path,
                                          const MovingSceneOptions& options) {
  Result<scene_io::LoadedScene> loaded = scene_io::load(path, {.allowOutside = options.allowOutside,
                                                               .memoryLimit = options.memoryLimit,
                                                               .sides = scene_io::Sides::One});
  if (!loaded) return loaded.error();
  LoadedMovingScene result;
  result.findings = std::move(loaded->findings);
  result.linkedFiles = std::move(loaded->linkedFiles);
  std::uint64_t lamps = 0;
  for (scene::Mesh& mesh : loaded->scene.meshes) {
    const scene::Material& material = loaded->scene.materials[std::size_t(mesh.material)];
    lamps += material.isEmitter();
    std::string name = mesh.name.empty() ? material.name : mesh.name;
    result.scene.bodies.push_back({std::move(name), std::move(mesh), material.emission, {}});
  }
  if (lamps == 0)
    result.findings.push_back(
        {Severity::Note, "no-lamps",
         path.string() + ": no material emits light, so everything in it is a black occluder. "
                         "Give lamps an emissiveFactor (and KHR_materials_emissive_strength)",
         result.scene.bodies.size()});
  return result;
}

}  // namespace lambent::capture
