// Lights that a few numbers give: uniform, disc, directional.
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "lambent/math/directions.h"
#include "lambent/sources/kinds.h"
#include "lambent/sources/numbers.h"

namespace lambent::sources {
using light::Environment;

namespace {

/// AZIMUTH,ELEVATION[,more…] with an optional colour at the end.
struct Aimed {
  Vec3 direction;
  double diameter = 0;  ///< degrees
  Rgb color = Rgb::Ones();
};

Result<Aimed> parseAimed(std::string_view term, std::string_view arguments, bool hasDiameter,
                         std::string_view colorName, std::string_view example) {
  constexpr std::array<std::string_view, 3> names = {"azimuth", "elevation", "angular diameter"};
  const std::size_t needed = hasDiameter ? 3 : 2;
  const std::vector<std::string_view> parts = split(arguments, ',');
  if (parts.size() < needed || parts.size() > needed + 1)
    return usage(term,
                 fmt::format("it takes AZIMUTH,ELEVATION{}[,{}], and has {} value{}",
                             hasDiameter ? ",ANGULAR_DIAMETER" : "", colorName,
                             arguments.empty() ? 0 : parts.size(), parts.size() == 1 ? "" : "s"),
                 example);
  std::array<double, 3> values = {};
  for (std::size_t i = 0; i < needed; ++i) {
    const std::optional<double> value = number(parts[i]);
    if (!value)
      return usage(term, fmt::format("{} '{}' is not a number", names[i], parts[i]), example);
    values[i] = *value;
  }
  // Beyond, a float does not tell directions apart.
  if (std::abs(values[0]) > 1e6)
    return usage(term, fmt::format("azimuth {} is not within -1e6 to 1e6 degrees", parts[0]),
                 example);
  if (std::abs(values[1]) > 90)
    return usage(term, fmt::format("elevation {} is not within -90 to 90 degrees", parts[1]),
                 example);
  if (hasDiameter && !(values[2] > 0 && values[2] <= 360))
    return usage(
        term,
        fmt::format("angular diameter {} is not above 0 and up to 360 degrees (for a light "
                    "without extent write directional:AZIMUTH,ELEVATION,IRRADIANCE)",
                    parts[2]),
        example);
  const Vec3d direction =
      math::directionFromAzimuthElevation(values[0] * kPi / 180, values[1] * kPi / 180);
  Aimed aimed{.direction = direction.cast<float>(), .diameter = values[2]};
  if (parts.size() > needed) {
    const std::optional<Rgb> given = color(parts[needed]);
    if (!given)
      return usage(term, fmt::format("{} '{}' {}", colorName, parts[needed], kColorRule), example);
    aimed.color = *given;
  }
  return aimed;
}

}  // namespace

Result<Light> uniformLight(const Term& term, const SourceOptions&) {
  if (!term.rest) return Light{Environment::uniform(Rgb::Ones()), {}};
  const std::optional<Rgb> radiance = color(*term.rest);
  if (!radiance)
    return usage(term.text, fmt::format("radiance '{}' {}", *term.rest, kColorRule),
                 "uniform:1 or uniform:0.2/0.3/0.5");
  return Light{Environment::uniform(*radiance), {}};
}

Result<Light> discLight(const Term& term, const SourceOptions&) {
  const Result<Aimed> aimed = parseAimed(term.text, term.rest.value_or(""), true, "RADIANCE",
                                         "disc:45,60,30 or disc:45,60,0.53,2e4/1.9e4/1.7e4");
  if (!aimed) return aimed.error();
  return Light{Environment::disc(aimed->direction, aimed->diameter * kPi / 180, aimed->color), {}};
}

Result<Light> directionalLight(const Term& term, const SourceOptions&) {
  const Result<Aimed> aimed = parseAimed(term.text, term.rest.value_or(""), false, "IRRADIANCE",
                                         "directional:45,60 or directional:45,60,3.1");
  if (!aimed) return aimed.error();
  return Light{Environment::directional(aimed->direction, aimed->color), {}};
}

}  // namespace lambent::sources
