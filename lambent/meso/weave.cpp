// This work is based on:
// - sloan2003biscale: §4.2, "the weave example consists of interleaved, deformed cylinders".
#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include <Eigen/Geometry>

#include "lambent/meso/generators.h"
#include "lambent/meso/tube.h"

namespace lambent::meso {

namespace {

/// One thread before it is laid along an axis: s runs along it in `spacing`s between the threads
/// that it crosses; `phase` says whether it begins above (0) or below (1). Width and height in
/// metres.
class Thread {
 public:
  Thread(const WeaveOptions& options, double spacing, double width, double height, int phase)
      : options_(options), spacing_(spacing), width_(width), height_(height), phase_(phase) {
    // Whole turns in a period of the weave.
    turns_ = std::round(options.turns * options.threads) / options.threads;
  }

  /// A point of the surface in (along, sideways, up), metres. angle 0 is its side, ¼ turn its top.
  Vec3d point(double s, double angle) const {
    const double a = kPi * (s + phase_);
    const double swing = 0.54 * height_;  // over and under by a little more than
                                          // half a thread: they hardly touch
    const Vec3d centre(s * spacing_, 0.0, swing * std::cos(a));
    const double slope = -swing * kPi / spacing_ * std::sin(a);
    const Vec3d up = Vec3d(-slope, 0.0, 1.0).normalized();
    // Pressed flat and wide at the crossings, rounder between them.
    const double flat = 0.06 * std::cos(2.0 * a);
    const double halfWidth = 0.5 * width_ * (1.0 + flat);
    const double halfHeight = 0.5 * height_ * (1.0 - flat);
    double groove = 1.0;
    if (options_.plies > 0) {
      const double twist = options_.plies * (angle + 2.0 * kPi * turns_ * s);
      // |sin| has the sharp valleys of strands that lie side by side; softened, so that its normals
      // are no finer than the facets.
      groove -= options_.plyDepth * (1.0 - std::sqrt(0.06 + std::pow(std::sin(0.5 * twist), 2)));
    }
    return centre + groove * (halfWidth * std::cos(angle) * Vec3d::UnitY() +
                              halfHeight * std::sin(angle) * up);
  }

  double spacing() const { return spacing_; }

  Vec3d normal(double s, double angle) const {
    return tubeNormal([&](double at, double around) { return point(at, around); }, s, angle);
  }

 private:
  const WeaveOptions& options_;
  double spacing_, width_, height_, turns_;
  int phase_;
};

/// One period of a thread's length, appended. `place` takes (along, sideways, up) to the patch.
template <class Place>
void append(scene::Mesh& mesh, const Thread& thread, const WeaveOptions& options,
            const Place& place, Winding winding) {
  const int rows = options.along * options.threads;
  appendTube(
      mesh, rows, options.around,
      [&](int row, double angle) {
        // The end repeats the beginning to the last bit, a period further on.
        const double s = double(row) / options.along, wrapped = row == rows ? 0.0 : s;
        Vec3d p = thread.point(wrapped, angle);
        if (row == rows) p.x() += s * thread.spacing();
        return std::pair<Vec3d, Vec3d>(place(p, true), place(thread.normal(wrapped, angle), false));
      },
      winding);
}

scene::Material threadMaterial(const char* name, const Rgb& color, const WeaveOptions& options) {
  scene::Material material;
  material.name = name;
  material.diffuse = color;
  material.glossy = options.glossy;
  material.lobeExponent = options.lobeExponent;
  return material;
}

}  // namespace

Patch weave(const WeaveOptions& options) {
  assert(options.threads >= 2 && options.threads % 2 == 0);
  const double across[2] = {double(options.size.x()) / options.threads,
                            double(options.size.y()) / options.threads};
  Patch patch;
  patch.name = "weave";
  patch.size = options.size;
  patch.backing = options.backing;
  patch.scene.materials = {threadMaterial("warp", options.warp, options),
                           threadMaterial("weft", options.weft, options)};
  patch.scene.meshes.resize(2);
  for (int kind = 0; kind < 2; ++kind) {
    scene::Mesh& mesh = patch.scene.meshes[kind];
    mesh.name = kind == 0 ? "warp" : "weft";
    mesh.material = kind;
    // The warp's length lies along y, the weft's along x; both are as thick as the smaller spacing
    // says. Crossings lie at whole numbers of s, shifted to the middles of cells.
    const double spacing = across[kind == 0 ? 1 : 0], sideways = across[kind];
    for (int t = 0; t < options.threads; ++t) {
      const Thread thread(options, spacing, options.width * sideways,
                          options.height * std::min(across[0], across[1]), (t + kind) % 2);
      const double offset = (t + 0.5) * sideways, start = 0.5 * spacing;
      append(
          mesh, thread, options,
          [&](const Vec3d& p, bool isPoint) -> Vec3d {
            const double along = p.x() + (isPoint ? start : 0.0);
            const double side = p.y() + (isPoint ? offset : 0.0);
            return kind == 0 ? Vec3d(side, along, p.z()) : Vec3d(along, side, p.z());
          },
          kind == 0 ? Winding::Turned : Winding::Kept);
    }
  }
  return patch;
}

}  // namespace lambent::meso
