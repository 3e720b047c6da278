// What the page may ask for: its own files, what the person gave, and the list that tells it so.
#pragma once

#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <variant>

#include "apps/lambent/console.h"
#include "apps/lambent/reading_arguments.h"
#include "lambent/report/result.h"

namespace lambent::tool {

/// Path of the URL → a file on disk, or the bytes themselves.
using ServedFiles = std::map<std::string, std::variant<std::filesystem::path, std::string>>;

/// All files of the folder `page`, the asset and the files that `environments` (SOURCEs) name under
/// /files/, and a manifest.json that lists them before the page's own:
///
///   {"lambent": "manifest", "version": 1,
///    "assets": [{"name": "bunny.glb", "file": "files/asset.glb"}, …],
///    "environments": [{"name": "sky.exr", "source": "light/sky.exr",
///                      "files": {"light/sky.exr": "files/environment-0-0.exr"}}, …]}
///
/// `files` has an entry for each term of the source that is a file. Maps that are not in latitude
/// and longitude are resampled to that, for it is what the page reads. BadInput for an asset
/// without transfer and for what is wrong with an environment, BadUsage for one that makes no
/// sense.
Result<ServedFiles> filesToServe(const std::filesystem::path& page,
                                 const std::filesystem::path& asset,
                                 std::span<const std::string> environments,
                                 const ReadingArguments& reading, Console& console);

}  // namespace lambent::tool
