// LIGHT.json: a light as harmonics, in a file that a person can read.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "lambent/report/result.h"
#include "lambent/sh/coefficients.h"

namespace lambent::light {

/// {"lambent": "light", "bands": n, "coefficients": [[r, g, b], …]}, one row for each coefficient
/// in the sequence of sh::index, 1 … 10 bands. Other keys are passed over.
Result<sh::RgbCoefficients> readLight(const std::filesystem::path& path);
/// The same from memory; `name` stands in messages for the file.
Result<sh::RgbCoefficients> parseLight(std::string_view json, const std::string& name);
/// Atomic; every float comes back bit for bit.
Status writeLight(const sh::RgbCoefficients& light, const std::filesystem::path& path);

}  // namespace lambent::light
