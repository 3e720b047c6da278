// file: URIs, as desktops name files.
#pragma once

#include <filesystem>
#include <string_view>

#include "lambent/report/result.h"

namespace lambent::file {

/// The file of a URI as RFC 8089 has it: `file:///home/a%20b`, also with this machine's name as
/// `localhost`, or `file:/home/a`. BadInput, with what to do: another scheme, another machine, a name
/// that is not absolute, a % without two hexadecimal digits, a byte 0.
Result<std::filesystem::path> pathOfUri(std::string_view uri);

}  // namespace lambent::file
