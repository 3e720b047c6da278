// The sky of a moment and a place: `sky:KEY=VALUE,…` with the keys of `lambent sky`.
#include <algorithm>

#include <fmt/format.h>

#include "lambent/sky/make_sky.h"
#include "lambent/sky/sky_light.h"
#include "lambent/sky/sky_request.h"
#include "lambent/sources/kinds.h"
#include "lambent/sources/numbers.h"

namespace lambent::sources {
namespace {

constexpr std::string_view kSkyExample =
    "sky:date=2026-06-21,time=05:40,utc-offset=2,lat=46.2,lon=6.1 or sky:sun-elevation=12";

/// What is wrong with the words of a term is told with the term and an example.
Error ofTerm(const Term& term, const Error& error) {
  return error.kind == ErrorKind::BadUsage ? usage(term.text, error.message, kSkyExample) : error;
}

}  // namespace

Result<WithFindings<sky::ResolvedSky>> resolvedTerm(const Term& term) {
  const auto request = sky::parseRequest(term.rest.value_or(""));
  if (!request) return ofTerm(term, request.error());
  auto resolved = sky::resolve(*request);
  if (!resolved) return ofTerm(term, resolved.error());
  resolved->value.options.cache = sky::cacheFolder();
  return resolved;
}

Result<Light> skyLight(const Term& term, const SourceOptions& options) {
  auto resolved = resolvedTerm(term);
  if (!resolved) return resolved.error();
  auto made = sky::makeSky(resolved->value.options, options.progress);
  if (!made) return ofTerm(term, made.error());
  Light light{sky::environmentOf(made->value, resolved->value.worldFromSun),
              std::move(resolved->findings)};
  light.findings.insert(light.findings.end(), made->findings.begin(), made->findings.end());
  return light;
}

std::optional<std::string_view> atmosphereOf(std::string_view rest) {
  constexpr std::string_view kKey = "atmosphere=";
  for (std::size_t at = 0; at < rest.size();) {
    const std::size_t equals = rest.find('=', at);
    if (equals == rest.npos) return std::nullopt;
    const std::size_t end = sky::endOfRequestValue(rest, equals + 1);
    const std::string_view value = rest.substr(equals + 1, end - equals - 1);
    if (rest.substr(at, equals + 1 - at) == kKey && !sky::preset(value)) return value;
    at = end + 1;
  }
  return std::nullopt;
}

std::size_t endOfKeys(std::string_view text, std::size_t at) {
  while (true) {
    const std::size_t plus = std::min(text.find('+', at), text.size());
    const std::size_t equals = text.find('=', at);
    if (equals > plus) return plus;
    const std::size_t end = sky::endOfRequestValue(text, equals + 1);
    if (end == text.size() || text[end] == '+') return end;
    at = end + 1;
  }
}

}  // namespace lambent::sources
