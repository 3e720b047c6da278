// A radiance transfer texture as a file of its own, .rtt (spec/rtt.md): what a patch becomes before
// it is spread over surfaces.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "lambent/encode/encoded_field.h"
#include "lambent/report/result.h"

namespace lambent::asset {

/// Writes atomically. BadUsage for another extension than .rtt.
Status writeRtt(const encode::EncodedRtt& rtt, const std::filesystem::path& path);
/// BadInput names the file and what is wrong in it: another kind of file, a newer version, a size
/// that does not fit, a number that is not finite.
Result<encode::EncodedRtt> readRtt(const std::filesystem::path& path);
/// Whether a file begins as an .rtt does.
bool isRtt(const std::filesystem::path& path);

/// What is wrong with the shape or the numbers of an RTT, if anything.
std::optional<std::string> faultOf(const encode::EncodedRtt& rtt);

/// Positions a side, and views a side: limits for readers.
inline constexpr int kLargestRtt = 4096, kLargestViews = 64;

}  // namespace lambent::asset
