// The SOURCE of the command line → Environment.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "lambent/light/environment.h"
#include "lambent/report/result.h"

namespace lambent::light {

/// FILE.exr|.hdr|.png (lat-long) | LIGHT.json | uniform[:RADIANCE] |
/// disc:AZIMUTH,ELEVATION,ANGULAR_DIAMETER[,RADIANCE] (degrees; azimuth from +x towards +z), and
/// several joined by '+'. RADIANCE is one number or R/G/B.
Result<Environment> parseSource(std::string_view text);

/// LIGHT.json: {"lambent": "light", "bands": n, "coefficients": [[r, g, b], …]}, one row for each
/// coefficient in the sequence of sh::index.
Result<sh::RgbCoefficients> readLight(const std::filesystem::path& path);
Status writeLight(const sh::RgbCoefficients& light, const std::filesystem::path& path);

}  // namespace lambent::light
