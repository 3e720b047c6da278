// The SOURCE of the command line and of view states → Environment. A kind of light is one row of a
// table: its word, how it is written, and the function that makes it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lambent/light/environment.h"
#include "lambent/report/finding.h"
#include "lambent/report/progress.h"
#include "lambent/report/result.h"
#include "lambent/sky/sky_request.h"

namespace lambent::sources {

struct SourceOptions {
  /// What becomes of an image with channels that are NaN or infinite: it is refused, or repaired as
  /// image::makeRadiance does, with a finding ("light-pixels-repaired").
  enum class NotFinite { Refuse, Repair };
  NotFinite notFinite = NotFinite::Refuse;
  /// Bytes that reading a file may take; nothing: as much as one of its size may need (see
  /// file/budget.h).
  std::optional<std::uint64_t> memoryLimit = {};
  /// Asked while the tables of a sky are made, which takes seconds the first time.
  Progress progress = {};
};

/// FILE.exr|.hdr|.png|.jpg|.webp (lat-long, 2:1, or what an .exr says it is) | latlong:FILE (any size) |
/// cube:FILE | angular:FILE | ball:FILE (see image::MapKind), each FILE.exr:LAYER for a layer or part |
/// LIGHT.json | uniform[:RADIANCE] |
/// disc:AZIMUTH,ELEVATION,ANGULAR_DIAMETER[,RADIANCE] | directional:AZIMUTH,ELEVATION[,IRRADIANCE]
/// (degrees; azimuth from +x towards +z) | sky:KEY=VALUE,… (see sky/sky_request.h: dome, Sun and
/// ground of a moment and a place), and several joined by '+', which add up. RADIANCE
/// (W m⁻² sr⁻¹) and IRRADIANCE (W m⁻², on a surface that faces the light) are one number or R/G/B.
///
/// What cannot be understood is BadUsage, what is wrong with a file BadInput. Negative channels of
/// an image become 0 ("light-pixels-negative"), and one made for a screen is no whole light
/// ("light-not-hdr"); what image::readPicture finds is told too.
Result<WithFindings<light::Environment>> parseSource(std::string_view text,
                                                     const SourceOptions& options = {});

/// The sky of a SOURCE, without what makes light of it: for its air. BadUsage: no term of it is a sky,
/// or more than one is; and as parseSource().
Result<WithFindings<sky::ResolvedSky>> resolvedSky(std::string_view text);

/// What a SOURCE is the sum of, in its sequence. A '+' in the name of a file that is there does not
/// divide.
std::vector<std::string_view> sourceTerms(std::string_view text);

/// One term of a sum: "disc:45,60,30" has the rest "45,60,30", and "uniform" has none.
struct Term {
  std::string_view text;
  std::optional<std::string_view> rest;
};

struct SourceKind {
  enum class Takes { Numbers, File, Keys };
  std::string_view word;    ///< what stands before the colon
  std::string_view syntax;  ///< "disc:AZIMUTH,ELEVATION,ANGULAR_DIAMETER[,RADIANCE]"
  std::string_view help;    ///< a line for a person
  Takes takes;              ///< of what the rest is
  Result<WithFindings<light::Environment>> (*make)(const Term&, const SourceOptions&);
};

/// All that have a word.
std::span<const SourceKind> sourceKinds();
/// The kind whose word a term begins with; null if the term is the name of a file.
const SourceKind* kindOf(std::string_view term);

/// FILE.exr:LAYER in two; a file that has such a name is one. A layer's name has no '+'.
struct PictureName {
  std::filesystem::path path;
  std::string layer;  ///< or empty
};
PictureName pictureNameOf(std::string_view name);

/// The files that one term names: a map, a LIGHT.json, the atmosphere of a sky.
std::vector<std::filesystem::path> filesOf(std::string_view term);

/// "SOURCE of light:" and a line or two for each of its forms.
std::string sourceHelp();

}  // namespace lambent::sources
