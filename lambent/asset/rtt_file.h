// A radiance transfer texture as a file of its own, .rtt (spec/rtt.md): what a patch becomes before
// it is spread over surfaces.
#pragma once

#include <filesystem>

#include "lambent/asset/read.h"
#include "lambent/report/result.h"
#include "lambent/transfer/field.h"

namespace lambent::asset {

/// Writes atomically. BadUsage for another extension than .rtt.
Status writeRtt(const transfer::EncodedRtt& rtt, const std::filesystem::path& path);
/// BadInput names the file and what is wrong in it: another kind of file, a newer version, a size
/// that does not fit, a number that is not finite.
Result<transfer::EncodedRtt> readRtt(const std::filesystem::path& path,
                                     const ReadOptions& options = {});
/// Whether a file begins as an .rtt does.
bool isRtt(const std::filesystem::path& path);

}  // namespace lambent::asset
