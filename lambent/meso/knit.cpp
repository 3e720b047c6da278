// Stockinette, the plain knit, from its right side: courses of yarn along x, each drawn in loops
// through the one below.
//
// A stitch of width w and a course of height c; s runs along the yarn by a turn of 2π a stitch:
//   x = w (s/2π + a sin 2s)     necks narrower than heads: the omega of a loop
//   y = w h cos s               heads at s = 0, feet at π; 2h above c/w: they reach into the next
//                               courses
//   z = −w d cos 2s             legs before, heads and feet behind
// Every course is the same curve a course further up. So a course's legs cross before the heads of
// the one below, and its feet behind that one's legs: it comes through the loops from behind, as a
// needle draws it. a, h and d are such that yarns of a quarter of a stitch touch and no more: where
// they come nearest, axes are 0.25 w apart between courses, 0.24 w between the legs of a course.
#include <algorithm>
#include <cassert>
#include <cmath>
#include <string>
#include <utility>

#include <Eigen/Geometry>

#include "lambent/meso/generators.h"
#include "lambent/meso/tube.h"

namespace lambent::meso {

namespace {

constexpr double kNeck = 0.24, kReach = 0.63, kSwing = 0.16;  // a, h, d of the legend
constexpr double kUsualCourse = 0.75;                         // c/w that they are made for

class Yarn {
 public:
  explicit Yarn(const KnitOptions& options)
      : width_(double(options.size.x()) / options.stitches),
        course_(double(options.size.y()) / options.courses),
        thickness_(std::min(width_, course_ / kUsualCourse)),
        plies_(options.plies),
        plyDepth_(options.plyDepth),
        turns_(std::round(options.turns)),
        radius_(0.5 * options.yarn * thickness_) {}

  double width() const { return width_; }
  double course() const { return course_; }

  Vec3d axis(double s) const {
    return {width_ * (s / (2.0 * kPi) + kNeck * std::sin(2.0 * s)),
            course_ / kUsualCourse * kReach * std::cos(s),
            -thickness_ * kSwing * std::cos(2.0 * s)};
  }

  /// angle 0 is the yarn's left side, a quarter turn its top.
  Vec3d point(double s, double angle) const {
    const Vec3d along(width_ * (1.0 / (2.0 * kPi) + 2.0 * kNeck * std::cos(2.0 * s)),
                      -course_ / kUsualCourse * kReach * std::sin(s),
                      2.0 * thickness_ * kSwing * std::sin(2.0 * s));
    const Vec3d side = Vec3d::UnitZ().cross(along).normalized();
    const Vec3d up = along.cross(side).normalized();
    double radius = radius_;
    if (plies_ > 0) {
      // As a weave's thread: sharp valleys between strands, softened to what the facets hold.
      const double twist = plies_ * angle + turns_ * s;
      radius *= 1.0 - plyDepth_ * (1.0 - std::sqrt(0.06 + std::pow(std::sin(0.5 * twist), 2)));
    }
    return axis(s) + radius * (std::cos(angle) * side + std::sin(angle) * up);
  }

  Vec3d normal(double s, double angle) const {
    return tubeNormal([&](double at, double around) { return point(at, around); }, s, angle);
  }

 private:
  double width_, course_, thickness_;  // metres; thickness_: what a stitch's width is to its depth
  int plies_;
  double plyDepth_, turns_, radius_;
};

}  // namespace

Patch knit(const KnitOptions& options) {
  assert(options.stitches >= 1 && options.courses >= 1);
  const Yarn yarn(options);
  Patch patch;
  patch.name = "knit";
  patch.size = options.size;
  patch.backing = options.backing;
  scene::Material material;
  material.name = "yarn";
  material.diffuse = options.color;
  material.glossy = options.glossy;
  material.lobeExponent = options.lobeExponent;
  patch.scene.materials = {material};
  for (int course = 0; course < options.courses; ++course) {
    scene::Mesh& mesh = patch.scene.meshes.emplace_back();
    mesh.name = "course " + std::to_string(course);
    const int rows = options.along * options.stitches;
    appendTube(mesh, rows, options.around, [&](int row, double angle) {
      // Every stitch repeats the first to the last bit, a stitch's width further on. Yarns end in
      // the middle of a leg: not where they reach furthest along y, which is no border.
      const double s = kPi * (0.5 + 2.0 * (row % options.along) / options.along);
      const Vec3d offset((row / options.along + 0.5) * yarn.width(), (course + 0.5) * yarn.course(),
                         0.0);
      return std::pair<Vec3d, Vec3d>(yarn.point(s, angle) + offset, yarn.normal(s, angle));
    });
  }
  return patch;
}

}  // namespace lambent::meso
