// Primaries → Rec. 709: SMPTE RP 177 (the matrix of primaries), ICC.1:2022 annex E (Bradford).
#include "lambent/radiometry/primaries.h"

#include <array>
#include <cctype>
#include <cmath>
#include <string>
#include <utility>

#include <Eigen/LU>

namespace lambent::radiometry {
namespace {

const Vec2d kD65{.3127, .3290}, kD50{.3457, .3585}, kAcesWhite{.32168, .33767};

const Primaries kRec709{{.64, .33}, {.30, .60}, {.15, .06}, kD65};
const Primaries kRec2020{{.708, .292}, {.170, .797}, {.131, .046}, kD65};
const Primaries kP3{{.680, .320}, {.265, .690}, {.150, .060}, kD65};
const Primaries kAdobe{{.64, .33}, {.21, .71}, {.15, .06}, kD65};
const Primaries kProPhoto{{.7347, .2653}, {.1596, .8404}, {.0366, .0001}, kD50};
/// SMPTE ST 2065-1 and, with AP1, S-2014-004 (ACEScg).
const Primaries kAp0{{.7347, .2653}, {0, 1}, {.0001, -.0770}, kAcesWhite};
const Primaries kAp1{{.713, .293}, {.165, .830}, {.128, .044}, kAcesWhite};
const Primaries kXyz{{1, 0}, {0, 1}, {0, 0}, {1. / 3, 1. / 3}};

/// What names in use contain, without their signs: the OpenColorIO configurations of ACES,
/// OpenEXR's colorInteropID, OpenImageIO.
const std::array<std::pair<std::string_view, const Primaries*>, 18> kNames{
    {{"acescg", &kAp1},
     {"ap1", &kAp1},
     {"aces2065", &kAp0},
     {"ap0", &kAp0},
     {"rec2020", &kRec2020},
     {"bt2020", &kRec2020},
     {"p3d65", &kP3},
     {"displayp3", &kP3},
     {"adobergb", &kAdobe},
     {"a98rgb", &kAdobe},
     {"prophoto", &kProPhoto},
     {"romm", &kProPhoto},
     {"ciexyz", &kXyz},
     {"xyzd65", &kXyz},
     {"rec709", &kRec709},
     {"bt709", &kRec709},
     {"srgb", &kRec709},
     {"xyz", &kXyz}}};

Vec3d xyzOf(const Vec2d& xy) {
  return {xy.x() / xy.y(), 1, (1 - xy.x() - xy.y()) / xy.y()};
}

/// The columns are X, Y, Z of red, green, blue; white has Y = 1.
Mat3d xyzFrom(const Primaries& p) {
  Mat3d directions;
  int column = 0;
  for (const Vec2d* xy : {&p.red, &p.green, &p.blue})
    directions.col(column++) << xy->x(), xy->y(), 1 - xy->x() - xy->y();
  const Vec3d scale = directions.inverse() * xyzOf(p.white);
  return directions * scale.asDiagonal();
}

Mat3d d65FromWhite(const Vec2d& white) {
  Mat3d cones;
  cones << .8951, .2664, -.1614, -.7502, 1.7135, .0367, .0389, -.0685, 1.0296;
  const Vec3d ratio = (cones * xyzOf(kD65)).cwiseQuotient(cones * xyzOf(white));
  return cones.inverse() * ratio.asDiagonal() * cones;
}

bool isFinite(const Primaries& p) {
  return p.red.allFinite() && p.green.allFinite() && p.blue.allFinite() && p.white.allFinite();
}

}  // namespace

const Primaries& rec709Primaries() {
  return kRec709;
}

const Primaries& xyzPrimaries() {
  return kXyz;
}

std::optional<Primaries> primariesNamed(std::string_view name) {
  std::string plain;
  for (const char c : name)
    if (std::isalnum(static_cast<unsigned char>(c)))
      plain += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  for (const auto& [known, primaries] : kNames)
    if (plain.find(known) != std::string::npos) return *primaries;
  return std::nullopt;
}

bool isNear(const Primaries& a, const Primaries& b, double tolerance) {
  return (a.red - b.red).cwiseAbs().maxCoeff() <= tolerance &&
         (a.green - b.green).cwiseAbs().maxCoeff() <= tolerance &&
         (a.blue - b.blue).cwiseAbs().maxCoeff() <= tolerance &&
         (a.white - b.white).cwiseAbs().maxCoeff() <= tolerance;
}

std::optional<Mat3d> rec709From(const Primaries& primaries) {
  if (!isFinite(primaries) || primaries.white.y() < 1e-3) return std::nullopt;
  const Vec2d a = primaries.green - primaries.red, b = primaries.blue - primaries.red;
  if (std::abs(a.x() * b.y() - a.y() * b.x()) < 1e-4) return std::nullopt;
  const Mat3d rgbFromXyz = xyzFrom(kRec709).inverse();
  if (isNear(primaries, kXyz)) return rgbFromXyz;
  return Mat3d(rgbFromXyz * d65FromWhite(primaries.white) * xyzFrom(primaries));
}

}  // namespace lambent::radiometry
