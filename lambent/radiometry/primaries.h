// The primaries that colours of a file are mixtures of, and how they become those of Rec. 709.
#pragma once

#include <optional>
#include <string_view>

#include "lambent/math/types.h"

namespace lambent::radiometry {

/// CIE 1931 x, y of what (1,0,0), (0,1,0), (0,0,1) and (1,1,1) stand for.
struct Primaries {
  Vec2d red, green, blue, white;
};

/// ITU-R BT.709, with D65.
const Primaries& rec709Primaries();
/// X, Y and Z themselves.
const Primaries& xyzPrimaries();
/// By a name in use, in any case: "ACEScg", "lin_ap1_scene", "Rec.2020", "P3-D65", "Adobe RGB", …
/// with a transfer function before or behind it or none. Nothing for a name not known.
std::optional<Primaries> primariesNamed(std::string_view name);

/// Whether no coordinate differs by more than `tolerance`.
bool isNear(const Primaries& a, const Primaries& b, double tolerance = 2e-4);

/// Linear colours → linear Rec. 709. White becomes white: what was seen under the file's white is
/// adapted to D65 by Bradford's cones (lindbloom). The primaries of XYZ have no white in that
/// sense: XYZ is taken as measured, and not adapted. Nothing if the primaries span no triangle,
/// or white or a coordinate is none.
std::optional<Mat3d> rec709From(const Primaries& primaries);

}  // namespace lambent::radiometry
