// What a file says about other files: percent-encoded relative names and data URIs.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lambent/report/result.h"

namespace lambent::scene_io {

/// RFC 4648, whitespace skipped; nothing if there is a foreign character.
std::optional<std::vector<std::byte>> decodeBase64(std::string_view text);

bool isDataUri(std::string_view uri);

/// The bytes behind a URI of the file `base`: a data URI's own, or a regular file beside `base`.
/// `what` names the thing in messages ("buffer 0").
Result<std::vector<std::byte>> readUri(const std::string& uri, const std::filesystem::path& base,
                                       const std::string& what);

}  // namespace lambent::scene_io
