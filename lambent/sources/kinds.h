// What the table of source.cpp points to: functions from a term to its light.
#pragma once

#include "lambent/sources/source.h"

namespace lambent::sources {

using Light = WithFindings<light::Environment>;

Result<Light> uniformLight(const Term& term, const SourceOptions& options);
Result<Light> discLight(const Term& term, const SourceOptions& options);
Result<Light> directionalLight(const Term& term, const SourceOptions& options);
Result<Light> latLongMap(const Term& term, const SourceOptions& options);
Result<Light> cubeMap(const Term& term, const SourceOptions& options);
Result<Light> angularMap(const Term& term, const SourceOptions& options);
Result<Light> mirrorBall(const Term& term, const SourceOptions& options);
Result<Light> skyLight(const Term& term, const SourceOptions& options);
/// Its request, resolved.
Result<WithFindings<sky::ResolvedSky>> resolvedTerm(const Term& term);

/// The file among the keys of a sky, if one of them names one.
std::optional<std::string_view> atmosphereOf(std::string_view rest);
/// Where KEY=VALUE,… that begins at `at` ends: at a '+' that is no sign, in no exponent and in no
/// name of a file that is there, or with the text.
std::size_t endOfKeys(std::string_view text, std::size_t at);

/// A file without a word before it, by its extension: a latitude-longitude map or a LIGHT.json.
/// Nothing if a light is not in files of that kind.
std::optional<Result<Light>> lightFromFile(std::string_view name, const SourceOptions& options);

}  // namespace lambent::sources
