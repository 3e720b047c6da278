// The words by which a file, a schema and a person name the enumerations.
#pragma once

#include <optional>
#include <string_view>

#include "lambent/encode/encoded_field.h"

namespace lambent::asset {

inline constexpr std::string_view kExtensionName = "LAMBENT_radiance_transfer";
/// The format's own version, in every file. A reader takes any minor version of its major one.
inline constexpr int kFormatMajor = 1, kFormatMinor = 2;

std::string_view nameOf(transport::TransferKind kind);  ///< unshadowed, shadowed, interreflected
std::string_view nameOf(transport::Layout layout);      ///< none, vertices, texels
std::string_view nameOf(transport::Albedo albedo);      ///< included, baseColor
std::string_view nameOf(encode::Encoding encoding);     ///< float16, float32, snorm8

std::optional<transport::TransferKind> transferKindNamed(std::string_view name);
std::optional<transport::Layout> layoutNamed(std::string_view name);
std::optional<transport::Albedo> albedoNamed(std::string_view name);
std::optional<encode::Encoding> encodingNamed(std::string_view name);

}  // namespace lambent::asset
