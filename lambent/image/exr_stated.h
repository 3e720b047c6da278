// What the header of an OpenEXR picture says that its numbers mean. Internal to this room.
#pragma once

#include <OpenEXR/ImfHeader.h>

#include <optional>
#include <string_view>

#include "lambent/image/image.h"
#include "lambent/image/maps.h"
#include "lambent/radiometry/primaries.h"
#include "lambent/report/finding.h"

namespace lambent::image::formats {

/// By `chromaticities`, else the flag of an ACES container (AP0), else a colour space's name; nothing
/// where the file says none: Rec. 709 then. "colour-primaries", "colour-not-linear": what is said but
/// cannot be used.
std::optional<radiometry::Primaries> statedPrimaries(const Imf::Header& header,
                                                     std::string_view name, Findings& findings);
/// By `envmap`.
std::optional<MapKind> statedMap(const Imf::Header& header);
/// "white-luminance", "pixel-aspect": what is said but not used.
void tellUnused(const Imf::Header& header, std::string_view name, Findings& findings);

/// A column of six faces as `envmap` has them → the same in the sequence and orientation of
/// MapKind::Cube, in Lambent's frame: that in which the latitude-longitude map of OpenEXR (its centre
/// +z, a quarter to the left +x) is MapKind::LatLong. OpenEXR's outermost pixels lie on the edges of
/// the cube, where two faces hold the same; ours are whole pixels between the edges, so that every
/// pixel is interpolated. Coverage is dropped. Nothing for other shapes than n × 6n.
std::optional<Image> cubeOfEnvmap(const Image& column);

}  // namespace lambent::image::formats
