#include "lambent/image/exr_stated.h"

#include <OpenEXR/ImfEnvmap.h>
#include <OpenEXR/ImfIntAttribute.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>

#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>

namespace lambent::image::formats {
namespace {

using radiometry::Primaries;

std::string textOf(const Imf::Header& header, const char* attribute) {
  const auto* const text = header.findTypedAttribute<Imf::StringAttribute>(attribute);
  return text ? text->value() : "";
}

/// The name of a colour space, by OpenEXR's attribute for it or by OpenImageIO's.
std::string colourSpaceOf(const Imf::Header& header) {
  for (const char* attribute : {"colorInteropID", "oiio:ColorSpace"})
    if (std::string text = textOf(header, attribute); !text.empty()) return text;
  return {};
}

/// Whether the name of a colour space says that its numbers are encoded for a screen.
bool isEncoded(std::string_view space) {
  for (const std::string_view begin : {"srgb_", "g18_", "g22_", "g24_", "g26_", "pq_", "hlg_"})
    if (space.starts_with(begin)) return true;
  return space == "sRGB" || space == "Rec709" || space.starts_with("GammaCorrected");
}

Vec2d point(const Imath::V2f& v) {
  return {v.x, v.y};
}

/// A direction of OpenEXR's frame in ours and back: a quarter turn about +y.
Imath::V3f envmapFromWorld(const Vec3d& d) {
  return {static_cast<float>(-d.z()), static_cast<float>(d.y()), static_cast<float>(d.x())};
}

/// Bilinear between the pixels of one face, whose rows begin at `top`.
Rgb between(const Image& column, float x, float y, int top) {
  const int n = column.width;
  const int x0 = std::clamp(static_cast<int>(x), 0, n - 1);
  const int y0 = std::clamp(static_cast<int>(y), top, top + n - 1);
  const int x1 = std::min(x0 + 1, n - 1), y1 = std::min(y0 + 1, top + n - 1);
  const float u = std::clamp(x - float(x0), 0.0f, 1.0f), v = std::clamp(y - float(y0), 0.0f, 1.0f);
  return (column.at(x0, y0) * (1 - u) + column.at(x1, y0) * u) * (1 - v) +
         (column.at(x0, y1) * (1 - u) + column.at(x1, y1) * u) * v;
}

}  // namespace

std::optional<Primaries> statedPrimaries(const Imf::Header& header, std::string_view name,
                                         Findings& findings) {
  if (Imf::hasChromaticities(header)) {
    const Imf::Chromaticities& c = Imf::chromaticities(header);
    Primaries stated{point(c.red), point(c.green), point(c.blue), point(c.white)};
    // Colours that are to look grey, where they are not the white of the primaries.
    if (Imf::hasAdoptedNeutral(header) && !isNear(stated, radiometry::xyzPrimaries()))
      findings.push_back(
          {Severity::Note, "colour-neutral",
           fmt::format("{}: states an adopted neutral of ({:.4f}, {:.4f}); white of its "
                       "primaries stays white, and it is not used",
                       name, Imf::adoptedNeutral(header).x, Imf::adoptedNeutral(header).y),
           1, true});
    if (radiometry::rec709From(stated)) return stated;
    findings.push_back(
        {Severity::Warning, "colour-primaries",
         fmt::format("{}: the primaries that it states span no triangle; its colours are "
                     "taken as mixtures of those of Rec. 709",
                     name),
         1, true});
    return std::nullopt;
  }
  const auto* const aces = header.findTypedAttribute<Imf::IntAttribute>("acesImageContainerFlag");
  if (aces && aces->value() == 1) return radiometry::primariesNamed("ACES2065-1");
  const std::string space = colourSpaceOf(header);
  if (space.empty()) return std::nullopt;
  if (isEncoded(space))
    findings.push_back(
        {Severity::Warning, "colour-not-linear",
         fmt::format("{}: says that its colour space is {}; numbers of OpenEXR files are "
                     "taken as linear: if these are encoded, colours come out wrong; save "
                     "it linear",
                     name, space),
         1, true});
  return radiometry::primariesNamed(space);
}

std::optional<MapKind> statedMap(const Imf::Header& header) {
  if (!Imf::hasEnvmap(header)) return std::nullopt;
  return Imf::envmap(header) == Imf::ENVMAP_CUBE ? MapKind::Cube : MapKind::LatLong;
}

void tellUnused(const Imf::Header& header, std::string_view name, Findings& findings) {
  if (Imf::hasWhiteLuminance(header) && Imf::whiteLuminance(header) != 1.0f)
    findings.push_back({Severity::Note, "white-luminance",
                        fmt::format("{}: states that white is {:g} cd/m²; its numbers are taken as "
                                    "radiances (W m⁻² sr⁻¹) as they are",
                                    name, Imf::whiteLuminance(header)),
                        1, true});
  if (std::abs(header.pixelAspectRatio() - 1.0f) > 1e-3f)
    findings.push_back(
        {Severity::Note, "pixel-aspect",
         fmt::format("{}: states that its pixels are {:g} times as wide as high; the "
                     "picture is not stretched",
                     name, header.pixelAspectRatio()),
         1, true});
}

std::optional<Image> cubeOfEnvmap(const Image& column) {
  const int n = column.width;
  if (n <= 0 || column.height != 6 * n) return std::nullopt;
  const Imath::Box2i window(Imath::V2i(0, 0), Imath::V2i(n - 1, 6 * n - 1));
  const MapShape shape{MapKind::Cube, n, 6 * n};
  Image cube(n, 6 * n);
  for (int y = 0; y < cube.height; ++y)
    for (int x = 0; x < n; ++x) {
      const Vec3d direction = *directionOf(shape, {x + 0.5, y + 0.5});
      Imf::CubeMapFace face;
      Imath::V2f inFace;
      Imf::CubeMap::faceAndPixelPosition(envmapFromWorld(direction), window, face, inFace);
      const Imath::V2f at = Imf::CubeMap::pixelPosition(face, window, inFace);
      cube.at(x, y) = between(column, at.x, at.y, int(face) * n);
    }
  return cube;
}

}  // namespace lambent::image::formats
