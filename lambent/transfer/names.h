// The words by which a file, a schema and a person name the enumerations.
#pragma once

#include <optional>
#include <string_view>

#include "lambent/transfer/kind.h"
#include "lambent/transfer/numbers.h"
#include "lambent/transfer/receivers.h"
#include "lambent/transfer/surface.h"

namespace lambent::transfer {

std::string_view nameOf(Kind kind);          ///< unshadowed, shadowed, interreflected
std::string_view nameOf(Albedo albedo);      ///< included, baseColor
std::string_view nameOf(Encoding encoding);  ///< float16, float32, snorm8

std::optional<Kind> kindNamed(std::string_view name);
std::optional<Albedo> albedoNamed(std::string_view name);
std::optional<Encoding> encodingNamed(std::string_view name);

/// How a layout of receivers is called: vertices, texels. What records nothing has the layout none.
std::string_view layoutOf(const Receivers& receivers);
inline constexpr std::string_view kNoLayout = "none";

}  // namespace lambent::transfer
