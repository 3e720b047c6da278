// What the table of source.cpp points to: functions from a term to its light.
#pragma once

#include "lambent/sources/source.h"

namespace lambent::sources {

using Light = WithFindings<light::Environment>;

Result<Light> uniformLight(const Term& term, const SourceOptions& options);
Result<Light> discLight(const Term& term, const SourceOptions& options);
Result<Light> directionalLight(const Term& term, const SourceOptions& options);
Result<Light> cubeMap(const Term& term, const SourceOptions& options);
Result<Light> angularMap(const Term& term, const SourceOptions& options);
Result<Light> mirrorBall(const Term& term, const SourceOptions& options);

/// A file without a word before it, by its extension: a latitude-longitude map or a LIGHT.json.
/// Nothing if a light is not in files of that kind.
std::optional<Result<Light>> lightFromFile(std::string_view name, const SourceOptions& options);

}  // namespace lambent::sources
