// The SOURCE of the command line → Environment.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "lambent/light/environment.h"
#include "lambent/report/finding.h"
#include "lambent/report/result.h"

namespace lambent::light {

/// FILE.exr|.hdr|.png (lat-long, 2:1) | cube:FILE | angular:FILE | ball:FILE (see image::MapKind) |
/// LIGHT.json | uniform[:RADIANCE] |
/// disc:AZIMUTH,ELEVATION,ANGULAR_DIAMETER[,RADIANCE] | directional:AZIMUTH,ELEVATION[,IRRADIANCE]
/// (degrees; azimuth from +x towards +z), and several joined by '+', which add up. RADIANCE
/// (W m⁻² sr⁻¹) and IRRADIANCE (W m⁻², on a surface that faces the light) are one number or R/G/B.
///
/// What cannot be understood is BadUsage, what is wrong with a file BadInput. Negative channels of
/// an image become 0. Channels that are NaN or infinite are repaired as image::makeRadiance does
/// and said in `findings` ("light-pixels-repaired"); without a list to say it in, such a file is
/// refused.
Result<Environment> parseSource(std::string_view text, Findings* findings = nullptr);

/// What a SOURCE is the sum of, in its sequence. A '+' in the name of a file that is there does not
/// divide.
std::vector<std::string_view> sourceTerms(std::string_view text);

/// LIGHT.json: {"lambent": "light", "bands": n, "coefficients": [[r, g, b], …]}, one row for each
/// coefficient in the sequence of sh::index, 1 … 10 bands. Other keys are passed over.
Result<sh::RgbCoefficients> readLight(const std::filesystem::path& path);
/// Atomic; every float comes back bit for bit.
Status writeLight(const sh::RgbCoefficients& light, const std::filesystem::path& path);

}  // namespace lambent::light
